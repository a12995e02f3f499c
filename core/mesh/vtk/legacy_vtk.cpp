// Legacy VTK files of unstructured grids.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <limits>
#include <map>

#include "core/base/characters.hpp"
#include "core/base/error.hpp"
#include "core/base/parse_number.hpp"
#include "core/base/printable.hpp"
#include "core/mesh/vtk/vtk_grid.hpp"

namespace bulbus::inline mesh {
namespace {

const char* const write_again = "write the file again; it may have been cut off";

// Blanks in names are written as %20.
std::string decoded(std::string_view name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    int code = 0;
    const bool coded = name[i] == '%' && i + 2 < name.size() &&
                       std::from_chars(&name[i + 1], &name[i + 1] + 2, code, 16).ptr == &name[i + 1] + 2;
    text += coded ? static_cast<char>(code) : name[i];
    if (coded) i += 2;
  }
  return text;
}

class LegacyReader {
 public:
  LegacyReader(const std::string& path, std::string_view text) : text_(text) { grid_.path = path; }

  VtkGrid read() {
    skip_line(), skip_line();
    const std::string_view kind = word();
    if (kind != "ASCII" && kind != "BINARY")
      fail(fmt::format("'{}' is neither ASCII nor BINARY", printable(kind)));
    binary_ = kind == "BINARY";
    while (skip_blanks(), at_ < text_.size()) section(std::string(word()));
    return std::move(grid_);
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& remedy = write_again) const {
    const auto end = text_.begin() + static_cast<long>(std::min(at_, text_.size()));
    const auto line = 1 + std::count(text_.begin(), end, '\n');
    throw input_error(grid_.path, binary_ ? 0 : static_cast<int>(line), what, remedy);
  }
  void skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  }
  void skip_line() { at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1; }
  std::string_view word() {
    skip_blanks();
    const std::size_t start = at_;
    while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
    if (start == at_) fail("the file ends too early");
    return text_.substr(start, at_ - start);
  }
  double number() {
    const std::string_view w = word();
    const auto value = parse_number<double>(w);
    if (!value) fail(fmt::format("'{}' is no number", printable(w)));
    return *value;
  }
  long long count() {
    const std::string_view w = word();
    const auto value = parse_number<long long>(w);
    if (!value || *value < 0 || *value > std::numeric_limits<int>::max())
      fail(fmt::format("'{}' is no number of entries", printable(w)));
    return *value;
  }
  VtkType type() {
    static const std::map<std::string, VtkType> types{
        {"char", VtkType::i8},          {"signed_char", VtkType::i8},     {"unsigned_char", VtkType::u8},
        {"short", VtkType::i16},        {"unsigned_short", VtkType::u16}, {"int", VtkType::i32},
        {"unsigned_int", VtkType::u32}, {"long", VtkType::i64},           {"unsigned_long", VtkType::u64},
        {"vtktypeint64", VtkType::i64}, {"vtktypeint32", VtkType::i32},   {"vtkIdType", VtkType::i32},
        {"float", VtkType::f32},        {"double", VtkType::f64}};
    const std::string name(word());
    const auto at = types.find(name);
    if (at == types.end())
      fail(fmt::format("an array of type '{}' is not read", printable(name)),
           "leave it out (in ParaView: Pass Arrays), or write int, float or double");
    return at->second;
  }

  // Big-endian bytes from the next line on, or words.
  std::vector<double> numbers(long long wanted, VtkType type) {
    if (wanted < 0 || wanted > static_cast<long long>(text_.size())) fail("the file ends too early");
    if (binary_) {
      skip_line();
      const std::size_t bytes = static_cast<std::size_t>(wanted) * size_of(type);
      if (text_.size() - at_ < bytes) fail("the file ends too early");
      at_ += bytes;
      return numbers_in(text_.substr(at_ - bytes, bytes), type, std::endian::native == std::endian::little);
    }
    if (static_cast<long long>(text_.size() - at_) / 2 + 1 < wanted) fail("the file ends too early");
    std::vector<double> values(static_cast<std::size_t>(wanted));
    for (double& v : values) v = number();
    return values;
  }

  void section(const std::string& key) {
    if (key == "DATASET") {
      if (const std::string_view set = word(); set != "UNSTRUCTURED_GRID")
        fail(fmt::format("a dataset of kind {} is not read", printable(set)), "write an UNSTRUCTURED_GRID");
    } else if (key == "POINTS") {
      const long long n = count();
      grid_.points = numbers(3 * n, type());
    } else if (key == "CELLS") {
      cells();
    } else if (key == "CELL_TYPES") {
      grid_.types = numbers(count(), VtkType::i32);
    } else if (key == "CELL_DATA") {
      begin_data(grid_.cell_arrays, grid_.ends.size(), "cells");
    } else if (key == "POINT_DATA") {
      begin_data(grid_.point_arrays, grid_.points.size() / 3, "points");
    } else if (key == "METADATA") {
      metadata();
    } else {
      attribute(key);
    }
  }

