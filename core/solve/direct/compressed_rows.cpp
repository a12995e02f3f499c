#include "core/solve/direct/compressed_rows.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

namespace bulbus::inline solve {
namespace {

// Every rank's triplets to those whose rows they are. `first` of each rank, and the end.
Triplets sent_home(const Triplets& t, const std::vector<long long>& first, const Comm& comm) {
  std::vector<std::vector<long long>> to(comm.size());
  for (std::size_t k = 0; k < t.row.size(); ++k) {
    const auto rank = std::ranges::upper_bound(first, t.row[k]) - first.begin() - 1;
    to[rank].insert(to[rank].end(), {t.row[k], t.col[k], std::bit_cast<long long>(t.value[k])});
  }
  Triplets mine;
  for (const auto& part : comm.exchange(to))
    for (std::size_t k = 0; k < part.size(); k += 3) {
      mine.row.push_back(static_cast<int>(part[k]));
      mine.col.push_back(static_cast<int>(part[k + 1]));
      mine.value.push_back(std::bit_cast<double>(part[k + 2]));
    }
  return mine;
}

}  // namespace

CompressedRows compressed_rows(Triplets t, int rows, const Comm& comm) {
  const long long begin = comm.offset(static_cast<long long>(rows));
  if (comm.size() > 1) t = sent_home(t, comm.gather(std::span<const long long>(&begin, 1)), comm);
  std::vector<int> order(t.row.size());
  std::iota(order.begin(), order.end(), 0);
  const auto place = [&](int k) { return std::pair(t.row[k], t.col[k]); };
  if (!std::ranges::is_sorted(order, {}, place)) std::ranges::stable_sort(order, {}, place);
  CompressedRows out{.first = static_cast<int>(begin), .start = std::vector<int>(rows + 1, 0)};
  std::pair<int, int> last{-1, -1};
  for (int k : order) {
    if (place(k) == last) {
      out.value.back() += t.value[k];
      continue;
    }
    last = place(k);
    out.column.push_back(t.col[k]);
    out.value.push_back(t.value[k]);
    ++out.start[t.row[k] - out.first + 1];
  }
  std::partial_sum(out.start.begin(), out.start.end(), out.start.begin());
  return out;
}

CompressedRows with_diagonals(const CompressedRows& a) {
  CompressedRows out{.first = a.first, .start = {0}};
  const auto add = [&](int column, double v) { out.column.push_back(column), out.value.push_back(v); };
  for (int i = 0; i < a.rows(); ++i) {
    const int diagonal = a.first + i;
    bool passed = false;
    for (int k = a.start[i]; k < a.start[i + 1]; ++k) {
      if (!passed && a.column[k] > diagonal) add(diagonal, 0);
      passed = passed || a.column[k] >= diagonal;
      add(a.column[k], a.value[k]);
    }
    if (!passed) add(diagonal, 0);
    out.start.push_back(static_cast<int>(out.column.size()));
  }
  return out;
}

}  // namespace bulbus::inline solve
