#pragma once
#include <map>
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
  std::map<std::string, double> attributes;
};

/// Writes an HDF5 file: datasets row, col (32-bit, from 0; duplicates are to be added), value, rhs, kind,
/// scaling and the attributes of the root group (those of the first rank). Collective. Throws OutputError if
/// the file cannot be written, std::invalid_argument if the vectors differ in length.
void write_system(const std::string& path, const SystemDump& part, const Comm& comm);

/// The whole system. Not collective. Throws InputError if the file cannot be read.
SystemDump read_system(const std::string& path);

/// A whole system as Matrix Market: `path` with duplicates added, and the right-hand side in `path` with
/// `_rhs` before its extension. Not collective. Throws InputError if a file cannot be written.
void write_matrix_market(const std::string& path, const SystemDump& whole);

}  // namespace bulbus::inline solve
