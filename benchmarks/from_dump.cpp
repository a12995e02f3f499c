// One linear system from its dump alone (docs/dump.md): MUMPS, GMRES with what the matrix itself offers, and
// GMRES on its displacement block with BoomerAMG.
//
//     bench_from_dump system.h5 ...      solves these
//     bench_from_dump -n 8               makes the dump of a small half eye first
#include <Eigen/Dense>
#include <cmath>
#include <filesystem>

#include "benchmarks/common.hpp"
#include "benchmarks/half_eye.hpp"
#include "core/solve/assemble.hpp"
#include "core/solve/mumps.hpp"
#include "core/solve/near_null_space.hpp"
#include "precond/amg/boomeramg.hpp"
#include "precond/make_preconditioner.hpp"

using namespace bulbus;
using namespace bulbus::bench;

namespace {

// s A s by rows; entries that come twice stay so.
class ScaledMatrix final : public LinearOperator {
 public:
  ScaledMatrix(const SystemDump& d, std::span<const double> s)
      : start_(d.rhs.size() + 1), column_(d.matrix.row.size()), value_(column_.size()) {
    for (int r : d.matrix.row) ++start_[r + 1];
    for (std::size_t r = 1; r < start_.size(); ++r) start_[r] += start_[r - 1];
    std::vector<std::size_t> at(start_.begin(), start_.end() - 1);
    for (std::size_t k = 0; k < column_.size(); ++k) {
      const std::size_t to = at[d.matrix.row[k]]++;
      column_[to] = d.matrix.col[k];
      value_[to] = s[d.matrix.row[k]] * d.matrix.value[k] * s[d.matrix.col[k]];
    }
  }
  int size() const override { return static_cast<int>(start_.size()) - 1; }
  void apply(std::span<const double> x, std::span<double> y) const override {
    for (int r = 0; r < size(); ++r) {
      double sum = 0;
      for (std::size_t k = start_[r]; k < start_[r + 1]; ++k) sum += value_[k] * x[column_[k]];
      y[r] = sum;
    }
  }
  double at(int r, int c) const {
    double sum = 0;
    for (std::size_t k = start_[r]; k < start_[r + 1]; ++k) sum += column_[k] == c ? value_[k] : 0;
    return sum;
  }
  bool symmetric() const {
    std::vector<double> x(size()), y(size()), Ax(size()), Ay(size());
    for (int i = 0; i < size(); ++i) x[i] = std::sin(1. + i), y[i] = std::cos(3. * i);
    apply(x, Ax), apply(y, Ay);
    double a = 0, b = 0, scale = 0;
    for (int i = 0; i < size(); ++i) a += y[i] * Ax[i], b += x[i] * Ay[i], scale += std::abs(y[i] * Ax[i]);
    return std::abs(a - b) < 1e-10 * scale;
  }

 private:
  std::vector<std::size_t> start_;
  std::vector<int> column_;
  std::vector<double> value_;
};

// Inverses of the nodes' 3×3 blocks; elsewhere the dump's scaling has made the typical size 1.
class NodalBlocks final : public Preconditioner {
 public:
  NodalBlocks(const ScaledMatrix& A, const std::vector<UnknownKind>& kind) : size_(A.size()) {
    for (int i = 0; i + 2 < size_ && kind[i + 2] == UnknownKind::displacement; i += 3) {
      Eigen::Matrix3d block;
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) block(r, c) = A.at(i + r, i + c);
      inverse_.push_back(block.inverse());
    }
  }
  int size() const override { return size_; }
  bool is_linear() const override { return true; }
  void apply(std::span<const double> x, std::span<double> y) const override {
    std::copy(x.begin(), x.end(), y.begin());
    for (std::size_t n = 0; n < inverse_.size(); ++n)
      Eigen::Map<Eigen::Vector3d>(y.data() + 3 * n) =
          inverse_[n] * Eigen::Map<const Eigen::Vector3d>(x.data() + 3 * n);
  }

 private:
  int size_;
  std::vector<Eigen::Matrix3d> inverse_;
};

