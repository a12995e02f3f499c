#include "core/solve/assemble.hpp"

#include <algorithm>
#include <array>

#include "core/base/error.hpp"
#include "core/problem/enclosed_parts.hpp"
#include "core/solve/reduced.hpp"

namespace bulbus::inline solve {
namespace {

// Global number of every kind of unknown.
class Numbering {
 public:
  explicit Numbering(const CoupledSystem& system) : mesh_(system.problem().mesh()), layout_(system.layout()) {
    const Comm& comm = mesh_.comm;
    const long long first = comm.offset(static_cast<long long>(layout_.size()));
    const std::vector<long long> mine{first, mesh_.first_node, first + layout_.nodal,
                                      first + layout_.primal() + layout_.hexes};
    const auto all = comm.gather(std::span<const long long>(mine));
    for (std::size_t r = 0; r < all.size(); r += 4) {
      row_.push_back(all[r]);
      node_.push_back(all[r + 1]);
    }
    bodies_ = all[2];
    liquids_ = all[3];
    hexes_ = first + layout_.primal();
  }
  int dof(int reduced) const {
    const int nodal = 3 * mesh_.nodes();
    if (reduced >= nodal) return static_cast<int>(bodies_ + reduced - nodal);
    const long long node = mesh_.number[reduced / 3];
    const auto rank = std::upper_bound(node_.begin(), node_.end(), node) - node_.begin() - 1;
    return static_cast<int>(row_[rank] + 3 * (node - node_[rank]) + reduced % 3);
  }
  int primal(int local) const {  // of an owned primal entry
    return static_cast<int>(row_[mesh_.comm.rank()] + local);
  }
  int hex(int local) const { return static_cast<int>(hexes_ + local); }
  int liquid(int i) const { return static_cast<int>(liquids_ + i); }

 private:
  const LocalMesh& mesh_;
  const Layout& layout_;
  std::vector<long long> row_, node_;
  long long bodies_ = 0, liquids_ = 0, hexes_ = 0;
};

// Rows by global number, columns ascending; what comes twice is added at once, so that element matrices never
// pile up.
class Collector {
 public:
  Collector(long long rows, Triangles part) : rows_(rows), upper_(part == Triangles::upper) {}
  void add(int r, int c, double v) {
    if ((v == 0 && r != c) || (upper_ && r > c)) return;
    auto& row = rows_[r];
    const auto at = std::lower_bound(row.begin(), row.end(), c,
                                     [](const Entry& e, int column) { return e.column < column; });
    if (at != row.end() && at->column == c)
      at->value += v;
    else
      row.insert(at, {c, v});
  }
  // A whole row of entries factor · v, columns ascending.
  void add_row(int r, std::span<const long long> columns, std::span<const double> v, double factor) {
    auto& row = rows_[r];
    std::vector<Entry> merged;
    merged.reserve(row.size() + columns.size());
    auto old = row.begin();
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const int c = static_cast<int>(columns[k]);
      if (upper_ && r > c) continue;
      while (old != row.end() && old->column < c) merged.push_back(*old++);
      const double before = old != row.end() && old->column == c ? old++->value : 0;
      merged.push_back({c, before + factor * v[k]});
    }
    merged.insert(merged.end(), old, row.end());
    row = std::move(merged);
  }
  // Empties the rows.
  Triplets take() {
    Triplets t;
    std::size_t entries = 0;
    for (const auto& row : rows_) entries += row.size();
    t.row.reserve(entries), t.col.reserve(entries), t.value.reserve(entries);
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      for (const Entry& e : rows_[r])
        t.row.push_back(static_cast<int>(r)), t.col.push_back(e.column), t.value.push_back(e.value);
      std::vector<Entry>().swap(rows_[r]);
    }
    return t;
  }

 private:
  struct Entry {
    int column;
    double value;
  };
  std::vector<std::vector<Entry>> rows_;
  bool upper_;
};

