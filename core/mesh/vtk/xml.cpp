#include "core/mesh/vtk/xml.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/characters.hpp"
#include "core/base/error.hpp"
#include "core/base/printable.hpp"

namespace bulbus::inline mesh {
namespace {

constexpr int deepest = 30;

bool is_name(char c) { return !is_blank(c) && std::string_view("<>/=\"'").find(c) == std::string_view::npos; }

std::string without_entities(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    bool found = false;
    for (const auto& [entity, c] :
         {std::pair{"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}, {"&quot;", '"'}, {"&apos;", '\''}})
      if (!found && text.substr(i).starts_with(entity)) {
        plain += c;
        i += std::string_view(entity).size() - 1;
        found = true;
      }
    if (!found) plain += text[i];
  }
  return plain;
}

class Parser {
 public:
  Parser(const std::string& path, std::string_view text) : path_(path), text_(text) {}

  XmlElement root() {
    skip_to_tag();
    if (at_ == text_.size())
      fail("this is no VTK file: it has no <VTKFile>", "give a .vtu or a legacy .vtk file");
    return element(0);
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& remedy = "write the file again") const {
    throw input_error(path_, line(), what, remedy);
  }
  int line() const {
    return 1 + static_cast<int>(std::count(text_.begin(), text_.begin() + static_cast<long>(at_), '\n'));
  }
  bool starts(std::string_view word) const { return text_.substr(at_).starts_with(word); }
  void skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  }
  void skip_past(std::string_view word) {
    const std::size_t found = text_.find(word, at_);
    if (found == std::string_view::npos) fail(fmt::format("'{}' is missing", word));
    at_ = found + word.size();
  }

  // To the next tag that is no comment or declaration, or the end.
  void skip_to_tag() {
    for (;;) {
      at_ = std::min(text_.find('<', at_), text_.size());
      if (starts("<!--"))
        skip_past("-->");
      else if (starts("<?"))
        skip_past("?>");
      else if (starts("<!"))
        skip_past(">");
      else
        return;
    }
  }

  std::string name() {
    const std::size_t start = at_;
    while (at_ < text_.size() && is_name(text_[at_])) ++at_;
    if (at_ == start) fail("a name is missing in a tag");
    return std::string(text_.substr(start, at_ - start));
  }

  void attribute(XmlElement& e) {
    const std::string key = name();
    skip_blanks();
    if (!starts("=")) fail(fmt::format("the attribute '{}' has no value", printable(key)));
    ++at_;
    skip_blanks();
    const char quote = at_ < text_.size() ? text_[at_] : ' ';
    const std::size_t end = text_.find(quote, at_ + 1);
    if ((quote != '"' && quote != '\'') || end == std::string_view::npos)
      fail(fmt::format("the value of '{}' is not in quotes", printable(key)));
    e.attributes.emplace_back(key, without_entities(text_.substr(at_ + 1, end - at_ - 1)));
    at_ = end + 1;
  }

  XmlElement element(int depth) {
    if (depth > deepest) fail(fmt::format("elements are nested more than {} deep", deepest));
    XmlElement e;
    e.line = lines_.line_at(text_, at_);
    ++at_;
    e.name = name();
    for (skip_blanks(); at_ < text_.size() && text_[at_] != '>' && text_[at_] != '/'; skip_blanks())
      attribute(e);
    if (starts("/>")) {
      at_ += 2;
      return e;
    }
    if (!starts(">")) fail(fmt::format("the tag <{}> has no end", printable(e.name)));
    const std::size_t begin = ++at_;
    if (e.name == "AppendedData") {
      e.text = text_.substr(begin);
      at_ = text_.size();
      appended_ = true;
      return e;
    }
    skip_to_tag();
    e.text = text_.substr(begin, at_ - begin);
    for (; !starts("</"); skip_to_tag()) {
      if (appended_) return e;
      if (at_ == text_.size())
        fail(fmt::format("</{}> is missing: the file ends too early", printable(e.name)));
      e.parts.push_back(element(depth + 1));
    }
    at_ += 2;
    if (const std::string closed = name(); closed != e.name)
      fail(fmt::format("</{}> stands where </{}> is expected", printable(closed), printable(e.name)));
    skip_past(">");
    return e;
  }

  // Counts lines once, from the last place on.
  struct Lines {
    std::size_t at = 0;
    int line = 1;
    int line_at(std::string_view text, std::size_t to) {
      for (; at < to; ++at) line += text[at] == '\n';
      return line;
    }
  };

  const std::string& path_;
  std::string_view text_;
  std::size_t at_ = 0;
  Lines lines_;
  bool appended_ = false;
};

}  // namespace

const std::string& XmlElement::attribute(std::string_view key) const {
  static const std::string none;
  const auto at = std::ranges::find(attributes, key, &std::pair<std::string, std::string>::first);
  return at == attributes.end() ? none : at->second;
}

const XmlElement* XmlElement::part(std::string_view wanted) const {
  const auto at = std::ranges::find(parts, wanted, &XmlElement::name);
  return at == parts.end() ? nullptr : &*at;
}

XmlElement parse_xml(const std::string& path, std::string_view text) { return Parser(path, text).root(); }

}  // namespace bulbus::inline mesh
