#include "core/mesh/abaqus/abaqus_resolve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/printable.hpp"

namespace bulbus::inline mesh {
namespace {

constexpr int deepest = 100;  // sets of sets of sets

std::vector<int> labels_of(const std::vector<AbaqusPart::Element>& elements) {
  std::vector<int> labels;
  labels.reserve(elements.size());
  for (const auto& e : elements) labels.push_back(e.label);
  return labels;
}

const char* word_of(AbaqusResolver::Kind kind) {
  return kind == AbaqusResolver::Kind::nodes ? "node" : "element";
}

}  // namespace

AbaqusLabels::AbaqusLabels(const std::vector<int>& labels) {
  sorted_.reserve(labels.size());
  for (int i = 0; i < static_cast<int>(labels.size()); ++i) sorted_.emplace_back(labels[i], i);
  if (!std::ranges::is_sorted(sorted_)) std::ranges::sort(sorted_);
}

int AbaqusLabels::find(int label) const {
  const auto at = std::ranges::lower_bound(sorted_, label, {}, &std::pair<int, int>::first);
  return at != sorted_.end() && at->first == label ? at->second : -1;
}

std::pair<int, int> AbaqusLabels::twins() const {
  const auto at = std::ranges::adjacent_find(sorted_, {}, &std::pair<int, int>::first);
  return at == sorted_.end() ? std::pair{-1, -1} : std::pair{at->second, (at + 1)->second};
}

int AbaqusLabels::append(const AbaqusRange& range, std::vector<int>& found) const {
  int missing = 0;
  const auto take = [&](int label) {
    if (const int at = find(label); at >= 0)
      found.push_back(at);
    else if (missing == 0)
      missing = label;
  };
  if ((static_cast<long long>(range.last) - range.first) / range.step <
      static_cast<long long>(sorted_.size())) {
    for (long long label = range.first; label <= range.last; label += range.step)
      take(static_cast<int>(label));
    return missing;
  }
  for (const auto& [label, index] : sorted_)  // a range of more labels than there are
    if (label >= range.first && label <= range.last && (label - range.first) % range.step == 0)
      found.push_back(index);
  return range.last;
}

AbaqusResolver::AbaqusResolver(const AbaqusModel& model) : model_(model) {
  for (const AbaqusPart& part : model.parts) {
    labels_.push_back({AbaqusLabels(part.labels), AbaqusLabels(labels_of(part.elements))});
    if (const auto [a, b] = labels_.back().nodes.twins(); a >= 0)
      model.fail(part.places[b], fmt::format("node {} appears twice", part.labels[b]),
                 "give every node a number of its own");
    if (const auto [a, b] = labels_.back().elements.twins(); a >= 0)
      model.fail(part.elements[b].place, fmt::format("element {} appears twice", part.elements[b].label),
                 "give every element a number of its own");
  }
  long long nodes = 0, hexes = 0;
  for (const AbaqusInstance& instance : model.instances) {
    const int part = part_named(instance);
    copies_.push_back({part, static_cast<int>(nodes), static_cast<int>(hexes)});
    nodes += static_cast<long long>(model.parts[part].points.size());
    hexes += static_cast<long long>(model.parts[part].elements.size());
    if (std::max(nodes, hexes) > std::numeric_limits<int>::max() / 6)
      model.fail(instance.place, "the instances have too many nodes or elements", "mesh more coarsely");
  }
}

int AbaqusResolver::part_named(const AbaqusInstance& instance) const {
  for (std::size_t p = 0; p < model_.parts.size(); ++p)
    if (in_capitals(model_.parts[p].name) == in_capitals(instance.part)) return static_cast<int>(p);
  model_.fail(instance.place,
              fmt::format("instance '{}' is of the part '{}', which the file lacks",
                          printable(instance.name, true), printable(instance.part, true)),
              "define the part before the assembly");
}

int AbaqusResolver::instance_named(const std::string& name, const AbaqusPlace& asked) const {
  for (std::size_t i = 0; i < model_.instances.size(); ++i)
    if (in_capitals(model_.instances[i].name) == in_capitals(name)) return static_cast<int>(i);
  model_.fail(asked, fmt::format("there is no instance '{}'", printable(name, true)),
              "name one that *INSTANCE makes");
}

const AbaqusResolver::Copy& AbaqusResolver::copy_of(int hex) const {
  return *(std::ranges::upper_bound(copies_, hex, {}, &Copy::first_hex) - 1);
}

const AbaqusPart::Element& AbaqusResolver::element(int hex) const {
  const Copy& copy = copy_of(hex);
  return model_.parts[copy.part].elements[hex - copy.first_hex];
}

const std::vector<int>& AbaqusResolver::set(Kind kind, int instance, const std::string& name,
                                            const AbaqusPlace& asked) {
  const std::string key = in_capitals(name);
  const auto [at, fresh] = known_.try_emplace(std::tuple(kind, instance, key));
  if (!fresh && !at->second.whole)
    model_.fail(asked, fmt::format("the set '{}' contains itself", printable(name, true)),
                "list its members");
  if (!fresh) return at->second.members;
  const AbaqusScope& scope = instance == assembly ? model_.assembly : part(instance);
  const auto& sets = kind == Kind::nodes ? scope.node_sets : scope.element_sets;
  const auto found = sets.find(key);
  if (found == sets.end()) {
    std::vector<std::string> names;
    for (const auto& [capitals, set] : sets) names.push_back(set.name);
    const std::string near = nearest(name, names);
    model_.fail(asked, fmt::format("there is no {} set '{}'", word_of(kind), printable(name, true)),
                near.empty() ? fmt::format("define it with *{}", kind == Kind::nodes ? "NSET" : "ELSET")
                             : "did you mean '" + printable(near, true) + "'?");
  }
  if (++depth_ > deepest)
    model_.fail(asked, fmt::format("sets of sets are nested more than {} deep", deepest),
                "list their members");
  std::vector<int> all;
  for (const AbaqusMembers& members : found->second.members) append(kind, instance, members, all);
  --depth_;
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  at->second = {std::move(all), true};
  return at->second.members;
}

std::vector<int> AbaqusResolver::of(Kind kind, int instance, const AbaqusMembers& members) {
  std::vector<int> found;
  append(kind, instance, members, found);
  return found;
}

void AbaqusResolver::append(Kind kind, int scope, const AbaqusMembers& members, std::vector<int>& found) {
  const int instance = members.instance.empty() ? scope : instance_named(members.instance, members.place);
  if (instance != assembly) {  // labels of the assembly itself are reference points
    const Labels& labels = labels_[copies_[instance].part];
    const int first = kind == Kind::nodes ? first_node(instance) : first_hex(instance);
    std::vector<int> local;
    for (const AbaqusRange& range : members.ranges)
      if (const int missing = (kind == Kind::nodes ? labels.nodes : labels.elements).append(range, local);
          missing > 0 && !members.generated)
        model_.fail(members.place,
                    fmt::format("a set has {} {}, which the file lacks", word_of(kind), missing),
                    fmt::format("name {}s that the file defines; it may have been cut off", word_of(kind)));
    for (int i : local) found.push_back(first + i);
  }
  for (const std::string& name : members.names) {
    const std::vector<int>& other = set(kind, instance, name, members.place);
    found.insert(found.end(), other.begin(), other.end());
  }
  if (members.elements.empty()) return;
  for (int hex : set(Kind::elements, instance, members.elements, members.place)) {
    const Copy& copy = copy_of(hex);
    for (int label : element(hex).labels)
      if (const int node = labels_[copy.part].nodes.find(label); node >= 0)
        found.push_back(copy.first_node + node);
  }
}

}  // namespace bulbus::inline mesh