  // Up to an empty line; of the array before it, each component may have a line with its name or an empty
  // one.
  void metadata() {
    skip_line();
    while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') {
      const bool names = text_.substr(at_).starts_with("COMPONENT_NAMES");
      skip_line();
      for (long long c = 0; names && c < components_; ++c) skip_line();
    }
  }

  void begin_data(std::vector<VtkArray>& arrays, std::size_t tuples, const char* of) {
    tuples_ = count();
    arrays_ = &arrays;
    if (tuples_ != static_cast<long long>(tuples))
      fail(fmt::format("data of {} {}, and there are {}", tuples_, of, tuples));
  }

  void cells() {
    const long long n = count(), size = count();
    std::size_t before = at_;
    if (skip_blanks(), text_.substr(at_).starts_with("OFFSETS")) {  // version 5: n is one more than the cells
      word();
      grid_.ends = numbers(n, type());
      if (!grid_.ends.empty()) grid_.ends.erase(grid_.ends.begin());
      if (word() != "CONNECTIVITY") fail("CONNECTIVITY is missing");
      grid_.connectivity = numbers(size, type());
      return;
    }
    at_ = before;
    const std::vector<double> lists = numbers(size, VtkType::i32);
    std::size_t at = 0;
    for (long long c = 0; c < n; ++c) {
      const double points = at < lists.size() ? lists[at++] : -1;
      if (!(points >= 0 && points <= static_cast<double>(lists.size() - at)))
        fail(fmt::format("cell {} does not fit into the {} numbers of CELLS", c, size));
      const auto first = lists.begin() + static_cast<long>(at);
      grid_.connectivity.insert(grid_.connectivity.end(), first, first + static_cast<long>(points));
      grid_.ends.push_back(static_cast<double>(grid_.connectivity.size()));
      at += static_cast<std::size_t>(points);
    }
  }

  void take(std::string name, long long components, VtkType type, long long tuples) {
    if (components < 1 || components > 1000) fail(fmt::format("an array has {} components", components));
    components_ = components;
    VtkArray array{std::move(name), static_cast<int>(components), is_whole(type),
                   numbers(components * tuples, type)};
    if (arrays_ && tuples == tuples_) arrays_->push_back(std::move(array));
  }

  void attribute(const std::string& key) {
    static const std::map<std::string, int> widths{{"VECTORS", 3},  {"NORMALS", 3},    {"TENSORS", 9},
                                                   {"TENSORS6", 6}, {"GLOBAL_IDS", 1}, {"PEDIGREE_IDS", 1}};
    if (key == "FIELD") return field();
    if (!arrays_ && (key == "SCALARS" || widths.contains(key)))
      fail(key + " stands before CELL_DATA and POINT_DATA");
    if (const auto width = widths.find(key); width != widths.end()) {
      const std::string name = decoded(word());
      return take(name, width->second, type(), tuples_);
    }
    if (key == "SCALARS") return scalars();
    if (key == "LOOKUP_TABLE") {
      word();
      numbers(4 * count(), binary_ ? VtkType::u8 : VtkType::f32);
    } else if (key == "COLOR_SCALARS") {
      word();
      numbers(count() * std::max(tuples_, 0LL), binary_ ? VtkType::u8 : VtkType::f32);
    } else if (key == "TEXTURE_COORDINATES") {
      const std::string name = decoded(word());
      const long long width = count();
      take(name, width, type(), tuples_);
    } else {
      fail(fmt::format("'{}' is no section", printable(key)));
    }
  }

  // SCALARS name type [components], and on the next line LOOKUP_TABLE name
  void scalars() {
    const std::string name = decoded(word());
    const VtkType kind = type();
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const bool plain =
        std::all_of(text_.begin() + static_cast<long>(at_), text_.begin() + static_cast<long>(end), is_blank);
    const long long components = plain ? 1 : count();
    const std::size_t before = at_;
    if (skip_blanks(), text_.substr(at_).starts_with("LOOKUP_TABLE"))
      word(), word();
    else
      at_ = before;
    take(name, components, kind, tuples_);
  }

  void field() {
    word();
    for (long long n = count(); n > 0; --n) {
      std::string name = decoded(word());
      while (name == "METADATA") {
        section(name);
        name = decoded(word());
      }
      const long long components = count(), tuples = count();
      take(name, components, type(), tuples);
    }
  }

  VtkGrid grid_;
  std::string_view text_;
  std::size_t at_ = 0;
  bool binary_ = false;
  long long tuples_ = -1, components_ = 3;   ///< of the data; of the array read last, at first of the points
  std::vector<VtkArray>* arrays_ = nullptr;  ///< of the cells or the points; null before either
};

}  // namespace

VtkGrid read_legacy_vtk(const std::string& path, const std::string& text) {
  return LegacyReader(path, text).read();
}

}  // namespace bulbus::inline mesh
