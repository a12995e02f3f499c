#include "core/solve/mumps_messages.hpp"

namespace bulbus::inline solve {

std::string mumps_ordering(int infog7) {
  switch (infog7) {
    case 0:
      return "AMD";
    case 1:
      return "given";
    case 2:
      return "AMF";
    case 3:
      return "Scotch";
    case 4:
      return "PORD";
    case 5:
      return "METIS";
    case 6:
      return "QAMD";
  }
  return "ordering " + std::to_string(infog7);
}

std::string explain_mumps(int code, int detail) {
  switch (code) {
    case -6:
      return "the matrix is singular in structure, of rank " + std::to_string(detail);
    case -7:
    case -13:
      return "not enough memory";
    case -8:
    case -9:
    case -17:
    case -20:
      return "pivoting needs more workspace than was allowed";
    case -10:
      return "the matrix is singular";
    case -40:
      return "the matrix is not positive definite";
    case -51:
    case -52:
      return "the graph is too large for the ordering";
  }
  return "MUMPS error " + std::to_string(code) + " (" + std::to_string(detail) + ")";
}

}  // namespace bulbus::inline solve
