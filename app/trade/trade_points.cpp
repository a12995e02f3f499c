#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include "app/trade/trade_figure.hpp"
#include "core/base/error.hpp"
#include "core/base/parse_number.hpp"
#include "core/base/printable.hpp"
#include "core/io/csv_line.hpp"

namespace bulbus::inline app {
namespace {

InputError no_trade(const std::string& path, int line, const std::string& why) {
  return input_error(path, line, why, "Name the folder of the results of a trade.");
}

// Cells of a line by their columns.
class TradeLine {
 public:
  TradeLine(std::string path, int number, std::map<std::string, std::string> cells)
      : path_(std::move(path)), number_(number), cells_(std::move(cells)) {}

  const std::string& word(const std::string& column) const {
    const auto found = cells_.find(column);
    if (found == cells_.end()) throw no_trade(path_, number_, "has no column '" + column + "'");
    return found->second;
  }
  double number(const std::string& column) const {
    const auto value = parse_number<double>(word(column));
    if (!value || !std::isfinite(*value) || *value < 0)
      throw no_trade(path_, number_, "'" + printable(word(column)) + "' is no " + column);
    return *value;
  }

 private:
  std::string path_;
  int number_;
  std::map<std::string, std::string> cells_;
};

// Runs that are not compared have nothing in the column of the front.
void take_point(const TradeLine& line, const std::string& error, const std::string& front,
                std::vector<TradePoint>& points) {
  if (line.word(front).empty()) return;
  points.push_back(
      {line.word("parameter"), line.number("seconds [s]"), line.number(error), line.word(front) == "front"});
}

}  // namespace

TradePoints read_trade_points(const std::string& path) {
  std::ifstream in(path);
  std::string text;
  if (!in || !std::getline(in, text)) throw no_trade(path, 0, "cannot be read");
  const std::vector<std::string> header = cells_of_line(text);
  TradePoints points;
  for (int number = 2; std::getline(in, text); ++number) {
    const std::vector<std::string> cells = cells_of_line(text);
    if (cells.size() != header.size()) throw no_trade(path, number, "has not as many cells as its header");
    std::map<std::string, std::string> named;
    for (std::size_t c = 0; c < cells.size(); ++c) named[header[c]] = cells[c];
    const TradeLine line(path, number, std::move(named));
    take_point(line, "error", "front", points.on_mesh);
    take_point(line, "extrapolated_error", "extrapolated_front", points.on_all);
  }
  for (auto* all : {&points.on_mesh, &points.on_all})
    std::ranges::stable_sort(*all, {}, &TradePoint::seconds);
  return points;
}

}  // namespace bulbus::inline app
