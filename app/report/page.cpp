#include "app/report/page.hpp"

#include <nlohmann/json.hpp>

#include "app/report/html.hpp"
#include "app/report/page_files.hpp"

namespace bulbus::inline app {
namespace {

// Fills the places {{name}} of a text.
std::string filled(std::string_view text, const std::vector<std::pair<std::string, std::string>>& values) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = text.find("{{", at), close = text.find("}}", open);
    if (close == std::string_view::npos) return out.append(text.substr(at));
    out.append(text.substr(at, open - at));
    const std::string_view name = text.substr(open + 2, close - open - 2);
    for (const auto& [known, value] : values)
      if (name == known) out.append(value);
    at = close + 2;
  }
  return out;
}

std::string script(std::string_view code) { return "<script>\n" + std::string(code) + "\n</script>\n"; }

// No "<" may end the element: JSON knows another way to write it.
std::string data_of(const std::vector<nlohmann::json>& models) {
  std::string out = "<script type=\"application/json\" id=\"models\">";
  for (char c : nlohmann::json(models).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace))
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  return out + "</script>\n";
}

}  // namespace

std::string html_of(const Page& page) {
  using namespace page_files;
  const std::string scripts_of_page = page.models.empty() ? ""
                                                          : data_of(page.models) + script(three_js) +
                                                                script(orbit_controls_js) + script(scripts);
  return filled(report_html, {{"title", html::escaped(page.title)},
                              {"style", std::string(report_css)},
                              {"body", page.body},
                              {"scripts", scripts_of_page}});
}

std::string heading_of(const std::string& title,
                       const std::vector<std::pair<std::string, std::string>>& sections) {
  std::string links;
  for (const auto& [id, words] : sections) links += html::link("#" + id, words) + "\n";
  return html::element("header", html::text("h1", title) + html::element("nav", links));
}

}  // namespace bulbus::inline app
