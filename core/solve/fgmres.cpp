#include "core/solve/fgmres.hpp"

#include <BelosBlockGmresSolMgr.hpp>
#include <BelosTpetraAdapter.hpp>
#include <Kokkos_Core.hpp>
#include <Teuchos_DefaultMpiComm.hpp>
#include <Teuchos_oblackholestream.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/solve/at_mpi_finalize.hpp"

namespace bulbus {
namespace {

using Map = Tpetra::Map<int, long long>;
using Vectors = Tpetra::MultiVector<double, int, long long>;
using Operator = Tpetra::Operator<double, int, long long>;

}  // namespace
}  // namespace bulbus

// Instantiated in libtrilinos_belostpetra.
extern template class Belos::BlockGmresSolMgr<double, bulbus::Vectors, bulbus::Operator>;

namespace bulbus {
namespace {

using Problem = Belos::LinearProblem<double, Vectors, Operator>;
using Solver = Belos::BlockGmresSolMgr<double, Vectors, Operator>;
using Iteration = Belos::Iteration<double, Vectors, Operator>;
using Teuchos::RCP;
using Teuchos::rcp;

void start_kokkos() {
  if (Kokkos::is_initialized()) return;
  Kokkos::initialize();
  at_mpi_finalize([] {
    if (Kokkos::is_initialized()) Kokkos::finalize();
  });
}

RCP<const Map> contiguous_map(int rows, const Comm& comm) {
  auto mpi = rcp(new Teuchos::MpiComm<int>(Teuchos::opaqueWrapper(comm.raw())));
  return rcp(new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), rows, 0, mpi));
}

/// A Tpetra vector on the caller's memory. Serial node: host and device are the same memory.
RCP<Vectors> wrap(RCP<const Map> map, double* x) {
  Vectors::dual_view_type::t_dev device(x, map->getNodeNumElements(), 1);
  Vectors::dual_view_type::t_host host(x, map->getNodeNumElements(), 1);
  return rcp(new Vectors(map, Vectors::dual_view_type(device, host)));
}

class Wrapped final : public Operator {
 public:
  Wrapped(const LinearOperator& op, RCP<const Map> map) : op_(op), map_(map) {}
  RCP<const Map> getDomainMap() const override { return map_; }
  RCP<const Map> getRangeMap() const override { return map_; }
  /// Belos asks for Y = A X only.
  void apply(const Vectors& X, Vectors& Y, Teuchos::ETransp, double, double) const override {
    auto x = X.getLocalViewHost(Tpetra::Access::ReadOnly);
    auto y = Y.getLocalViewHost(Tpetra::Access::OverwriteAll);
    std::size_t n = map_->getNodeNumElements();
    for (std::size_t j = 0; j < X.getNumVectors(); ++j)
      op_.apply({x.data() + j * x.stride(1), n}, {y.data() + j * y.stride(1), n});
  }

 private:
  const LinearOperator& op_;
  RCP<const Map> map_;
};

/// Never ends the iteration: records its residual norms and passes its iterates on.
class Recorder final : public Belos::StatusTest<double, Vectors, Operator> {
 public:
  Recorder(std::vector<double>& history, const KrylovObserver& observer, bool flexible)
      : history_(history), observer_(observer), flexible_(flexible) {}
  Belos::StatusType checkStatus(Iteration* it) override {
    std::size_t k = it->getNumIters();
    if (k < history_.size()) return Belos::Failed;  // a restart repeats the last iterate
    std::vector<double> norm(1);
    it->getNativeResiduals(&norm);
    history_.push_back(norm[0]);
    if (observer_) pass_on(*it, static_cast<int>(k));
    return Belos::Failed;
  }
  Belos::StatusType getStatus() const override { return Belos::Failed; }
  void reset() override {}
  void print(std::ostream&, int) const override {}

 private:
  void pass_on(const Iteration& it, int k) {
    RCP<Vectors> update = it.getCurrentUpdate();
    auto& problem = const_cast<Problem&>(it.getProblem());  // Belos' getters are not const
    Vectors x(*problem.getCurrLHSVec(), Teuchos::Copy);
    if (update != Teuchos::null && flexible_)  // the flexible basis is already preconditioned
      x.update(1, *update, 1);
    else if (update != Teuchos::null)
      x.assign(*problem.updateSolution(update, false));
    auto values = x.getLocalViewHost(Tpetra::Access::ReadOnly);
    observer_(k, {values.data(), values.extent(0)});
  }

