// What a Problem makes of mesh and model before the first step.
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/mesh/distributed/bounds.hpp"
#include "core/problem/closed_surface.hpp"
#include "core/problem/fibre_directions.hpp"
#include "core/problem/problem.hpp"
#include "core/problem/region_material.hpp"

namespace bulbus::inline problem {
namespace {

// Mean place of some nodes, on the symmetry planes where there are any: the same on every rank.
Vec3<double> center_of(const LocalMesh& mesh, std::span<const int> nodes,
                       std::span<const std::string> symmetry) {
  Vec3<double> center{0, 0, 0};
  const auto owned = std::ranges::count_if(nodes, [&](int n) { return n < mesh.owned; });
  const auto all = static_cast<double>(mesh.comm.sum(static_cast<long long>(owned)));
  for (int n : nodes)
    if (n < mesh.owned)
      for (int c = 0; c < 3; ++c) center[c] += mesh.X[3 * n + c] / all;
  mesh.comm.sum(center);
  for (const std::string& s : symmetry) center[axis_of(s)] = 0;
  return center;
}

// A length by which rounding can be told from a distance: 1e-9 of the mesh's size.
double tolerance_of(const LocalMesh& mesh) {
  double size = 0;
  for (double v : mesh.X) size = std::max(size, std::abs(v));
  return 1e-9 * mesh.comm.max(size);
}

// A body cut by a symmetry plane may neither leave it nor tilt out of it.
std::array<bool, 6> free_motions(std::span<const std::string> symmetry) {
  std::array<bool, 6> free{true, true, true, true, true, true};
  for (const std::string& s : symmetry) {
    const int c = axis_of(s);
    free[c] = free[3 + (c + 1) % 3] = free[3 + (c + 2) % 3] = false;
  }
  return free;
}

// The symmetry planes that have a node of a region: one beside it mirrors it, but holds nothing.
std::vector<std::string> planes_through(const LocalMesh& mesh, std::span<const int> nodes,
                                        std::span<const std::string> symmetry) {
  const double tolerance = tolerance_of(mesh);
  std::vector<std::string> planes;
  for (const std::string& s : symmetry)
    if (mesh.comm.any(std::ranges::any_of(
            nodes, [&](int n) { return std::abs(mesh.X[3 * n + axis_of(s)]) <= tolerance; })))
      planes.push_back(s);
  return planes;
}

// Middle of the box around the nodes of faces of all ranks, and its volume.
struct Box {
  Point middle;
  double volume = 1;
};

Box box_of(const LocalMesh& mesh, std::span<const Quad> faces) {
  std::vector<double> corners;
  for (const Quad& q : faces)
    for (int n : q) corners.insert(corners.end(), &mesh.X[3 * n], &mesh.X[3 * n] + 3);
  const Bounds bounds = bounds_of(mesh.comm, corners);
  Box box;
  for (int c = 0; c < 3; ++c) {
    box.middle[c] = (bounds.high[c] + bounds.low[c]) / 2;
    box.volume *= bounds.sides()[c];
  }
  return box;
}

// Throws InputError where two rigid regions share a node of this rank.
void mark_rigid_nodes(const LocalMesh& mesh, const Model& model, std::vector<bool>& rigid) {
  for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
    const std::string& name = mesh.region_names[r];
    if (!model.regions.at(name).rigid) continue;
    for (int n : mesh.region_nodes[r]) {
      if (rigid[n])
        throw scene_error("regions." + name,
                          "rigid region '" + name + "' shares nodes with another rigid region",
                          "Give both one name, or let the tissue between them deform.");
      rigid[n] = true;
    }
  }
}

}  // namespace

void Problem::build_bodies_and_solid() {
  solid_.reset();
  std::vector<RigidBody> bodies;
  std::vector<SolidRegion> regions;
  std::vector<bool> rigid_node(mesh_.nodes());
  std::vector<Hex> hexes;
  mesh_.comm.together([&] { mark_rigid_nodes(mesh_, model_, rigid_node); });
  for (std::size_t r = 0; r < mesh_.regions.size(); ++r) {
    const std::string& name = mesh_.region_names[r];
    const RegionSpec& spec = model_.regions.at(name);
    if (!spec.rigid) {
      const auto& run = mesh_.regions[r];
      regions.push_back({name, material_of(spec), run.first, run.count});
      if (spec.fibres)
        mesh_.comm.together([&] {
          regions.back().directions =
              fibre_directions(*spec.fibres, "regions." + name + ".fibres", mesh_.drawn_places(),
                               std::span(mesh_.hexes).subspan(run.first, run.count));
        });
      continue;
    }
    const auto& nodes = mesh_.region_nodes[r];  // ghosts too of which this rank has no hexahedron
    const auto planes = planes_through(mesh_, nodes, model_.symmetry);
    bodies.emplace_back(name, nodes, center_of(mesh_, nodes, planes), free_motions(planes));
  }
  solid_ = std::make_shared<const Solid>(mesh_.X, mesh_.hexes, regions);
  dofs_ = std::make_unique<DofMap>(mesh_, std::move(bodies));
  build_floors();
}

