#pragma once
#include <string>
#include <vector>

/// Pieces of a page. What is called `html` is written as it stands, everything else is escaped.
namespace bulbus::inline app::html {

std::string escaped(const std::string& text);
/// <name class="kind">html</name>; no class if it is empty.
std::string element(const std::string& name, const std::string& html, const std::string& kind = "");
std::string text(const std::string& name, const std::string& words, const std::string& kind = "");
/// A section with a heading that a link leads to.
std::string section(const std::string& id, const std::string& heading, const std::string& html);
/// Folded until it is asked for, on paper too.
std::string details(const std::string& summary, const std::string& html);
std::string link(const std::string& address, const std::string& words);

/// A table of which the first `words` columns are text and the others numbers. Cells are html.
struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  int words = 1;
};
std::string table(const Table& table, const std::string& kind = "");

/// A number as a person reads it: four digits, no more than it has.
std::string number(double value);
/// mm², mm³ for mm2, mm3.
std::string unit(const std::string& unit);

}  // namespace bulbus::inline app::html
