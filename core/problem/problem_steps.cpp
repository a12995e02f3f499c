// How a step changes loads, holds and liquids.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/did_you_mean.hpp"
#include "core/base/error.hpp"
#include "core/mesh/faces.hpp"
#include "core/problem/closed_surface.hpp"
#include "core/problem/enclosed_parts.hpp"
#include "core/problem/formula.hpp"
#include "core/problem/problem.hpp"
#include "core/problem/set_motion.hpp"

namespace bulbus::inline problem {
namespace {

Vec3<double> unit(Vec3<double> v) {
  const double length = norm(v);
  for (double& c : v) c /= length;
  return v;
}

std::string step_key(int step, const std::string& rest) {
  return "steps." + std::to_string(step) + "." + rest;
}

// Vectors of any length along one line, and against it, replace one another.
std::string line_along(const Vec3<double>& v) {
  Vec3<double> d = unit(v);
  const auto first = std::ranges::find_if(d, [](double c) { return std::abs(c) > 1e-9; });
  const double sign = *first < 0 ? -1 : 1;
  for (double& c : d) c = std::abs(c) > 1e-9 ? sign * c : 0;
  return fmt::format("{:.9g} {:.9g} {:.9g}", d[0], d[1], d[2]);
}

// Displacement of one node along n over the step: numbers are approached linearly, formulas taken as they
// stand.
std::function<double(double)> course(std::shared_ptr<Formula> f, Vec3<double> X, double start,
                                     bool from_start, int step) {
  if (f->constant()) {
    const double end = (*f)(X, 1, step + 1) + (from_start ? start : 0);
    return [=](double s) { return start + (end - start) * s; };
  }
  return [=](double s) { return (*f)(X, s, step + s) + (from_start ? start : 0); };
}

// Size of a load or pressure over the step.
std::function<double(double)> ramp(std::shared_ptr<Formula> f, double start, int step) {
  const Vec3<double> origin{0, 0, 0};
  f->require_uniform();
  f->require_finite(origin, step);
  if (f->constant())
    return [=, end = (*f)(origin, 1, step + 1)](double s) { return start + (end - start) * s; };
  return [=](double s) { return (*f)(origin, s, step + s); };
}

// Faces of a surface with normals out of a region that has each of them on one side; its hexahedron may be
// another rank's, but that of a face's other side is then this one's.
std::vector<Quad> faces_towards(const LocalMesh& mesh, const std::string& surface,
                                const std::string& region) {
  const auto& run = mesh.regions[std::ranges::find(mesh.region_names, region) - mesh.region_names.begin()];
  const std::vector<Hex> hexes(mesh.hexes.begin() + run.first, mesh.hexes.begin() + run.first + run.count);
  const FaceTable table(hexes), of_all(mesh.hexes);
  std::vector<Quad> faces = mesh.surfaces.at(surface);
  for (Quad& q : faces)
    if (const int face = table.first(q); face >= 0) {
      q = face_nodes(hexes, face);
    } else {
      const Quad other = face_nodes(mesh.hexes, of_all.first(q));
      q = {other[3], other[2], other[1], other[0]};
    }
  return faces;
}

// Bodies, contacts and sutures are drawn where the mesh is drawn: in an unloaded reference parts may overlap
// that its loads hold apart.
State as_drawn(const LocalMesh& mesh, State state) {
  state.x = mesh.drawn;
  return state;
}

// Whether a load of this name is a pressure on the surface, or on one side of it.
bool presses(const std::string& load, const std::string& surface) {
  return load == "surface " + surface || load.starts_with("surface " + surface + "\n");
}

void build_dofs(DofMap& dofs, int step) {
  try {
    dofs.build();
  } catch (const InputError& fault) {
    throw InputError(fault.what(), "steps." + std::to_string(step) + ".displace");
  }
}

}  // namespace

// What liquids have is known where the steps before have been solved, not in a rehearsal.
void Problem::begin_step(int step, const State& start) {
  begin(step, start, &Term::begin_step);
  for (const auto& [name, volume] : model_.steps[step].add) {
    const std::string key = step_key(step, "add." + name);
    const double there = multiplicity_ * liquids_[liquid_index(name, key)].at_start();
    if (there + volume <= 0)
      throw scene_error(
          key,
          fmt::format("{:g} mm3 are drained from liquid '{}', which has {:.6g} mm3", -volume, name, there),
          "Drain less than there is.");
  }
}

void Problem::begin(int step, const State& start, void (Term::*begin_term)(int, const State&)) {
  const StepSpec& spec = model_.steps.at(step);
  step_ = step;
  fading_.clear();
  comm().together([&] {
    release(spec, step);
    for (std::size_t i = 0; i < spec.displace.size(); ++i)
      add_displacement(spec.displace[i], step, static_cast<int>(i), start);
    build_dofs(*dofs_, step);
    if (!follows_) require_free_elements();
    for (std::size_t i = 0; i < spec.loads.size(); ++i) add_load(spec.loads[i], step, static_cast<int>(i));
  });
  if (!follows_) find_enclosed(step, start);
  begin_liquids(spec, step, start);
  const auto begin_terms = [&](const State& seen) {
    for (const auto& term : terms()) (term.get()->*begin_term)(step, seen);
  };
  if (step == 0 && !mesh_.drawn.empty())
    begin_terms(as_drawn(mesh_, start));
  else
    begin_terms(start);
  if (coarser_) coarser_->begin(step, coarsened(start), begin_term);
  s_ = 0;
}

void Problem::add_displacement(const DisplaceSpec& spec, int step, int index, const State& start) {
  const std::string where = step_key(step, "displace." + std::to_string(index));
  const auto nodes = nodes_of(spec.set);
  const bool from_start = spec.from == "start";
  // `key`: of the formula; `made`: of the displacement that it counts, what the start of the step has
  const auto along = [&](const std::string& what, const std::string& key, const std::string& text,
                         auto direction, auto made) {
    auto formula = std::make_shared<Formula>(text, where + "." + key);
    std::vector<Constraint> constraints;
    for (int n : nodes) {
      const Vec3<double> d = direction(n), drawn = at(mesh_.drawn_places(), n);
      formula->require_finite(drawn, step);
      const double done = dot(d, minus(at(start.x, n), at(mesh_.X, n))), before = made(n, done);
      constraints.push_back(
          {n, d, [value = course(formula, drawn, before, from_start, step), rest = done - before](double s) {
             return value(s) + rest;
           }});
    }
    dofs_->constrain("2 " + spec.set + "/" + what, std::move(constraints));
  };
  const auto all = [](int, double done) { return done; };
  for (const auto& [name, text] : {std::pair{"x", &spec.x}, {"y", &spec.y}, {"z", &spec.z}})
    if (*text)
      along(
          name, name, **text,
          [c = axis_of(name)](int) {
            Vec3<double> d{0, 0, 0};
            d[c] = 1;
            return d;
          },
          all);
  if (spec.radial) {
    RadialHold& hold = radial_holds_[spec.set] = {spec, {}};
    along(
        "radial", "radial", *spec.radial,
        [&](int n) {
          const Vec3<double> r = from_axis(spec, at(start.x, n));
          if (!(norm(r) > 0))
            throw scene_error(where + ".radial",
                              "a node of '" + spec.set + "' lies on the axis: it has no radial direction",
                              "Take it out of the set.");
          return hold.directions.emplace_back(n, unit(r)).second;
        },
        // a set that has turned about the axis is as far from it as before
        [&](int n, double) {
          return norm(from_axis(spec, at(start.x, n))) - norm(from_axis(spec, at(mesh_.X, n)));
        });
  }
  if (spec.by)
    along(
        "along " + line_along(spec.along), "by", *spec.by, [&](int) { return unit(spec.along); }, all);
  if (!spec.affine && !spec.rotate && !spec.translate) return;
  // whole motions: u(s) for all three directions; affine from the reference, rigid from the start of the step
  const auto motion = [spec](const Vec3<double>& X, const Vec3<double>& x, double s) {
    if (!spec.affine) return minus(rigidly_moved(spec, x, s), X);
    const Vec3<double> end = minus(affine_image(spec, X), X);
    Vec3<double> u = minus(x, X);
    for (int c = 0; c < 3; ++c) u[c] += s * (end[c] - u[c]);
    return u;
  };
  for (int c = 0; c < 3; ++c) {
    Vec3<double> d{0, 0, 0};
    d[c] = 1;
    std::vector<Constraint> constraints;
    for (int n : nodes)
      constraints.push_back(
          {n, d, [=, X = at(mesh_.X, n), x = at(start.x, n)](double s) { return motion(X, x, s)[c]; }});
    dofs_->constrain("2 " + spec.set + "/" + std::string(1, static_cast<char>('x' + c)),
                     std::move(constraints));
  }
}

// An element whose nodes are all constrained cannot keep its volume by itself: its pressure would be
// undetermined.
void Problem::require_free_elements() const {
  for (const SolidRegion& r : solid_->regions())
    for (int h = r.first; h < r.first + r.count; ++h) {
      const Hex& hex = mesh_.hexes[h];
      if (!std::ranges::all_of(hex, [&](int n) { return dofs_->fully_constrained(n); })) continue;
      throw scene_error("steps." + std::to_string(step_),
                        "over-constrained: all eight nodes of hexahedron " +
                            std::to_string(mesh_.input_hex[h] + 1) + " (region '" + r.name +
                            "') are constrained in all directions, so its pressure is undetermined",
                        "Leave at least one of its nodes free, or declare the region rigid.");
    }
}

void Problem::find_enclosed(int step, const State& start) {
  enclosed_ = std::make_shared<EnclosedParts>(*this, start, step);
  for (const std::string& sentence : enclosed_->sentences())
    if (std::ranges::find(warnings_, sentence) == warnings_.end()) warnings_.push_back(sentence);
}

// The two sides of a surface between regions have pressures of their own. A load that names its region
// replaces one that did not have to, and the other way round.
std::string Problem::pressure_name(const LoadSpec& spec) {
  const std::string whole = "surface " + spec.surface;
  if (spec.region.empty()) {
    const auto one =
        std::ranges::find_if(loads_, [&](const auto& load) { return presses(load.first, spec.surface); });
    return one == loads_.end() ? whole : one->first;
  }
  const std::string name = whole + "\n" + spec.region;
  if (auto old = loads_.extract(whole)) {
    old.key() = name;
    loads_.insert(std::move(old));
  }
  return name;
}

// A pressure that acts otherwise than the one it replaces grows from nothing while that one fades.
void Problem::add_pressure(const LoadSpec& spec, const std::string& key, int step) {
  const auto formula = std::make_shared<Formula>(*spec.pressure, key);
  const auto [x, y, z] = spec.direction;
  const std::string name = pressure_name(spec),
                    acts = fmt::format("{} {} {} {} {}", spec.dead, x, y, z, spec.region);
  const auto old = loads_.contains(name) ? loads_[name] : nullptr;
  const bool alike = old && old->acts == acts;
  const auto value = ramp(formula, alike ? old->end() : 0, step);
  const auto faces =
      spec.region.empty() ? mesh_.surfaces.at(spec.surface) : faces_towards(mesh_, spec.surface, spec.region);
  std::shared_ptr<Load> load;
  if (spec.dead)
    load = std::make_shared<DeadLoad>(std::vector<double>{},
                                      dead_pressure_pattern(mesh_.X, faces, spec.direction), value);
  else
    load = std::make_shared<FollowerPressure>(PressureSurface(faces), value, false);
  load->acts = acts;
  loads_[name] = load;
  if (!old || alike || !formula->constant()) return;
  old->fade();
  fading_.push_back(old);
}

void Problem::add_load(const LoadSpec& spec, int step, int index) {
  const std::string where = step_key(step, "loads." + std::to_string(index));
  if (spec.pressure) add_pressure(spec, where + ".pressure", step);
  if (spec.force) {
    std::vector<double> pattern(mesh_.X.size());
    for (int n : nodes_of(spec.set))
      if (n < mesh_.owned)
        for (int c = 0; c < 3; ++c) pattern[3 * n + c] = (*spec.force)[c];
    auto& load = loads_["force " + spec.set];
    std::vector<double> before;
    if (const auto* old = dynamic_cast<const DeadLoad*>(load.get())) {
      before = old->at_end();
      for (std::size_t i = 0; i < pattern.size(); ++i) pattern[i] -= before[i];
    }
    load = std::make_shared<DeadLoad>(std::move(before), std::move(pattern), [](double s) { return s; });
  }
}

int Problem::liquid_index(const std::string& name, const std::string& key) const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < liquids_.size(); ++i) {
    if (liquids_[i].name() == name) return static_cast<int>(i);
    names.push_back(liquids_[i].name());
  }
  throw scene_error(key, "there is no liquid '" + name + "'",
                    did_you_mean(name, names, "Name one under `liquids`."));
}

