#include <omp.h>
#include <superlu_ddefs.h>

#include <algorithm>
#include <cmath>

#include "core/base/clock.hpp"
#include "core/solve/direct/compressed_rows.hpp"
#include "core/solve/direct/libraries.hpp"
#include "core/solve/direct/nested_dissection.hpp"

namespace bulbus::inline solve {
namespace {

// A grid of ranks that is as square as can be.
int rows_of_grid(int ranks) {
  int rows = static_cast<int>(std::sqrt(ranks + .5));
  while (ranks % rows != 0) --rows;
  return rows;
}

class SuperLuDist final : public Factorisation {
 public:
  // By one thread: with two, Debian's 8.1 gives wrong solutions now and then (docs/decisions/054).
  explicit SuperLuDist(const Comm& comm) : comm_(comm) {
    omp_set_num_threads(1);
    const int rows = rows_of_grid(comm.size());
    superlu_gridinit(comm.raw(), rows, comm.size() / rows, &grid_);
  }
  ~SuperLuDist() override {
    release();
    int ended = 0;
    MPI_Finalized(&ended);
    if (!ended) superlu_gridexit(&grid_);
  }
  SuperLuDist(const SuperLuDist&) = delete;
  SuperLuDist& operator=(const SuperLuDist&) = delete;

  FactorReport factorise(Triplets t, int rows, bool) override {
    release();
    const double start = Clock::now();
    const std::vector<int> position = nested_dissection(t, comm_.sum(rows), comm_);
    const double seconds_ordering = comm_.max(Clock::now() - start);
    const CompressedRows matrix = compressed_rows(std::move(t), rows, comm_);
    begin(matrix, position);
    int info = 0;
    call(nullptr, 0, info);  // no right-hand side: factors only
    FactorReport report{.ok = info == 0, .code = info, .ordering = "METIS", .negative_pivots = -1};
    if (info != 0)  // beyond n: bytes that were allocated
      report.reason = info > n_
                          ? "not enough memory"
                          : "the matrix is singular, or a pivot vanished, as rows are not exchanged: take "
                            "direct: mumps";
    report.matrix_entries = static_cast<double>(comm_.sum(static_cast<long long>(matrix.value.size())));
    if (report.ok) tell(report);
    report.seconds_analysis += seconds_ordering;
    options_.Fact = FACTORED;
    factorised_ = report.ok;
    return report;
  }

  bool solve(std::span<const double> b, std::span<double> x) override {
    if (!factorised_) return false;
    std::vector<double> solution(b.begin(), b.end());
    int info = 0;
    call(solution.data(), 1, info);
    const auto finite = [](double v) { return std::isfinite(v); };
    const bool ok = comm_.all(info == 0 && std::ranges::all_of(solution, finite));
    if (ok) std::ranges::copy(solution, x.begin());
    return ok;
  }

 private:
  // Debian's library has no code that brings large entries to the diagonal (MC64 is not free).
  void begin(const CompressedRows& matrix, const std::vector<int>& position) {
    rows_ = with_diagonals(matrix);
    CompressedRows& a = rows_;
    n_ = comm_.sum(a.rows());
    dCreate_CompRowLoc_Matrix_dist(&matrix_, n_, n_, static_cast<int_t>(a.value.size()), a.rows(), a.first,
                                   a.value.data(), a.column.data(), a.start.data(), SLU_NR_loc, SLU_D,
                                   SLU_GE);
    set_default_options_dist(&options_);
    options_.PrintStat = NO;
    options_.ColPerm = MY_PERMC;
    options_.RowPerm = NOROWPERM;
    options_.IterRefine = SLU_DOUBLE;
    dScalePermstructInit(n_, n_, &permutation_);
    std::ranges::copy(position, permutation_.perm_c);
    dLUstructInit(n_, &factors_);
    PStatInit(&statistics_);
    begun_ = true;
  }
  // Scales the matrix in place.
  void call(double* b, int columns, int& info) {
    double error = 0;
    pdgssvx(&options_, &matrix_, &permutation_, b, rows_.rows(), columns, &grid_, &factors_, &solution_,
            &error, &statistics_, &info);
  }
  void tell(FactorReport& report) {
    superlu_dist_mem_usage_t memory{};
    dQuerySpace_dist(n_, &factors_, &grid_, &statistics_, &memory);
    const double* seconds = statistics_.utime;
    report.seconds_analysis =
        comm_.max(seconds[EQUIL] + seconds[ROWPERM] + seconds[COLPERM] + seconds[ETREE] + seconds[SYMBFAC]);
    report.seconds_factorisation = comm_.max(seconds[DIST] + seconds[FACT]);
    report.flops = comm_.sum(static_cast<double>(statistics_.ops[FACT]));
    report.memory_mb = 1e-6 * comm_.sum(static_cast<double>(memory.total));
    report.memory_max_mb = 1e-6 * comm_.max(static_cast<double>(memory.total));
    report.factor_entries = comm_.sum(static_cast<double>(memory.for_lu)) / sizeof(double);
  }
  void release() {
    if (!begun_) return;
    PStatFree(&statistics_);
    dDestroy_LU(n_, &grid_, &factors_);
    dScalePermstructFree(&permutation_);
    dLUstructFree(&factors_);
    if (options_.SolveInitialized == YES) dSolveFinalize(&options_, &solution_);
    Destroy_SuperMatrix_Store_dist(&matrix_);  // whose arrays are ours
    begun_ = factorised_ = false;
  }

  Comm comm_;
  gridinfo_t grid_{};
  superlu_dist_options_t options_{};
  SuperMatrix matrix_{};
  dScalePermstruct_t permutation_{};
  dLUstruct_t factors_{};
  dSOLVEstruct_t solution_{};
  SuperLUStat_t statistics_{};
  CompressedRows rows_;
  int n_ = 0;
  bool begun_ = false, factorised_ = false;
};

}  // namespace

std::unique_ptr<Factorisation> make_superlu_dist(const Comm& comm) {
  return std::make_unique<SuperLuDist>(comm);
}

}  // namespace bulbus::inline solve
