#pragma once
#include "core/base/parallel.hpp"
#include "core/solve/triplets.hpp"

namespace bulbus::inline solve {

/// Rows of a square matrix, one behind the other, columns ascending, each once.
struct CompressedRows {
  int first = 0;                   ///< number of the first row
  std::vector<int> start, column;  ///< entries of row first + i: start[i] … start[i + 1] − 1
  std::vector<double> value;
  int rows() const { return static_cast<int>(start.size()) - 1; }
};

/// The `rows` rows of this rank, in the order of the ranks, of the sum of all ranks' triplets. Collective.
CompressedRows compressed_rows(Triplets matrix, int rows, const Comm& comm);

/// The same with an entry on every diagonal, be it zero.
CompressedRows with_diagonals(const CompressedRows& a);

}  // namespace bulbus::inline solve
