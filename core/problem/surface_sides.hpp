#pragma once
#include <array>
#include <set>
#include <string>
#include <unordered_map>

#include "core/mesh/mesh.hpp"
#include "core/mesh/sorted.hpp"

namespace bulbus::inline problem {

/// The regions on either side of the faces of some surfaces.
class SurfaceSides {
 public:
  SurfaceSides(const Mesh& mesh, const std::set<std::string>& surfaces);
  /// Indices of Mesh::region_names; the second is −1 on the boundary.
  const std::array<int, 2>& of(const Quad& face) const { return regions_.at(sorted(face)); }

 private:
  struct Hash {
    std::size_t operator()(const Quad& q) const;
  };
  std::unordered_map<Quad, std::array<int, 2>, Hash> regions_;
};

/// Faces that two surfaces have in common.
int common_faces(const Mesh& mesh, const std::string& a, const std::string& b);

}  // namespace bulbus::inline problem
