#include "contact/suture/suture_term.hpp"

#include "core/base/error.hpp"

#include <algorithm>
#include <unordered_map>

namespace bulbus::inline contact {
namespace {

constexpr double step_of_difference = 1e-5;  // in lengths of the string

Vec3<double> in_plane(const CuttingPlane& plane, const Point2& v) {
  return v[0] * plane.along + v[1] * plane.away;
}

}  // namespace

SutureTerm::SutureTerm(const LocalMesh& mesh, const std::vector<SuturePoint>& points,
                       std::shared_ptr<const RigidSurface> body, const SutureSpec& spec, std::string key)
    : mesh_(mesh),
      body_(std::move(body)),
      frame_(spec.meridians, key),
      generator_(spec.generator),
      follow_(spec.follow),
      key_(std::move(key)),
      strings_(points.size()) {
  std::unordered_map<int, int> local;
  for (int n = 0; n < mesh.nodes(); ++n) local.emplace(mesh.input_node[n], n);
  for (const SuturePoint& p : points) {
    Bite& bite = bites_.emplace_back();
    bite.on_plane = p.on_plane;
    bite.share = p.share;
    double near_weight = 0;
    for (std::size_t i = 0; i < p.nodes.size(); ++i) {
      const auto found = local.find(p.nodes[i]);
      if (found == local.end()) continue;
      bite.near.nodes.push_back(found->second);
      bite.near.weights.push_back(p.weights[i]);
      near_weight += p.weights[i];
      if (found->second >= mesh.owned) continue;
      bite.owned.nodes.push_back(found->second);
      bite.owned.weights.push_back(p.weights[i]);
    }
    const auto all = mesh.comm.gather(std::span<const double>(&near_weight, 1));
    if (std::ranges::max_element(all) - all.begin() != mesh.comm.rank()) bite.near = {};
  }
}

std::vector<Vec3<double>> SutureTerm::places(const State& state) const {
  std::vector<double> sum(3 * bites_.size());
  for (std::size_t b = 0; b < bites_.size(); ++b)
    for (std::size_t i = 0; i < bites_[b].owned.nodes.size(); ++i)
      for (int c = 0; c < 3; ++c)
        sum[3 * b + c] += bites_[b].owned.weights[i] * state.x[3 * bites_[b].owned.nodes[i] + c];
  mesh_.comm.sum(sum);
  std::vector<Vec3<double>> S(bites_.size());
  for (std::size_t b = 0; b < bites_.size(); ++b)
    for (int c = 0; c < 3; ++c)
      S[b][c] = bites_[b].on_plane[c] ? 0 : sum[3 * b + c];  // with its image it lies on the plane
  return S;
}

CuttingPlane SutureTerm::plane_through(const Vec3<double>& S) const {
  const bool meridian = norm(generator_) == 0;
  const Vec3<double> r = S - frame_.center, off = meridian ? frame_.axis : unit(generator_),
                     away = unit(r - dot(r, off) * off);
  const Vec3<double> normal = meridian ? cross(frame_.axis, away) : off;
  return {meridian ? frame_.center : frame_.center + dot(r, off) * off, normal, cross(away, normal), away};
}

std::optional<SutureTerm::Pull> SutureTerm::pull(const Vec3<double>& S) const {
  const CuttingPlane plane = plane_through(S);
  const auto found = outer_tangent(convex_outline(*body_, plane), plane.flat(S));
  if (!found) return {};
  const auto& d = found->direction;
  return Pull{plane.lift(found->touch), in_plane(plane, d), in_plane(plane, {-d[1], d[0]}), plane.normal,
              found->length};
}

// ∂d/∂S = −q qᵀ/ℓ + (∂d/∂s) nᵀ. As S moves by s along the plane's normal n, the plane follows and cuts
// another outline out of the body's triangles: that derivative is a central difference.
Mat3<double> SutureTerm::turn(const Vec3<double>& S, const Pull& at) const {
  const double h = step_of_difference * at.length;
  const auto ahead = pull(S + h * at.normal), back = pull(S + (-h) * at.normal);
  const Vec3<double> aside =
      ahead && back ? (.5 / h) * (ahead->direction - back->direction) : Vec3<double>{0, 0, 0};
  Mat3<double> D;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) D(i, j) = -at.across[i] * at.across[j] / at.length + aside[i] * at.normal[j];
  return D;
}

void SutureTerm::update(const State& state) {
  const auto S = places(state);
  for (std::size_t b = 0; b < bites_.size(); ++b) {
    strings_[b].S = S[b];
    const auto found = pull(S[b]);
    strings_[b].lost = !found;
    if (!found) continue;
    strings_[b].T = found->T;
    strings_[b].direction = found->direction;
  }
}

