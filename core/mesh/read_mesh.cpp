#include "core/mesh/read_mesh.hpp"

#include <cctype>
#include <filesystem>

#include "core/base/error.hpp"
#include "core/mesh/abaqus/abaqus.hpp"
#include "core/mesh/abaqus/abaqus_lines.hpp"
#include "core/mesh/gmsh/gmsh.hpp"
#include "core/mesh/vtk/vtk.hpp"

namespace bulbus::inline mesh {
namespace {

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

}  // namespace

bool is_vtk(const std::string& path) {
  const std::string extension = extension_of(path);
  return extension == ".vtu" || extension == ".pvtu" || extension == ".vtk";
}

ReadMesh read_mesh(const std::string& path, const std::string& regions) {
  if (is_vtk(path)) return read_vtk(path, regions);
  if (extension_of(path) == ".inp") return read_abaqus(path);
  return {read_gmsh(path), {}, {}};
}

std::vector<std::string> included_files(const std::string& path) {
  if (extension_of(path) != ".inp") return {};
  try {
    AbaqusLines lines(path);
    while (!lines.at_end()) lines.next();
    return {lines.files().begin() + 1, lines.files().end()};
  } catch (const InputError&) {
    return {};  // the reader tells
  }
}

}  // namespace bulbus::inline mesh
