#include "core/base/parallel.hpp"

#include <malloc.h>

#include <cstdlib>
#include <numeric>
#include <optional>

#include "core/base/error.hpp"

namespace bulbus {
namespace {

bool started_here = false;

std::string broadcast(std::string text, int root, MPI_Comm comm) {
  int length = static_cast<int>(text.size());
  MPI_Bcast(&length, 1, MPI_INT, root, comm);
  text.resize(length);
  MPI_Bcast(text.data(), length, MPI_CHAR, root, comm);
  return text;
}

template <class T>
std::vector<T> gather_all(std::span<const T> x, MPI_Comm comm, int size, MPI_Datatype type) {
  int count = static_cast<int>(x.size());
  std::vector<int> counts(size), starts(size, 0);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  for (int r = 1; r < size; ++r) starts[r] = starts[r - 1] + counts[r - 1];
  std::vector<T> all(starts.back() + counts.back());
  MPI_Allgatherv(x.data(), count, type, all.data(), counts.data(), starts.data(), type, comm);
  return all;
}

// Open MPI has malloc keep all that is freed, for networks that pin memory: a third of a large run would be
// holes.
void give_freed_memory_back() {
#ifdef __GLIBC__
  mallopt(M_MMAP_MAX, 1 << 16);
  mallopt(M_MMAP_THRESHOLD, 4 << 20);
  mallopt(M_TRIM_THRESHOLD, 64 << 20);
#endif
}

// Settings of Open MPI, where the environment has none:
// - Shared file pointers, which nothing here uses, live in semaphores named after the file. One that a killed
// process leaves behind lets every
//   later process hang that opens a file of that name.
// - A process that mpirun has not started is no server of others: it needs none of the large files that Open
// MPI shares with them, which
//   fail where the disk is full.
void set_up_open_mpi() {
  setenv("OMPI_MCA_sharedfp", "^sm", 0);
  if (!std::getenv("PMIX_NAMESPACE")) setenv("PMIX_MCA_gds", "hash", 0);
}

}  // namespace

Traffic& traffic() {
  static Traffic sent;
  return sent;
}

Session::Session(int& argc, char**& argv) {
  int running = 0;
  MPI_Initialized(&running);
  if (!running) {
    set_up_open_mpi();
    MPI_Init(&argc, &argv);
  }
  give_freed_memory_back();
  started_here = !running;
}

Session::~Session() {
  int ended = 0;
  MPI_Finalized(&ended);
  if (started_here && !ended) MPI_Finalize();
}

Comm::Comm(MPI_Comm c) : comm_(c) {
  MPI_Comm_rank(c, &rank_);
  MPI_Comm_size(c, &size_);
}

double Comm::sum(double x) const {
  ++traffic().reductions;
  MPI_Allreduce(MPI_IN_PLACE, &x, 1, MPI_DOUBLE, MPI_SUM, comm_);
  return x;
}

long long Comm::sum(long long x) const {
  ++traffic().reductions;
  MPI_Allreduce(MPI_IN_PLACE, &x, 1, MPI_LONG_LONG, MPI_SUM, comm_);
  return x;
}

double Comm::max(double x) const {
  ++traffic().reductions;
  MPI_Allreduce(MPI_IN_PLACE, &x, 1, MPI_DOUBLE, MPI_MAX, comm_);
  return x;
}

double Comm::min(double x) const { return -max(-x); }

void Comm::sum(std::span<double> x) const {
  ++traffic().reductions;
  MPI_Allreduce(MPI_IN_PLACE, x.data(), static_cast<int>(x.size()), MPI_DOUBLE, MPI_SUM, comm_);
}

void Comm::max(std::span<double> x) const {
  ++traffic().reductions;
  MPI_Allreduce(MPI_IN_PLACE, x.data(), static_cast<int>(x.size()), MPI_DOUBLE, MPI_MAX, comm_);
}

void Comm::broadcast(std::span<double> x, int root) const {
  MPI_Bcast(x.data(), static_cast<int>(x.size()), MPI_DOUBLE, root, comm_);
}

long long Comm::offset(long long x) const {
  long long below = 0;
  MPI_Exscan(&x, &below, 1, MPI_LONG_LONG, MPI_SUM, comm_);
  return rank_ == 0 ? 0 : below;
}

std::vector<double> Comm::gather(std::span<const double> x) const {
  return gather_all(x, comm_, size_, MPI_DOUBLE);
}

std::vector<long long> Comm::gather(std::span<const long long> x) const {
  return gather_all(x, comm_, size_, MPI_LONG_LONG);
}

std::vector<std::vector<long long>> Comm::exchange(const std::vector<std::vector<long long>>& to_rank) const {
  std::vector<int> give(size_), take(size_), give_start(size_ + 1), take_start(size_ + 1);
  for (int r = 0; r < size_; ++r) give[r] = static_cast<int>(to_rank[r].size());
  MPI_Alltoall(give.data(), 1, MPI_INT, take.data(), 1, MPI_INT, comm_);
  std::partial_sum(give.begin(), give.end(), give_start.begin() + 1);
  std::partial_sum(take.begin(), take.end(), take_start.begin() + 1);
  std::vector<long long> out, in(take_start.back());
  out.reserve(give_start.back());
  for (const auto& list : to_rank) out.insert(out.end(), list.begin(), list.end());
  MPI_Alltoallv(out.data(), give.data(), give_start.data(), MPI_LONG_LONG, in.data(), take.data(),
                take_start.data(), MPI_LONG_LONG, comm_);
  std::vector<std::vector<long long>> from_rank;
  for (int r = 0; r < size_; ++r)
    from_rank.emplace_back(in.begin() + take_start[r], in.begin() + take_start[r + 1]);
  return from_rank;
}

void Comm::together(const std::function<void()>& work) const {
  std::optional<InputError> fault;
  try {
    work();
  } catch (const InputError& e) {
    fault = e;
  }
  const int first = static_cast<int>(min(fault ? rank_ : size_));
  if (first == size_) return;
  const std::string message = bulbus::broadcast(fault ? fault->what() : "", first, comm_);
  throw InputError(message, bulbus::broadcast(fault ? fault->key : "", first, comm_));
}

void Comm::barrier() const { MPI_Barrier(comm_); }

}  // namespace bulbus
