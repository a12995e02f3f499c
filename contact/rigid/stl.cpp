#include "contact/rigid/stl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <set>

#include "core/base/error.hpp"
#include "core/base/whole_file.hpp"
#include "core/mesh/gmsh/gmsh_scanner.hpp"

namespace bulbus::inline contact {
namespace {

constexpr std::size_t header = 80,
                      facet = 50;  // bytes of a binary file: 12 floats and two bytes per triangle

using Corners = std::array<std::array<double, 3>, 3>;

class Collector {
 public:
  /// False if a coordinate is not finite.
  bool add(const Corners& corners, int place) {
    std::array<int, 3> t;
    for (int i = 0; i < 3; ++i) {
      for (double c : corners[i])
        if (!std::isfinite(c)) return false;
      const auto [entry, fresh] = number_.emplace(corners[i], static_cast<int>(number_.size()));
      if (fresh) surface_.add(corners[i]);
      t[i] = entry->second;
    }
    std::ranges::rotate(t, std::ranges::min_element(t));
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
      ++flat_;
    } else if (!seen_.insert(t).second) {
      ++repeated_;
    } else {
      surface_.triangles.push_back(t);
      surface_.places.push_back(place);
    }
    return true;
  }
  StlSurface take(const std::string& path, bool text) {
    if (flat_ + repeated_ > 0)
      surface_.warnings.push_back(
          fmt::format("{}: {} facets with two equal corners and {} that repeat an earlier one are left out.",
                      path, flat_, repeated_));
    surface_.text = text;
    return std::move(surface_);
  }

 private:
  StlSurface surface_;
  std::map<std::array<double, 3>, int> number_;
  std::set<std::array<int, 3>> seen_;
  int flat_ = 0, repeated_ = 0;
};

class TextReader {
 public:
  TextReader(const std::string& path, const std::string& text) : path_(path), text_(text) {}

  StlSurface read() {
    expect("solid");
    bool in_solid = true;
    for (skip_line(); in_solid;) {
      const std::string w = word();
      if (w == "facet") {
        read_facet();
      } else if (w == "endsolid") {
        skip_line();
        in_solid = !at_end();
        if (in_solid) {
          expect("solid");
          skip_line();
        }
      } else {
        fail(fmt::format("expected facet or endsolid, found '{}'", printable(w)));
      }
    }
    return collector_.take(path_, true);
  }

 private:
  void read_facet() {
    const int line = line_;
    expect("normal");
    for (int c = 0; c < 3; ++c) real();
    expect("outer");
    expect("loop");
    Corners corners;
    for (auto& corner : corners) {
      expect("vertex");
      for (double& c : corner) c = real();
    }
    expect("endloop");
    expect("endfacet");
    if (!collector_.add(corners, line)) fail("a corner is not finite");
  }
  bool at_end() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])))
      line_ += text_[at_++] == '\n';
    return at_ == text_.size();
  }
  std::string word() {
    if (at_end()) fail("the file ends too early");
    const std::size_t start = at_;
    while (at_ < text_.size() && !std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    std::string w = text_.substr(start, at_ - start);
    std::ranges::transform(w, w.begin(), [](unsigned char c) { return std::tolower(c); });
    return w;
  }
  void expect(const char* wanted) {
    if (const std::string w = word(); w != wanted)
      fail(fmt::format("expected {}, found '{}'", wanted, printable(w)));
  }
  double real() {
    const std::string w = word();
    const char* first = w.data() + (w[0] == '+');
    double value = 0;
    const auto [end, fault] = std::from_chars(first, w.data() + w.size(), value);
    if (fault != std::errc() || end != w.data() + w.size())
      fail(fmt::format("'{}' is no number", printable(w)));
    return value;
  }
  void skip_line() { at_ = std::min(text_.find('\n', at_), text_.size()); }
  [[noreturn]] void fail(const std::string& what) const {
    throw input_error(path_, line_, what, "Save the STL file again.");
  }

  const std::string &path_, &text_;
  std::size_t at_ = 0;
  int line_ = 1;
  Collector collector_;
};

// A text file may be called solid, a binary one too: only the size tells.
std::optional<std::uint32_t> binary_count(const std::string& bytes) {
  std::uint32_t count = 0;
  if (bytes.size() < header + sizeof count) return {};
  std::memcpy(&count, bytes.data() + header, sizeof count);
  if (bytes.size() != header + sizeof count + facet * count) return {};
  return count;
}

// What a file that is neither claims to have.
std::string claim_of(const std::string& bytes) {
  std::uint32_t count = 0;
  if (bytes.size() < header + sizeof count) return "";
  std::memcpy(&count, bytes.data() + header, sizeof count);
  return fmt::format(", which {} triangles would have to be {}", count,
                     header + sizeof count + facet * count);
}

StlSurface read_binary(const std::string& path, const std::string& bytes, std::uint32_t count) {
  Collector collector;
  for (std::uint32_t t = 0; t < count; ++t) {
    std::array<float, 12> raw;  // normal and three corners
    std::memcpy(raw.data(), bytes.data() + header + sizeof count + facet * t, sizeof raw);
    Corners corners;
    for (int i = 0; i < 9; ++i) corners[i / 3][i % 3] = raw[3 + i];
    if (!collector.add(corners, static_cast<int>(t) + 1))
      throw input_error(path, 0, fmt::format("facet {}: a corner is not finite", t + 1),
                        "Save the STL file again.");
  }
  return collector.take(path, false);
}

bool begins_as_text(const std::string& bytes) {
  const std::string solid = "solid";
  return bytes.size() >= solid.size() &&
         std::equal(solid.begin(), solid.end(), bytes.begin(),
                    [](char a, unsigned char b) { return a == std::tolower(b); });
}

}  // namespace

StlSurface read_stl(const std::string& path) {
  const std::string bytes = whole_file(path, "STL file");
  const auto count = binary_count(bytes);
  if (!count && !begins_as_text(bytes))
    throw input_error(path, 0,
                      fmt::format("is neither a text STL file, which begins with 'solid', nor a binary one, "
                                  "whose size fits its number "
                                  "of triangles (it has {} bytes{})",
                                  bytes.size(), claim_of(bytes)),
                      "Save the STL file again: it is cut short, or of another kind.");
  StlSurface surface = count ? read_binary(path, bytes, *count) : TextReader(path, bytes).read();
  if (surface.triangles.empty()) throw input_error(path, 0, "has no triangles", "Save the STL file again.");
  return surface;
}

}  // namespace bulbus::inline contact
