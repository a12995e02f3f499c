#pragma once
#include <map>
#include <tuple>
#include <vector>

#include "core/mesh/abaqus/abaqus_model.hpp"

namespace bulbus::inline mesh {

/// Finds indices by labels, which need not be contiguous.
class AbaqusLabels {
 public:
  AbaqusLabels() = default;
  explicit AbaqusLabels(const std::vector<int>& labels);
  /// −1 if there is none.
  int find(int label) const;
  /// The two indices of the least label that appears twice, (−1, −1) if there is none.
  std::pair<int, int> twins() const;
  /// Appends the indices of a range; labels that do not exist are passed over. Returns the first of these, or
  /// 0.
  int append(const AbaqusRange& range, std::vector<int>& found) const;

 private:
  std::vector<std::pair<int, int>> sorted_;  ///< label, index
};

/// Turns the sets of an input file into nodes and hexahedra of all its instances, one instance behind the
/// other.
class AbaqusResolver {
 public:
  enum class Kind { nodes, elements };
  static constexpr int assembly = -1;

  /// Refuses labels that appear twice.
  explicit AbaqusResolver(const AbaqusModel& model);

  const AbaqusPart& part(int instance) const { return model_.parts[copies_[instance].part]; }
  const AbaqusLabels& nodes(int instance) const { return labels_[copies_[instance].part].nodes; }
  int first_node(int instance) const { return copies_[instance].first_node; }
  int first_hex(int instance) const { return copies_[instance].first_hex; }
  int instances() const { return static_cast<int>(copies_.size()); }
  /// The element that became a hexahedron.
  const AbaqusPart::Element& element(int hex) const;

  /// Sorted. `instance` is the scope of the name, or `assembly`. Refuses names and labels that are not there.
  const std::vector<int>& set(Kind kind, int instance, const std::string& name, const AbaqusPlace& asked);
  std::vector<int> of(Kind kind, int instance, const AbaqusMembers& members);

 private:
  struct Labels {
    AbaqusLabels nodes, elements;
  };
  struct Copy {
    int part, first_node, first_hex;
  };
  struct Known {
    std::vector<int> members;
    bool whole = false;  ///< not under way
  };
  const Copy& copy_of(int hex) const;
  int instance_named(const std::string& name, const AbaqusPlace& asked) const;
  int part_named(const AbaqusInstance& instance) const;
  void append(Kind kind, int instance, const AbaqusMembers& members, std::vector<int>& found);

  const AbaqusModel& model_;
  std::vector<Labels> labels_;  ///< per part
  std::vector<Copy> copies_;    ///< per instance
  std::map<std::tuple<Kind, int, std::string>, Known> known_;
  int depth_ = 0;
};

}  // namespace bulbus::inline mesh
