#include "core/io/archive_copy.hpp"

namespace bulbus::inline io {

void ArchiveCopy::numbers(const std::string& name, std::vector<double>& values) {
  parts_.push_back({Kind::numbers, path_of(name), {}, 0, values, {}});
}

void ArchiveCopy::text(const std::string& name, std::string& value) {
  parts_.push_back({Kind::text, path_of(name), {}, 0, {}, value});
}

void ArchiveCopy::rows(const std::string& name, const Keys& keys, int width, std::vector<double>& values) {
  parts_.push_back({Kind::rows, path_of(name), keys, width, values, {}});
}

void ArchiveCopy::mesh_table(const std::string& name, const std::string& of, const Keys&, int,
                             std::vector<double>& values) {
  parts_.push_back({of == "node" ? Kind::nodes : Kind::hexes, path_of(name), {}, 0, values, {}});
}

void ArchiveCopy::give(Archive& other) {
  for (Part& part : parts_) give(part, part.path, other);
}

// Slashes of a path part groups.
void ArchiveCopy::give(Part& part, const std::string& path, Archive& other) {
  if (const auto slash = path.find('/'); slash != std::string::npos) {
    const Group group(other, path.substr(0, slash));
    return give(part, path.substr(slash + 1), other);
  }
  switch (part.kind) {
    case Kind::numbers:
      return other.numbers(path, part.values);
    case Kind::text:
      return other.text(path, part.text);
    case Kind::rows:
      return other.rows(path, part.keys, part.width, part.values);
    case Kind::nodes:
      return other.nodes(path, part.values);
    case Kind::hexes:
      return other.hexes(path, part.values);
  }
}

}  // namespace bulbus::inline io
