// Meshes of both versions of MSH, of Abaqus and VTK, STL files, text and binary, and checkpoints.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "app/records/checkpoints.hpp"
#include "contact/rigid/stl.hpp"
#include "core/mesh/generate/generate.hpp"
#include "core/mesh/gmsh/gmsh.hpp"
#include "tests/fuzz/bytes.hpp"
#include "tests/fuzz/prepared.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/support/foreign_meshes.hpp"
#include "tests/support/left.hpp"

namespace bulbus::fuzz {
namespace {

namespace fs = std::filesystem;

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

struct Seed {
  std::string name, content;
  bool binary;
  YamlNode scene;
  std::string file;  ///< what the scene reads it from; empty: the target's own
};

// A file that a scene reads, in the place of the one that the scene names.
class ReadFile : public Target {
 public:
  explicit ReadFile(std::string file) : file_(std::move(file)) {}
  Mutant make(Random& random) const override {
    const Seed& seed = random.of(seeds_);
    return {seed.name, with_faults(seed.content, seed.binary, random)};
  }
  void judge(const Mutant& mutant) const override {
    const auto seed = std::ranges::find(seeds_, mutant.seed, &Seed::name);
    const std::string& file = seed->file.empty() ? file_ : seed->file;
    write(file, mutant.content);
    prepare_checked(seed->scene, file);
  }

 protected:
  std::string file_;
  std::vector<Seed> seeds_;
};

class Meshes final : public ReadFile {
 public:
  Meshes(const std::string& cases, const std::string& scratch) : ReadFile(scratch + "/mesh.msh") {
    for (const char* folder : {"coincident_nodes", "hexahedra_twice", "partitioned_mesh",
                               "pressure_between_regions", "symmetry_noise", "matching_nodes"})
      add(cases + "/" + folder);
  }
  std::string name() const override { return "mesh"; }
  std::string extension() const override { return ".msh"; }

 private:
  void add(const std::string& folder) {
    YamlNode scene = read_yaml(fs::exists(folder + "/s.yaml") ? folder + "/s.yaml" : folder + "/clean.yaml");
    const std::string source = folder + "/" + scene.find("mesh")->find("file")->text;
    set_at(scene, "mesh.file", place_of(scene, "mesh"), YamlNode::word(file_, place_of(scene, "mesh")));
    seeds_.push_back({source, content_of(source), false, scene, ""});
    try {
      const Mesh mesh = read_gmsh(source);
      for (const bool version4 : {true, false})
        for (const bool binary : {true, false}) {
          write_gmsh(mesh, file_, {version4, binary});
          seeds_.push_back({source + (version4 ? " 4.1" : " 2.2") + (binary ? " binary" : " text"),
                            content_of(file_), binary, scene, ""});
        }
    } catch (const InputError&) {  // refused as it stands
    }
  }
};

// Abaqus and VTK files of two small meshes, in a scene that needs none of their sets.
class ForeignMeshes final : public ReadFile {
 public:
  explicit ForeignMeshes(const std::string& scratch) : ReadFile(scratch + "/mesh.inp"), scratch_(scratch) {
    Mesh mesh = generate(BlockShape{.nx = 3, .ny = 2, .nz = 1});
    for (std::size_t e = 0; e < mesh.region.size(); ++e) mesh.region[e] = e < 3 ? 0 : 1;
    mesh.region_names = {"1", "2"};
    mesh.node_sets["end"] = {0, 4, 8};
    add("abaqus", ".inp", test::abaqus_text(mesh), false);
    add("abaqus assembly", ".inp", assembly(test::abaqus_text(mesh)), false);
    add("vtu text", ".vtu", test::vtu_text(mesh), false);
    add("vtu base64", ".vtu", test::vtu_text(mesh, {.binary = true}), false);
    add("vtu zlib", ".vtu", test::vtu_text(mesh, {.binary = true, .compressed = true, .wide = true}), false);
    add("vtu raw", ".vtu", test::vtu_text(mesh, {.binary = true, .appended = true}), true);
    add("vtu raw zlib", ".vtu", test::vtu_text(mesh, {.binary = true, .appended = true, .compressed = true}),
        true);
    add("vtk text", ".vtk", test::legacy_vtk_text(mesh), false);
    add("vtk binary", ".vtk", test::legacy_vtk_text(mesh, true), true);
  }
  std::string name() const override { return "foreign"; }
  std::string extension() const override { return ".mesh"; }

 private:
  static std::string assembly(const std::string& flat) {
    const std::size_t rest = flat.find("*MATERIAL");
    return "*PART, NAME=P\n" + flat.substr(0, rest) +
           "*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=P-1, PART=P\n0, 0, 0\n0, 0, 0, 0, 0, 1, 30\n*END "
           "INSTANCE\n"
           "*NSET, NSET=few, INSTANCE=P-1, GENERATE\n1, 41, 10\n*NSET, NSET=more\nfew, P-1.11\n"
           "*SURFACE, NAME=skin\nP-1.1,\n*END ASSEMBLY\n" +
           flat.substr(rest);
  }

