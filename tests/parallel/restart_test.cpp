// A run is left on some ranks and goes on on others: 1 → 1, 1 → 2 and 2 → 1, 2 → 3 and 3 → 1, as many as
// there are.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "core/io/hdf5_read.hpp"
#include "core/io/text_file.hpp"
#include "tests/support/left.hpp"
#include "tests/support/numbers.hpp"

namespace bulbus {
namespace {

namespace fs = std::filesystem;
using namespace test;

/// Runs work on the first `ranks` ranks, with a communicator of their own.
template <class Work>
void on(int ranks, Work work) {
  const Comm all;
  MPI_Comm raw;
  MPI_Comm_split(all.raw(), all.rank() < ranks ? 0 : MPI_UNDEFINED, 0, &raw);
  if (raw != MPI_COMM_NULL) work(Comm(raw));
  all.barrier();
}

fs::path folder_of(const std::string& name) {
  const Comm all;
  const auto folder = fs::temp_directory_path() / fmt::format("bulbus_restart_{}", all.size()) / name;
  if (all.rank() == 0) {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  all.barrier();
  return folder;
}

nlohmann::json probes_in(const fs::path& folder) {
  std::ifstream in(folder / "summary.json");
  return nlohmann::json::parse(in)["probes"];
}

/// Rows of a table of the checkpoint in the order of their keys.
std::vector<double> in_order(const fs::path& folder, const std::string& keys, const std::string& name) {
  const auto key = read_dataset(folder / "checkpoint.h5", keys),
             rows = read_dataset(folder / "checkpoint.h5", name);
  const std::size_t width = rows.size() / key.size();
  std::vector<double> sorted(rows.size());
  for (std::size_t i = 0; i < key.size(); ++i)
    std::copy_n(&rows[i * width], width, &sorted[static_cast<std::size_t>(key[i]) * width]);
  return sorted;
}

/// The largest relative difference of probes and fields.
double difference(const fs::path& a, const fs::path& b) {
  double worst = 0;
  const auto found = probes_in(a), wanted = probes_in(b);
  for (const auto& [name, v] : wanted.items())
    worst = worse(worst, std::abs(found[name].get<double>() - v.get<double>()) / size_of(name, v));
  for (const auto& [keys, name] : {std::pair{"node", "now/x"}, {"hexahedron", "now/lambda"}})
    worst = worse(worst, relative_difference(in_order(a, keys, name), in_order(b, keys, name)));
  return worst;
}

/// Leaves a run on `from` ranks amid a step with moving bodies and at the end of one, and goes on.
void expect_same(int from, const std::map<int, double>& tolerance_on) {
  const Scene scene = parse_scene(full_of_memory, "scene.yaml");
  const auto whole = folder_of("whole"), left = folder_of("left");
  on(from, [&](const Comm& comm) { run(scene, "", whole, comm, Log::Screen::silent); });
  on(from, [&](const Comm& comm) {
    run_and_leave(scene, left, comm, [&](int number) {
      if (comm.rank() == 0 && number == 4) fs::copy(left, left / "4");
      if (comm.rank() == 0 && number == 8) fs::copy(left, left / "8");
      if (number == 8) throw Left();
    });
  });
  for (const auto& [to, tolerance] : tolerance_on)
    for (const char* last : {"4", "8"}) {
      const auto out = folder_of("out");
      int status = 0;
      on(to, [&](const Comm& comm) {
        status = run(scene, "", out, comm, Log::Screen::silent, left / last / "checkpoint.h5");
      });
      ASSERT_EQ(status, 0);
      if (Comm().rank() != 0) continue;
      const double d = difference(out, whole);
      EXPECT_LE(d, tolerance);
      fmt::print("{} to {} ranks after increment {}: {:.1e}\n", from, to, last, d);
    }
}

TEST(Restart, DoesNotDependOnTheRanks) {
  switch (Comm().size()) {
    case 1:
      return expect_same(1, {{1, 1e-12}});
    case 2:
      return expect_same(1, {{2, 1e-8}}), expect_same(2, {{1, 1e-8}, {2, 1e-12}});
    case 3:
      return expect_same(2, {{3, 1e-8}}), expect_same(3, {{1, 1e-8}, {3, 1e-12}});
  }
}

TEST(Restart, IsRefusedOnAllRanksTogether) {
  const auto folder = folder_of("refused");
  const Scene scene = parse_scene(full_of_memory, "scene.yaml");
  if (Comm().rank() == 0) write_whole(folder / "checkpoint.h5", "no HDF5");
  Comm().barrier();
  EXPECT_THROW(run(scene, "", folder, Comm(), Log::Screen::silent, folder / "checkpoint.h5"), InputError);
  EXPECT_THROW(run(scene, "", folder, Comm(), Log::Screen::silent, folder / "none.h5"), InputError);
}

}  // namespace
}  // namespace bulbus
