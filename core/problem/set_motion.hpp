#pragma once
#include "core/problem/model.hpp"

namespace bulbus::inline problem {

/// Where `rotate` and `translate` of a displacement carry a position x, by the part s of their motion. mm
Vec3<double> rigidly_moved(const DisplaceSpec& spec, const Vec3<double>& x, double s);

/// The image F X of a reference position under `affine`, which has to be given. mm
Vec3<double> affine_image(const DisplaceSpec& spec, const Vec3<double>& X);

}  // namespace bulbus::inline problem
