#include "app/new/starting_scene.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <ostream>

#include "app/new/scene_texts.hpp"
#include "core/base/error.hpp"
#include "core/io/output.hpp"
#include "core/io/text_file.hpp"
#include "core/mesh/generate/generate.hpp"
#include "core/mesh/gmsh/gmsh.hpp"

namespace bulbus::inline app {
namespace {

namespace fs = std::filesystem;

constexpr std::pair<const char*, const std::string_view*> starting_texts[] = {
    {"eye", &scene_texts::eye}, {"sphere", &scene_texts::sphere}, {"mesh", &scene_texts::mesh}};

// NAME stands for the scene's own name.
std::string text_for(const std::string& kind, const std::string& name) {
  std::string text;
  for (const auto& [known, its] : starting_texts)
    if (known == kind) text = *its;
  const std::string mark = "NAME";
  for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark, at + name.size()))
    text.replace(at, mark.size(), name);
  return text;
}

// A bar that stands on `bottom` and has a `top`.
Mesh standing_bar() {
  Mesh mesh = generate(BlockShape{.upper = {4, 4, 10}, .nx = 3, .ny = 3, .nz = 6, .region = "tissue"});
  mesh.surfaces = {{"bottom", mesh.surfaces.at("zmin")}, {"top", mesh.surfaces.at("zmax")}};
  return mesh;
}

void refuse_no_place(const fs::path& name) {
  if (name.filename().empty())
    throw input_error("'" + name.string() + "' is no name of a file", "Give one, such as 'my_eye'.");
  if (const fs::path folder = name.parent_path(); !folder.empty() && !fs::is_directory(folder))
    throw input_error(folder.string() + ": is no folder", "Make it first, or name another.");
}

void refuse_existing(const std::string& file) {
  if (fs::exists(fs::symlink_status(file)))
    throw input_error(file, 0, "is there already, and nothing is written over it",
                      "Take another name, or move it away.");
}

}  // namespace

std::vector<std::string> starting_scenes() {
  std::vector<std::string> kinds;
  for (const auto& [kind, text] : starting_texts) kinds.emplace_back(kind);
  return kinds;
}

void write_starting_scene(std::string name, const std::string& kind, const Comm& comm, std::ostream& out) {
  if (name.ends_with(".yaml")) name.resize(name.size() - 5);
  const std::string scene = name + ".yaml", mesh = name + ".msh", stem = fs::path(name).filename();
  comm.together([&] {
    refuse_no_place(name);
    refuse_existing(scene);
    if (kind == "mesh") refuse_existing(mesh);
  });
  write_together(comm, [&] {
    if (comm.rank() != 0) return;
    if (kind == "mesh")
      write_whole(mesh, [](const std::string& file) { write_gmsh(standing_bar(), file, {false, false}); });
    write_whole(scene, text_for(kind, stem));
  });
  const std::size_t width = scene.size() + std::string("check ").size();
  out << scene << (kind == "mesh" ? " and " + mesh : "") << "\n"
      << fmt::format("  bulbus {:<{}}    {}\n", "check " + scene, width, "what it describes; solves nothing")
      << fmt::format("  bulbus {:<{}}    {}\n", "run " + scene, width, "solves it into results/" + stem)
      << fmt::format("  bulbus {:<{}}    {}\n", "help scene", width, "what its keys mean");
}

}  // namespace bulbus::inline app