double relative_residual(const ScaledMatrix& A, std::span<const double> x, std::span<const double> b) {
  std::vector<double> r(b.size());
  A.apply(x, r);
  double rr = 0, bb = 0;
  for (std::size_t i = 0; i < r.size(); ++i) rr += std::pow(b[i] - r[i], 2), bb += b[i] * b[i];
  return std::sqrt(rr / bb);
}

/// The displacement block of a dump of one rank, its right-hand side and its rotations.
class DisplacementBlockOf final : public LinearOperator {
 public:
  explicit DisplacementBlockOf(const SystemDump& d) {
    while (size_ < static_cast<int>(d.kind.size()) && d.kind[size_] == UnknownKind::displacement) ++size_;
    csr.rows = size_;
    for (std::size_t k = 0; k < d.matrix.row.size(); ++k) {  // sorted by row
      const int row = d.matrix.row[k], column = d.matrix.col[k];
      if (row >= size_ || column >= size_) continue;
      if (csr.row_ids.empty() || csr.row_ids.back() != row) {
        csr.row_ids.push_back(row);
        csr.start.push_back(static_cast<int>(csr.columns.size()));
      }
      csr.columns.push_back(column);
      csr.values.push_back(d.matrix.value[k]);
    }
    csr.start.push_back(static_cast<int>(csr.columns.size()));
    rhs.assign(d.rhs.begin(), d.rhs.begin() + size_);
    take_rotations(d);
  }
  int size() const override { return size_; }
  void apply(std::span<const double> x, std::span<double> y) const override {
    for (std::size_t i = 0; i < csr.row_ids.size(); ++i) {
      double sum = 0;
      for (int k = csr.start[i]; k < csr.start[i + 1]; ++k) sum += csr.values[k] * x[csr.columns[k]];
      y[csr.row_ids[i]] = sum;
    }
  }

  DistributedCsr csr;
  std::vector<double> rhs;
  std::vector<std::vector<double>> rotations;  ///< about the middle of the nodes, of the size of translations

 private:
  void take_rotations(const SystemDump& d) {
    if (d.near_null_space.empty()) return;
    Vec3<double> middle{0, 0, 0};
    double squares = 0;
    for (int i = 0; i < size_; i += 3)
      for (int c = 0; c < 3; ++c) {
        middle[c] += 3 * d.coordinates[3 * i + c] / size_;
        squares += 3 * std::pow(d.coordinates[3 * i + c], 2) / size_;
      }
    const double radius = std::sqrt(squares - dot(middle, middle));
    rotations.assign(3, std::vector<double>(size_));
    for (int i = 0; i < size_; ++i)
      for (int k = 0; k < 3; ++k) {
        const double* of = &d.near_null_space[6 * i];
        const int a = (k + 1) % 3, b = (k + 2) % 3;  // e_k × x = x_a e_b − x_b e_a
        rotations[k][i] = (of[3 + k] - middle[a] * of[b] + middle[b] * of[a]) / radius;
      }
  }
  int size_ = 0;
};

/// BoomerAMG at several thresholds of strong connections, unknown by unknown and node by node.
void solve_displacements(const SystemDump& d, const json& system, const Options& o, json& rows) {
  const Comm comm;
  const DisplacementBlockOf K(d);
  for (const bool nodal : {false, true})
    for (const double threshold : {.25, .5, .7, .9}) {
      AmgOptions options{.functions = 3, .nodal = nodal, .threshold = threshold};
      if (nodal) options.rigid_modes = K.rotations;
      double start = cpu_seconds();
      const BoomerAmg amg(K.csr, options, comm);
      const double made = cpu_seconds() - start;
      std::vector<double> x(K.size());
      start = cpu_seconds();
      const KrylovReport k = fgmres(K, &amg, K.rhs, x, {1e-6, 100, o.smoke ? 50 : 400, false}, comm);
      json row{{"method",
                fmt::format("displacements by boomeramg{}, threshold {}", nodal ? "_nodal" : "", threshold)},
               {"iterations", k.iterations},
               {"setup_s", made},
               {"solve_s", cpu_seconds() - start},
               {"mb", 1e-6 * amg.bytes()},
               {"reason", k.converged ? "" : k.reason}};
      row.update(system);
      rows.push_back(std::move(row));
    }
}

