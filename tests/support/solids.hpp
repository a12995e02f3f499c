#pragma once
#include <optional>

#include "core/element/solid_tangent.hpp"
#include "core/mesh/generate/generate.hpp"
#include "tests/support/numbers.hpp"

namespace bulbus {

inline std::vector<double> places(const Mesh& mesh) {
  std::vector<double> X;
  for (const Point& p : mesh.points) X.insert(X.end(), p.begin(), p.end());
  return X;
}

/// nx × ny × nz cells of size 1 with nodes shaken by `shake`.
inline Mesh shaken_block(int nx, int ny, int nz, double shake = .12, int seed = 1) {
  BlockShape shape{.upper = {double(nx), double(ny), double(nz)}, .nx = nx, .ny = ny, .nz = nz};
  Mesh mesh = generate(shape);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    for (int c = 0; c < 3; ++c) mesh.points[i][c] += shake * noise(seed, 3 * i + c);
  return mesh;
}

/// A random affine map and a random shake: finite strains, nothing inverted.
inline std::vector<double> deformed(std::span<const double> X, int seed, double strain = .2,
                                    double shake = .08) {
  const Mat3<double> F = random_gradient(seed, strain);
  std::vector<double> x(X.size());
  for (std::size_t i = 0; i < X.size(); ++i) {
    const std::size_t n = i / 3 * 3;
    const int c = static_cast<int>(i % 3);
    x[i] = F(c, 0) * X[n] + F(c, 1) * X[n + 1] + F(c, 2) * X[n + 2] + shake * noise(seed + 1000, i);
  }
  return x;
}

/// Of a solid that outlives it.
inline SolidTangent tangent_of(const Solid& solid, std::span<const double> x, std::span<const double> lambda,
                               double gamma, StrainSource source = StrainSource::recompute) {
  const auto shared = [](std::span<const double> v) {
    return std::make_shared<const std::vector<double>>(v.begin(), v.end());
  };
  return {std::shared_ptr<const Solid>(std::shared_ptr<void>(), &solid), shared(x), shared(lambda), gamma,
          source};
}

/// A row of n neo-Hookean hexahedra, deformed: packs that are not full.
struct Row {
  int n;
  Mesh mesh = shaken_block(n, 1, 1);
  std::vector<double> X = places(mesh), x = deformed(X, 3, .15, .05), lambda = noise_vector(n, 1),
                      d = noise_vector(X.size(), 2);
  Solid solid{X, mesh.hexes, {{"a", make_material({{1, 0, .8}}), 0, n}}};
};

/// 27 hexahedra of three materials: 10 neo-Hookean, 9 Mooney-Rivlin, 8 polynomial; full packs and partial
/// ones.
struct ThreeTissues {
  Mesh mesh = shaken_block(3, 3, 3);
  std::vector<double> X = places(mesh), x = deformed(X, 7), lambda = noise_vector(27, 5);
  Solid solid{X,
              mesh.hexes,
              {{"a", make_material({{1, 0, .8}}), 0, 10},
               {"b", make_material({{1, 0, .5}, {0, 1, .4}}), 10, 9},
               {"c", make_material({{1, 0, .7}, {0, 1, .2}, {2, 0, .3}, {1, 1, .1}, {0, 2, .2}, {3, 0, .1}}),
                19, 8}}};
  std::optional<SolidTangent> tangent;  ///< after linearise()
  int size() const { return static_cast<int>(X.size()); }

  void linearise(std::span<const double> at, std::span<const double> pressures, double gamma,
                 StrainSource source = StrainSource::recompute) {
    tangent.emplace(tangent_of(solid, at, pressures, gamma, source));
  }

  std::vector<double> force(std::span<const double> at, std::span<const double> pressures) const {
    std::vector<double> f(X.size()), v(27);
    solid.residual(at, pressures, f, v);
    return f;
  }
  std::vector<double> volume_defect(std::span<const double> at) const {
    std::vector<double> f(X.size()), v(27);
    solid.residual(at, lambda, f, v);
    return v;
  }
};

}  // namespace bulbus
