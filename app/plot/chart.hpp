#pragma once
#include <string>
#include <vector>

namespace bulbus::inline app {

/// Small multiples as an SVG file: panels in rows, each with its own axes, one legend for all.
struct Chart {
  struct Mark {
    double x, y;
    bool solid =
        true;  ///< else hollow, and no line leads there; an arrow at the edge where it is far from the others
  };
  struct Series {
    std::string name;
    std::vector<Mark> marks;  ///< in the order of the curve
    bool background = false;  ///< grey marks without a curve, below the others
  };
  struct Tick {
    double at;
    std::string text;
  };
  struct Panel {
    std::string title, x_label;
    std::vector<Tick> x_ticks;  ///< at least one
    std::vector<Series> series;
    bool decades = false;  ///< y are decimal logarithms of ratios, which are written in per cent
  };
  std::string title, note;
  int columns = 3;            ///< panels in a row
  bool rows_share_y = false;  ///< one scale for all panels of a row
  std::vector<Panel> panels;
};

/// The whole file. The legend takes its names from the first panel; there is none for a single series.
std::string svg_of(const Chart& chart);

/// Round values, a handful, that span [low, high], with as many digits as they need.
std::vector<Chart::Tick> round_ticks(double low, double high);
/// 1, 2 and 5 times powers of ten that enclose [low, high], both positive, at their decimal logarithms.
std::vector<Chart::Tick> log_ticks(double low, double high);
/// Powers of ten in per cent that enclose ratios whose decimal logarithms are [low, high]: -2 is written as 1
/// %.
std::vector<Chart::Tick> percent_ticks(double low, double high);

}  // namespace bulbus::inline app
