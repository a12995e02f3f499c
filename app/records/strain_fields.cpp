#include "app/records/strain_fields.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/element/q1.hpp"

namespace bulbus::inline app {
namespace {

using Matrix = Eigen::Matrix3d;

// ½ ∂/∂ξ in the middle of the hexahedron, a column per direction.
Matrix middle_gradient(const Hex& hex, std::span<const double> values) {
  NodalVectors<double> at_nodes;
  for (int n = 0; n < 8; ++n)
    for (int c = 0; c < 3; ++c) at_nodes[n][c] = values[3 * hex[vtk_of_lexicographic[n]] + c];
  const Modes<double> m = modes(at_nodes);
  Matrix g;
  for (int c = 0; c < 3; ++c)
    for (int d = 0; d < 3; ++d) g(c, d) = m.linear[d][c];
  return g;
}

// FᵀF of every hexahedron.
template <class Use>
void for_each_right_cauchy_green(const Snapshot& s, Use use) {
  const LocalMesh& mesh = s.problem.mesh();
  for (const Hex& hex : mesh.hexes) {
    const Matrix F = middle_gradient(hex, s.state.x) * middle_gradient(hex, mesh.X).inverse();
    use(Matrix(F.transpose() * F));
  }
}

// Largest first.
Eigen::Vector3d eigenvalues(const Matrix& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Matrix>(symmetric, Eigen::EigenvaluesOnly).eigenvalues().reverse();
}

}  // namespace

Field green_strain(const Snapshot& s) {
  Field f{"strain", 6, {}};
  for_each_right_cauchy_green(s, [&](const Matrix& C) {
    const Matrix E = (C - Matrix::Identity()) / 2;
    f.values.insert(f.values.end(), {E(0, 0), E(1, 1), E(2, 2), E(0, 1), E(1, 2), E(0, 2)});
  });
  return f;
}

Field principal_stretches(const Snapshot& s) {
  Field f{"principal_stretches", 3, {}};
  for_each_right_cauchy_green(s, [&](const Matrix& C) {
    for (double squared : eigenvalues(C)) f.values.push_back(std::sqrt(std::max(squared, 0.)));
  });
  return f;
}

Field principal_stresses(Snapshot& s) {
  Field f{"principal_stresses", 3, {}, "MPa"};
  for (const CellStress& cell : s.stresses()) {
    Matrix sigma;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) sigma(i, j) = cell.cauchy(i, j);
    for (double value : eigenvalues(sigma)) f.values.push_back(value);
  }
  return f;
}

}  // namespace bulbus::inline app
