#include "app/report/html.hpp"

#include <fmt/format.h>

#include "core/io/markup.hpp"

namespace bulbus::inline app::html {

std::string escaped(const std::string& text) { return escaped_markup(text); }

std::string element(const std::string& name, const std::string& html, const std::string& kind) {
  const std::string attribute = kind.empty() ? "" : " class=\"" + kind + "\"";
  return fmt::format("<{0}{1}>{2}</{0}>\n", name, attribute, html);
}

std::string text(const std::string& name, const std::string& words, const std::string& kind) {
  return element(name, escaped(words), kind);
}

std::string section(const std::string& id, const std::string& heading, const std::string& html) {
  return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", id, escaped(heading), html);
}

std::string details(const std::string& summary, const std::string& html) {
  return element("details", text("summary", summary) + html);
}

std::string link(const std::string& address, const std::string& words) {
  return fmt::format("<a href=\"{}\">{}</a>", escaped(address), escaped(words));
}

std::string table(const Table& t, const std::string& kind) {
  const auto cell = [&](const char* name, std::size_t column, const std::string& html) {
    return fmt::format("<{0}{1}>{2}</{0}>", name,
                       static_cast<int>(column) < t.words ? "" : " class=\"number\"", html);
  };
  std::string head, body;
  for (std::size_t c = 0; c < t.header.size(); ++c) head += cell("th", c, t.header[c]);
  for (const auto& row : t.rows) {
    std::string cells;
    for (std::size_t c = 0; c < row.size(); ++c) cells += cell("td", c, row[c]);
    body += element("tr", cells);
  }
  const std::string whole =
      element("table", element("thead", element("tr", head)) + element("tbody", body), kind);
  return element("div", whole, "wide");
}

std::string number(double value) { return fmt::format("{:.4g}", value + 0.); }

std::string unit(const std::string& unit) {
  std::string out;
  for (std::size_t i = 0; i < unit.size(); ++i)
    out += i > 1 && unit[i - 1] == 'm' && unit[i] == '2'   ? "²"
           : i > 1 && unit[i - 1] == 'm' && unit[i] == '3' ? "³"
                                                           : std::string(1, unit[i]);
  return out;
}

}  // namespace bulbus::inline app::html
