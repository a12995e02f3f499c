#include <fmt/format.h>

#include "core/mesh/gmsh/gmsh.hpp"
#include "core/mesh/gmsh/gmsh_file.hpp"

namespace bulbus::inline mesh {
namespace {

struct Header {
  bool version4 = false, binary = false;
};

Header read_header(GmshScanner& in) {
  if (in.at_end() || in.word() != "$MeshFormat")
    in.fail("this is no Gmsh mesh: $MeshFormat is missing",
            "give an MSH file, version 4.1 or 2.2; Abaqus meshes are read from .inp, VTK from .vtu and .vtk");
  const std::string version(in.word());
  if (version != "4.1" && version != "2.2" && version != "2.1" && version != "2")
    in.fail("MSH version " + printable(version) + " is not read",
            "save as MSH 4.1 or 2.2 (gmsh -format msh41)");
  Header header{version == "4.1", in.integer() == 1};
  if (in.integer() != 8) in.fail("numbers are not of 8 bytes", "save the mesh on a 64-bit machine");
  if (header.binary) {
    in.skip_line();
    if (in.bytes<int>() != 1) in.fail("the file has the byte order of another machine", "save it as ASCII");
  }
  in.expect("$EndMeshFormat");
  return header;
}

void read_names(GmshScanner& in, GmshFile& file) {
  for (long long n = in.count(false); n > 0; --n) {
    const int dimension = in.whole(false), tag = in.whole(false);
    if (dimension < 0 || dimension > 3)
      in.fail(fmt::format("a physical group has dimension {}", dimension),
              "save the mesh again as MSH 4.1 or 2.2");
    const std::string name = in.quoted();
    if (const auto [old, fresh] = file.names.emplace(std::pair{dimension, tag}, name);
        !fresh && old->second != name)
      in.fail(fmt::format("physical group {} of dimension {} is named '{}' and '{}'", tag, dimension,
                          old->second, name),
              "give it one name");
  }
}

}  // namespace

Mesh read_gmsh(const std::string& path) {
  GmshScanner in(path);
  GmshFile file;
  file.path = path;
  const Header header = read_header(in);
  file.binary = header.binary;
  GmshEntities entities;
  while (!in.at_end()) {
    const std::string section(in.word());
    if (section.size() < 2 || section[0] != '$')
      in.fail(fmt::format("'{}' is no section", printable(section)), "save the mesh again as MSH 4.1 or 2.2");
    const bool data = section == "$Nodes" || section == "$Elements" || section == "$Entities" ||
                      section == "$PartitionedEntities";
    if (header.binary && data && header.version4) in.skip_line();
    if (section == "$PhysicalNames")
      read_names(in, file);
    else if (section == "$Nodes")
      header.version4 ? read_nodes4(in, file) : read_nodes2(in, file);
    else if (section == "$Elements")
      header.version4 ? read_elements4(in, file, entities) : read_elements2(in, file);
    else if (section == "$PartitionedEntities")
      read_partitioned4(in, file, entities);
    else if (section == "$Entities")
      entities = read_entities4(in, file);
    else {
      in.skip_past("$End" + section.substr(1));
      continue;
    }
    in.expect("$End" + section.substr(1));
  }
  return mesh_of(file);
}

}  // namespace bulbus::inline mesh
