#include <algorithm>

#include "app/export/export_file.hpp"
#include "app/export/export_scene.hpp"
#include "app/export/exported_material.hpp"
#include "app/export/feb_loads.hpp"

namespace bulbus::inline app {
namespace {

bool is_yeoh(const ExportedMaterial& m) {
  return m.order() <= 6 && std::ranges::all_of(m.c, [](const auto& e) { return e.first.second == 0; });
}

class FebModel {
 public:
  explicit FebModel(const ExportContent& content)
      : content_(content), mesh_(content.mesh), made_(content.told) {
    if (!made_.printed.empty())
      made_.left_out.push_back("records of displacements and reactions of sets: ask for them in FEBio");
    cut_steps_for_feb(made_);
    for (const std::string& region : mesh_.region_names) {
      const ExportedMaterial m = material_of_region(region);
      if (m.order() > 1 && !is_yeoh(m))
        made_.left_out.push_back("region '" + region +
                                 "' is neither Mooney-Rivlin nor Yeoh: it is written without a material");
    }
  }

  std::vector<std::string> write(const std::string& path) {
    ExportFile out(path);
    out.text("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<febio_spec version=\"4.0\">\n");
    out.text("<!-- {} -->\n", in_comment(content_.heading));
    for (const std::string& sentence : made_.left_out)
      out.text("<!-- not in this file: {} -->\n", in_comment(sentence));
    out.text("<Module type=\"solid\"/>\n<Material>\n");
    for (std::size_t r = 0; r < mesh_.region_names.size(); ++r) material(out, static_cast<int>(r));
    out.text("</Material>\n<Mesh>\n");
    nodes_and_elements(out);
    sets_and_surfaces(out);
    out.text("</Mesh>\n<MeshDomains>\n");
    for (const std::string& region : mesh_.region_names)
      out.text("<SolidDomain name=\"{}\" mat=\"{}\"/>\n", escaped_markup(region), escaped_markup(region));
    out.text("</MeshDomains>\n");
    write_feb_loads(out, made_);
    out.text("<Output>\n<plotfile type=\"febio\">\n<var type=\"displacement\"/>\n<var type=\"stress\"/>\n");
    out.text("</plotfile>\n</Output>\n</febio_spec>\n");
    out.flush();
    return made_.left_out;
  }

 private:
  ExportedMaterial material_of_region(const std::string& region) const {
    return exported_material(content_.model.regions.at(region));
  }

  void material(ExportFile& out, int r) const {
    const std::string& region = mesh_.region_names[r];
    const ExportedMaterial m = material_of_region(region);
    if (content_.model.regions.at(region).rigid || (m.order() > 1 && !is_yeoh(m))) return;
    const bool linear = m.order() == 1;
    out.text("<material id=\"{}\" name=\"{}\" type=\"{}\">\n<density>1</density>\n", r + 1,
             escaped_markup(region), linear ? "Mooney-Rivlin" : "Yeoh");
    for (int k = 1; k <= (linear ? 2 : m.order()); ++k)
      out.text("<c{}>{}</c{}>\n", k,
               linear ? m.coefficient(k == 1 ? 1 : 0, k == 1 ? 0 : 1) : m.coefficient(k, 0), k);
    out.text("<k>{}</k>\n</material>\n", content_.options.bulk * m.shear());
  }

  void nodes_and_elements(ExportFile& out) const {
    out.text("<Nodes name=\"nodes\">\n");
    for (std::size_t n = 0; n < mesh_.points.size(); ++n)
      out.text("<node id=\"{}\">{},{},{}</node>\n", n + 1, mesh_.points[n][0], mesh_.points[n][1],
               mesh_.points[n][2]);
    out.text("</Nodes>\n");
    for (int r = 0; r < static_cast<int>(mesh_.region_names.size()); ++r) {
      out.text("<Elements type=\"hex8\" name=\"{}\">\n", escaped_markup(mesh_.region_names[r]));
      for (std::size_t e = 0; e < mesh_.hexes.size(); ++e) {
        if (mesh_.region[e] != r) continue;
        const Hex& h = mesh_.hexes[e];
        out.text("<elem id=\"{}\">{},{},{},{},{},{},{},{}</elem>\n", e + 1, h[0] + 1, h[1] + 1, h[2] + 1,
                 h[3] + 1, h[4] + 1, h[5] + 1, h[6] + 1, h[7] + 1);
      }
      out.text("</Elements>\n");
    }
  }

  void sets_and_surfaces(ExportFile& out) const {
    for (const auto& [name, nodes] : made_.sets) {
      out.text("<NodeSet name=\"{}\">", escaped_markup(name));
      for (std::size_t i = 0; i < nodes.size(); ++i) out.text("{}{}", i > 0 ? "," : "", nodes[i] + 1);
      out.text("</NodeSet>\n");
    }
    for (const auto& [name, quads] : mesh_.surfaces) {
      out.text("<Surface name=\"{}\">\n", escaped_markup(name));
      for (std::size_t i = 0; i < quads.size(); ++i)
        out.text("<quad4 id=\"{}\">{},{},{},{}</quad4>\n", i + 1, quads[i][0] + 1, quads[i][1] + 1,
                 quads[i][2] + 1, quads[i][3] + 1);
      out.text("</Surface>\n");
    }
  }

  const ExportContent& content_;
  const Mesh& mesh_;
  ExportedModel made_;
};

}  // namespace

std::vector<std::string> write_feb(const std::string& path, const ExportContent& content) {
  return FebModel(content).write(path);
}

}  // namespace bulbus::inline app
