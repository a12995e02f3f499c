#include "core/io/series.hpp"

#include <nlohmann/json.hpp>

#include "core/io/json_file.hpp"

namespace bulbus::inline io {

void Series::add(const std::string& file, double time) {
  states_.push_back({file, time});
  nlohmann::json files = nlohmann::json::array();
  for (const State& s : states_) files.push_back({{"name", s.file}, {"time", s.time}});
  write_json(path_, {{"file-series-version", "1.0"}, {"files", files}});
}

}  // namespace bulbus::inline io
