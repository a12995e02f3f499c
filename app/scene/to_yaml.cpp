#include <algorithm>
#include <array>
#include <cctype>

#include "app/scene/yaml_node.hpp"

namespace bulbus::inline app {
namespace {

// Words that some YAML reader takes for something else than text.
constexpr std::array reserved{"null", "yes", "no", "on", "off"};

bool is_plain(const std::string& text) {
  if (text.empty()) return false;
  std::string lower;
  for (unsigned char c : text) {
    if (!std::isalnum(c) && c != '_' && c != '-' && c != '.' && c != '+') return false;
    lower += static_cast<char>(std::tolower(c));
  }
  if (text.find_first_not_of("-.+") == std::string::npos) return false;
  return std::find(reserved.begin(), reserved.end(), lower) == reserved.end();
}

std::string escaped(char c) {
  static const char* digits = "0123456789abcdef";
  if (c == '"' || c == '\\') return std::string("\\") + c;
  const auto code = static_cast<unsigned char>(c);
  if (code >= 0x20 && code != 0x7f) return {c};
  return std::string("\\x") + digits[code >> 4] + digits[code & 15];
}

std::string quoted(const std::string& text) {
  if (is_plain(text)) return text;
  std::string out = "\"";
  for (char c : text) out += escaped(c);
  return out + "\"";
}

bool in_one_line(const YamlNode& e) {
  if (!e.is(YamlNode::Kind::list)) return e.is(YamlNode::Kind::word) || e.items.empty();
  return std::all_of(e.items.begin(), e.items.end(), in_one_line) &&
         std::none_of(e.items.begin(), e.items.end(),
                      [](const YamlNode& i) { return i.is(YamlNode::Kind::map); });
}

std::string one_line(const YamlNode& e) {
  switch (e.kind) {
    case YamlNode::Kind::nothing:
      return "null";
    case YamlNode::Kind::word:
      return quoted(e.text);
    case YamlNode::Kind::map:
      return "{}";
    default:
      break;
  }
  std::string out = "[";
  for (std::size_t i = 0; i < e.items.size(); ++i) out += (i ? ", " : "") + one_line(e.items[i]);
  return out + "]";
}

void write(const YamlNode& e, int indent, bool continues, std::string& out);

void write_value(const YamlNode& e, int indent, std::string& out) {
  if (in_one_line(e)) {
    out += " " + one_line(e) + (e.note.empty() ? "" : "  # " + e.note) + "\n";
  } else {
    out += "\n";
    write(e, indent, false, out);
  }
}

void write_list(const YamlNode& list, int indent, std::string& out) {
  for (const YamlNode& item : list.items) {
    out += std::string(indent, ' ') + "-";
    if (item.is(YamlNode::Kind::map) && !item.items.empty()) {
      out += " ";
      write(item, indent + 2, true, out);
    } else {
      write_value(item, indent + 2, out);
    }
  }
}

// `continues`: the first key stands behind the dash of its list entry.
void write(const YamlNode& e, int indent, bool continues, std::string& out) {
  if (e.is(YamlNode::Kind::list)) return write_list(e, indent, out);
  for (std::size_t i = 0; i < e.items.size(); ++i) {
    if (i || !continues) out += std::string(indent, ' ');
    out += quoted(e.keys[i]) + ":";
    write_value(e.items[i], indent + 2, out);
  }
}

}  // namespace

std::string to_yaml(const YamlNode& map) {
  if (in_one_line(map)) return one_line(map) + "\n";
  std::string out;
  write(map, 0, false, out);
  return out;
}

}  // namespace bulbus::inline app
