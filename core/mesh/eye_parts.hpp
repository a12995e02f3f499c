#pragma once
#include "core/mesh/eye.hpp"

namespace bulbus {

/// Indices of region_names of the eye.
enum EyeRegion { cornea, sclera, ciliary_body, choroid, retina, optic_nerve, lens };

/// Adds the lens: a half-disc of columns between its posterior and its anterior surface.
void add_lens(Mesh& mesh, const EyeSettings& settings);

/// Names the boundary; `outer` flags the nodes of the outer surface of sclera and cornea.
void name_eye_surfaces(Mesh& mesh, const EyeShape& shape, const std::vector<bool>& outer);

/// Adds the bars "zonules" between "lens_surface" and the ciliary body's wet faces.
void add_zonules(Mesh& mesh, const EyeSettings& settings);

}  // namespace bulbus
