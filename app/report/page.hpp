#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace bulbus::inline app {

/// A page that needs nothing else: style, scripts and data are in it.
struct Page {
  std::string title, body;             ///< `body` is html
  std::vector<nlohmann::json> models;  ///< of model_json, drawn side by side; none: no 3-D, and no scripts
};
std::string html_of(const Page& page);

/// The heading, and links to sections (id and words).
std::string heading_of(const std::string& title,
                       const std::vector<std::pair<std::string, std::string>>& sections);

/// Bytes that a page may have.
constexpr double most_bytes = 15e6;

}  // namespace bulbus::inline app
