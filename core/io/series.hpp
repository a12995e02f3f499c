#pragma once
#include <string>
#include <vector>

namespace bulbus::inline io {

/// The index of saved states that ParaView opens: `result.hdf.series`. Not collective: for one rank.
class Series {
 public:
  explicit Series(std::string path) : path_(std::move(path)) {}
  /// Adds a state and rewrites the index whole; `file` is relative to the index. Throws std::runtime_error.
  void add(const std::string& file, double time);

 private:
  struct State {
    std::string file;
    double time;
  };
  std::string path_;
  std::vector<State> states_;
};

}  // namespace bulbus::inline io
