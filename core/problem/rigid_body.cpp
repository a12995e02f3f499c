#include "core/problem/rigid_body.hpp"

namespace bulbus::inline problem {

Mat3<double> rotation(const Vec3<double>& w) {
  const double angle = norm(w);
  // sin θ/θ and (1 − cos θ)/θ² by series near zero
  const double a = angle > 1e-4 ? std::sin(angle) / angle : 1 - angle * angle / 6;
  const double b = angle > 1e-4 ? (1 - std::cos(angle)) / (angle * angle) : 0.5 - angle * angle / 24;
  const Mat3<double> W{{{{0, -w[2], w[1]}, {w[2], 0, -w[0]}, {-w[1], w[0], 0}}}};
  Mat3<double> R = W * W;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) R(i, j) = (i == j) + a * W(i, j) + b * R(i, j);
  return R;
}

Vec3<double> spin(const Mat3<double>& R) {
  const Vec3<double> axis{R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1)};  // 2 sin θ times the axis
  const double sine = norm(axis) / 2, cosine = (R(0, 0) + R(1, 1) + R(2, 2) - 1) / 2;
  const double a = sine > 1e-12 ? std::atan2(sine, cosine) / (2 * sine) : 0.5;
  return {a * axis[0], a * axis[1], a * axis[2]};
}

Vec3<double> RigidBody::arm(const Pose& pose, std::span<const double> x, int n) const {
  Vec3<double> r;
  for (int c = 0; c < 3; ++c) r[c] = x[3 * n + c] - center_[c] - pose.shift[c];
  return r;
}

void RigidBody::place(const Pose& pose, std::span<const double> X, std::span<double> x) const {
  for (int n : nodes_)
    for (int c = 0; c < 3; ++c) {
      double v = center_[c] + pose.shift[c];
      for (int k = 0; k < 3; ++k) v += pose.rotation(c, k) * (X[3 * n + k] - center_[k]);
      x[3 * n + c] = v;
    }
}

Pose RigidBody::moved(const Pose& pose, const Six& q) const {
  Six f;
  for (int i = 0; i < 6; ++i) f[i] = free_[i] ? q[i] : 0;
  Pose p{rotation({f[3], f[4], f[5]}) * pose.rotation, pose.shift};
  for (int c = 0; c < 3; ++c) p.shift[c] += f[c];
  return p;
}

void RigidBody::expand(const Pose& pose, std::span<const double> x, const Six& q,
                       std::span<double> dx) const {
  Six f;
  for (int i = 0; i < 6; ++i) f[i] = free_[i] ? q[i] : 0;
  for (int n : nodes_) {
    const Vec3<double> turn = cross({f[3], f[4], f[5]}, arm(pose, x, n));
    for (int c = 0; c < 3; ++c) dx[3 * n + c] = f[c] + turn[c];
  }
}

RigidBody::Six RigidBody::reduce(const Pose& pose, std::span<const double> x, std::span<const double> f,
                                 int owned) const {
  Six sum{};
  for (int n : nodes_) {
    if (n >= owned) continue;
    const Vec3<double> force = at(f, n);
    const Vec3<double> moment = cross(arm(pose, x, n), force);
    for (int c = 0; c < 3; ++c) sum[c] += force[c], sum[3 + c] += moment[c];
  }
  for (int i = 0; i < 6; ++i)
    if (!free_[i]) sum[i] = 0;
  return sum;
}

Mat3<double> RigidBody::geometric(const Pose& pose, std::span<const double> x, std::span<const double> f,
                                  int owned) const {
  Mat3<double> G{};
  for (int n : nodes_) {
    if (n >= owned) continue;
    const Vec3<double> r = arm(pose, x, n), force = at(f, n);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) G(i, j) += 0.5 * (force[i] * r[j] + r[i] * force[j]);
      G(i, i) -= dot(force, r);
    }
  }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (!free_[3 + i] || !free_[3 + j]) G(i, j) = 0;
  return G;
}

}  // namespace bulbus::inline problem
