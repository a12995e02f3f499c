// Rigid motions that nothing prevents: the null space of all holds and bars on the rigid motions of the
// mesh's parts.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <span>

#include "core/base/dense.hpp"
#include "core/base/disjoint_sets.hpp"
#include "core/base/error.hpp"
#include "core/base/tensor.hpp"
#include "core/mesh/faces.hpp"
#include "core/mesh/geometry.hpp"
#include "core/problem/closed_surface.hpp"
#include "core/problem/set_motion.hpp"
#include "core/problem/validate.hpp"

namespace bulbus::inline problem {
namespace {

using Vector = std::vector<double>;

// Parts are hexahedra that are joined by faces. Nodes of several parts, along an edge or at a corner, move
// with each of them; bars alone do not join.
struct Parts {
  std::vector<int> of_node;  // the first one; -1 for nodes of bars only
  struct Joint {
    int node, part;  // another part of a node
  };
  std::vector<Joint> joints;
  std::vector<std::string> name;
  std::vector<Vec3<double>> center;
  std::vector<double> size;
};

Parts find_parts(const Mesh& mesh) {
  DisjointSets sets(static_cast<int>(mesh.hexes.size()));
  const FaceTable faces(mesh.hexes);
  for (int f = 0; f < 6 * static_cast<int>(mesh.hexes.size()); ++f)
    sets.join(f / 6, faces.first(face_nodes(mesh.hexes, f)) / 6);
  Parts parts;
  std::set<std::pair<int, int>> more;
  parts.of_node.assign(mesh.points.size(), -1);
  std::map<int, int> number;
  std::vector<int> of_hex;
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
    const int r = sets.root(static_cast<int>(h));
    const auto [entry, fresh] = number.emplace(r, static_cast<int>(number.size()));
    of_hex.push_back(entry->second);
    const std::string& region = mesh.region_names[mesh.region[h]];
    if (fresh)
      parts.name.push_back(region);
    else if (std::string& name = parts.name[entry->second];
             ("+" + name + "+").find("+" + region + "+") == std::string::npos)
      name += "+" + region;
    for (int n : mesh.hexes[h])
      if (int& first = parts.of_node[n]; first < 0)
        first = entry->second;
      else if (first != entry->second)
        more.emplace(n, entry->second);
  }
  for (const auto& [node, part] : more) parts.joints.push_back({node, part});
  const std::size_t count = parts.name.size();
  parts.center.assign(count, {0, 0, 0});
  parts.size.assign(count, 0);
  std::vector<double> corners(count);
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
    for (int n : mesh.hexes[h]) {
      Vec3<double>& center = parts.center[of_hex[h]];
      center = center + mesh.points[n];
      ++corners[of_hex[h]];
    }
  for (std::size_t p = 0; p < count; ++p)
    for (double& c : parts.center[p]) c /= corners[p];
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
    for (int n : mesh.hexes[h]) {
      double& size = parts.size[of_hex[h]];
      size = std::max(size, norm(minus(mesh.points[n], parts.center[of_hex[h]])));
    }
  return parts;
}

// Adds the row of weight · (d · displacement of the node) in terms of the shift and (scaled) spin of part p.
void add_row(const Mesh& mesh, const Parts& parts, int p, int node, const Vec3<double>& d, double weight,
             Vector& row) {
  if (p < 0) return;
  Vec3<double> r = minus(mesh.points[node], parts.center[p]);
  for (double& c : r) c /= parts.size[p];
  const Vec3<double> moment = cross(r, d);
  for (int c = 0; c < 3; ++c) row[6 * p + c] += weight * d[c], row[6 * p + 3 + c] += weight * moment[c];
}

class Constraints {
 public:
  Constraints(const Mesh& mesh, const Parts& parts)
      : mesh_(mesh), parts_(parts), size_(6 * parts.name.size()), gram_(size_ * size_) {}

  void constrain(int node, const Vec3<double>& d) {
    Vector row(size_);
    add_row(mesh_, parts_, parts_.of_node[node], node, d, 1, row);
    add(row);
  }
  void add(const Parts::Joint& joint) {
    for (int c = 0; c < 3; ++c) {
      Vec3<double> d{0, 0, 0};
      d[c] = 1;
      Vector row(size_);
      add_row(mesh_, parts_, parts_.of_node[joint.node], joint.node, d, 1, row);
      add_row(mesh_, parts_, joint.part, joint.node, d, -1, row);
      add(row);
    }
  }
  void add(const Bar& bar) {
    Vec3<double> d{0, 0, 0};
    for (const auto& [end, sign] : {std::pair{&bar.a, -1.0}, std::pair{&bar.b, 1.0}})
      for (int i = 0; i < 4; ++i)
        for (int c = 0; c < 3; ++c) d[c] += sign * end->weights[i] * mesh_.points[end->nodes[i]][c];
    const double length = norm(d);
    for (double& c : d) c /= length;
    Vector row(size_);
    for (const auto& [end, sign] : {std::pair{&bar.a, -1.0}, std::pair{&bar.b, 1.0}})
      for (int i = 0; i < 4; ++i)
        if (end->weights[i] != 0)
          add_row(mesh_, parts_, parts_.of_node[end->nodes[i]], end->nodes[i], d, sign * end->weights[i],
                  row);
    add(row);
  }
  const Vector& gram() const { return gram_; }

