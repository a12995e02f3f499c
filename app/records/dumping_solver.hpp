#pragma once
#include "app/records/folder.hpp"
#include "core/solve/linear_solver.hpp"

namespace bulbus::inline app {

/// A solver that writes every system it is given, augmented as it is iterated on, to system_0001.h5 and so on
/// in the folder `name` within that of the results, and leaves the solution to `solver`. `increment` is asked
/// for the number of the increment at work. Making one is collective and throws InputError if the folder
/// cannot be made.
std::unique_ptr<LinearSolver> make_dumping_solver(std::unique_ptr<LinearSolver> solver,
                                                  const std::string& name, ResultsFolder& folder,
                                                  std::function<int()> increment, const Comm& comm);

}  // namespace bulbus::inline app
