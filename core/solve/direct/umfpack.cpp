#include "core/solve/direct/libraries.hpp"

#ifdef BULBUS_UMFPACK
#include <umfpack.h>

#include <array>
#include <cmath>

#include "core/base/clock.hpp"
#include "core/solve/direct/compressed_rows.hpp"

namespace bulbus::inline solve {
namespace {

std::string explain_umfpack(int status) {
  if (status == UMFPACK_WARNING_singular_matrix) return "the matrix is singular";
  if (status == UMFPACK_ERROR_out_of_memory) return "not enough memory";
  return "UMFPACK error " + std::to_string(status);
}

// Integers of 64 bits: its own counts pass 2^31 at 60,000 hexahedra.
class Umfpack final : public Factorisation {
 public:
  explicit Umfpack(const Comm& comm) : comm_(comm) {
    umfpack_dl_defaults(control_.data());
    control_[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
    control_[UMFPACK_ORDERING] = UMFPACK_ORDERING_METIS;
  }
  ~Umfpack() override { release(); }
  Umfpack(const Umfpack&) = delete;
  Umfpack& operator=(const Umfpack&) = delete;

  FactorReport factorise(Triplets t, int rows, bool) override {
    release();
    take(compressed_rows(std::move(t), rows, comm_));
    FactorReport report{.matrix_entries = static_cast<double>(value_.size()), .negative_pivots = -1};
    double begin = Clock::now();
    void* symbolic = nullptr;
    int status = static_cast<int>(umfpack_dl_symbolic(rows, rows, start_.data(), index_.data(), value_.data(),
                                                      &symbolic, control_.data(), info_.data()));
    report.seconds_analysis = Clock::now() - begin;
    begin = Clock::now();
    if (status == UMFPACK_OK)
      status = static_cast<int>(umfpack_dl_numeric(start_.data(), index_.data(), value_.data(), symbolic,
                                                   &numeric_, control_.data(), info_.data()));
    umfpack_dl_free_symbolic(&symbolic);
    report.seconds_factorisation = Clock::now() - begin;
    report.code = status;
    report.ok = status == UMFPACK_OK;
    if (!report.ok) return release(), report.reason = explain_umfpack(status), report;
    report.ordering = info_[UMFPACK_ORDERING_USED] == UMFPACK_ORDERING_METIS ? "METIS" : "AMD";
    report.factor_entries = info_[UMFPACK_LNZ] + info_[UMFPACK_UNZ];
    report.flops = info_[UMFPACK_FLOPS];
    report.memory_mb = report.memory_max_mb = 1e-6 * info_[UMFPACK_PEAK_MEMORY] * info_[UMFPACK_SIZE_OF_UNIT];
    return report;
  }

  // Rows compressed are the columns of Aᵀ.
  bool solve(std::span<const double> b, std::span<double> x) override {
    return numeric_ && umfpack_dl_solve(UMFPACK_At, start_.data(), index_.data(), value_.data(), x.data(),
                                        b.data(), numeric_, control_.data(), info_.data()) == UMFPACK_OK;
  }

 private:
  void take(const CompressedRows& a) {
    start_.assign(a.start.begin(), a.start.end());
    index_.assign(a.column.begin(), a.column.end());
    value_ = a.value;
  }
  void release() {
    if (numeric_) umfpack_dl_free_numeric(&numeric_);
    numeric_ = nullptr;
  }

  Comm comm_;
  std::array<double, UMFPACK_CONTROL> control_{};
  std::array<double, UMFPACK_INFO> info_{};
  std::vector<SuiteSparse_long> start_, index_;
  std::vector<double> value_;
  void* numeric_ = nullptr;
};

}  // namespace

bool has_umfpack() { return true; }

std::unique_ptr<Factorisation> make_umfpack(const Comm& comm) { return std::make_unique<Umfpack>(comm); }

}  // namespace bulbus::inline solve

#else

namespace bulbus::inline solve {

bool has_umfpack() { return false; }

std::unique_ptr<Factorisation> make_umfpack(const Comm&) { return nullptr; }

}  // namespace bulbus::inline solve

#endif
