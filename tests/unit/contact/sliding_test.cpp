#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "tests/support/sheets.hpp"
#include "tests/support/term_tangent.hpp"

namespace bulbus {
namespace {

/// Two wavy sheets whose nodes hang on springs k, with edges of stiffness 20 k between them; the slave's
/// anchors are pressed into the master's and slide along.
struct Sliding : testing::Test {
  Sheets sheets;
  std::vector<Quad> slave = sheets.add(9, 9, [](double u, double v) {
    return Vec3<double>{.2 + .5 * v, .2 + .5 * u, height(.2 + .5 * v) + .005};
  });
  int slaves = sheets.nodes();
  std::vector<Quad> master = sheets.add(13, 11, [](double u, double v) {
    return Vec3<double>{1.3 * u, v, height(1.3 * u)};
  });
  ContactTerm term{contact_spec(3e4, .1),
                   {.penalty = 0, .depth = 0, .reach = .4},
                   {sheets.X, sheets.nodes(), slave, Master(split(master)), {}},
                   Comm()};
  std::vector<double> anchors = sheets.X;
  State state = sheets.state();
  double k = 1;
  Eigen::MatrixXd sheet_stiffness = [this] {
    const long size = static_cast<long>(sheets.X.size());
    Eigen::MatrixXd K = Eigen::MatrixXd::Identity(size, size) * k;
    for (const auto* faces : {&slave, &master})
      for (const Quad& q : *faces)
        for (int i = 0; i < 4; ++i)
          for (int c = 0; c < 3; ++c) {
            const int a = 3 * q[i] + c, b = 3 * q[(i + 1) % 4] + c;
            K(a, a) += 10 * k, K(b, b) += 10 * k, K(a, b) -= 10 * k, K(b, a) -= 10 * k;
          }
    return K;
  }();

  static double height(double x) { return .06 * std::sin(4 * x); }

  std::vector<double> residual() const {
    const auto u = plus(state.x, -1, anchors);
    const Eigen::VectorXd pull = sheet_stiffness * Eigen::Map<const Eigen::VectorXd>(u.data(), u.size());
    std::vector<double> r(pull.begin(), pull.end());
    term.add_residual(state, r, {});
    return r;
  }
  /// The largest residuals, iteration by iteration.
  std::vector<double> newton() {
    std::vector<double> history;
    for (int i = 0; i < 25; ++i) {
      const auto r = residual();
      history.push_back(largest(r));
      if (history.back() < 1e-12) break;
      const auto tangent = tangent_at(term, state);
      Eigen::MatrixXd K = sheet_stiffness;
      tangent->visit([&](std::span<const int> nodes, std::span<const double> M) {
        const std::size_t n = 3 * nodes.size();
        for (std::size_t a = 0; a < n; ++a)
          for (std::size_t b = 0; b < n; ++b)
            K(3 * nodes[a / 3] + a % 3, 3 * nodes[b / 3] + b % 3) += M[n * a + b];
      });
      const Eigen::VectorXd dx =
          -K.partialPivLu().solve(Eigen::Map<const Eigen::VectorXd>(r.data(), r.size()));
      for (std::size_t j = 0; j < state.x.size(); ++j) state.x[j] += dx[j];
      term.predict(*tangent, {dx.data(), static_cast<std::size_t>(dx.size())});
    }
    return history;
  }
};

TEST_F(Sliding, NewtonConvergesQuadraticallyOverManyFacets) {
  term.begin_step(0, state);
  for (int increment = 1; increment <= 6; ++increment) {
    for (int n = 0; n < slaves; ++n) {
      anchors[3 * n] += .06;
      if (increment == 1) anchors[3 * n + 2] -= .03;
    }
    term.set_progress(increment / 6.);
    const auto history = newton();
    ASSERT_LT(history.back(), 1e-12) << increment;
    EXPECT_LE(history.size(), 12u) << increment;
    EXPECT_LT(history.back(), 1e2 * std::pow(history[history.size() - 2], 2) + 1e-13);
    term.commit(state);
    EXPECT_GE(term.figures(state).pairs, 10);
    EXPECT_LT(term.figures(state).penetration, .005);
  }
}

}  // namespace
}  // namespace bulbus
