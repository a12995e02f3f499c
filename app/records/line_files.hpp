#pragma once
#include "contact/interactions.hpp"
#include "core/io/vtp.hpp"

namespace bulbus::inline app {

/// The bars (zonules) and the strings of sutures that pull, where they are, beside the result files:
/// lines_0001.vtp and so on with lines.pvd. The lines carry `force` (N, tension positive; a bar's of the part
/// that the model owns, a string's of the whole), `length` (mm) and `group`: labels `group_NAME` say which
/// that is.
class LineFiles {
 public:
  LineFiles(const Problem& problem, std::shared_ptr<const Interactions> interactions,
            const std::string& folder);

  /// Has the model bars or sutures?
  bool any() const { return !labels_.empty(); }
  /// Nothing if there are none. Collective. Throws OutputError.
  void save(int number, const State& state) const;
  /// Adds what was saved to the index. Throws std::runtime_error. Not collective: for one rank.
  void list(int number, double time);

 private:
  std::vector<double> lines(const State& state) const;

  const Problem& problem_;
  std::shared_ptr<const Interactions> interactions_;
  std::string folder_;
  std::vector<Label> labels_;
  Collection index_;
};

}  // namespace bulbus::inline app