// Nodes beside a region a hundred times stiffer are judged with that alone: its forces neither hide the
// balance of the softer one nor disturb it by what rounding leaves of them.
void Problem::build_floors() {
  constexpr double much_stiffer = 100;
  const auto nodes_of_region = [&](const std::string& name) -> const std::vector<int>& {
    return mesh_.region_nodes[std::ranges::find(mesh_.region_names, name) - mesh_.region_names.begin()];
  };
  region_nodes_.clear();
  region_floor_.clear();
  std::vector<double> stiffest(mesh_.nodes());  // shear moduli of the regions around each node
  for (const SolidRegion& r : solid_->regions())
    for (int n : nodes_of_region(r.name))
      stiffest[n] = std::max(stiffest[n], initial_shear_modulus(r.material));
  std::vector<double> around(
      dofs_->bodies().size());  // largest floor of the regions that a body is joined to
  for (const SolidRegion& r : solid_->regions()) {
    const double modulus = initial_shear_modulus(r.material);
    // forces of a strain of 1e-7 on the faces of the region's hexahedra, since rounded positions leave
    // strains of 1e-14 in thin cells
    double areas = 0;
    for (int h = r.first; h < r.first + r.count; ++h)
      areas += std::pow(solid_->reference_volumes()[h], 4.0 / 3);
    region_floor_.push_back(1e-7 * modulus * std::sqrt(comm().sum(areas)));
    std::vector<int> nodes = nodes_of_region(r.name);
    for (int n : nodes)
      if (const int b = dofs_->body_of(n); b >= 0) around[b] = std::max(around[b], region_floor_.back());
    std::erase_if(nodes, [&](int n) {
      return n >= mesh_.owned || dofs_->body_of(n) >= 0 || stiffest[n] > much_stiffer * modulus;
    });
    region_nodes_.push_back(std::move(nodes));
  }
  comm().max(around);
  // one that only contact, bars or a liquid hold is joined to none
  const double least = region_floor_.empty() ? 1e-300 : std::ranges::min(region_floor_);
  body_floor_.clear();
  for (double floor : around) body_floor_.push_back(floor > 0 ? floor : least);
}

void Problem::build_liquids() {
  liquids_.clear();
  for (const auto& [name, spec] : model_.liquids) {
    const auto& faces = mesh_.surfaces.at(spec.surface);
    const Box box = box_of(mesh_, faces);
    Point x0 = box.middle;
    for (const std::string& s : model_.symmetry)
      x0[axis_of(s)] = 0;  // the missing cap then contributes nothing
    liquids_.emplace_back(name, PressureSurface(faces), x0, spec.K, comm());
    const double V = liquids_.back().volume(mesh_.X);
    if (!(V > 1e-9 * box.volume))
      throw scene_error("liquids." + name + ".surface",
                        "liquid '" + name + "' has no volume: surface '" + spec.surface + "' encloses " +
                            std::to_string(V) + " mm3",
                        "The surface must bound the solid towards the liquid (normals are taken from the "
                        "hexahedra), with the "
                        "liquid inside.");
    liquids_.back().set_scale(V);
  }
}

void Problem::build_bars() {
  for (const auto& [name, spec] : model_.bars)
    bars_[name] =
        std::make_shared<BarsTerm>(Bars(mesh_.X, mesh_.bars.at(name), spec.E, spec.area, spec.tension_only));
}

void Problem::hold_fixed() {
  const auto zero = [](double) { return 0.0; };
  const double tolerance = tolerance_of(mesh_);
  for (const std::string& plane : model_.symmetry) {
    const int c = axis_of(plane);
    Vec3<double> normal{0, 0, 0};
    normal[c] = 1;
    std::vector<Constraint> constraints;
    for (int n = 0; n < mesh_.nodes(); ++n)
      if (std::abs(mesh_.X[3 * n + c]) <= tolerance) constraints.push_back({n, normal, zero});
    dofs_->constrain("0 symmetry " + plane, std::move(constraints));
  }
  for (const FixSpec& fix : model_.fix)
    for (const std::string& d : fix.directions) {
      Vec3<double> normal{0, 0, 0};
      normal[axis_of(d)] = 1;
      std::vector<Constraint> constraints;
      for (int n : nodes_of(fix.set)) constraints.push_back({n, normal, zero});
      dofs_->constrain("1 " + fix.set + "/" + d, std::move(constraints));
    }
  dofs_->build();
}

}  // namespace bulbus::inline problem
