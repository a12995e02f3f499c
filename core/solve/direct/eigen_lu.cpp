#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

#include "core/base/clock.hpp"
#include "core/solve/direct/compressed_rows.hpp"
#include "core/solve/direct/libraries.hpp"

namespace bulbus::inline solve {
namespace {

class EigenLu final : public Factorisation {
 public:
  explicit EigenLu(const Comm& comm) : comm_(comm) {}

  FactorReport factorise(Triplets t, int rows, bool) override {
    factorised_ = false;
    FactorReport report{.ordering = "COLAMD", .negative_pivots = -1};
    const CompressedRows a = compressed_rows(std::move(t), rows, comm_);
    report.matrix_entries = static_cast<double>(a.value.size());
    matrix_ = Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>>(
        rows, rows, static_cast<int>(a.value.size()), a.start.data(), a.column.data(), a.value.data());
    double begin = Clock::now();
    lu_.analyzePattern(matrix_);
    report.seconds_analysis = Clock::now() - begin;
    begin = Clock::now();
    lu_.factorize(matrix_);
    report.seconds_factorisation = Clock::now() - begin;
    report.ok = factorised_ = lu_.info() == Eigen::Success;
    if (!report.ok) report.reason = "the matrix is singular";
    report.factor_entries = static_cast<double>(lu_.nnzL()) + static_cast<double>(lu_.nnzU());
    report.memory_mb = report.memory_max_mb = 1e-6 * report.factor_entries * (sizeof(double) + sizeof(int));
    return report;
  }

  bool solve(std::span<const double> b, std::span<double> x) override {
    if (!factorised_) return false;
    using Vector = Eigen::Map<Eigen::VectorXd>;
    Vector(x.data(), matrix_.rows()) = lu_.solve(Eigen::Map<const Eigen::VectorXd>(b.data(), matrix_.rows()));
    return true;
  }

 private:
  Comm comm_;
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SparseLU<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> lu_;
  bool factorised_ = false;
};

}  // namespace

std::unique_ptr<Factorisation> make_eigen(const Comm& comm) { return std::make_unique<EigenLu>(comm); }

}  // namespace bulbus::inline solve
