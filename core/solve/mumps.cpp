#include "core/solve/mumps.hpp"

#include <dmumps_c.h>
#include <smumps_c.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <type_traits>

#include "core/base/clock.hpp"
#include "core/base/error.hpp"
#include "core/solve/direct/nested_dissection.hpp"
#include "core/solve/mumps_messages.hpp"

namespace bulbus::inline solve {
namespace {

template <class Number>
constexpr double megabytes_per_entry = 1e-6 * (2 * sizeof(int) + sizeof(Number));

enum Job { start = -1, end = -2, analysis = 1, factorisation = 2, solution = 3 };

/// ICNTL(7) of MUMPS's users' guide. Debian's MUMPS is built without METIS: its order is given.
int code_of(Ordering ordering) {
  switch (ordering) {
    case Ordering::amd:
      return 0;
    case Ordering::scotch:
      return 3;
    case Ordering::pord:
      return 4;
    case Ordering::metis:
      return 1;
    case Ordering::qamd:
      return 6;
    case Ordering::automatic:
      return 7;
  }
  return 7;
}

/// A large count: a negative one is in millions.
double count(MUMPS_INT value) { return value < 0 ? -1e6 * value : value; }

void check(const Triplets& t, long long n, const Comm& comm) {
  if (n > std::numeric_limits<int>::max())
    throw input_error("more than 2^31 unknowns for MUMPS: " + std::to_string(n),
                      "take the iterative solver, or a coarser mesh");
  auto outside = [&](int i) { return i < 0 || i >= n; };
  bool fits = t.row.size() == t.col.size() && t.row.size() == t.value.size() &&
              std::none_of(t.row.begin(), t.row.end(), outside) &&
              std::none_of(t.col.begin(), t.col.end(), outside);
  if (comm.any(!fits)) throw std::invalid_argument("Mumps: an entry is outside of the matrix");
}

/// MUMPS counts from 1 and adds both triangles of a symmetric matrix.
void convert(Triplets& t, bool symmetric) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < t.row.size(); ++k) {
    if (symmetric && t.row[k] > t.col[k]) continue;
    t.row[kept] = t.row[k] + 1;
    t.col[kept] = t.col[k] + 1;
    t.value[kept++] = t.value[k];
  }
  t.row.resize(kept), t.col.resize(kept), t.value.resize(kept);
}

void call(DMUMPS_STRUC_C& id) { dmumps_c(&id); }
void call(SMUMPS_STRUC_C& id) { smumps_c(&id); }

}  // namespace

struct Mumps::Instance {
  virtual ~Instance() = default;
  enum class Taken {
    unknown,
    known,
    near
  };  // to the last analysis; so near the factorised one that its factors do
  virtual Taken take(Triplets t, long long n, bool symmetric, const KeepFactors& keep) = 0;
  virtual FactorReport& analyse() = 0;
  virtual FactorReport& factorise() = 0;
  virtual bool solve(std::span<const double> b, std::span<double> x) = 0;
  FactorReport report;
};

// Id: MUMPS's structure of one precision.
template <class Id>
struct Mumps::InstanceOf final : Instance {
  using Number = std::remove_pointer_t<decltype(Id::a_loc)>;
  const Comm comm;
  const MumpsOptions options;
  Id id{};
  std::vector<int> row, col, place;  // counted from 1
  std::vector<Number> value;
  std::vector<double> null_space;
  bool started = false, analysed = false, factorised = false;

  // Of the scaled matrix, relative to its norm. MUMPS's own is 1e-21; rounding left 1e-10 of a null pivot of
  // twist.yaml in the order of METIS.
  static constexpr double least_pivot = 1e-9;

  InstanceOf(const Comm& c, const MumpsOptions& o) : comm(c), options(o) {}
  ~InstanceOf() override { stop(); }

  int& control(int i) { return id.icntl[i - 1]; }
  int infog(int i) const { return id.infog[i - 1]; }
  double rinfog(int i) const { return id.rinfog[i - 1]; }

  bool run(Job job) {
    id.job = job;
    call(id);
    return infog(1) >= 0;
  }

  void stop() {
    int ended = 0;
    MPI_Finalized(&ended);
    if (started && !ended) run(end);
    started = analysed = factorised = false;
  }

  void restart(bool symmetric) {
    stop();
    id = {};
    id.comm_fortran = MPI_Comm_c2f(comm.raw());
    id.par = 1;
    id.sym = symmetric ? 2 : 0;
    run(start);
    started = true;
    for (int i : {1, 2, 3, 4}) control(i) = i < 4 ? -1 : 0;  // silent
    control(7) = code_of(options.ordering);
    control(10) = options.refinements;
    if (options.block > 1) control(15) = -options.block;
    control(13) = 1;  // no ScaLAPACK at the root: its pivots would be missing in the inertia
    control(18) = 3;  // entries are distributed
    control(24) = options.null_pivots;
    if (options.null_pivots) id.cntl[2] = least_pivot;
    control(28) = 1;  // sequential analysis
  }

