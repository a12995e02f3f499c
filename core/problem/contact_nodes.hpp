#pragma once
#include <span>
#include <vector>

#include "core/mesh/mesh.hpp"
#include "core/problem/model.hpp"

namespace bulbus::inline problem {

/// Nodes of the two sides of every contact between deformable bodies, each sorted.
class ContactNodes {
 public:
  ContactNodes(const Mesh& mesh, const Model& model);
  /// Is the node of one side of a contact, and are all the others of its other side?
  bool join(int node, std::span<const int> others) const;

 private:
  struct Sides {
    std::vector<int> slave, master;
  };
  std::vector<Sides> contacts_;
};

}  // namespace bulbus::inline problem
