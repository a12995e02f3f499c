#include "core/solve/dump.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/base/error.hpp"
#include "core/io/output.hpp"
#include "tests/support/not_empty.hpp"

namespace bulbus {
namespace {

/// Rank r holds r + 1 unknowns and as many entries, but the second rank no entry.
SystemDump part_of(int rank, int first) {
  SystemDump d;
  for (int i = first; i <= first + rank; ++i) {
    if (rank != 1) d.matrix.row.push_back(i), d.matrix.col.push_back(0), d.matrix.value.push_back(i / 3.0);
    d.rhs.push_back(10.0 * i);
    d.kind.push_back(static_cast<UnknownKind>(i % 4));
    d.scaling.push_back(1.0 + i);
  }
  d.attributes = {{"gamma", 10.0 + rank}, {"time", 0.25}};
  return d;
}

struct Dump : testing::Test {
  Comm comm;
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("bulbus_dump_test_" + std::to_string(comm.size()) + ".h5");
  int first = comm.rank() * (comm.rank() + 1) / 2;
  SystemDump mine = part_of(comm.rank(), first);
  void TearDown() override {
    comm.barrier();
    if (comm.rank() == 0) std::filesystem::remove(path);
  }
};

TEST_F(Dump, ReadsWhatItWrote) {
  write_system(path, mine, comm);
  SystemDump all = read_system(path);
  SystemDump expected;
  auto append = [](auto& a, const auto& b) { a.insert(a.end(), b.begin(), b.end()); };
  for (int r = 0; r < comm.size(); ++r) {
    SystemDump p = part_of(r, r * (r + 1) / 2);
    append(expected.matrix.row, p.matrix.row), append(expected.matrix.col, p.matrix.col);
    append(expected.matrix.value, p.matrix.value);
    append(expected.rhs, p.rhs), append(expected.kind, p.kind), append(expected.scaling, p.scaling);
  }
  EXPECT_EQ(all.matrix.row, expected.matrix.row);
  EXPECT_EQ(all.matrix.col, expected.matrix.col);
  EXPECT_EQ(all.matrix.value, expected.matrix.value);
  EXPECT_EQ(all.rhs, expected.rhs);
  EXPECT_EQ(all.kind, expected.kind);
  EXPECT_EQ(all.scaling, expected.scaling);
  EXPECT_EQ(all.attributes, (std::map<std::string, double>{{"gamma", 10}, {"time", 0.25}}));
}

TEST_F(Dump, ScalingMayBeLeftOut) {
  mine.scaling.clear();
  write_system(path, mine, comm);
  EXPECT_TRUE(read_system(path).scaling.empty());
}

TEST_F(Dump, TakesItsSolutionLater) {
  const std::size_t n = mine.rhs.size();
  mine.coordinates.assign(3 * n, 1);
  mine.near_null_space.assign(6 * n, 2);
  mine.solution.assign(n, std::nan(""));
  write_system(path, mine, comm);
  for (double v : not_empty(read_system(path).solution)) EXPECT_TRUE(std::isnan(v));
  write_solution(path, mine.rhs, {{"time", 0.5}}, comm);
  const SystemDump all = read_system(path);
  EXPECT_EQ(all.solution, all.rhs);
  EXPECT_EQ(all.coordinates, std::vector<double>(3 * all.rhs.size(), 1));
  EXPECT_EQ(all.near_null_space, std::vector<double>(6 * all.rhs.size(), 2));
  EXPECT_EQ(all.attributes.at("time"), 0.5);
  EXPECT_THROW(write_solution("/no/such/folder/a.h5", mine.rhs, {}, comm), OutputError);
  EXPECT_THROW(write_solution(path, mine.rhs, {{"none", 1}}, comm), OutputError);
}

TEST_F(Dump, OverwritesAnOlderFile) {
  write_system(path, mine, comm);
  for (double& v : mine.rhs) v = -1;
  write_system(path, mine, comm);
  for (double v : not_empty(read_system(path).rhs)) EXPECT_EQ(v, -1);
}

TEST_F(Dump, SaysWhichFileCannotBeUsed) {
  EXPECT_THROW(write_system("/no/such/folder/a.h5", mine, comm), OutputError);
  EXPECT_THROW(read_system("/no/such/folder/a.h5"), InputError);
  mine.coordinates.push_back(0);
  EXPECT_THROW(write_system(path, mine, comm), std::invalid_argument);
  mine.coordinates.clear();
  mine.kind.push_back(UnknownKind::rigid);
  EXPECT_THROW(write_system(path, mine, comm), std::invalid_argument);
}

TEST_F(Dump, MatrixMarketAddsDuplicates) {
  SystemDump whole;
  whole.matrix = {{1, 0, 1, 0}, {0, 0, 0, 1}, {0.5, 2, 0.25, -1}};
  whole.rhs = {1, 0.1};
  whole.attributes = {{"gamma", 10}, {"tolerance", 0.1}};
  std::string name = path.string() + std::to_string(comm.rank()) + ".mtx", rhs_name = name;
  rhs_name.insert(name.size() - 4, "_rhs");
  write_matrix_market(name, whole);
  std::stringstream matrix, rhs;
  matrix << std::ifstream(name).rdbuf(), rhs << std::ifstream(rhs_name).rdbuf();
  EXPECT_EQ(matrix.str(),
            "%%MatrixMarket matrix coordinate real general\n% gamma 10\n% tolerance 0.10000000000000001\n"
            "2 2 3\n1 1 2\n2 1 0.75\n1 2 -1\n");
  EXPECT_EQ(rhs.str(), "%%MatrixMarket matrix array real general\n2 1\n1\n0.10000000000000001\n");
  std::filesystem::remove(name), std::filesystem::remove(rhs_name);
  whole.coordinates = {1, 2, 3, 4, 5, 6};
  const auto names = write_matrix_market(name, whole);
  ASSERT_EQ(names.size(), 3u);
  std::stringstream table;
  table << std::ifstream(names[2]).rdbuf();
  EXPECT_EQ(table.str(), "%%MatrixMarket matrix array real general\n2 3\n1\n4\n2\n5\n3\n6\n");
  for (const std::string& written : names) std::filesystem::remove(written);
}

}  // namespace
}  // namespace bulbus
