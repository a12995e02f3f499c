#include "core/problem/set_motion.hpp"

#include "core/problem/rigid_body.hpp"

namespace bulbus::inline problem {

Vec3<double> rigidly_moved(const DisplaceSpec& spec, const Vec3<double>& x, double s) {
  Vec3<double> place = x;
  if (spec.rotate) {
    const auto& r = *spec.rotate;
    const double turn = s * r.angle, length = norm(r.axis);
    const Vec3<double> arm = minus(x, r.center);
    const Mat3<double> R =
        rotation({turn * (r.axis[0] / length), turn * (r.axis[1] / length), turn * (r.axis[2] / length)});
    for (int c = 0; c < 3; ++c)
      place[c] = r.center[c] + R(c, 0) * arm[0] + R(c, 1) * arm[1] + R(c, 2) * arm[2];
  }
  if (spec.translate)
    for (int c = 0; c < 3; ++c) place[c] += s * (*spec.translate)[c];
  return place;
}

Vec3<double> from_axis(const DisplaceSpec& spec, const Vec3<double>& x) {
  Vec3<double> r = minus(x, spec.center);
  const double t = dot(r, spec.axis) / dot(spec.axis, spec.axis);
  for (int c = 0; c < 3; ++c) r[c] -= t * spec.axis[c];
  return r;
}

Vec3<double> affine_image(const DisplaceSpec& spec, const Vec3<double>& X) {
  const auto& F = *spec.affine;
  Vec3<double> image;
  for (int c = 0; c < 3; ++c) image[c] = F[3 * c] * X[0] + F[3 * c + 1] * X[1] + F[3 * c + 2] * X[2];
  return image;
}

}  // namespace bulbus::inline problem
