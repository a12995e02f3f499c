#pragma once
#include <vector>

#include "app/eye/eye.hpp"
#include "app/eye/eye_map.hpp"

namespace bulbus::inline eye {

/// Indices of region_names of the eye.
enum EyeRegion { cornea, sclera, ciliary_body, choroid, retina, optic_nerve, lens };

/// The detachment on the sheet; without one nothing is lifted or torn.
struct DetachedSheet {
  std::vector<double> lift;  ///< per node of the sheet, mm; 0 where the retina is attached
  std::vector<bool> torn;    ///< per quad: it has no retina
  std::vector<int> nodes;    ///< under which the retina is there and lifted, rising
  std::vector<int> rim;      ///< of these, those on the tear's edge
};

/// Throws InputError if retina, tear and lens do not fit together.
DetachedSheet detached_sheet(const EyeSheet& sheet, const EyeSettings& settings);

/// Adds the lens: a half-disc of columns between its posterior and its anterior surface.
void add_lens(Mesh& mesh, const EyeMap& map);

/// Names the boundary; `outer` flags the nodes of the outer surface of sclera and cornea.
void name_eye_surfaces(Mesh& mesh, const EyeShape& shape, const std::vector<bool>& outer);

/// Adds the bars "zonules" between "lens_surface" and the ciliary body's faces in the cavity.
void add_zonules(Mesh& mesh, const EyeSettings& settings);

}  // namespace bulbus::inline eye
