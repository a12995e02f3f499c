#include "core/solve/fgmres.hpp"

#include <BelosBlockGmresSolMgr.hpp>
#include <BelosOperator.hpp>
#include <Teuchos_oblackholestream.hpp>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/inner_product.hpp"
#include "core/base/interrupt.hpp"
#include "core/solve/krylov_vectors.hpp"

namespace bulbus::inline solve {
namespace {

using Vectors = Belos::MultiVec<double>;
using Operator = Belos::Operator<double>;
using Problem = Belos::LinearProblem<double, Vectors, Operator>;
using Solver = Belos::BlockGmresSolMgr<double, Vectors, Operator>;
using Iteration = Belos::Iteration<double, Vectors, Operator>;
using Teuchos::RCP;
using Teuchos::rcp;

constexpr std::size_t between_safe_points = 8;  // iterations

// In double precision, for what operators map: one for all that are not applied at once.
struct Workspace {
  std::vector<double> argument, image;
};

class Wrapped final : public Operator {
 public:
  Wrapped(const LinearOperator& op, Workspace& workspace) : op_(op), workspace_(workspace) {}
  void Apply(const Vectors& X, Vectors& Y, Belos::ETrans) const override {
    for (int j = 0; j < X.GetNumberVecs(); ++j) {
      op_.apply(dynamic_cast<const KrylovVectors&>(X).read(j, workspace_.argument), workspace_.image);
      dynamic_cast<KrylovVectors&>(Y).write(j, workspace_.image);
    }
  }

 private:
  const LinearOperator& op_;
  Workspace& workspace_;
};

/// Records the iteration's residual norms, passes its iterates on, and ends it where it is told to.
class Recorder final : public Belos::StatusTest<double, Vectors, Operator> {
 public:
  Recorder(std::vector<double>& history, const KrylovObserver& observer, const KrylovOptions& options,
           bool flexible, const Comm& comm)
      : history_(history), observer_(observer), go_on_(options.go_on), flexible_(flexible), comm_(comm) {}
  Belos::StatusType checkStatus(Iteration* it) override {
    std::size_t k = it->getNumIters();
    if (k < history_.size()) return Belos::Failed;  // a restart repeats the last iterate
    std::vector<double> norm(1);
    it->getNativeResiduals(&norm);
    history_.push_back(norm[0]);
    std::vector<double> copy;
    if (observer_) observer_(static_cast<int>(k), iterate(*it, copy));
    if (k % between_safe_points == between_safe_points - 1)
      if (const int signal = interrupt(comm_)) throw Interruption{signal};
    if (k == 0 || !go_on_ || go_on_(static_cast<int>(k), norm[0])) return Belos::Failed;
    const auto last = iterate(*it, copy);
    last_.assign(last.begin(), last.end());
    return Belos::Passed;
  }
  Belos::StatusType getStatus() const override { return Belos::Failed; }
  /// Where it was ended; empty if it was not.
  std::span<const double> last() const { return last_; }
  void reset() override {}
  void print(std::ostream&, int) const override {}

 private:
  std::span<const double> iterate(const Iteration& it, std::vector<double>& copy) const {
    RCP<Vectors> update = it.getCurrentUpdate();
    auto& problem = const_cast<Problem&>(it.getProblem());  // Belos' getters are not const
    RCP<Vectors> x = rcp(problem.getCurrLHSVec()->CloneCopy());
    if (update != Teuchos::null && flexible_)  // the flexible basis is already preconditioned
      x->MvAddMv(1, *update, 1, *x);
    else if (update != Teuchos::null)
      x = problem.updateSolution(update, false);
    const auto values = dynamic_cast<const KrylovVectors&>(*x).read(0, copy);
    if (values.data() != copy.data()) copy.assign(values.begin(), values.end());  // x goes
    return copy;
  }

  std::vector<double>& history_;
  const KrylovObserver& observer_;
  const std::function<bool(int, double)>& go_on_;
  bool flexible_;
  std::vector<double> last_;
  const Comm& comm_;
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

  const bool flexible = options.flexible && M != nullptr;
  const auto space = std::make_shared<KrylovSpace>(comm, b.size(), options.basis);
  const auto wrap = [&](double* values) { return rcp(new KrylovVectors(space, {values, b.size()})); };
  Workspace workspace{{}, std::vector<double>(b.size())};
  auto problem = rcp(new Problem(rcp(new Wrapped(A, workspace)), wrap(x.data()),
                                 wrap(const_cast<double*>(b.data()))));  // Belos only reads b
  if (M) problem->setRightPrec(rcp(new Wrapped(*M, workspace)));
  const bool from_zero = norm(x, comm) == 0;
  if (from_zero) problem->setInitResVec(wrap(const_cast<double*>(b.data())));
  problem->setProblem();  // computes b - A x elsewhere
  std::vector<double> initial(1);
  problem->getInitResVec()->MvNorm(initial);
  report.initial = initial[0];
  report.final = report.initial;
  if (!std::isfinite(report.initial)) return ends(false, "the initial residual is not finite");
  if (report.initial <= options.tolerance * scale) return ends(true, "the initial guess suffices");

  const std::vector<double> guess = from_zero ? std::vector<double>() : std::vector(x.begin(), x.end());
  const auto recorder = rcp(new Recorder(report.history, observer, options, flexible, comm));
  std::string failure = run(problem, recorder, options, flexible);
  if (!failure.empty() && !recorder->last().empty()) {
    std::ranges::copy(recorder->last(), x.begin());
    failure = "ended before convergence";
  }
  report.iterations = std::max(0, static_cast<int>(report.history.size()) - 1);
  report.basis_bytes = space->peak;
  report.final = residual_norm(A, b, x, comm);
  if (!(report.final <= report.initial)) {  // worse than nothing, or NaN
    if (guess.empty()) std::ranges::fill(x, 0.0);
    std::ranges::copy(guess, x.begin());
    report.final = report.initial;
  }
  // The method's own residual and the true one differ by rounding.
  if (report.final <= 1.1 * options.tolerance * scale) return ends(true, "converged");
  return ends(false,
              failure.empty() ? "loss of accuracy: the true residual is above the tolerance" : failure);
}

}  // namespace bulbus::inline solve