  FactorReport& fail(std::string reason) {
    report.ok = false;
    report.reason = std::move(reason);
    return report;
  }
  FactorReport& fail() {
    report.code = infog(1);
    return fail(explain_mumps(infog(1), infog(2)));
  }

  Taken take(Triplets t, long long n, bool symmetric, const KeepFactors& keep) override {
    check(t, n, comm);
    convert(t, symmetric);
    const bool comparable = analysed && id.n == n && (id.sym == 2) == symmetric;
    if (comparable && options.joined) join(t);
    const bool same = comm.all(comparable && t.row == row && t.col == col);
    if (same && factorised && keep && keep(comm.max(largest_change(t)))) return Taken::near;
    row = std::move(t.row);
    col = std::move(t.col);
    if constexpr (std::is_same_v<Number, double>)
      value = std::move(t.value);
    else
      value.assign(t.value.begin(), t.value.end());
    factorised = false;
    if (!same) restart(symmetric);
    id.n = static_cast<MUMPS_INT>(n);
    id.nnz_loc = static_cast<MUMPS_INT8>(row.size());
    id.irn_loc = row.data();
    id.jcn_loc = col.data();
    id.a_loc = value.data();
    return same ? Taken::known : Taken::unknown;
  }

  // The order of elimination that MUMPS is given.
  void order() {
    Triplets t{row, col, {value.begin(), value.end()}};
    for (int& i : t.row) --i;
    for (int& i : t.col) --i;
    place = nested_dissection(t, id.n, comm);
    for (int& p : place) ++p;
    id.perm_in = place.data();
  }

  // Zeros where the last matrix had entries, unless they would be too many.
  void join(Triplets& t) const {
    // Times the entries: a known pattern saves the analysis, and a tenth more entries hardly fill the
    // factors.
    constexpr double most = 1.1;
    const auto before = [](int i, int j, int k, int l) { return i < k || (i == k && j < l); };
    Triplets all;
    for (std::vector<int>* part : {&all.row, &all.col}) part->reserve(row.size());
    all.value.reserve(row.size());
    const auto push = [&](int i, int j, double v) {
      all.row.push_back(i), all.col.push_back(j), all.value.push_back(v);
    };
    std::size_t k = 0;
    for (std::size_t l = 0; l < t.row.size(); ++l) {
      for (; k < row.size() && before(row[k], col[k], t.row[l], t.col[l]); ++k) push(row[k], col[k], 0);
      if (k < row.size() && row[k] == t.row[l] && col[k] == t.col[l]) ++k;
      push(t.row[l], t.col[l], t.value[l]);
    }
    for (; k < row.size(); ++k) push(row[k], col[k], 0);
    if (static_cast<double>(all.row.size()) <= most * static_cast<double>(t.row.size())) t = std::move(all);
  }

  // From the matrix that is factorised to one of the same pattern: of this rank's part of a row, relative to
  // its sum of magnitudes.
  double largest_change(const Triplets& t) const {
    struct Row {
      float change = 0, magnitude = 0;
    };
    std::vector<Row> rows(id.n);
    const auto add = [&](int i, Number before, double now) {
      rows[i - 1].change += static_cast<float>(std::abs(now - before));
      rows[i - 1].magnitude += static_cast<float>(std::abs(before));
    };
    for (std::size_t k = 0; k < value.size(); ++k) {
      add(row[k], value[k], t.value[k]);
      if (id.sym == 2 && col[k] != row[k]) add(col[k], value[k], t.value[k]);
    }
    double largest = 0;
    for (const Row& r : rows)
      if (r.change > 0)
        largest = std::max(largest, static_cast<double>(r.change / r.magnitude));
      else if (std::isnan(r.change))
        return std::numeric_limits<double>::infinity();
    return largest;
  }

  FactorReport& analyse() override {
    report = {};
    report.matrix_entries = static_cast<double>(comm.sum(static_cast<long long>(row.size())));
    double begin = Clock::now();
    if (options.ordering == Ordering::metis) order();
    analysed = run(analysis);
    report.seconds_analysis = Clock::now() - begin;
    if (!analysed) return fail();
    report.ok = true;
    report.ordering = options.ordering == Ordering::metis ? "METIS" : mumps_ordering(infog(7));
    report.estimated_max_mb = infog(16);
    report.estimated_mb = infog(17);
    report.estimated_entries = count(infog(20));
    report.estimated_flops = rinfog(1);
    return report;
  }

