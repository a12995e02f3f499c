#pragma once
#include <string>
#include <vector>

#include "app/scene/mesh_source.hpp"
#include "app/scene/value.hpp"
#include "app/scene/yaml_node.hpp"
#include "core/base/error.hpp"
#include "core/problem/model.hpp"
#include "core/solve/settings.hpp"

namespace bulbus::inline app {

/// What a run saves for ParaView. The last converged increment is always saved.
struct OutputSettings {
  bool vtk = true;
  int every = 1, checkpoint = 0;
  std::vector<std::string> fields{"displacement", "stress",           "mises",         "pressure", "region",
                                  "gap",          "contact_pressure", "contact_status"};
  template <class V>
  void describe(V&& v) {
    v("vtk", vtk,
      About{"write result_*.hdf (VTKHDF) and result.hdf.series, the rigid bodies as bodies_*.vtp with "
            "bodies.pvd, bars and sutures as lines_*.vtp with lines.pvd"});
    v("every", every, About{"save each n-th converged increment, and always the last"}.between(1, 1000000));
    v("checkpoint", checkpoint,
      About{"write checkpoint.h5, from which --restart goes on, at each n-th converged increment and at the "
            "end; 0: only where the run is interrupted"}
          .between(0, 1000000));
    v("fields", fields,
      About{"what is saved: Cauchy stress in MPa (xx, yy, zz, xy, yz, xz), pressure (positive in "
            "compression) with J, Green-Lagrange strain, principal values with the largest first; where the "
            "scene has contacts gap in mm, pressure in MPa, status 1 where closed, NaN away from contacts"}
          .one_of({"displacement", "stress", "mises", "pressure", "region", "gap", "contact_pressure",
                   "contact_status", "strain", "principal_stresses", "principal_stretches"}));
  }
};

/// A whole scene file, checked as far as it can be without the mesh.
struct Scene {
  std::string title;
  MeshSource mesh;
  std::string materials = "none";  ///< of regions that the model leaves out, if they are tissues
  Model model;
  SolverSettings solver;
  OutputSettings output;
  template <class V>
  void describe(V&& v) {
    v("title", title, About{"a line for the records"});
    v("mesh", mesh,
      About{"where the mesh comes from: exactly one source, and how often it is refined"}.needed());
    v("materials", materials,
      About{"what regions named after a tissue of the eye have where `regions` does not mention them: "
            "`paper`, c10 in MPa of cornea "
            "0.0333, sclera 0.0833, ciliary_body 0.01, choroid 0.0083, retina 0.0008, optic_nerve 0.05, lens "
            "1; `physiological`, six "
            "times that but for the lens; `stiff_lens`, `paper` with a lens of 100"}
          .one_of({"none", "paper", "physiological", "stiff_lens"}));
    model.describe(v);
    v("solver", solver, About{"how the equations are solved"});
    v("output", output, About{"what is saved"});
  }
  /// Throws InputError if two probes or two named steps share a name.
  void validate() const;
  static constexpr const char* preset_key = "mesh";
  /// Defaults of the solver that depend on the mesh; the reader calls it before the solver's settings
  /// override them.
  void take_preset();
};

/// The scene as a group of values, which reader, writer and outline go through.
Value parameters_of(Scene& scene);

/// A scene from its YAML as data. Relative files count from the folder of `path`, the scene's, and come out
/// absolute. Throws InputError with file, line, key, value and remedy. Settings without effect are left to
/// unused_settings.
Scene scene_of(const YamlNode& root, const std::string& path);

/// A scene file as data, after `path.to.key=value` overrides in their order. Throws InputError.
YamlNode scene_data(const std::string& path, const std::vector<std::string>& overrides);

/// Reads a scene file, after `path.to.key=value` overrides in their order. Throws InputError, also if a
/// setting has no effect.
Scene read_scene(const std::string& path, const std::vector<std::string>& overrides = {});

/// The same from text; `path` is the name in messages and gives the folder.
Scene parse_scene(const std::string& text, const std::string& path,
                  const std::vector<std::string>& overrides = {});

/// The message of a fault that knows only its key, with the place where the scene gives that key (or the
/// nearest map around it). A fault without a key comes back as it is.
InputError located(const InputError& fault, const YamlNode& root);
InputError located(const InputError& fault, const std::string& path,
                   const std::vector<std::string>& overrides = {});

/// The scene as YAML with every default written out. Reading it back gives the same scene.
std::string resolved_yaml(const Scene& scene);

}  // namespace bulbus::inline app
