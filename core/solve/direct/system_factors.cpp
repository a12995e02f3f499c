#include "core/solve/direct/system_factors.hpp"

#include <fmt/format.h>

#include "core/solve/assemble.hpp"
#include "core/solve/direct/libraries.hpp"
#include "core/solve/direct_memory.hpp"

namespace bulbus::inline solve {
namespace {

// Bytes of an entry of the matrix until MUMPS has analysed it, measured on 2e8 of them: the triplet, MUMPS's
// copy, both directions of its graph and the ordering's.
constexpr double bytes_per_entry = 50;

FactorReport too_large(std::string reason, double mb, double entries = 0) {
  return {.reason = std::move(reason), .too_large = true, .matrix_entries = entries, .estimated_mb = mb};
}

}  // namespace

// MUMPS estimates its factors itself, when the matrix is there.
FactorReport SystemFactors::refused(const CoupledSystem& system, double limit_mb, bool triangle) const {
  const double entries =
                   static_cast<double>(liquid_entries(system, triangle ? Triangles::upper : Triangles::both)),
               dense_mb = 1e-6 * bytes_per_entry * entries;
  if (dense_mb > limit_mb)
    return too_large(
        fmt::format("{:.3g} entries of the liquids need about {:.0f} MB, more than the {:.0f} MB "
                    "allowed",
                    entries, dense_mb, limit_mb),
        dense_mb, entries);
  if (settings_.direct == Direct::mumps) return {.ok = true};
  const long long unknowns = global_size(system.problem());
  if (settings_.direct == Direct::eigen && unknowns > most_for_eigen)
    return too_large(fmt::format("{} unknowns, and more than {} take too long", unknowns, most_for_eigen), 0);
  const LocalMesh& mesh = system.problem().mesh();
  const bool symmetric = system.problem().symmetric();
  const double hexes = static_cast<double>(mesh.all_hexes),
               mb = 1e-6 *
                    (direct_matrix_bytes(hexes, symmetric) +
                     (symmetric ? lu_of_ldlt : 1) * direct_factor_bytes(static_cast<double>(unknowns), hexes,
                                                                        static_cast<double>(mesh.all_nodes),
                                                                        mesh.comm.size(), symmetric));
  if (mb > limit_mb)
    return too_large(
        fmt::format("matrix and factors need about {:.0f} MB, more than the {:.0f} MB allowed", mb, limit_mb),
        mb);
  return {.ok = true};
}

FactorReport SystemFactors::factorise(SharedSystem system) {
  const auto scope = profiler_.clock.measure("factorisation");
  const Problem& problem = system->problem();
  const Comm& comm = problem.comm();
  const double limit_mb = comm.min(settings_.allowed_mb());
  if (!library_) library_ = make_factorisation(settings_, comm, limit_mb);
  const bool symmetric = problem.symmetric(), triangle = symmetric && library_->takes_upper_triangle();
  FactorReport report = refused(*system, limit_mb, triangle);
  if (report.ok)
    report =
        library_->factorise(assemble(CoupledOperator(system), triangle ? Triangles::upper : Triangles::both),
                            system->size(), symmetric);
  profiler_.memory.set("factor", static_cast<std::size_t>(report.memory_max_mb * 1e6));
  return report;
}

}  // namespace bulbus::inline solve
