#include <cctype>
#include <filesystem>
#include <ostream>

#include "app/commands.hpp"
#include "app/export/exported_material.hpp"
#include "app/eye/tissues.hpp"
#include "app/prepare.hpp"
#include "app/scene/size_limits.hpp"
#include "app/version.hpp"
#include "core/base/error.hpp"
#include "core/io/output.hpp"
#include "core/io/text_file.hpp"
#include "core/problem/symmetry_planes.hpp"
#include "core/problem/validate.hpp"

namespace bulbus::inline app {
namespace {

MeshHierarchy meshes_to_write(const Scene& scene) {
  if (const auto base = count_of(scene.mesh)) refuse_too_large_to_make(*base, scene);
  MeshHierarchy meshes =
      make_meshes(scene.mesh, nullptr, [&](Mesh& base) { move_onto_planes(base, scene.model); });
  if (scene.mesh.file) refuse_too_large_to_make(count(meshes.base), scene);
  return meshes;
}

// The mesh that a run would solve on, checked against the model as a run checks it.
Mesh mesh_of_model(const Scene& scene, Model& model) {
  scene.validate();
  if (scene.reference)
    throw scene_error("reference", "the unloaded mesh is found by a run, and this writes the drawn one",
                      "Export a scene without `reference` whose mesh is the unloaded.msh of a run.");
  MeshHierarchy meshes = meshes_to_write(scene);
  refuse_unsound(meshes.base, scene);
  add_tissues(scene.materials, meshes.base.region_names, model);
  require_tissues(meshes.base.region_names, model);
  validate(meshes.base, model);
  return meshes.finest();
}

std::string heading_of(const Scene& scene, const std::string& scene_path) {
  std::string text = "bulbus " + std::string(version) + ", " + scene_path +
                     (scene.title.empty() ? "" : ": " + scene.title) + " (mm, N, MPa)";
  for (char& c : text)
    if (std::iscntrl(static_cast<unsigned char>(c))) c = ' ';
  return text;
}

std::string extension_of(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

using WriteModel = std::vector<std::string> (*)(const std::string&, const ExportContent&);

// Null for a mesh without a model.
WriteModel writer_of(const std::string& file) {
  const std::string extension = extension_of(file);
  if (extension == ".inp") return write_inp;
  if (extension == ".feb") return write_feb;
  if (extension == ".msh") return nullptr;
  throw input_error("'" + file + "' names no format that is written",
                    "end it in .inp (Abaqus, CalculiX), .feb (FEBio) or .msh (Gmsh, the mesh alone)");
}

// A pipe or a device cannot be replaced by a whole file.
void write_at(const std::string& file, const std::function<void(const std::string&)>& write) {
  if (std::filesystem::exists(file) && !std::filesystem::is_regular_file(file))
    write(file);
  else
    write_whole(file, write);
}

}  // namespace

int write_mesh(const Scene& scene, const std::string& file, const GmshFormat& format, const Comm& comm) {
  std::string fault;
  try {
    if (comm.rank() == 0) write_gmsh(meshes_to_write(scene).finest(), file, format);
  } catch (const InputError& e) {
    fault = e.what();
  }
  if (comm.any(!fault.empty())) throw InputError(fault, "mesh");
  return 0;
}

int export_scene(const Scene& scene, const std::string& scene_path, const std::string& file,
                 const ExportOptions& options, const Comm& comm, std::ostream& out) {
  const WriteModel write = writer_of(file);
  if (!write) return write_mesh(scene, file, {}, comm);
  Model model = scene.model;
  Mesh mesh;
  ExportedModel told;
  comm.together([&] {
    if (comm.rank() > 0) return;
    mesh = mesh_of_model(scene, model);
    refuse_unwritten_laws(model);
    told = exported_model(model, mesh);
  });
  const std::string heading = heading_of(scene, scene_path);
  std::vector<std::string> left_out;
  write_together(comm, [&] {
    if (comm.rank() > 0) return;
    write_at(file, [&](const std::string& temporary) {
      left_out = write(temporary, {heading, mesh, model, told, options});
    });
  });
  out << file << ": " << mesh.hexes.size() << " hexahedra, " << mesh.points.size() << " nodes\n";
  for (const std::string& sentence : left_out) out << "  not in it: " << sentence << "\n";
  return 0;
}

}  // namespace bulbus::inline app
