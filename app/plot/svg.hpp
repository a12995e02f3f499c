#pragma once
#include <string>

/// Elements of an SVG file. Places in pixels, y downwards; a series has its colour, and its dashes when
/// colours are used up.
namespace bulbus::inline app::svg {

/// `anchor`: start, middle or end.
std::string text(double x, double y, const std::string& words, const char* anchor, const char* style = "");
std::string line(double x1, double y1, double x2, double y2, const std::string& stroke);
/// Of a mark that belongs to no curve.
constexpr std::size_t grey = static_cast<std::size_t>(-1);
/// The mark of a series.
std::string circle(double x, double y, std::size_t series, bool solid);
/// The mark of what lies beyond the edge at y; `way` is 1 downwards, -1 upwards.
std::string arrow(double x, double y, int way, std::size_t series);
/// The attributes of a curve.
std::string stroke_of(std::size_t series);

}  // namespace bulbus::inline app::svg