void Problem::begin_liquids(const StepSpec& spec, int step, const State& start) {
  for (const auto& [name, pressure] : spec.pressures) {
    const std::string key = step_key(step, "pressures." + name);
    const int i = liquid_index(name, key);
    liquids_[i].prescribe_pressure(ramp(std::make_shared<Formula>(pressure, key), start.P[i], step));
  }
  for (const std::string& name : spec.enclose) {
    const int i = liquid_index(name, step_key(step, "enclose"));
    if (spec.pressures.contains(name))
      throw scene_error(step_key(step, "pressures." + name),
                        "liquid '" + name +
                            "' is enclosed in this step: its pressure is an unknown, and the "
                            "one given would be passed over",
                        "Give the pressure in a step before, or take the liquid out of `enclose`.");
    if (!liquids_[i].enclosed()) liquids_[i].enclose(liquids_[i].volume(start.x), start.P[i]);
  }
  for (const auto& [name, volume] : spec.add) {
    const std::string key = step_key(step, "add." + name);
    const int i = liquid_index(name, key);
    if (!liquids_[i].enclosed())
      throw scene_error(
          key,
          "liquid '" + name +
              "' is not enclosed in this step: its pressure is given, so adding volume means nothing",
          "List it under `enclose`.");
    liquids_[i].add(volume / multiplicity_);
  }
}

void Problem::release(const StepSpec& spec, int step) {
  for (const std::string& name : spec.release) {
    const auto acts_on = [&](const auto& load) {
      return load.first == "force " + name || presses(load.first, name);
    };
    bool found = std::erase_if(loads_, acts_on) > 0;
    for (const char* what : {"x", "y", "z", "radial", "along"})
      found |= dofs_->release("2 " + name + "/" + what);
    if (!found)
      throw scene_error(step_key(step, "release"),
                        "nothing is prescribed on '" + name + "', so nothing can be released",
                        "Name a set of an earlier `displace` or `loads`.");
  }
}

}  // namespace bulbus::inline problem
