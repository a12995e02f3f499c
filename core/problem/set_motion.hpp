#pragma once
#include "core/base/tensor.hpp"
#include "core/problem/model.hpp"

namespace bulbus::inline problem {

/// Where `rotate` and `translate` of a displacement carry a position x, by the part s of their motion. mm
Vec3<double> rigidly_moved(const DisplaceSpec& spec, const Vec3<double>& x, double s);

/// The way to a position from the axis of `radial`, square to it. mm
Vec3<double> from_axis(const DisplaceSpec& spec, const Vec3<double>& x);

/// The image F X of a reference position under `affine`, which has to be given. mm
Vec3<double> affine_image(const DisplaceSpec& spec, const Vec3<double>& X);

}  // namespace bulbus::inline problem
