#pragma once
#include <span>
#include <vector>

#include "core/base/pack.hpp"
#include "core/base/parallel.hpp"

namespace bulbus::inline mesh {

/// Exchange between owned nodes and their ghost copies on other ranks, `width` numbers per node.
class Halo {
 public:
  struct Neighbour {
    int rank;
    std::vector<int> send;     ///< owned local nodes that are ghosts there
    std::vector<int> receive;  ///< ghost local nodes that are owned there, in the order it sends them
  };

  Halo(const Comm& comm, std::vector<Neighbour> neighbours)
      : comm_(comm), neighbours_(std::move(neighbours)) {}

  /// Ghost update: ghosts take the owners' values. Collective.
  void update_ghosts(std::span<double> v, int width = 3) const;
  /// Ghost accumulation: ghosts' values are added to the owners'; the ghosts' are left as they are.
  /// Collective.
  void accumulate_ghosts(std::span<double> v, int width = 3) const;
  void update_ghosts(std::span<float> v, int width) const;
  void update_ghosts(std::span<NodeSingle> v) const;
  void accumulate_ghosts(std::span<NodeSingle> v) const;
  const std::vector<Neighbour>& neighbours() const { return neighbours_; }

 private:
  Comm comm_;
  std::vector<Neighbour> neighbours_;
};

}  // namespace bulbus::inline mesh