void SutureTerm::begin_step(int, const State& state) {
  if (idle()) return;
  update(state);
  for (std::size_t b = 0; b < bites_.size(); ++b)
    if (norm(strings_[b].direction) == 0)
      throw scene_error(key_,
                        "point " + std::to_string(b) + " has no tangent to the outline of '" + body_->name +
                            "': it lies inside, or its plane misses the body",
                        "Move the point out from under the body, or the body to the point.");
}

void SutureTerm::commit(const State& state) {
  if (!idle()) update(state);
}

void SutureTerm::serialize(Archive& archive) {
  std::vector<double> values;
  const auto visit = [&](auto take) {
    for (std::size_t b = 0; b < bites_.size(); ++b) {
      auto& [S, T, direction, force, lost] = strings_[b];
      for (auto* v : {&S, &T, &direction})
        for (double& c : *v) take(c);
      double flag = lost;
      take(flag);
      lost = flag != 0;
    }
  };
  visit([&](double v) { values.push_back(v); });
  archive.numbers(key_, values);
  std::size_t i = 0;
  visit([&](double& v) { v = values.at(i++); });
}

void SutureTerm::set_progress(double s) {
  now_ = start_ + (end_ - start_) * s;
  for (std::size_t b = 0; b < bites_.size(); ++b) strings_[b].force = now_;
}

void SutureTerm::freeze() {
  start_ = end_;
  set_progress(1);
}

void SutureTerm::add_residual(const State& state, std::span<double> force,
                              std::span<double> reference_force) const {
  if (now_ == 0) return;
  const auto S = follow_ ? places(state) : std::vector<Vec3<double>>{};
  for (std::size_t b = 0; b < bites_.size(); ++b) {
    const Bite& bite = bites_[b];
    Vec3<double> d = strings_[b].direction;
    if (follow_)
      if (const auto found = pull(S[b])) d = found->direction;
    for (std::size_t i = 0; i < bite.owned.nodes.size(); ++i) {
      const int n = bite.owned.nodes[i];
      const double f = bite.share * now_ * bite.owned.weights[i];
      for (int c = 0; c < 3; ++c) force[3 * n + c] -= f * d[c];
      if (!reference_force.empty()) reference_force[n] += std::abs(f);
    }
  }
}

// Of every point the nodes that hold it, and −∂(F d)/∂S.
struct SutureTerm::Tangent final : TermTangent {
  void add_action(std::span<const double> dx, std::span<double> force) const override {
    for (const auto& [near, K] : points) {
      Vec3<double> dS{0, 0, 0};
      for (std::size_t i = 0; i < near.nodes.size(); ++i)
        for (int c = 0; c < 3; ++c) dS[c] += near.weights[i] * dx[3 * near.nodes[i] + c];
      for (std::size_t i = 0; i < near.nodes.size(); ++i)
        for (int c = 0; c < 3; ++c)
          for (int k = 0; k < 3; ++k) force[3 * near.nodes[i] + c] += near.weights[i] * K(c, k) * dS[k];
    }
  }
  void visit(const ContributionVisitor& visitor) const override {
    std::vector<double> block;
    for (const auto& [near, K] : points) {
      if (near.nodes.empty()) continue;
      const std::size_t n = 3 * near.nodes.size();
      block.resize(n * n);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          block[n * i + j] =
              near.weights[i / 3] * near.weights[j / 3] * K(static_cast<int>(i % 3), static_cast<int>(j % 3));
      visitor(near.nodes, block);
    }
  }
  struct Point {
    Patch near;
    Mat3<double> stiffness;
  };
  std::vector<Point> points;
};

std::shared_ptr<const TermTangent> SutureTerm::tangent(const std::shared_ptr<const State>& state) const {
  if (!follow_ || now_ == 0) return nullptr;
  auto tangent = std::make_shared<Tangent>();
  const auto S = places(*state);
  for (std::size_t b = 0; b < bites_.size(); ++b) {
    auto& [near, K] = tangent->points.emplace_back(Tangent::Point{bites_[b].near, {}});
    const auto found = pull(S[b]);
    if (!found) continue;
    const Mat3<double> D = turn(S[b], *found);
    const auto& on_plane = bites_[b].on_plane;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (!on_plane[i] && !on_plane[j]) K(i, j) = -bites_[b].share * now_ * D(i, j);
  }
  return tangent;
}

}  // namespace bulbus::inline contact