// The same of nodes alone, block by block: nodes meet far fewer others than unknowns do.
class BlockCollector {
 public:
  BlockCollector(const LocalMesh& mesh, Triangles part)
      : mesh_(mesh), rows_(mesh.all_nodes), upper_(part == Triangles::upper) {}
  // What bodies have is left out.
  void add(std::span<const int> dofs, std::span<const double> K) {
    first_of_nodes(dofs, 3 * mesh_.nodes(), firsts_);
    for (std::size_t i : firsts_)
      for (std::size_t j : firsts_) {
        const int row = number(dofs[i]), column = number(dofs[j]);
        if (upper_ && row > column) continue;
        auto& block = at(row, column);
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) block[3 * r + c] += K[(i + r) * dofs.size() + j + c];
      }
  }
  void add(int node, const std::array<double, 9>& diagonal) {
    auto& block = at(static_cast<int>(mesh_.number[node]), static_cast<int>(mesh_.number[node]));
    for (int i = 0; i < 9; ++i) block[i] += diagonal[i];
  }
  // With zeros, so that the pattern does not depend on values. Empties the rows.
  Triplets take() {
    Triplets t;
    std::size_t blocks = 0;
    for (const auto& row : rows_) blocks += row.size();
    for (auto* part : {&t.row, &t.col}) part->reserve(9 * blocks);
    t.value.reserve(9 * blocks);
    for (int n = 0; n < static_cast<int>(rows_.size()); ++n) {
      for (int r = 0; r < 3; ++r)
        for (const Block& b : rows_[n])
          for (int c = 0; c < 3; ++c) {
            const int row = 3 * n + r, column = 3 * b.column + c;
            if (upper_ && row > column) continue;
            t.row.push_back(row), t.col.push_back(column), t.value.push_back(b.values[3 * r + c]);
          }
      std::vector<Block>().swap(rows_[n]);
    }
    return t;
  }

 private:
  struct Block {
    int column;
    std::array<double, 9> values;
  };
  int number(int dof) const { return static_cast<int>(mesh_.number[dof / 3]); }
  std::array<double, 9>& at(int row, int column) {
    auto& blocks = rows_[row];
    if (blocks.empty()) blocks.reserve(upper_ ? 14 : 27);  // of a node inside of a regular mesh
    const auto place = std::ranges::lower_bound(blocks, column, {}, &Block::column);
    if (place != blocks.end() && place->column == column) return place->values;
    return blocks.insert(place, {column, {}})->values;
  }

  const LocalMesh& mesh_;
  std::vector<std::vector<Block>> rows_;  // by number of the node
  bool upper_;
  std::vector<std::size_t> firsts_;
};

void add_contributions(const CoupledSystem& system, Matrices matrices, const Numbering& number,
                       Collector& out) {
  std::vector<int> rows;
  for_each_condensed_matrix(system, matrices, [&](std::span<const int> d, std::span<const double> K) {
    rows.clear();
    for (int i : d) rows.push_back(number.dof(i));
    for (std::size_t i = 0; i < d.size(); ++i)
      for (std::size_t j = 0; j < d.size(); ++j) out.add(rows[i], rows[j], K[i * d.size() + j]);
  });
}

// add(node, block): identity rows of constrained directions and of bodies' nodes.
template <class Add>
void visit_held(const CoupledSystem& system, Add add) {
  for (int n = 0; n < system.problem().mesh().owned; ++n)
    if (system.problem().dofs().constrained(n)) add(n, system.constrained_block(n));
}

// Columns and rows of the liquids, and ω g gᵀ, which needs the whole of g on every rank; `augmented` may be
// null.
void add_liquids(const CoupledSystem& system, const CoupledOperator* augmented, const Numbering& number,
                 Collector& out) {
  const Comm& comm = system.problem().comm();
  for (int i = 0; i < static_cast<int>(system.liquid_columns().size()); ++i) {
    const int P = number.liquid(i);
    if (system.layout().liquids > 0) out.add(P, P, -system.compliance(i));
    std::vector<long long> where;
    std::vector<double> g;
    for (std::size_t k = 0; k < system.liquid_columns()[i].size(); ++k)
      if (const double v = system.liquid_columns()[i][k]; v != 0)
        where.push_back(number.primal(static_cast<int>(k))), g.push_back(v);
    const double column = augmented ? augmented->column_part(i) : 1,
                 row = augmented ? augmented->row_part() : 1;
    for (std::size_t k = 0; k < g.size(); ++k) {
      out.add(static_cast<int>(where[k]), P, -column * g[k]);
      out.add(P, static_cast<int>(where[k]), -row * g[k]);
    }
    const double omega = augmented ? augmented->omega()[i] : 0;
    if (omega == 0) continue;
    const auto all = comm.gather(std::span<const long long>(where));
    const auto all_g = comm.gather(std::span<const double>(g));
    for (std::size_t k = 0; k < g.size(); ++k)
      out.add_row(static_cast<int>(where[k]), all, all_g, omega * g[k]);
  }
}

