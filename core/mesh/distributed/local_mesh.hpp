#pragma once
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/mesh/distributed/halo.hpp"
#include "core/mesh/distributed/mesh_part.hpp"

namespace bulbus::inline mesh {

/// One rank's part of a mesh. Local nodes: the owned ones first, as this rank's hexahedra meet them, then
/// ghosts. Node numbers of the whole are renumbered so that each rank owns a run; hexahedra are sorted by
/// region.
struct LocalMesh {
  struct Run {
    int first = 0, count = 0;
  };

  Comm comm;
  int owned = 0;                  ///< owned nodes
  std::vector<double> X;          ///< reference positions, 3 per local node, mm
  std::vector<double> drawn;      ///< places as drawn, where X has been moved (move_reference); else empty
  std::vector<long long> number;  ///< global number of a local node
  std::vector<int> input_node;    ///< its index in the Mesh
  std::vector<int> by_input;      ///< local nodes in the order of the Mesh
  long long first_node = 0, all_nodes = 0;
  std::vector<Hex> hexes;      ///< local nodes
  std::vector<int> input_hex;  ///< index in the Mesh
  std::vector<Run> regions;    ///< hexahedra of each region of the Mesh
  long long first_hex = 0, all_hexes = 0;
  std::vector<std::string> region_names;
  std::map<std::string, std::vector<Quad>> surfaces;  ///< faces of this rank's hexahedra
  std::map<std::string, std::vector<Quad>>
      shared;  ///< all faces of surfaces that every rank asked for, in the Mesh's order
  std::map<std::string, std::vector<Bar>> bars;       ///< each bar on one rank
  std::map<std::string, std::vector<int>> input_bar;  ///< index of each in the Mesh's group
  std::map<std::string, std::vector<int>>
      sets;  ///< local nodes of every node set, and surface of no set's name
  std::vector<std::vector<int>> region_nodes;  ///< local nodes of every region
  int refinements = 0;  ///< that the Mesh is away from the one that was read or generated
  Halo halo;

  /// What coordinates of the scene refer to: formulas, suture points.
  std::span<const double> drawn_places() const { return drawn.empty() ? X : drawn; }
  int nodes() const { return static_cast<int>(input_node.size()); }
  /// Local number of a Mesh node, −1 if this rank does not hold it (owned or ghost).
  int local(int mesh_node) const;
  /// Those of the given Mesh nodes that this rank holds.
  std::vector<int> local(std::span<const int> mesh_nodes) const;
  /// Local nodes of a set, surface or region, ascending in the Mesh; null if it has none of that name.
  const std::vector<int>* nodes_of(const std::string& name) const;
  std::size_t bytes() const;
};

/// Takes what this rank is given of a part, as from part_of(). Every rank gets the nodes of the surfaces
/// `shared` at least as ghosts. Collective.
LocalMesh distribute(const Mesh& part, const Labels& whole, const Comm& comm,
                     const std::set<std::string>& shared);
/// Of a mesh that every rank has; `rank_of_hex` as from partition(). Collective.
LocalMesh distribute(const Mesh& mesh, std::span<const int> rank_of_hex, const Comm& comm,
                     const std::set<std::string>& shared = {});

}  // namespace bulbus::inline mesh
