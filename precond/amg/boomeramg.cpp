#include "precond/amg/boomeramg.hpp"

#include <HYPRE.h>
#include <HYPRE_parcsr_ls.h>
#include <_hypre_parcsr_ls.h>
#include <_hypre_parcsr_mv.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/base/error.hpp"
#include "precond/amg/at_mpi_finalize.hpp"

#undef max
#undef min

namespace bulbus::inline precond {
namespace {

void start_hypre() {
  static bool started = false;
  if (started) return;
  HYPRE_Init();
  at_mpi_finalize([] { HYPRE_Finalize(); });
  started = true;
}

/// Hypre's errors since the last call, without "did not converge", which one cycle never does.
std::string take_error() {
  HYPRE_Int error = HYPRE_GetError() & ~HYPRE_ERROR_CONV;
  HYPRE_ClearAllErrors();
  if (!error) return "";
  char text[256] = "";
  HYPRE_DescribeError(error, text);
  return std::string("hypre: ") + text;
}

void check(const DistributedCsr& m, const AmgOptions& o, const Comm& comm) {
  long long limit = std::numeric_limits<HYPRE_Int>::max();
  long long total = comm.sum(static_cast<long long>(m.rows));
  if (total > limit)
    throw input_error("more than 2^31 unknowns for hypre: " + std::to_string(total),
                      "take a preconditioner without BoomerAMG, or a coarser mesh");
  bool fits = m.first_row == comm.offset(m.rows) && m.start.size() == m.row_ids.size() + 1 &&
              m.columns.size() == m.values.size() && m.start.back() == static_cast<int>(m.columns.size());
  auto outside = [&](long long i) { return i < 0 || i >= total; };
  fits = fits && std::none_of(m.row_ids.begin(), m.row_ids.end(), outside) &&
         std::none_of(m.columns.begin(), m.columns.end(), outside);
  if (comm.any(!fits))
    throw std::invalid_argument("BoomerAmg: the rows do not make a distributed square matrix");
  if (comm.any(m.rows % o.functions != 0))
    throw std::invalid_argument("BoomerAmg: a rank's rows must hold whole nodes");
  for (const auto& mode : o.rigid_modes)
    if (static_cast<int>(mode.size()) != m.rows || !o.nodal)
      throw std::invalid_argument("BoomerAmg: rigid modes need nodal coarsening and one entry per row");
}

bool finite(const DistributedCsr& m, const Comm& comm) {
  return comm.all(std::all_of(m.values.begin(), m.values.end(), [](double v) { return std::isfinite(v); }));
}

HYPRE_IJMatrix assemble(const DistributedCsr& m, const Comm& comm) {
  HYPRE_IJMatrix A;
  HYPRE_BigInt first = m.first_row, last = m.first_row + m.rows - 1;
  HYPRE_IJMatrixCreate(comm.raw(), first, last, first, last, &A);
  HYPRE_IJMatrixSetObjectType(A, HYPRE_PARCSR);
  std::vector<HYPRE_Int> lengths(m.rows, 0), counts(m.row_ids.size());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    counts[i] = m.start[i + 1] - m.start[i];
    if (m.row_ids[i] >= first && m.row_ids[i] <= last) lengths[m.row_ids[i] - first] += counts[i];
  }
  HYPRE_IJMatrixSetRowSizes(A, lengths.data());
  HYPRE_IJMatrixInitialize(A);
  std::vector<HYPRE_BigInt> rows(m.row_ids.begin(), m.row_ids.end()),
      columns(m.columns.begin(), m.columns.end());
  HYPRE_IJMatrixAddToValues(A, static_cast<HYPRE_Int>(rows.size()), counts.data(), rows.data(),
                            columns.data(), m.values.data());
  HYPRE_IJMatrixAssemble(A);
  return A;
}

/// A hypre vector on memory of the caller.
hypre_ParVector* wrap(const double* x, hypre_ParCSRMatrix* A) {
  hypre_ParVector* v = hypre_ParVectorCreate(hypre_ParCSRMatrixComm(A), hypre_ParCSRMatrixGlobalNumRows(A),
                                             hypre_ParCSRMatrixRowStarts(A));
  hypre_Vector* local = hypre_ParVectorLocalVector(v);
  hypre_VectorOwnsData(local) = 0;
  hypre_VectorData(local) = const_cast<double*>(x);
  hypre_ParVectorInitialize(v);
  return v;
}

void set_smoother(HYPRE_Solver s, AmgSmoother smoother) {
  auto down_up = [&](int down, int up) {
    HYPRE_BoomerAMGSetCycleRelaxType(s, down, 1);
    HYPRE_BoomerAMGSetCycleRelaxType(s, up, 2);
  };
  switch (smoother) {
    case AmgSmoother::gauss_seidel:
      down_up(13, 14);
      break;
    case AmgSmoother::symmetric_gauss_seidel:
      down_up(8, 8);
      break;
    case AmgSmoother::jacobi:
      down_up(18, 18);
      break;
    case AmgSmoother::chebyshev:
      down_up(16, 16);
      break;
  }
  HYPRE_BoomerAMGSetCycleRelaxType(s, 9, 3);  // Gaussian elimination of at most so many rows:
  HYPRE_BoomerAMGSetMaxCoarseSize(s, 64);
  HYPRE_BoomerAMGSetRelaxOrder(s, 0);  // C/F ordering would make the cycle unsymmetric
}

/// Where coarsening ended above the greatest size for elimination, hypre falls back on a forward sweep, which
/// would make the cycle unsymmetric: a symmetric sweep (hybrid, which needs no l1 norms) in its place.
void keep_coarsest_symmetric(HYPRE_Solver s) {
  auto* data = reinterpret_cast<hypre_ParAMGData*>(s);
  if (hypre_ParAMGDataGridRelaxType(data)[3] != 9) HYPRE_BoomerAMGSetCycleRelaxType(s, 6, 3);
}

HYPRE_Solver configure(const AmgOptions& o) {
  HYPRE_Solver s;
  HYPRE_BoomerAMGCreate(&s);
  HYPRE_BoomerAMGSetPrintLevel(s, 0);
  HYPRE_BoomerAMGSetTol(s, 0);
  HYPRE_BoomerAMGSetMaxIter(s, o.cycles);
  HYPRE_BoomerAMGSetCoarsenType(s, o.pmis ? 8 : 10);
  HYPRE_BoomerAMGSetInterpType(s, 6);  // extended+i
  HYPRE_BoomerAMGSetPMaxElmts(s, o.max_per_row);
  HYPRE_BoomerAMGSetStrongThreshold(s, o.threshold);
  HYPRE_BoomerAMGSetAggNumLevels(s, o.aggressive_levels);
  HYPRE_BoomerAMGSetNumSweeps(s, o.sweeps);
  HYPRE_BoomerAMGSetCycleNumSweeps(s, 1, 3);
  set_smoother(s, o.smoother);
  if (o.functions > 1) HYPRE_BoomerAMGSetNumFunctions(s, o.functions);
  if (o.nodal) {
    HYPRE_BoomerAMGSetNodal(s, 4);      // row-sum norm of the nodal blocks
    HYPRE_BoomerAMGSetNodalDiag(s, 1);  // diagonal = -(sum of the others)
  }
  return s;
}

void set_rigid_modes(HYPRE_Solver s, std::vector<hypre_ParVector*>& modes) {
  if (modes.empty()) return;
  // A coarse rotation that interpolates to nothing leaves an empty row, which l1 norms and elimination
  // refuse. Sweeps without them (hybrid between ranks) pass over it.
  for (int way : {1, 2, 3}) HYPRE_BoomerAMGSetCycleRelaxType(s, 6, way);
  HYPRE_BoomerAMGSetInterpVecVariant(s, 2);  // GM2
  HYPRE_BoomerAMGSetInterpVecQMax(s, 4);
  HYPRE_BoomerAMGSetInterpVectors(s, static_cast<HYPRE_Int>(modes.size()), modes.data());
}

long long local_entries(hypre_ParCSRMatrix* A) {
  return static_cast<long long>(hypre_CSRMatrixNumNonzeros(hypre_ParCSRMatrixDiag(A))) +
         hypre_CSRMatrixNumNonzeros(hypre_ParCSRMatrixOffd(A));
}

std::size_t local_bytes(hypre_ParCSRMatrix* A) {
  std::size_t rows = hypre_CSRMatrixNumRows(hypre_ParCSRMatrixDiag(A));
  return local_entries(A) * (sizeof(HYPRE_Complex) + sizeof(HYPRE_Int)) + 2 * rows * sizeof(HYPRE_Int);
}

}  // namespace

