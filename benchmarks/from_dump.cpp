// One linear system from its dump alone (core/solve/dump.hpp): MUMPS, and GMRES with what the matrix itself
// offers.
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
}

// The first coupled increment's system, as a run with `solver.linear.dump` would write it.
std::string make_dump(int n) {
  const Comm comm;
  const SolverSettings settings;
  Profiler profiler;
  auto problem = half_eye(n, comm);
  State state = pressurised(*problem, settings, profiler);
  const auto [r, prescribed] = first_increment(*problem, state);
  CoupledSystem system(*problem, settings.linear);
  system.linearize(state, r);
  const CoupledOperator A(system);
  const std::string path =
      std::filesystem::temp_directory_path() / ("bulbus_half_eye_" + std::to_string(n) + ".h5");
  write_system(path,
               {assemble(A),
                A.right_hand_side(r, prescribed),
                unknown_kinds(system.layout()),
                system.scaling(),
                {{"n", n}}},
               comm);
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
