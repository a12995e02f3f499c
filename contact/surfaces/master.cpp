#include "contact/surfaces/master.hpp"

#include <algorithm>

#include "contact/surfaces/normal_projection.hpp"
#include "core/base/sort_unique.hpp"

namespace bulbus::inline contact {

Master::Master(Facets faces) : faces_(std::move(faces)), piece_(faces_.triangles.size()) {
  for (const auto& t : faces_.triangles) nodes_.insert(nodes_.end(), t.begin(), t.end());
  sort_unique(nodes_);
  for (auto& t : faces_.triangles)
    for (int& n : t) n = static_cast<int>(std::ranges::lower_bound(nodes_, n) - nodes_.begin());
  mirror(std::vector<std::array<bool, 3>>(nodes_.size()));
}

void Master::mirror(std::vector<std::array<bool, 3>> components) {
  if (!surface_) node_normals_.emplace(faces_, std::move(components));
}

Master::Master(std::shared_ptr<const RigidSurface> surface, std::span<const std::string> symmetry)
    : surface_(std::move(surface)),
      edges_(surface_->facets, surface_->places, SharpEdges::Kind::convex, symmetry),
      hollows_(surface_->facets, surface_->places, SharpEdges::Kind::concave, symmetry),
      pieces_(std::max(1, static_cast<int>(surface_->parts.size()))),
      piece_(surface_->facets.triangles.size()) {
  for (std::size_t k = 0; k < surface_->parts.size(); ++k)
    std::fill_n(piece_.begin() + surface_->parts[k].first_triangle, surface_->parts[k].triangles,
                static_cast<int>(k));
}

std::vector<double> Master::places(const State& state) const {
  if (surface_) return surface_->places;
  std::vector<double> places;
  places.reserve(3 * nodes_.size());
  for (int n : nodes_) places.insert(places.end(), &state.x[3 * n], &state.x[3 * n] + 3);
  return places;
}

MasterSurface Master::at(const State& state) const {
  if (surface_) {
    if (!spheres_ || spheres_after_ != moves())
      spheres_ = std::make_shared<const EnclosingSpheres>(facets(), surface_->places),
      spheres_after_ = moves();
    return {facets(), surface_->places, surface_->normals, spheres_};
  }
  struct Shape {
    std::vector<double> places;
    std::vector<CornerNormals> normals;
  };
  const auto now = std::make_shared<Shape>(Shape{places(state), {}});
  now->normals = node_normals_->at_corners(now->places);
  MasterSurface faces(facets(), now->places, now->normals);
  faces.edges = false, faces.rim = fading_rim, faces.shape = now;
  return faces;
}

}  // namespace bulbus::inline contact