struct BoomerAmg::Hierarchy {
  int rows = 0, levels = 0;
  HYPRE_IJMatrix ij = nullptr;
  hypre_ParCSRMatrix* A = nullptr;
  HYPRE_Solver solver = nullptr;
  std::vector<hypre_ParVector*> modes;  // hypre refers to them until it is destroyed
  std::string failure;
  std::size_t bytes = 0;
  double grid = 1, entries = 1;

  ~Hierarchy() {
    if (solver) HYPRE_BoomerAMGDestroy(solver);
    for (hypre_ParVector* v : modes) hypre_ParVectorDestroy(v);
    if (ij) HYPRE_IJMatrixDestroy(ij);
  }

  void set_up(const DistributedCsr& m, const AmgOptions& o, const Comm& comm) {
    ij = assemble(m, comm);
    void* object = nullptr;
    HYPRE_IJMatrixGetObject(ij, &object);
    A = static_cast<hypre_ParCSRMatrix*>(object);
    solver = configure(o);
    for (const auto& mode : o.rigid_modes) modes.push_back(wrap(mode.data(), A));
    set_rigid_modes(solver, modes);
    std::vector<double> zero(rows, 0.0);
    hypre_ParVector *b = wrap(zero.data(), A), *x = wrap(zero.data(), A);
    HYPRE_BoomerAMGSetup(solver, A, b, x);
    for (hypre_ParVector* v : modes)
      hypre_VectorData(hypre_ParVectorLocalVector(v)) = nullptr;  // the caller's
    hypre_ParVectorDestroy(b), hypre_ParVectorDestroy(x);
    std::string error = take_error();
    if (comm.any(!error.empty())) failure = error.empty() ? "hypre: an error on another rank" : error;
    if (!failure.empty()) return;
    keep_coarsest_symmetric(solver);
    measure(comm);
  }