  void add(const std::string& name, const std::string& extension, const std::string& content, bool binary) {
    const std::string file = scratch_ + "/mesh" + extension;
    const YamlNode scene =
        parse_yaml("mesh: {file: " + file +
                       ", surfaces: {low: \"Z < 0.1\"}}\nregions: {\"1\": {c10: 50 kPa}, \"2\": {c10: "
                       "50 kPa}}\nfix: [{set: low}]\nsteps: [{name: rest}]\n",
                   file);
    seeds_.push_back({name, content, binary, scene, file});
  }
  std::string scratch_;
};

// The facets of a text file as a binary one.
std::string binary_stl(const std::string& path) {
  const StlSurface skin = read_stl(path);
  const auto count = static_cast<std::uint32_t>(skin.triangles.size());
  std::string bytes(84 + 50 * count, '\0');
  std::memcpy(bytes.data() + 80, &count, sizeof count);
  for (std::uint32_t t = 0; t < count; ++t)
    for (int i = 0; i < 9; ++i) {
      const auto x = static_cast<float>(skin.points[3 * skin.triangles[t][i / 3] + i % 3]);
      std::memcpy(bytes.data() + 84 + 50 * t + 4 * (3 + i), &x, sizeof x);
    }
  return bytes;
}

class Bodies final : public ReadFile {
 public:
  Bodies(const std::string& cases, const std::string& scratch) : ReadFile(scratch + "/body.stl") {
    for (const auto& [folder, file] : {std::pair{"ridge", "roof.stl"},
                                       {"stl_facet_turned", "lid.stl"},
                                       {"stl_duplicate_facets", "lid.stl"}}) {
      YamlNode scene = read_yaml(cases + "/" + folder + "/s.yaml");
      for (YamlNode& body : scene.find("rigid_bodies")->items)
        set_at(body, "file.path", body.place, YamlNode::word(file_, body.place));
      const std::string source = cases + "/" + folder + "/" + file;
      seeds_.push_back({source, content_of(source), false, scene, ""});
      seeds_.push_back({source + " binary", binary_stl(source), true, scene, ""});
    }
  }
  std::string name() const override { return "body"; }
  std::string extension() const override { return ".stl"; }
};

class Forgetful final : public Archived {
 public:
  void serialize(Archive&, const MarchProgress&) override {}
};

class Checkpoints final : public Target {
 public:
  explicit Checkpoints(const std::string& scratch) : file_(scratch + "/mutant.h5") {
    root_ = parse_yaml(test::full_of_memory, scratch + "/scene.yaml");
    set_at(root_, "mesh.shell.n", {}, YamlNode::word("2"));
    set_at(root_, "mesh.shell.layers", {}, YamlNode::word("1"));
    const Scene scene = scene_of(root_, scratch + "/scene.yaml");
    test::run_and_leave(scene, scratch, Comm(MPI_COMM_SELF), [](int number) {
      if (number == 3) throw test::Left();
    });
    content_ = content_of(checkpoint_in(scratch));
  }
  std::string name() const override { return "checkpoint"; }
  std::string extension() const override { return ".h5"; }
  Mutant make(Random& random) const override {
    return {"checkpoint.h5", with_faults(content_, true, random)};
  }

  void judge(const Mutant& mutant) const override {
    write(file_, mutant.content);
    const Scene scene = scene_of(root_, file_);
    const Prepared prepared = prepare(scene, Comm(MPI_COMM_SELF));
    Checkpoint checkpoint(file_, scene, prepared);
    Forgetful records;
    const Resumed resumed = checkpoint.resume(*prepared.problem, records);
    for (double x : resumed.state.x)
      if (!std::isfinite(x)) throw Silent("not finite: a state of a checkpoint");
  }

 private:
  std::string file_, content_;
  YamlNode root_;
};

}  // namespace

std::unique_ptr<Target> meshes(const std::string& cases, const std::string& scratch) {
  return std::make_unique<Meshes>(cases, scratch);
}
std::unique_ptr<Target> foreign_meshes(const std::string& scratch) {
  return std::make_unique<ForeignMeshes>(scratch);
}
std::unique_ptr<Target> bodies(const std::string& cases, const std::string& scratch) {
  return std::make_unique<Bodies>(cases, scratch);
}
std::unique_ptr<Target> checkpoints(const std::string& scratch) {
  return std::make_unique<Checkpoints>(scratch);
}

}  // namespace bulbus::fuzz
