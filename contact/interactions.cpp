#include "contact/interactions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ranges>
#include <set>

#include "contact/elastic_bands.hpp"
#include "contact/rigid/rigid_shapes.hpp"
#include "contact/surfaces/layer.hpp"
#include "contact/suture/suture_points.hpp"
#include "contact/suture/sutured_tissue.hpp"
#include "core/base/did_you_mean.hpp"
#include "core/base/error.hpp"
#include "core/mesh/distributed/bounds.hpp"
#include "core/problem/region_material.hpp"

namespace bulbus::inline contact {
namespace {

// Default α_A in shear moduli per thickness: a pressure of a quarter of the modulus lets in 1/120 of the
// layer.
constexpr double stiffness_ratio = 30;
// Default reach in diagonals of the model: a larger one finds triangles that no point comes to, beyond a
// smaller one more increments have to widen the search.
constexpr double part_of_size = 0.03;
constexpr double out_of_sight =
    1e5;  // diagonals of the model: gaps to places beyond lose half of their digits
constexpr double farthest_gap = 0.25;  // the same of the gaps reported

double diagonal(const LocalMesh& mesh) {
  return norm(bounds_of(mesh.comm, std::span(mesh.X).first(3 * mesh.owned)).sides());
}

double shear_modulus(const Mesh& mesh, const Model& model, const Layer& layer) {
  double mu = 0;
  for (int r : layer.regions) {
    const RegionSpec& spec = model.regions.at(mesh.region_names[r]);
    if (!spec.rigid) mu = std::max(mu, initial_shear_modulus(material_of(spec)));
  }
  return mu;
}

using std::views::keys;

void refuse_out_of_sight(const RigidSurface& body, double farthest, const std::string& key) {
  double most = 0;
  for (double x : body.reference) most = std::max(most, std::abs(x));
  if (!(most <= farthest))
    throw scene_error(key,
                      fmt::format("rigid body '{}' reaches {:.3g} mm from the origin, beyond {:g} diagonals "
                                  "of the mesh: contact there has no digits",
                                  body.name, most, out_of_sight),
                      "Give its sizes and position in mm, or in another unit that is named.");
}

// A body that a step brings to touch is out of reach until then.
void keep_away(RigidMotion& motion, const RigidSurface& body, const MoveSpec& move, double distance) {
  auto poses = motion.poses();
  for (std::size_t p = 0; p < poses.size(); ++p) {
    const bool shifts = move.close == 0 && move.shorten == 0 && norm(move.translate) > 0;
    const Vec3<double> d = shifts ? move.translate : body.parts[p].inwards;
    const double length = norm(d);
    for (int c = 0; c < 3; ++c) poses[p].shift[c] -= length > 0 ? distance * d[c] / length : 0;
  }
  motion.set_poses(std::move(poses));
}

struct FirstMove {
  std::size_t step = 0;
  const MoveSpec* move = nullptr;
  bool from_touch() const { return move && move->from == "touch"; }
};

FirstMove first_move(const Model& model, const std::string& body) {
  for (std::size_t k = 0; k < model.steps.size(); ++k)
    for (const MoveSpec& move : model.steps[k].move)
      if (move.body == body) return {k, &move};
  return {};
}

void check_sewing(const Model& model) {
  for (std::size_t k = 0; k < model.steps.size(); ++k)
    for (const auto& [name, force] : model.steps[k].sew) {
      const std::string key = fmt::format("steps.{}.sew.{}", k, name);
      const auto suture = model.sutures.find(name);
      if (suture == model.sutures.end())
        throw scene_error(key, "there is no suture '" + name + "'",
                          did_you_mean(name, keys(model.sutures), "Describe it under `sutures`."));
      if (force < 0)
        throw scene_error(key, fmt::format("a string pulls, it cannot push with {:g} N", -force),
                          "Give a force of 0 or more.");
      const std::string& body = suture->second.body;
      if (const FirstMove first = first_move(model, body); force > 0 && first.from_touch() && first.step > k)
        throw scene_error(
            key,
            fmt::format(
                "the string is drawn over '{}', which is kept away until step {} brings it `from: touch`",
                body, first.step + 1),
            "Sew in that step or later, or draw the body where it touches and leave `from: touch` out.");
    }
}

// A plane of no given size reaches past the model on all sides, wherever its point is: the sheet covers a
// circle of half its size.
RigidBodySpec sized(RigidBodySpec spec, const Mesh& base) {
  if (!spec.plane || spec.plane->size) return spec;
  const double length = norm(spec.plane->normal);
  double farthest = 0;  // of the model's nodes from the point, along the plane
  for (const Point& X : base.points) {
    const Vec3<double> r = minus(X, spec.plane->point);
    farthest = std::max(farthest, norm(cross(r, spec.plane->normal)) / (length > 0 ? length : 1));
  }
  spec.plane->size = std::max({usual_plane, 2 * diagonal(base), 2 * std::numbers::sqrt2 * farthest});
  return spec;
}

}  // namespace

std::shared_ptr<Interactions> Interactions::attach(Problem& problem, const Mesh& base) {
  std::shared_ptr<Interactions> interactions(new Interactions(problem, base));
  if (!interactions->bodies_.empty() || !interactions->contacts_.empty()) problem.add(interactions);
  for (const Contact& c : interactions->contacts_) {
    problem.add(c.term);
    if (c.exchanged) problem.add(c.exchanged);
    if (c.middles) problem.add(c.middles);
  }
  for (const auto& [name, suture] : interactions->sutures_) problem.add(suture);
  if (auto bands = std::make_shared<ElasticBands>(problem, *interactions); !bands->empty())
    problem.add(bands);
  return interactions;
}

Interactions::Interactions(Problem& problem, const Mesh& base) : problem_(problem) {
  const Model& model = problem.model();
  const double farthest = out_of_sight * diagonal(problem.mesh());
  problem.comm().together([&] {
    for (const auto& [name, spec] : model.rigid_bodies) {
      bodies_[name] = std::make_shared<RigidSurface>(
          make_rigid_surface(name, sized(spec, base), "rigid_bodies." + name, model.symmetry));
      refuse_out_of_sight(*bodies_[name], farthest, "rigid_bodies." + name);
      motions_.emplace(name, bodies_[name]);
    }
    for (std::size_t k = 0; k < model.steps.size(); ++k) {
      std::set<std::string> moved;
      for (std::size_t i = 0; i < model.steps[k].move.size(); ++i) {
        const std::string& body = model.steps[k].move[i].body;
        const std::string key = fmt::format("steps.{}.move.{}.body", k, i);
        if (!bodies_.contains(body))
          throw scene_error(key, "there is no rigid body '" + body + "'",
                            did_you_mean(body, keys(bodies_), "Describe it under `rigid_bodies`."));
        if (!moved.insert(body).second)
          throw scene_error(
              key, "the rigid body '" + body + "' is moved twice in one step: only one motion would count",
              "Put both into one motion (`translate`, `rotate` and `close` go together), or into two steps.");
      }
    }
    check_sewing(model);
  });
  for (std::size_t i = 0; i < model.contacts.size(); ++i)
    add_contact(base, model.contacts[i], "contacts." + std::to_string(i));
  for (const auto& [name, spec] : model.sutures) add_suture(name, spec);
  for (auto& [name, motion] : motions_)
    if (const FirstMove first = first_move(model, name); first.from_touch())
      keep_away(motion, *bodies_[name], *first.move, 2 * diagonal(problem.mesh()));
}

void Interactions::add_contact(const Mesh& base, const ContactSpec& spec, const std::string& key) {
  const LocalMesh& local = problem_.mesh();
  const Model& model = problem_.model();
  for (const Contact& other : contacts_)
    if (other.spec.name == spec.name)
      throw scene_error(key + ".name", "two contacts are named '" + spec.name + "'",
                        "Give each its own name.");
  const auto body = bodies_.find(spec.master);
  const auto under = [&](const std::string& surface) {
    return layer_under(base, base.surfaces.at(surface), local.refinements, problem_.comm());
  };
  Layer layer = under(spec.slave);
  double mu = shear_modulus(base, model, layer), thickness = layer.thickness,
         compliance = mu > 0 ? 1 / (4 * mu) : 0;
  if (body == bodies_.end()) {
    layer = under(spec.master);
    if (const double other = shear_modulus(base, model, layer); other > 0)
      mu = mu > 0 ? std::min(mu, other) : other, compliance += 1 / (4 * other);
    thickness = std::min(thickness, layer.thickness);
  }
  if (spec.penalty == 0 && mu == 0)
    throw scene_error(
        key + ".penalty",
        "contact '" + spec.name + "' is between rigid sides only: no stiffness to choose its penalty from",
        "Give `penalty`, in MPa/mm.");
  const double usual = stiffness_ratio * mu / thickness, penalty = spec.penalty > 0 ? spec.penalty : usual;
  const ContactDefaults defaults{usual, thickness / 2, mu, compliance > 0 ? 1 / compliance : 0,
                                 part_of_size * diagonal(local)};
  Contact c{spec,
            make_term(spec, defaults, key),
            {},
            {},
            body == bodies_.end() ? nullptr : body->second,
            penalty,
            thickness,
            farthest_gap * diagonal(local)};
  if (spec.two_way) {
    ContactSpec back = spec;
    std::swap(back.slave, back.master);
    back.name += " (exchanged)";
    c.exchanged = make_term(back, defaults, key);
  } else if (spec.divisions == 0) {
    c.middles =
        std::make_shared<MidfaceCheck>(spec, defaults, sides_of(spec), problem_.comm(), local.halo, c.term);
  }
  contacts_.push_back(std::move(c));
}

ContactSides Interactions::sides_of(const ContactSpec& spec) const {
  const LocalMesh& local = problem_.mesh();
  const auto body = bodies_.find(spec.master);
  return {local.X, local.owned, local.shared.at(spec.slave),
          body == bodies_.end() ? Master(split(local.shared.at(spec.master), local.X))
                                : Master(body->second, problem_.model().symmetry),
          problem_.model().symmetry};
}

std::shared_ptr<ContactTerm> Interactions::make_term(const ContactSpec& spec, const ContactDefaults& defaults,
                                                     const std::string& key) const {
  const auto term = std::make_shared<ContactTerm>(spec, defaults, sides_of(spec), problem_.comm());
  if (problem_.comm().sum(static_cast<int>(term->slave().nodes().size())) == 0)
    throw scene_error(key + ".slave",
                      "contact '" + spec.name + "' has no slave nodes: all nodes of '" + spec.slave +
                          "' are nodes of '" + spec.master + "' too",
                      "Give the two sides nodes of their own.");
  return term;
}

void Interactions::add_suture(const std::string& name, const SutureSpec& spec) {
  const std::string key = "sutures." + name;
  const auto body = bodies_.find(spec.body);
  if (body == bodies_.end())
    throw scene_error(key + ".body", "there is no rigid body '" + spec.body + "'",
                      did_you_mean(spec.body, keys(bodies_), "Describe it under `rigid_bodies`."));
  std::vector<SuturePoint> points;
  const SuturedTissue tissue = sutured_tissue(problem_.mesh(), spec);
  problem_.comm().together(
      [&] { points = suture_points(tissue.mesh, spec, problem_.model().symmetry, key); });
  for (SuturePoint& p : points)
    for (int& n : p.nodes) n = tissue.input[n];
  for (const SuturePoint& p : points) {
    suture_places_[name].push_back(p.place);
    for (int n : problem_.mesh().local(p.nodes)) bites_[name].push_back(n);
  }
  sutures_[name] = std::make_shared<SutureTerm>(problem_.mesh(), points, body->second, spec, key);
}

const Interactions::Contact& Interactions::contact(const std::string& name, const std::string& key) const {
  std::vector<std::string> names;
  for (const Contact& c : contacts_) {
    if (c.spec.name == name) return c;
    names.push_back(c.spec.name);
  }
  throw scene_error(key, "there is no contact '" + name + "'",
                    did_you_mean(name, names, "Describe it under `contacts`."));
}

const SutureTerm& Interactions::suture(const std::string& name, const std::string& key) const {
  if (const auto found = sutures_.find(name); found != sutures_.end()) return *found->second;
  throw scene_error(key, "there is no suture '" + name + "'",
                    did_you_mean(name, keys(sutures_), "Describe it under `sutures`."));
}

std::vector<const Interactions::Contact*> Interactions::contacts_on(const std::string& body,
                                                                    const std::string& key) const {
  if (!bodies_.contains(body))
    throw scene_error(key, "there is no rigid body '" + body + "'",
                      did_you_mean(body, keys(bodies_), "Describe it under `rigid_bodies`."));
  std::vector<const Contact*> found;
  for (const Contact& c : contacts_)
    if (c.spec.master == body) found.push_back(&c);
  if (found.empty())
    throw scene_error(key, "no contact has the rigid body '" + body + "' for its master",
                      "Describe one under `contacts`.");
  return found;
}

// All points that may touch a body, of all ranks.
SlavePlaces Interactions::slaves_of(const std::string& body, const State& state) const {
  SlavePlaces mine;
  for (const Contact& c : contacts_) {
    if (c.spec.master != body) continue;
    std::ranges::copy(c.term->outermost(state), std::back_inserter(mine.points));
    for (const Vec3<double>& n : c.term->normals(state))
      std::ranges::copy(n, std::back_inserter(mine.normals));
  }
  const Comm& comm = problem_.comm();
  return {comm.gather(std::span<const double>(mine.points)),
          comm.gather(std::span<const double>(mine.normals))};
}

void Interactions::start_contacts(const State& start) {
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& c = contacts_[i];
    if (c.spec.start == "resolve") {
      c.term->resolve(start);
      if (c.exchanged) c.exchanged->resolve(start);
      if (c.middles) c.middles->resolve(start);
      continue;
    }
    Overlap o = of_all_ranks(c.term->overlaps(start, 1e-4 * c.thickness), problem_.comm());
    if (o.points == 0 && c.exchanged)
      o = of_all_ranks(c.exchanged->overlaps(start, 1e-4 * c.thickness), problem_.comm());
    if (o.points > 0)
      throw scene_error(
          fmt::format("contacts.{}", i),
          fmt::format("contact '{}' starts with {} of its points inside '{}', the deepest by {:.3g} mm at "
                      "({:.4g}, {:.4g}, {:.4g})",
                      c.spec.name, o.points, c.spec.master, o.depth, o.place[0], o.place[1], o.place[2]),
          "Draw the two apart, or say `start: resolve`.");
  }
}

void Interactions::begin_step(int step, const State& start) {
  const StepSpec& spec = problem_.model().steps.at(step);
  for (std::size_t i = 0; i < spec.move.size(); ++i) {
    MoveSpec move = spec.move[i];
    const auto& band = problem_.model().rigid_bodies.at(move.body).band;
    if (band && band->stiffness > 0) move.shorten = 0;  // its radius is found
    motions_.at(move.body).begin(move, slaves_of(move.body, start), fmt::format("steps.{}.move.{}", step, i));
  }
  for (const auto& [name, force] : spec.sew) sutures_.at(name)->sew(force);
  set_progress(0);
  if (step == 0) start_contacts(start);
}

void Interactions::set_progress(double s) {
  for (auto& [name, motion] : motions_) motion.set_progress(s);
}

void Interactions::freeze() {
  for (auto& [name, motion] : motions_) motion.freeze();
}

void Interactions::serialize(Archive& archive) {
  for (auto& [name, motion] : motions_) motion.serialize(archive);
}

}  // namespace bulbus::inline contact
