#pragma once
#include <memory>

#include "core/base/parallel.hpp"
#include "core/solve/factorisation.hpp"
#include "core/solve/linear_settings.hpp"

namespace bulbus::inline solve {

/// As messages call it.
std::string name_of(Direct library);

/// Throws InputError where `solver.linear.direct` is not part of this build or not for so many ranks.
void check_direct(const LinearSettings& settings, int ranks);

/// The direct solver that the settings name. What needs more than `limit_mb` over all ranks is refused where
/// the library estimates it before. Collective; throws as check_direct does.
std::unique_ptr<Factorisation> make_factorisation(const LinearSettings& settings, const Comm& comm,
                                                  double limit_mb);

}  // namespace bulbus::inline solve
