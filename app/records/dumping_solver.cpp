#include "app/records/dumping_solver.hpp"

#include <fmt/format.h>

#include <limits>

#include "core/solve/assemble.hpp"
#include "core/solve/near_null_space.hpp"

namespace bulbus::inline app {
namespace {

class DumpingSolver final : public LinearSolver {
 public:
  DumpingSolver(std::unique_ptr<LinearSolver> solver, std::string name, ResultsFolder& folder,
                std::function<int()> increment)
      : solver_(std::move(solver)),
        name_(std::move(name)),
        folder_(folder),
        increment_(std::move(increment)) {}

  Preparation prepare(SharedSystem system) override { return solver_->prepare(std::move(system)); }
  void release() override { solver_->release(); }
  void forget() override { solver_->forget(); }
  void increment_begins() override { solver_->increment_begins(); }
  void watch(SolveWatcher watcher) override { solver_->watch(std::move(watcher)); }
  bool counts_pivots(const Problem& problem) override { return solver_->counts_pivots(problem); }
  int negative_pivots(const CoupledSystem& system) override { return solver_->negative_pivots(system); }

  LinearReport solve(const CoupledOperator& A, std::vector<double> b, std::span<double> x,
                     double tolerance) override {
    const std::string file = fmt::format("{}/system_{:04d}.h5", name_, ++count_);
    const std::string path = folder_.path() + "/" + file;
    const Comm& comm = A.system().problem().comm();
    folder_.claim({file});
    write_system(path, dump_of(A, b, tolerance), comm);
    const LinearReport report = solver_->solve(A, std::move(b), x, tolerance);
    write_solution(path, x,
                   {{"converged", report.ok},
                    {"iterations", report.iterations},
                    {"negative_pivots", report.negative_pivots}},
                   comm);
    return report;
  }

 private:
  // Solution and what is known with it are filled in later.
  SystemDump dump_of(const CoupledOperator& A, const std::vector<double>& b, double tolerance) const {
    const CoupledSystem& system = A.system();
    SystemDump dump;
    dump.matrix = assemble(A);
    dump.rhs = b;
    dump.kind = unknown_kinds(system.layout());
    dump.scaling = system.scaling();
    dump.coordinates = unknown_coordinates(system);
    dump.near_null_space = near_null_space(system);
    dump.solution.assign(b.size(), std::numeric_limits<double>::quiet_NaN());
    dump.attributes = {{"gamma", system.gamma()}, {"increment", increment_()}, {"tolerance", tolerance},
                       {"converged", 0},          {"iterations", 0},           {"negative_pivots", -1}};
    return dump;
  }

  std::unique_ptr<LinearSolver> solver_;
  std::string name_;
  ResultsFolder& folder_;
  std::function<int()> increment_;
  int count_ = 0;
};

}  // namespace

std::unique_ptr<LinearSolver> make_dumping_solver(std::unique_ptr<LinearSolver> solver,
                                                  const std::string& name, ResultsFolder& folder,
                                                  std::function<int()> increment, const Comm& comm) {
  make_folder(folder.path() + "/" + name, comm);
  return std::make_unique<DumpingSolver>(std::move(solver), name, folder, std::move(increment));
}

}  // namespace bulbus::inline app
