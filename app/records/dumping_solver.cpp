#include "app/records/dumping_solver.hpp"

#include <fmt/format.h>

#include "core/solve/assemble.hpp"

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

  Preparation prepare(const CoupledSystem& system) override { return solver_->prepare(system); }
  void forget() override { solver_->forget(); }
  void increment_begins() override { solver_->increment_begins(); }
  void watch(SolveWatcher watcher) override { solver_->watch(std::move(watcher)); }
  bool counts_pivots(const CoupledSystem& system) override { return solver_->counts_pivots(system); }
  int negative_pivots(const CoupledSystem& system) override { return solver_->negative_pivots(system); }

  LinearReport solve(const CoupledOperator& A, std::vector<double> b, std::span<double> x,
                     double tolerance) override {
    const CoupledSystem& system = A.system();
    SystemDump dump;
    dump.matrix = assemble(A);
    dump.rhs = b;
    dump.kind = unknown_kinds(system.layout());
    dump.scaling = system.scaling();
    dump.attributes = {{"gamma", system.gamma()}, {"increment", increment_()}, {"tolerance", tolerance}};
    const std::string file = fmt::format("{}/system_{:04d}.h5", name_, ++count_);
    folder_.claim({file});
    write_system(folder_.path() + "/" + file, dump, system.problem().comm());
    return solver_->solve(A, std::move(b), x, tolerance);
  }

 private:
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
