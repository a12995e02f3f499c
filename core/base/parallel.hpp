#pragma once
#include <mpi.h>

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace bulbus {

/// Starts and ends MPI and the libraries on it (hypre is started by its own wrapper). One per program.
class Session {
 public:
  Session(int& argc, char**& argv);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
};

/// What this rank has sent through Halo and summed through Comm since the program began.
struct Traffic {
  long long messages = 0, bytes = 0, reductions = 0;
};
Traffic& traffic();

/// A communicator with the few reductions that the program needs. Every member but rank/size is collective.
class Comm {
 public:
  Comm(MPI_Comm c = MPI_COMM_WORLD);
  int rank() const { return rank_; }
  int size() const { return size_; }
  MPI_Comm raw() const { return comm_; }

  double sum(double x) const;
  long long sum(long long x) const;
  int sum(int x) const { return static_cast<int>(sum(static_cast<long long>(x))); }
  double max(double x) const;
  double min(double x) const;
  bool any(bool x) const { return max(x ? 1.0 : 0.0) > 0; }
  bool all(bool x) const { return !any(!x); }
  /// In place.
  void sum(std::span<double> x) const;
  void max(std::span<double> x) const;
  void broadcast(std::span<double> x, int root = 0) const;
  /// Sum of x over the ranks below this one.
  long long offset(long long x) const;
  /// Concatenation in the order of the ranks, on every rank.
  std::vector<double> gather(std::span<const double> x) const;
  std::vector<long long> gather(std::span<const long long> x) const;
  /// `to_rank[r]` goes to rank r; returned is what came from each rank.
  std::vector<std::vector<long long>> exchange(const std::vector<std::vector<long long>>& to_rank) const;
  void barrier() const;
  /// Runs work that may throw an InputError on some ranks only; then all ranks throw that of the lowest one.
  void together(const std::function<void()>& work) const;

 private:
  MPI_Comm comm_;
  int rank_, size_;
};

}  // namespace bulbus