Triplets assemble(const CoupledSystem& system, const CoupledOperator* augmented, Triangles part) {
  const Numbering number(system);
  const Layout& layout = system.layout();
  Collector out(global_size(system.problem()), part);
  add_contributions(system, augmented ? Matrices::augmented : Matrices::plain, number, out);
  visit_held(system, [&](int n, const std::array<double, 9>& block) {
    for (int i = 0; i < 9; ++i) out.add(number.dof(3 * n + i / 3), number.dof(3 * n + i % 3), block[i]);
  });
  if (layout.bodies > 0) {
    // geometry and constrained unknowns of bodies: what body_blocks() has beyond the contributions
    for (const auto& e : system.body_extra())
      out.add(number.primal(layout.nodal + e.row), number.primal(layout.nodal + e.column), e.value);
  }
  std::vector<int> dofs;
  std::vector<double> values;
  system.solid().visit_constraints([&](int hex, std::span<const int> nodes, std::span<const double> b) {
    reduce_vector(system.problem(), system.state(), nodes, b, dofs, values);
    for (std::size_t i = 0; i < dofs.size(); ++i) {
      out.add(number.dof(dofs[i]), number.hex(hex), values[i]);
      out.add(number.hex(hex), number.dof(dofs[i]), values[i]);
    }
    out.add(number.hex(hex), number.hex(hex), -system.problem().enclosed().compliance(hex));
  });
  for (int e : system.problem().solid().rigid_hexes())
    out.add(number.hex(e), number.hex(e), -system.rigid_compliance(e));
  add_liquids(system, augmented, number, out);
  return out.take();
}

}  // namespace

long long unknowns_of(const Problem& problem) {
  return problem.comm().sum(static_cast<long long>(layout_of(problem).size()));
}

long long global_size(const Problem& problem) {
  const long long n = unknowns_of(problem);
  if (n > most_assembled)
    throw input_error("more than 2^31 unknowns cannot be assembled",
                      "Use the iterative solver, or a coarser mesh.");
  return n;
}

Triplets assemble(const CoupledOperator& A, Triangles part) { return assemble(A.system(), &A, part); }

Triplets assemble_plain(const CoupledSystem& system, Triangles part) {
  return assemble(system, nullptr, part);
}

Triplets assemble_displacement(const CoupledSystem& system, Triangles part) {
  const LocalMesh& mesh = system.problem().mesh();
  BlockCollector out(mesh, part);
  for_each_condensed_matrix(system, Matrices::augmented,
                            [&](std::span<const int> d, std::span<const double> K) { out.add(d, K); });
  visit_held(system, [&](int n, const std::array<double, 9>& block) { out.add(n, block); });
  return out.take();
}

long long liquid_entries(const CoupledSystem& system, Triangles part) {
  const bool upper = part == Triangles::upper;
  long long entries = 0;
  for (const auto& g : system.liquid_columns()) {
    const long long own = std::ranges::count_if(g, [](double v) { return v != 0; }),
                    wet = system.problem().comm().sum(own);
    entries +=
        1 + (system.eliminated() ? (upper ? wet * (wet + 1) / 2 : wet * wet) : (upper ? wet : 2 * wet));
  }
  return entries;
}

std::vector<UnknownKind> unknown_kinds(const Layout& layout) {
  std::vector<UnknownKind> kinds(layout.nodal, UnknownKind::displacement);
  kinds.insert(kinds.end(), layout.bodies, UnknownKind::rigid);
  kinds.insert(kinds.end(), layout.hexes, UnknownKind::element_pressure);
  kinds.insert(kinds.end(), layout.liquids, UnknownKind::liquid_pressure);
  return kinds;
}

}  // namespace bulbus::inline solve