  void measure(const Comm& comm) {
    auto* data = reinterpret_cast<hypre_ParAMGData*>(solver);
    levels = hypre_ParAMGDataNumLevels(data);
    long long all_rows = 0, all_entries = 0;
    for (int l = 0; l < levels; ++l) {
      hypre_ParCSRMatrix* Al = hypre_ParAMGDataAArray(data)[l];
      long long n = hypre_CSRMatrixNumRows(hypre_ParCSRMatrixDiag(Al));
      all_rows += n;
      all_entries += local_entries(Al);
      bytes += local_bytes(Al) + 4 * n * sizeof(double);  // right-hand side, solution, l1 norms, work
      if (l + 1 < levels) bytes += local_bytes(hypre_ParAMGDataPArray(data)[l]);
    }
    grid = static_cast<double>(comm.sum(all_rows)) / std::max(1LL, comm.sum(static_cast<long long>(rows)));
    entries = static_cast<double>(comm.sum(all_entries)) / std::max(1LL, comm.sum(local_entries(A)));
  }
};

BoomerAmg::BoomerAmg(const DistributedCsr& matrix, const AmgOptions& options, const Comm& comm)
    : h_(std::make_unique<Hierarchy>()) {
  check(matrix, options, comm);
  start_hypre();
  take_error();
  h_->rows = matrix.rows;
  if (finite(matrix, comm))
    h_->set_up(matrix, options, comm);
  else
    h_->failure = "the matrix is not finite";
}

BoomerAmg::~BoomerAmg() = default;

void BoomerAmg::apply(std::span<const double> x, std::span<double> y) const {
  std::fill(y.begin(), y.end(), 0.0);
  std::string error = h_->failure;
  if (error.empty()) {
    hypre_ParVector *b = wrap(x.data(), h_->A), *v = wrap(y.data(), h_->A);
    HYPRE_BoomerAMGSolve(h_->solver, h_->A, b, v);
    hypre_ParVectorDestroy(b), hypre_ParVectorDestroy(v);
    error = take_error();
  }
  if (!error.empty()) std::fill(y.begin(), y.end(), std::numeric_limits<double>::quiet_NaN());
}

int BoomerAmg::size() const { return h_->rows; }
std::size_t BoomerAmg::bytes() const { return h_->bytes; }
const std::string& BoomerAmg::failure() const { return h_->failure; }
int BoomerAmg::levels() const { return h_->levels; }
double BoomerAmg::grid_complexity() const { return h_->grid; }
double BoomerAmg::operator_complexity() const { return h_->entries; }

}  // namespace bulbus::inline precond
