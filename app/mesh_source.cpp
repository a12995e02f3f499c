#include "app/mesh_source.hpp"

#include "app/kinds.hpp"
#include "app/wording.hpp"
#include "core/base/error.hpp"
#include "core/mesh/gmsh.hpp"

namespace bulbus {

void MeshSource::validate() const {
  MeshSource copy = *this;
  std::vector<std::string> given, known;
  copy.describe([&]<class T>(const char* key, T& member, const About&) {
    if constexpr (kinds::Optional<T>) {
      known.emplace_back(key);
      if (member) given.emplace_back(key);
    }
  });
  if (given.size() == 1) return;
  const std::string all = alternatives(known);
  if (given.empty()) throw input_error("the mesh has no source", "give one of " + all);
  throw input_error(
      "the mesh has " + std::to_string(given.size()) + " sources: " + given[0] + " and " + given[1],
      "keep exactly one of " + all);
}

namespace {

Mesh make_base(const MeshSource& source) {
  if (source.file) return read_gmsh(*source.file);
  if (source.eye) return generate(*source.eye);
  if (source.block) return generate(*source.block);
  if (source.shell) return generate(*source.shell);
  if (source.ball) return generate(*source.ball);
  return generate(*source.cylinder);
}

}  // namespace

MeshHierarchy make_meshes(const MeshSource& source) {
  source.validate();
  return refined(make_base(source), source.refine);
}

}  // namespace bulbus
