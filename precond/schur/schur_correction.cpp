#include "precond/schur/schur_correction.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/base/memory.hpp"
#include "precond/schur/checkerboard_matrix.hpp"
#include "precond/schur/oscillation_filter.hpp"
#include "precond/smoothers/chebyshev.hpp"

namespace bulbus::inline precond {
namespace {

// (1 + γ) μ_e/V0_e; zero of rigid hexahedra, which have no Schur complement.
std::vector<double> inverse_diagonal(const CoupledSystem& system) {
  std::vector<double> values = system.inverse_pressure_schur();
  for (int e : system.problem().solid().rigid_hexes()) values[e] = 0;
  return values;
}

// Of the four modes of eight hexahedra: an eighth of the mean of theirs, for columns of P are as long as
// √8.
std::vector<double> inverse_diagonal(const CoupledSystem& system, const CheckerboardModes& modes) {
  const auto of_hexes = inverse_diagonal(system);
  std::vector<double> values(modes.size());
  for (std::size_t h = 0; h < of_hexes.size(); ++h)
    if (const int coarser = modes.coarser_of(static_cast<int>(h)); coarser >= 0)
      for (int k = 0; k < modes.count(); ++k) values[modes.count() * coarser + k] += of_hexes[h] / 64;
  return values;
}

class Diagonal final : public Preconditioner {
 public:
  explicit Diagonal(std::vector<double> values) : values_(std::move(values)) {}
  int size() const override { return static_cast<int>(values_.size()); }
  void apply(std::span<const double> r, std::span<double> z) const override {
    std::ranges::transform(values_, r, z.begin(), std::multiplies{});
  }
  bool is_linear() const override { return true; }
  std::size_t bytes() const override { return bytes_of(values_); }

 private:
  std::vector<double> values_;
};

// As many hexahedra as a mesh has in one direction, more or less, times `part`: halving them doubles it.
// Fewer than 16 gain little. `part` is where the eye's fourth Newton system stopped to gain: 59 k hexahedra
// 41, 32 iterations with 1, 1.6; refined once 20, 15, 17 with 1, 2, 3. Solves to 1e-3 take as many with 0.8
// as with 1.6 and a quarter less time (benchmarks/notebook/checkerboard_modes.md).
int degree_for(double hexes, double part) {
  return std::max(16, static_cast<int>(std::lround(part * std::cbrt(hexes))));
}

// A polynomial of degree d inverts eigenvalues above the part a of the largest one to within
// 1/T_d((1+a)/(1−a)), which is a third where √a = arccosh(3)/(2d), for small a: a = 0.777/d².
double smallest_for(int degree) { return 0.77 / (static_cast<double>(degree) * degree); }

// Of a block of the checkerboard modes' matrix: a third to two fifths of them are less. Iterations are the
// same with 1e-3 and grow by half with 3e-3 (benchmarks/notebook/checkerboard_modes.md).
constexpr double negligible = 3e-4;

class OscillationCorrection final : public SchurCorrection {
 public:
  OscillationCorrection(const CoupledSystem& system, const LineJacobi& lines,
                        std::shared_ptr<const LinePressureStiffness> K, int degree)
      : K_(std::move(K)),
        filter_(system.problem(), carried_by_lines(system, lines)),
        scale_(std::make_shared<Diagonal>(inverse_diagonal(system))),
        inverse_(K_, scale_, degree, smallest_for(degree), system.problem().comm()),
        given_(K_->size()),
        correction_(K_->size()) {}
  void add(std::span<const double> r, double weight, std::span<double> z) override {
    std::ranges::copy(r, given_.begin());
    filter_.apply(given_);
    inverse_.apply(given_, correction_);
    filter_.apply(correction_);
    for (std::size_t e = 0; e < z.size(); ++e) z[e] += weight * correction_[e];
  }
  std::size_t bytes() const override {
    return filter_.bytes() + scale_->bytes() + inverse_.bytes() + bytes_of(given_) + bytes_of(correction_);
  }

 private:
  std::shared_ptr<const LinePressureStiffness> K_;
  OscillationFilter filter_;
  std::shared_ptr<const Diagonal> scale_;
  Chebyshev inverse_;
  std::vector<double> given_, correction_;
};

template <class Product, class Scale>
class CheckerboardCorrection final : public SchurCorrection {
 public:
  // make_product(P), make_scale(P, product): shared pointers
  template <class MakeProduct, class MakeScale>
  CheckerboardCorrection(const Problem& problem, int refinements, int degree, MakeProduct make_product,
                         MakeScale make_scale)
      : modes_(std::make_shared<CheckerboardModes>(problem, refinements)),
        K_(make_product(modes_)),
        scale_(make_scale(*modes_, *K_)),
        inverse_(K_, scale_, degree, smallest_for(degree), problem.comm()),
        given_(K_->size()),
        correction_(K_->size()) {}
  void add(std::span<const double> r, double weight, std::span<double> z) override {
    modes_->restrict_pressures(r, given_);
    inverse_.apply(given_, correction_);
    modes_->add_prolonged(correction_, weight, z);
  }
  std::size_t bytes() const override {
    return modes_->bytes() + K_->bytes() + scale_->bytes() + inverse_.bytes() + bytes_of(given_) +
           bytes_of(correction_);
  }

 private:
  std::shared_ptr<const CheckerboardModes> modes_;
  std::shared_ptr<const Product> K_;
  std::shared_ptr<const Scale> scale_;
  Chebyshev inverse_;
  std::vector<double> given_, correction_;
};

}  // namespace

std::unique_ptr<SchurCorrection> oscillation_correction(const CoupledSystem& system, const LineJacobi& lines,
                                                        std::shared_ptr<const LinePressureStiffness> K,
                                                        std::optional<int> degree, bool many_digits) {
  const double hexes = static_cast<double>(system.problem().mesh().all_hexes);
  return std::make_unique<OscillationCorrection>(system, lines, std::move(K),
                                                 degree.value_or(degree_for(hexes, many_digits ? 1.6 : 0.8)));
}

std::unique_ptr<SchurCorrection> fine_checkerboard_correction(const CoupledSystem& system,
                                                              std::shared_ptr<const LinePressureStiffness> K,
                                                              std::optional<int> degree) {
  return std::make_unique<CheckerboardCorrection<CheckerboardProduct, Diagonal>>(
      system.problem(), 1, degree.value_or(16),
      [&](const auto& P) { return std::make_shared<CheckerboardProduct>(P, K); },
      [&](const CheckerboardModes& P, const CheckerboardProduct&) {
        return std::make_shared<Diagonal>(inverse_diagonal(system, P));
      });
}

std::unique_ptr<SchurCorrection> coarse_checkerboard_correction(const CoupledSystem& system,
                                                                const LineJacobi& lines,
                                                                std::optional<int> degree) {
  const Problem& problem = system.problem();
  const int refinements = std::min(2, problem.mesh().refinements);
  const double hexes = static_cast<double>(problem.mesh().all_hexes >> (3 * refinements));
  return std::make_unique<CheckerboardCorrection<CheckerboardMatrix, CheckerboardJacobi>>(
      problem, refinements, degree.value_or(degree_for(hexes, 2)),
      [&](const auto& P) {
        auto matrix = std::make_shared<CheckerboardMatrix>(system, P, lines);
        matrix->drop(negligible);
        return matrix;
      },
      [](const CheckerboardModes&, const CheckerboardMatrix& matrix) {
        return std::make_shared<CheckerboardJacobi>(matrix);
      });
}

}  // namespace bulbus::inline precond
