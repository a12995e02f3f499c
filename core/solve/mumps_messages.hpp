#pragma once
#include <string>

namespace bulbus::inline solve {

/// The ordering that MUMPS has taken, by INFOG(7) of its users' guide.
std::string mumps_ordering(int infog7);

/// What an error of MUMPS means, by INFOG(1) and INFOG(2) of its users' guide.
std::string explain_mumps(int code, int detail);

}  // namespace bulbus::inline solve
