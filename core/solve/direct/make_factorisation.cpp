#include "core/solve/direct/make_factorisation.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/solve/direct/libraries.hpp"
#include "core/solve/mumps.hpp"

namespace bulbus::inline solve {
namespace {

class MumpsFactorisation final : public Factorisation {
 public:
  MumpsFactorisation(const Comm& comm, const MumpsOptions& options) : comm_(comm), mumps_(comm, options) {}
  bool takes_upper_triangle() const override { return true; }
  FactorReport factorise(Triplets matrix, int rows, bool symmetric) override {
    return mumps_.factorise(std::move(matrix), comm_.sum(static_cast<long long>(rows)), symmetric);
  }
  bool solve(std::span<const double> b, std::span<double> x) override { return mumps_.solve(b, x); }

 private:
  Comm comm_;
  Mumps mumps_;
};

const std::string direct_key = "solver.linear.direct";

}  // namespace

std::string name_of(Direct library) {
  constexpr std::array names{"MUMPS", "SuperLU_DIST", "UMFPACK", "Eigen"};
  return names[static_cast<std::size_t>(library)];
}

void check_direct(const LinearSettings& settings, int ranks) {
  if (settings.method != Method::direct) return;
  const std::string word(word_of(settings.direct));
  if (settings.direct == Direct::umfpack && !has_umfpack())
    throw scene_error(
        direct_key, "umfpack is not part of this build",
        "Choose mumps or superlu_dist, or build with -DBULBUS_UMFPACK=ON, under whose licence (GPL) "
        "the program then stands.");
  const bool serial = settings.direct == Direct::umfpack || settings.direct == Direct::eigen;
  if (serial && ranks > 1)
    throw scene_error(direct_key, fmt::format("{} factorises on one rank, and there are {}", word, ranks),
                      "Choose mumps or superlu_dist, or start one rank.");
}

std::unique_ptr<Factorisation> make_factorisation(const LinearSettings& settings, const Comm& comm,
                                                  double limit_mb) {
  check_direct(settings, comm.size());
  switch (settings.direct) {
    case Direct::superlu_dist:
      return make_superlu_dist(comm);
    case Direct::umfpack:
      return make_umfpack(comm);
    case Direct::eigen:
      return make_eigen(comm);
    case Direct::mumps:
      break;
  }
  return std::make_unique<MumpsFactorisation>(
      comm, MumpsOptions{.ordering = settings.ordering, .null_pivots = true, .memory_limit_mb = limit_mb});
}

}  // namespace bulbus::inline solve
