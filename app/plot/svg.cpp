#include "app/plot/svg.hpp"

#include <fmt/format.h>

#include <array>

#include "core/io/markup.hpp"

namespace bulbus::inline app::svg {
namespace {

// Distinct for colour-blind eyes too (Okabe and Ito).
constexpr std::array colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                             "#e69f00", "#56b4e9", "#000000", "#8c6d31"};
constexpr std::array dashes{"", "7 3", "2 3", "7 3 2 3"};

const char* colour(std::size_t series) {
  return series == grey ? "#b5b5b5" : colours[series % colours.size()];
}
const char* dash(std::size_t series) { return dashes[series / colours.size() % dashes.size()]; }

// Control characters are none of XML's.
std::string escaped(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  return escaped_markup(text);
}

}  // namespace

std::string text(double x, double y, const std::string& words, const char* anchor, const char* style) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, style,
                     escaped(words));
}

std::string line(double x1, double y1, double x2, double y2, const std::string& stroke) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x1, y1, x2, y2,
                     stroke);
}

std::string circle(double x, double y, std::size_t series, bool solid) {
  return fmt::format(
      "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\" stroke=\"{}\" stroke-width=\"1.5\"/>\n", x,
      y, solid ? colour(series) : "white", colour(series));
}

std::string arrow(double x, double y, int way, std::size_t series) {
  return fmt::format(
      "<path d=\"M{:.1f} {:.1f}l5 {}h-10z\" fill=\"white\" stroke=\"{}\" stroke-width=\"1.5\"/>\n", x, y,
      -9 * way, colour(series));
}

std::string stroke_of(std::size_t series) {
  return fmt::format("stroke=\"{}\" stroke-width=\"1.8\" stroke-dasharray=\"{}\"", colour(series),
                     *dash(series) ? dash(series) : "none");
}

}  // namespace bulbus::inline app::svg
