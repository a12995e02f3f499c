#pragma once
#include <string>

namespace bulbus::inline app {

/// Throws InputError unless what draws PNG files, the program rsvg-convert, is installed.
void require_png();

/// Draws an SVG file's text as a PNG file, two pixels for each of its own. Throws std::runtime_error. Not
/// collective.
void write_png(const std::string& path, const std::string& svg);

}  // namespace bulbus::inline app