 private:
  // rank-one update of the touched 6×6 (or 12×12) entries only
  void add(const Vector& row) {
    std::vector<std::size_t> used;
    for (std::size_t i = 0; i < size_; ++i)
      if (row[i] != 0) used.push_back(i);
    for (std::size_t i : used)
      for (std::size_t j : used) gram_[i * size_ + j] += row[i] * row[j];
  }
  const Mesh& mesh_;
  const Parts& parts_;
  std::size_t size_;
  Vector gram_;  // size_ × size_
};

// What is prescribed in a step: what steps before it prescribed and none has released.
std::vector<DisplaceSpec> held_in(const Model& model, std::size_t step) {
  std::vector<DisplaceSpec> held;
  for (std::size_t k = 0; k <= step; ++k) {
    for (const std::string& name : model.steps[k].release)
      std::erase_if(held, [&](const DisplaceSpec& d) { return d.set == name; });
    held.insert(held.end(), model.steps[k].displace.begin(), model.steps[k].displace.end());
  }
  return held;
}

void add_holds(const Mesh& mesh, const Model& model, std::size_t step, Constraints& constraints) {
  const auto unit = [](int c) {
    Vec3<double> d{0, 0, 0};
    d[c] = 1;
    return d;
  };
  const double tolerance = mesh_tolerance(mesh);
  for (const std::string& s : model.symmetry)
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
      if (std::abs(mesh.points[n][axis_of(s)]) <= tolerance)
        constraints.constrain(static_cast<int>(n), unit(axis_of(s)));
  for (const FixSpec& f : model.fix)
    for (int n : nodes_of(mesh, f.set))
      for (const std::string& d : f.directions) constraints.constrain(n, unit(axis_of(d)));
  for (const DisplaceSpec& d : held_in(model, step)) {
    const bool all = d.affine || d.rotate || d.translate;
    const bool along[3] = {all || d.x, all || d.y, all || d.z};
    for (int n : nodes_of(mesh, d.set)) {
      for (int c = 0; c < 3; ++c)
        if (along[c]) constraints.constrain(n, unit(c));
      if (d.by) constraints.constrain(n, d.along);
      if (d.radial) {
        Vec3<double> r = from_axis(d, mesh.points[n]);
        if (const double length = norm(r); length > 0) {
          for (double& c : r) c /= length;
          constraints.constrain(n, r);
        }
      }
    }
  }
}

// "shift along (0, 0, 1)" or "rotation about (0, 0, 1)", whichever is the larger part of the motion.
std::string describe(std::span<const double> motion) {
  const Vec3<double> shift{motion[0], motion[1], motion[2]}, spin{motion[3], motion[4], motion[5]};
  const bool turns = norm(spin) > norm(shift);
  Vec3<double> d = turns ? spin : shift;
  const double largest = *std::ranges::max_element(d, {}, [](double v) { return std::abs(v); });
  const double scale = std::copysign(100 / norm(d), largest);
  for (double& c : d) c = std::round(scale * c) / 100 + 0.0;  // no "-0.00"
  return fmt::format("{} ({:.2f}, {:.2f}, {:.2f})", turns ? "rotation about" : "shift along", d[0], d[1],
                     d[2]);
}

void require_supported(const Mesh& mesh, const Model& model, const Parts& parts, std::size_t step) {
  Constraints constraints(mesh, parts);
  add_holds(mesh, model, step, constraints);
  for (const auto& [name, group] : mesh.bars)
    for (const Bar& bar : group) constraints.add(bar);
  for (const Parts::Joint& joint : parts.joints) constraints.add(joint);
  const SymmetricEigen eigen = symmetric_eigen(constraints.gram());
  const double largest = std::max(eigen.values.back(), 1e-300);
  if (eigen.values.front() > 1e-9 * largest && largest > 1e-12) return;
  const auto motion = [&](int part) { return eigen.vector(0).subspan(6 * part, 6); };
  const auto square = [](std::span<const double> v) {
    return std::inner_product(v.begin(), v.end(), v.begin(), 0.0);
  };
  int worst = 0;
  for (int p = 1; p < static_cast<int>(parts.name.size()); ++p)
    if (square(motion(p)) > square(motion(worst))) worst = p;
  throw scene_error(
      step == 0 ? "fix" : fmt::format("steps.{}.release", step),
      fmt::format("under-constrained: nothing prevents a rigid motion of {} ({}), {}",
                  parts.name.size() == 1 ? "the model" : "a part of the model", parts.name[worst],
                  describe(motion(worst))),
      std::string(step == 0 ? "Constrain it with `fix`, `symmetry`, `displace` in the first step, or bars."
                            : "Keep one of the holds, or give the step another in `displace`.") +
          (parts.joints.empty() ? ""
                                : " Hexahedra that share an edge or a corner, but no face, "
                                  "turn about it: join them by faces."));
}

}  // namespace

// Once a step has released something contacts and sutures may be what holds.
void require_supported(const Mesh& mesh, const Model& model) {
  const Parts parts = find_parts(mesh);
  const bool held_otherwise = !model.contacts.empty() || !model.sutures.empty();
  for (std::size_t k = 0; k < model.steps.size(); ++k)
    if (k == 0 || (!model.steps[k].release.empty() && !held_otherwise))
      require_supported(mesh, model, parts, k);
}

}  // namespace bulbus::inline problem