void solve_one(const std::string& path, const Options& o, json& rows) {
  const SystemDump d = read_system(path);
  const std::size_t n = d.rhs.size();
  std::vector<double> s = d.scaling.empty() ? std::vector<double>(n, 1) : d.scaling, b(n), x(n);
  const ScaledMatrix A(d, s);
  for (std::size_t i = 0; i < n; ++i) b[i] = s[i] * d.rhs[i];
  const json system{{"file", std::filesystem::path(path).filename()},
                    {"unknowns", n},
                    {"entries", d.matrix.row.size()},
                    {"symmetric", A.symmetric()}};
  const auto add = [&](json row) {
    row.update(system);
    rows.push_back(std::move(row));
  };

  const Comm comm;
  Mumps mumps(comm);
  double start = cpu_seconds();
  const FactorReport f = mumps.factorise(d.matrix, static_cast<long long>(n), system["symmetric"]);
  const double factorised = cpu_seconds();
  json row{{"method", "MUMPS"},
           {"iterations", 0},
           {"setup_s", factorised - start},
           {"mb", f.memory_mb},
           {"reason", f.reason}};
  if (f.ok && mumps.solve(d.rhs, x)) {
    row["solve_s"] = cpu_seconds() - factorised;
    for (std::size_t i = 0; i < n; ++i) x[i] /= s[i];
    row["residual"] = relative_residual(A, x, b);
    if (system["symmetric"]) row["negative_pivots"] = f.negative_pivots;
  }
  add(row);

  start = cpu_seconds();
  const NodalBlocks blocks(A, d.kind);
  const double made = cpu_seconds() - start;
  for (auto [name, M] : {std::pair<const char*, const Preconditioner*>{"GMRES, scaling alone", nullptr},
                         {"GMRES, nodal blocks", &blocks}}) {
    std::fill(x.begin(), x.end(), 0.);
    start = cpu_seconds();
    const KrylovReport k = fgmres(A, M, b, x, {1e-6, 100, o.smoke ? 200 : 3000, false}, comm);
    add({{"method", name},
         {"iterations", k.iterations},
         {"setup_s", M ? made : 0.},
         {"solve_s", cpu_seconds() - start},
         {"mb", 1e-6 * k.basis_bytes},
         {"residual", relative_residual(A, x, b)},
         {"reason", k.converged ? "" : k.reason}});
  }
  solve_displacements(d, system, o, rows);
}

// The first coupled increment's system, as a run with `solver.linear.dump` would write it.
std::string make_dump(int n) {
  const Comm comm;
  const SolverSettings settings;
  Profiler profiler;
  auto problem = half_eye(n, comm);
  State state = pressurised(*problem, settings, profiler);
  const auto [r, prescribed] = first_increment(*problem, state);
  const auto system = std::make_shared<const CoupledSystem>(*problem, settings.linear, state, r);
  const CoupledOperator A(system);
  const std::string path =
      std::filesystem::temp_directory_path() / ("bulbus_half_eye_" + std::to_string(n) + ".h5");
  SystemDump dump;
  dump.matrix = assemble(A);
  dump.rhs = A.right_hand_side(r, prescribed);
  dump.kind = unknown_kinds(system->layout());
  dump.scaling = system->scaling();
  dump.coordinates = unknown_coordinates(*system);
  dump.near_null_space = near_null_space(*system);
  dump.attributes = {{"n", n}};
  write_system(path, dump, comm);
  return path;
}

}  // namespace

int main(int argc, char** argv) {
  single_threaded(argv);
  Session session(argc, argv);
  Options o = parse(argc, argv, {8}, {4}, 1);
  json report = new_report("from_dump", o);
  report["parameters"].update({{"tolerance", 1e-6}, {"restart", 100}, {"files", o.rest}});
  report["notes"] =
      "seconds are processor time; residual: scaled norm relative to the right-hand side's; mb: factor, or "
      "Krylov basis";
  for (const std::string& path : o.rest) solve_one(path, o, report["rows"]);
  if (o.rest.empty())
    for (int n : o.sizes) {
      const std::string path = make_dump(n);
      solve_one(path, o, report["rows"]);
      std::filesystem::remove(path);
    }
  finish(report,
         {"file", "unknowns", "method", "iterations", "setup_s", "solve_s", "mb", "residual", "reason"}, o);
}
