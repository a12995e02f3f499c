#include "core/io/checkpoint.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <thread>

#include "core/base/error.hpp"
#include "core/io/archive_copy.hpp"
#include "core/mesh/distributed/partition.hpp"
#include "core/mesh/generate/generate.hpp"
#include "tests/support/numbers.hpp"

namespace bulbus {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

LocalMesh block(int n) {
  const Comm comm(MPI_COMM_SELF);
  const Mesh mesh = generate(BlockShape{.nx = n, .ny = n, .nz = n});
  return distribute(mesh, partition(mesh, 1), comm);
}

std::string fresh_file(const std::string& name) {
  const fs::path folder = fs::temp_directory_path() / ("bulbus_checkpoint_" + name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder / "checkpoint.h5";
}

/// One of everything a Archive takes.
struct Everything {
  double half = .5;
  int count = 3;
  bool flag = true;
  std::vector<double> odd{-0., 5e-324, 1 / 3., std::numeric_limits<double>::infinity()}, none, x, lambda,
      rows;
  std::string words = "süß: [1]\n", silence;
  Archive::Keys keys;

  explicit Everything(const LocalMesh& mesh)
      : x(noise_vector(mesh.X.size(), 1)),
        lambda(noise_vector(mesh.hexes.size(), 2)),
        rows(noise_vector(6, 3)) {
    for (long long k : {7LL, 1LL << 40, 2LL}) keys.add(k, k != 2);
  }
  void serialize(Archive& archive) {
    archive.scalars("plain", half, count, flag);
    archive.numbers("odd", odd);
    archive.numbers("none", none);
    archive.text("words", words);
    archive.text("silence", silence);
    const Archive::Group group(archive, "a/b");
    archive.nodes("x", x);
    archive.hexes("lambda", lambda);
    archive.rows("rows / and more", keys, 2, rows);
  }
};

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

void write(const std::string& path, const LocalMesh& mesh) {
  Everything e(mesh);
  write_checkpoint(path, mesh, [&](Archive& archive) { e.serialize(archive); });
}

TEST(Checkpoint, GivesBackEveryBit) {
  const LocalMesh mesh = block(3);
  const std::string path = fresh_file("round_trip");
  write(path, mesh);
  const Everything kept(mesh);
  Everything read(mesh);
  for (auto* v : {&read.odd, &read.x, &read.lambda, &read.rows}) std::ranges::fill(*v, 9.);
  read.half = 0, read.count = 0, read.flag = false, read.none = {1}, read.words = "", read.silence = "?";
  const auto reader = open_checkpoint(path, mesh);
  EXPECT_TRUE(reader->reading());
  read.serialize(*reader);
  EXPECT_EQ(read.half, kept.half);
  EXPECT_EQ(read.count, kept.count);
  EXPECT_EQ(read.flag, kept.flag);
  EXPECT_EQ(read.words, kept.words);
  EXPECT_EQ(read.silence, "");
  EXPECT_TRUE(read.none.empty());
  EXPECT_TRUE(same_bits(read.odd, kept.odd));
  EXPECT_TRUE(same_bits(read.x, kept.x));
  EXPECT_TRUE(same_bits(read.lambda, kept.lambda));
  EXPECT_TRUE(
      same_bits({read.rows.begin(), read.rows.begin() + 4}, {kept.rows.begin(), kept.rows.begin() + 4}));
  EXPECT_EQ(read.rows[4], 9);  // not mine: not kept
  EXPECT_TRUE(reader->knows("a/b"));
  EXPECT_FALSE(reader->knows("c"));
  const Archive::Group group(*reader, "a/b");
  EXPECT_TRUE(reader->knows("x"));
  EXPECT_FALSE(reader->knows("plain"));
}

// Whatever has become of it since.
TEST(ArchiveCopy, GivesWhatWasKept) {
  const LocalMesh mesh = block(3);
  const std::string path = fresh_file("copy");
  Everything e(mesh);
  ArchiveCopy copy(mesh);
  e.serialize(copy);
  for (auto* v : {&e.odd, &e.x, &e.lambda, &e.rows}) std::ranges::fill(*v, 9.);
  e.half = 0, e.words = "";
  write_checkpoint(path, mesh, [&](Archive& archive) { copy.give(archive); });
  const Everything kept(mesh);
  e.serialize(*open_checkpoint(path, mesh));
  EXPECT_EQ(e.half, kept.half);
  EXPECT_EQ(e.words, kept.words);
  EXPECT_TRUE(same_bits(e.odd, kept.odd));
  EXPECT_TRUE(same_bits(e.x, kept.x));
  EXPECT_TRUE(same_bits(e.lambda, kept.lambda));
  EXPECT_TRUE(same_bits({e.rows.begin(), e.rows.begin() + 4}, {kept.rows.begin(), kept.rows.begin() + 4}));
}

TEST(Checkpoint, LeavesNothingBeside) {
  const LocalMesh mesh = block(2);
  const std::string path = fresh_file("alone");
  write(path, mesh);
  write(path, mesh);
  EXPECT_EQ(std::distance(fs::directory_iterator(fs::path(path).parent_path()), {}), 1);
}

TEST(Checkpoint, KeepsTheOldOneWhenTheNewOneFails) {
  const LocalMesh mesh = block(2);
  const std::string path = fresh_file("kept");
  write(path, mesh);
  EXPECT_THROW(write_checkpoint(path, mesh,
                                [](Archive& archive) {
                                  double half = .25;
                                  archive.scalars("plain", half);
                                  throw std::runtime_error("the disk is full");
                                }),
               std::runtime_error);
  double half = 0;
  int count = 0;
  bool flag = false;
  open_checkpoint(path, mesh)->scalars("plain", half, count, flag);
  EXPECT_EQ(half, .5);
  EXPECT_FALSE(fs::exists(path + ".tmp"));
  EXPECT_THROW(write("/nowhere/at/all.h5", mesh), std::runtime_error);
}

std::string fault_of(const std::string& path, const LocalMesh& mesh) {
  try {
    open_checkpoint(path, mesh);
    return "";
  } catch (const InputError& fault) {
    return fault.what();
  }
}

TEST(Checkpoint, RefusesOtherFiles) {
  const LocalMesh mesh = block(2);
  const std::string path = fresh_file("other");
  for (const char* content : {"", "steps: []\n"}) {
    std::ofstream(path) << content;
    EXPECT_NE(fault_of(path, mesh).find(path + ": no whole checkpoint"), std::string::npos);
  }
}

TEST(Checkpoint, FindsEveryChangeOfItsNumbers) {
  const LocalMesh mesh = block(3);
  const std::string path = fresh_file("damaged");
  write(path, mesh);
  ASSERT_EQ(fault_of(path, mesh), "");
  std::ifstream in(path, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  const Everything e(mesh);
  for (const auto* v : {&e.odd, &e.x, &e.lambda})
    for (std::size_t i : {std::size_t{0}, v->size() - 1}) {
      const auto at =
          whole.find(std::string(reinterpret_cast<const char*>(v->data()), v->size() * sizeof(double)));
      ASSERT_NE(at, std::string::npos);
      std::string damaged = whole;
      damaged[at + i * sizeof(double)] ^= 1;
      std::ofstream(path, std::ios::binary) << damaged;
      EXPECT_NE(fault_of(path, mesh), "");
    }
  for (std::size_t length : {whole.size() - 1, whole.size() / 2, std::size_t{100}}) {
    std::ofstream(path, std::ios::binary) << whole.substr(0, length);
    EXPECT_NE(fault_of(path, mesh), "") << length;
  }
}

TEST(Checkpoint, RefusesAnotherMesh) {
  const std::string path = fresh_file("mesh");
  write(path, block(2));
  const LocalMesh larger = block(3);
  Everything e(larger);
  EXPECT_THROW(e.serialize(*open_checkpoint(path, larger)), InputError);
}

// A process that only writes checkpoints: every place holds the number of the checkpoint.
pid_t start_writer(const std::string& path) {
  const pid_t writer = fork();
  if (writer != 0) return writer;
  execl(BULBUS_CHECKPOINT_WRITER, "checkpoint_writer", path.c_str(), nullptr);
  _exit(1);
}

TEST(Checkpoint, IsWholeWhenItsWriterIsKilled) {
  const LocalMesh mesh = block(24);
  const std::string path = fresh_file("killed");
  int amid = 0;
  for (int round = 0; round < 8; ++round) {
    const double before = fs::exists(path) ? fs::last_write_time(path).time_since_epoch().count() : 0;
    const pid_t writer = start_writer(path);
    const auto changed = [&] {
      return fs::exists(path) && fs::last_write_time(path).time_since_epoch().count() != before;
    };
    for (int i = 0; i < 20000 && !changed(); ++i) std::this_thread::sleep_for(1ms);
    ASSERT_TRUE(changed());
    std::this_thread::sleep_for(
        1ms + std::chrono::microseconds(static_cast<int>(9000 * std::abs(noise(5, round)))));
    kill(writer, SIGKILL);
    int status = 0;
    waitpid(writer, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status)) << "it had ended by itself";
    amid += fs::exists(path + ".tmp");
    double number = 0;
    std::vector<double> x;
    const auto reader = open_checkpoint(path, mesh);
    reader->scalars("number", number);
    reader->nodes("x", x);
    EXPECT_GE(number, 1);
    EXPECT_EQ(std::ranges::count(x, number), std::ssize(x));
  }
  EXPECT_GT(amid, 2);  // the kills did hit writers at work
}

}  // namespace
}  // namespace bulbus
