// What a Problem makes of mesh and model before the first step.
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/problem/closed_surface.hpp"
#include "core/problem/problem.hpp"
#include "core/problem/validate.hpp"

namespace bulbus {
namespace {

// Mean place of a region's nodes in the Mesh, on the symmetry planes where there are any: the same on every rank.
Vec3<double> center_of(const Mesh& mesh, const std::string& region, std::span<const std::string> symmetry) {
  Vec3<double> center{0, 0, 0};
  const auto nodes = nodes_of_region(mesh, region_index(mesh, region));
  for (int n : nodes)
    for (int c = 0; c < 3; ++c) center[c] += mesh.points[n][c] / static_cast<double>(nodes.size());
  for (const std::string& s : symmetry) center[axis_of(s)] = 0;
  return center;
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

// The symmetry planes that cut a region: one beside it mirrors it, but holds nothing.
std::vector<std::string> planes_through(const Mesh& mesh, const std::string& region, std::span<const std::string> symmetry) {
  const double tolerance = mesh_tolerance(mesh);
  std::vector<std::string> planes;
  for (const std::string& s : symmetry)
    if (std::ranges::any_of(nodes_of_region(mesh, region_index(mesh, region)), [&](int n) { return std::abs(mesh.points[n][axis_of(s)]) <= tolerance; })) planes.push_back(s);
  return planes;
}

}  // namespace

void Problem::build_bodies_and_solid(const Mesh& mesh) {
  std::vector<RigidBody> bodies;
  std::vector<SolidRegion> regions;
  std::vector<bool> rigid_node(mesh_.nodes());
  std::vector<Hex> hexes;
  for (std::size_t r = 0; r < mesh_.regions.size(); ++r) {
    const std::string& name = mesh_.region_names[r];
    const RegionSpec& spec = model_.regions.at(name);
    if (!spec.rigid) {
      const auto& run = mesh_.regions[r];
      regions.push_back({name, make_material(terms_of(spec)), run.first, run.count});
      continue;
    }
    const auto planes = planes_through(mesh, name, model_.symmetry);
    auto nodes = mesh_.local(nodes_of_region(mesh, static_cast<int>(r)));  // ghosts too of which this rank has no hexahedron
    for (int n : nodes) {
      if (rigid_node[n])
        throw scene_error("regions." + name, "rigid region '" + name + "' shares nodes with another rigid region",
                          "Give both one name, or let the tissue between them deform.");
      rigid_node[n] = true;
    }
    bodies.emplace_back(name, std::move(nodes), center_of(mesh, name, planes), free_motions(planes));
  }
  solid_ = std::make_unique<Solid>(mesh_.X, mesh_.hexes, regions);
  dofs_ = std::make_unique<DofMap>(mesh_, std::move(bodies));
  for (const SolidRegion& r : solid_->regions()) {
    auto nodes = mesh_.local(nodes_of_region(mesh, region_index(mesh, r.name)));
    std::erase_if(nodes, [&](int n) { return n >= mesh_.owned || rigid_node[n]; });
    // forces of a strain of 1e-7 on the faces of the region's hexahedra: rounded places leave strains of 1e-14 in thin cells, and a
    // softer region feels those of its neighbour
    double areas = 0;
    for (int h = r.first; h < r.first + r.count; ++h) areas += std::pow(solid_->reference_volumes()[h], 4.0 / 3);
    region_floor_.push_back(1e-7 * initial_shear_modulus(r.material) * std::sqrt(comm().sum(areas)));
    region_nodes_.push_back(std::move(nodes));
  }
}

void Problem::build_liquids(const Mesh& mesh) {
  for (const auto& [name, spec] : model_.liquids) {
    const auto& faces = mesh.surfaces.at(spec.surface);
    require_closed(mesh, faces, model_.symmetry, spec.surface, "liquids." + name + ".surface");
    Point low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300}, x0;
    for (const Quad& q : faces)
      for (int n : q)
        for (int c = 0; c < 3; ++c) {
          low[c] = std::min(low[c], mesh.points[n][c]);
          high[c] = std::max(high[c], mesh.points[n][c]);
        }
    for (int c = 0; c < 3; ++c) x0[c] = (low[c] + high[c]) / 2;
    for (const std::string& s : model_.symmetry) x0[axis_of(s)] = 0;  // the missing cap then contributes nothing
    liquids_.emplace_back(name, PressureSurface(mesh_.surfaces.at(spec.surface)), x0, spec.K, comm());
    const double V = liquids_.back().volume(mesh_.X);
    const double box = (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]);
    if (!(V > 1e-9 * box))
      throw scene_error("liquids." + name + ".surface",
                        "liquid '" + name + "' has no volume: surface '" + spec.surface + "' encloses " + std::to_string(V) + " mm3",
                        "The surface must bound the solid towards the liquid (normals are taken from the hexahedra), with the "
                        "liquid inside.");
    liquids_.back().set_scale(V);
  }
}

void Problem::build_bars() {
  for (const auto& [name, spec] : model_.bars)
    bars_[name] = std::make_shared<BarsTerm>(Bars(mesh_.X, mesh_.bars.at(name), spec.E, spec.area, spec.tension_only));
}

void Problem::hold_fixed() {
  const auto zero = [](double) { return 0.0; };
  double size = 0;
  for (double v : mesh_.X) size = std::max(size, std::abs(v));
  const double tolerance = 1e-9 * comm().max(size);
  for (const std::string& plane : model_.symmetry) {
    const int c = axis_of(plane);
    Vec3<double> normal{0, 0, 0};
    normal[c] = 1;
    std::vector<Hold> holds;
    for (int n = 0; n < mesh_.nodes(); ++n)
      if (std::abs(mesh_.X[3 * n + c]) <= tolerance) holds.push_back({n, normal, zero});
    dofs_->hold("0 symmetry " + plane, std::move(holds));
  }
  for (const FixSpec& fix : model_.fix)
    for (const std::string& d : fix.directions) {
      Vec3<double> normal{0, 0, 0};
      normal[axis_of(d)] = 1;
      std::vector<Hold> holds;
      for (int n : nodes_of(fix.set)) holds.push_back({n, normal, zero});
      dofs_->hold("1 " + fix.set + "/" + d, std::move(holds));
    }
  dofs_->build();
}

}  // namespace bulbus