  FactorReport& factorise() override {
    report.ok = false;
    report.memory_mb = report.memory_max_mb = report.flops = report.factor_entries = 0;
    report.negative_pivots = report.null_pivots = report.relaxations = 0;
    auto finite = [](Number v) { return std::isfinite(v); };
    if (!comm.all(std::all_of(value.begin(), value.end(), finite))) return fail("the matrix is not finite");
    const double needed = report.estimated_mb + megabytes_per_entry<Number> * report.matrix_entries;
    report.too_large = options.memory_limit_mb > 0 && needed > options.memory_limit_mb;
    if (report.too_large)
      return fail("matrix and factors need about " + std::to_string(std::llround(needed)) +
                  " MB, more than the " + std::to_string(std::llround(options.memory_limit_mb)) +
                  " MB allowed");
    double begin = Clock::now();
    factorised = run(factorisation);
    // workspaces and, on several ranks, buffers of messages that are too small
    const auto too_small = [&] { return std::ranges::count(std::array{-8, -9, -17, -20}, infog(1)) > 0; };
    while (too_small() && report.relaxations < options.relaxations) {
      control(14) = 2 * std::max(control(14), 20);  // percent beyond the estimate
      ++report.relaxations;
      factorised = run(factorisation);
    }
    report.seconds_factorisation = Clock::now() - begin;
    if (!factorised) return fail();
    report.ok = true;
    report.reason.clear();
    report.code = infog(1);
    report.memory_max_mb = infog(21);
    report.memory_mb = infog(22);
    report.factor_entries = count(infog(29));
    report.flops = rinfog(3);
    report.negative_pivots = id.sym == 2 ? infog(12) : 0;
    report.null_pivots = infog(28);
    find_null_space();
    return report;
  }

  // On rank 0, orthonormal, one after the other; more would take as much memory as factors do, and are left.
  void find_null_space() {
    constexpr int most = 64;
    null_space.clear();
    const int vectors = infog(28);
    if (vectors == 0 || vectors > most) return;
    std::vector<Number> all(comm.rank() == 0 ? static_cast<std::size_t>(vectors) * id.n : 0);
    control(25) = -1;
    if (!run_solution(all, vectors)) all.clear();
    control(25) = 0;
    for (auto v = all.begin(); v != all.end(); v += id.n) {
      for (int twice = 0; twice < 2; ++twice) remove_null_space({&*v, static_cast<std::size_t>(id.n)});
      const double length = std::sqrt(std::inner_product(v, v + id.n, v, 0.0));
      if (!(length > 0)) continue;
      std::transform(v, v + id.n, std::back_inserter(null_space), [&](Number a) { return a / length; });
    }
  }

  void remove_null_space(std::span<Number> x) const {
    for (auto q = null_space.begin(); q != null_space.end(); q += id.n) {
      const double part = std::inner_product(x.begin(), x.end(), q, 0.0);
      for (std::size_t i = 0; i < x.size(); ++i) x[i] -= static_cast<Number>(part * q[i]);
    }
  }

  // `whole`: on rank 0
  bool run_solution(std::vector<Number>& whole, int vectors) {
    id.rhs = whole.data();
    id.nrhs = vectors;
    id.lrhs = id.n;
    const bool ok = run(solution);
    id.rhs = nullptr;
    return ok;
  }

  bool solve(std::span<const double> b, std::span<double> x) override {
    if (!factorised) return false;
    if (comm.sum(static_cast<long long>(b.size())) != id.n || comm.any(b.size() != x.size()))
      throw std::invalid_argument("Mumps: the vectors do not have the matrix's size");
    const MPI_Datatype type = std::is_same_v<Number, double> ? MPI_DOUBLE : MPI_FLOAT;
    int size = static_cast<int>(b.size()), ranks = comm.size();
    std::vector<int> sizes(ranks), starts(ranks, 0);
    MPI_Gather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, 0, comm.raw());
    std::partial_sum(sizes.begin(), sizes.end() - 1, starts.begin() + 1);
    std::vector<Number> here(b.begin(), b.end()), whole(comm.rank() == 0 ? id.n : 0);
    MPI_Gatherv(here.data(), size, type, whole.data(), sizes.data(), starts.data(), type, 0, comm.raw());
    if (!run_solution(whole, 1)) return false;
    remove_null_space(whole);
    MPI_Scatterv(whole.data(), sizes.data(), starts.data(), type, here.data(), size, type, 0, comm.raw());
    std::ranges::copy(here, x.begin());
    return true;
  }
};

Mumps::Mumps(const Comm& comm, MumpsOptions options) {
  if (options.precision == Precision::full)
    m_ = std::make_unique<InstanceOf<DMUMPS_STRUC_C>>(comm, options);
  else
    m_ = std::make_unique<InstanceOf<SMUMPS_STRUC_C>>(comm, options);
}
Mumps::~Mumps() = default;

FactorReport Mumps::analyse(Triplets matrix, long long n, bool symmetric) {
  m_->take(std::move(matrix), n, symmetric, {});
  return m_->analyse();
}

FactorReport Mumps::factorise(Triplets matrix, long long n, bool symmetric, const KeepFactors& keep) {
  const auto taken = m_->take(std::move(matrix), n, symmetric, keep);
  m_->report.kept = taken == Instance::Taken::near;
  if (m_->report.kept) return m_->report;
  if (taken == Instance::Taken::unknown && !m_->analyse().ok) return m_->report;
  if (taken == Instance::Taken::known) m_->report.seconds_analysis = 0;
  return m_->factorise();
}

bool Mumps::solve(std::span<const double> b, std::span<double> x) { return m_->solve(b, x); }

}  // namespace bulbus::inline solve
