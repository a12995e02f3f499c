#pragma once
#include <string_view>

/// Files of page/ and of three.js, made part of the program by cmake/Embed.cmake.
namespace bulbus::inline app::page_files {

extern const std::string_view report_html, report_css, three_js, orbit_controls_js, scripts;

}  // namespace bulbus::inline app::page_files
