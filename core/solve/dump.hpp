#pragma once
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/base/parallel.hpp"
#include "core/solve/triplets.hpp"

namespace bulbus::inline solve {

/// What an unknown of a linear system is.
enum class UnknownKind : unsigned char {
  displacement = 0,
  element_pressure = 1,
  liquid_pressure = 2,
  rigid = 3
};

/// One linear system A x = b as it was solved. In memory either this rank's part (any entries of A;
/// contiguous rows of the vectors, in the order of the ranks) or the whole.
struct SystemDump {
  Triplets matrix;
  std::vector<double> rhs;
  std::vector<UnknownKind> kind;
  std::vector<double> scaling;  ///< a typical size of each unknown; may be empty (on all ranks)
  /// 3 and 6 numbers per unknown, see near_null_space.hpp; may be empty (on all ranks).
  std::vector<double> coordinates, near_null_space;
  std::vector<double> solution;  ///< NaN until it is found; may be empty (on all ranks)
  std::map<std::string, double> attributes;
};

/// Writes an HDF5 file as docs/dump.md describes it, with the attributes of the first rank. Collective.
/// Throws OutputError if the file cannot be written, std::invalid_argument if the vectors differ in length.
void write_system(const std::string& path, const SystemDump& part, const Comm& comm);

/// Puts the solution and new values of attributes into a file that has room for them: write_system() was
/// given others. Collective. Throws OutputError.
void write_solution(const std::string& path, std::span<const double> part,
                    const std::map<std::string, double>& attributes, const Comm& comm);

/// The whole system. Not collective. Throws InputError if the file cannot be read.
SystemDump read_system(const std::string& path);

/// A whole system as Matrix Market: `path` with duplicates added and attributes as comments, and what else
/// the system has in files of its own, `path` with `_rhs`, `_solution`, `_scaling`, `_kind`, `_coordinates`
/// and `_near_null_space` before its extension. Returns their names. Not collective. Throws InputError if a
/// file cannot be written.
std::vector<std::string> write_matrix_market(const std::string& path, const SystemDump& whole);

}  // namespace bulbus::inline solve