  std::vector<double>& history_;
  const KrylovObserver& observer_;
  bool flexible_;
};

RCP<Teuchos::ParameterList> parameters(const KrylovOptions& o, bool flexible) {
  RCP<Teuchos::ParameterList> p = Teuchos::parameterList();
  p->set("Flexible Gmres", flexible);
  p->set("Num Blocks", o.restart);
  p->set("Maximum Iterations", o.max_iterations);
  p->set("Maximum Restarts", o.max_iterations / std::max(o.restart, 1) + 1);
  p->set("Convergence Tolerance", o.tolerance);
  p->set("Implicit Residual Scaling", "Norm of RHS");
  p->set("Explicit Residual Scaling", "Norm of RHS");
  // Belos prints its errors at every verbosity.
  p->set("Output Stream", RCP<std::ostream>(rcp(new Teuchos::oblackholestream)));
  return p;
}

/// Empty if the method ended as it should.
std::string run(RCP<Problem> problem, RCP<Recorder> recorder, const KrylovOptions& options, bool flexible) {
  Solver solver;
  solver.setProblem(problem);
  solver.setDebugStatusTest(recorder);
  solver.setParameters(parameters(options, flexible));
  try {
    return solver.solve() == Belos::Converged ? "" : "iterations exhausted";
  } catch (const std::logic_error& e) {  // BelosError and Teuchos' own; what the operators throw passes
    std::string what = e.what();
    return what.find("NaN") != std::string::npos ? "a residual is not a number" : "breakdown: " + what;
  }
}

double norm(std::span<const double> x, const Comm& comm) {
  double sum = 0;
  for (double v : x) sum += v * v;
  return std::sqrt(comm.sum(sum));
}

double residual_norm(const LinearOperator& A, std::span<const double> b, std::span<const double> x,
                     const Comm& comm) {
  std::vector<double> r(b.size());
  A.apply(x, r);
  for (std::size_t i = 0; i < r.size(); ++i) r[i] = b[i] - r[i];
  return norm(r, comm);
}

}  // namespace

KrylovReport fgmres(const LinearOperator& A, const Preconditioner* M, std::span<const double> b,
                    std::span<double> x, const KrylovOptions& options, const Comm& comm,
                    const KrylovObserver& observer) {
  if (b.size() != x.size() || static_cast<int>(b.size()) != A.size())
    throw std::invalid_argument("fgmres: the vectors do not have the operator's size");
  KrylovReport report;
  auto ends = [&](bool converged, std::string reason) {
    report.converged = converged;
    report.reason = std::move(reason);
    return report;
  };
  double scale = norm(b, comm);
  if (!std::isfinite(scale)) return ends(false, "the right-hand side is not finite");
  if (scale == 0) {
    std::fill(x.begin(), x.end(), 0.0);
    return ends(true, "the right-hand side is zero");
  }

  start_kokkos();
  bool flexible = options.flexible && M != nullptr;
  RCP<const Map> map = contiguous_map(A.size(), comm);
  auto problem = rcp(new Problem(rcp(new Wrapped(A, map)), wrap(map, x.data()),
                                 wrap(map, const_cast<double*>(b.data()))));  // Belos only reads b
  if (M) problem->setRightPrec(rcp(new Wrapped(*M, map)));
  problem->setProblem();  // computes b - A x
  problem->getInitResVec()->norm2(Teuchos::arrayView(&report.initial, 1));
  report.final = report.initial;
  if (!std::isfinite(report.initial)) return ends(false, "the initial residual is not finite");
  if (report.initial <= options.tolerance * scale) return ends(true, "the initial guess suffices");

  long long basis = std::min<long long>(options.restart, map->getGlobalNumElements()) + 1;
  report.basis_bytes = (flexible ? 2 : 1) * basis * b.size() * sizeof(double);
  std::vector<double> guess(x.begin(), x.end());
  std::string failure =
      run(problem, rcp(new Recorder(report.history, observer, flexible)), options, flexible);
  report.iterations = std::max(0, static_cast<int>(report.history.size()) - 1);
  report.final = residual_norm(A, b, x, comm);
  if (!(report.final <= report.initial)) {  // worse than nothing, or NaN
    std::copy(guess.begin(), guess.end(), x.begin());
    report.final = report.initial;
  }
  // The method's own residual and the true one differ by rounding.
  if (report.final <= 1.1 * options.tolerance * scale) return ends(true, "converged");
  return ends(false,
              failure.empty() ? "loss of accuracy: the true residual is above the tolerance" : failure);
}

}  // namespace bulbus
