// Files that do not become whole, folders in use, and what a manifest allows.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "core/base/error.hpp"
#include "core/io/disk_file.hpp"
#include "core/io/folder_lock.hpp"
#include "core/io/manifest.hpp"
#include "core/io/output.hpp"
#include "core/io/table.hpp"
#include "core/io/vtkhdf.hpp"

namespace bulbus {
namespace {

namespace fs = std::filesystem;

/// While it lives, files may not grow beyond so many bytes.
class SmallFiles {
 public:
  explicit SmallFiles(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit now{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &now);
  }
  ~SmallFiles() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_;
  void (*handler_)(int);
};

fs::path fresh_folder() {
  const fs::path folder = fs::temp_directory_path() / "bulbus_disk_test";
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }

TEST(FullDisk, LeavesNoHalfRow) {
  const fs::path path = fresh_folder() / "history.csv";
  CsvTable table(path, {"increment", "force"});
  table.append({1LL, 1.5});
  const std::string before = read(path);
  {
    const SmallFiles limit(before.size() + 3);
    EXPECT_THROW(table.append({2LL, 2.5}), std::runtime_error);
    EXPECT_EQ(read(path), before);
  }
  table.append({2LL, 2.5});
  EXPECT_EQ(read(path), before + "2,2.5\n");
}

TEST(FullDisk, KeepsTheOldFile) {
  const fs::path folder = fresh_folder();
  write_whole(folder / "a.json", std::string("old"));
  const SmallFiles limit(100);
  EXPECT_THROW(write_whole(folder / "a.json", std::string(1000, 'x')), std::runtime_error);
  EXPECT_EQ(read(folder / "a.json"), "old");
  EXPECT_FALSE(fs::exists(folder / "a.json.tmp"));
}

/// Before HDF5 has begun a file that it could not get rid of.
TEST(FullDisk, IsMetBeforeAResultIsBegun) {
  const fs::path path = fresh_folder() / "result_0001.hdf";
  const std::vector<Point> points(1000);
  try {
    const SmallFiles limit(20000);
    write_vtkhdf(path, {points, {}, {}, {}}, Comm(MPI_COMM_SELF));
    FAIL() << "written";
  } catch (const OutputError& fault) {
    EXPECT_EQ(std::string(fault.what()).find(path.string() + ": cannot be written: no space left"), 0u)
        << fault.what();
  }
  EXPECT_TRUE(fs::is_empty(path.parent_path()));
  EXPECT_FALSE(files_left_open());
  write_vtkhdf(path, {points, {}, {}, {}}, Comm(MPI_COMM_SELF));
  EXPECT_LT(fs::file_size(path), 40000u);  // the room that it did not need is given back
}

TEST(FullDisk, OnOneRankIsTheSameErrorOnAll) {
  const Comm comm;
  try {
    write_together(comm, [&] {
      if (comm.rank() == comm.size() - 1) throw std::runtime_error("a reason");
    });
    FAIL() << "nothing thrown";
  } catch (const OutputError& fault) {
    EXPECT_STREQ(fault.what(), "a reason");
  }
}

TEST(Table, IsCutWhereARunWasLeft) {
  const fs::path path = fresh_folder() / "history.csv";
  write(path, "increment,force\n1,1\n2,2\n3,3\n4,");
  cut_table(path, 2);
  EXPECT_EQ(read(path), "increment,force\n1,1\n2,2\n");
  write(path, "increment,force\n1,1\n2,2\n2,");
  cut_table(path, 2);
  EXPECT_EQ(read(path), "increment,force\n1,1\n2,2\n");
  cut_table(path.parent_path() / "none.csv", 2);
  EXPECT_FALSE(fs::exists(path.parent_path() / "none.csv"));
}

TEST(HalfLine, IsCut) {
  const fs::path path = fresh_folder() / "run.log";
  for (const auto& [text, left] : {std::pair{"a\nb", "a\n"}, {"a\nb\n", "a\nb\n"}, {"a", ""}, {"", ""}}) {
    write(path, text);
    cut_half_line(path);
    EXPECT_EQ(read(path), left);
  }
}

TEST(FolderLock, HoldsAFolderOnce) {
  const fs::path folder = fresh_folder();
  {
    const FolderLock lock(folder);
    EXPECT_TRUE(lock.held());
    EXPECT_THROW(FolderLock{folder}, InputError);
    fs::create_directories(folder / "below");
    EXPECT_TRUE(FolderLock(folder / "below").held());
  }
  EXPECT_TRUE(FolderLock(folder).held());
  EXPECT_THROW(FolderLock{folder / "none"}, InputError);
}

TEST(Manifest, TakesAwayWhatItLists) {
  const fs::path folder = fresh_folder();
  Manifest(folder).add({"a.txt", "c.txt"});
  for (const char* name : {"a.txt", "a.txt.tmp", "b.txt"}) write(folder / name, "x");
  Manifest again(folder);
  EXPECT_TRUE(again.lists("a.txt"));
  again.remove_file("b.txt");
  again.remove_files();
  EXPECT_FALSE(fs::exists(folder / "a.txt"));
  EXPECT_FALSE(fs::exists(folder / "a.txt.tmp"));
  EXPECT_TRUE(fs::exists(folder / "b.txt"));
  EXPECT_TRUE(Manifest(folder).names().empty());
}

TEST(Manifest, IsNotTakenForOneThatIsNone) {
  const fs::path folder = fresh_folder();
  write(folder / "manifest.txt", "a.txt\n");
  EXPECT_THROW(Manifest{folder}, InputError);
}

}  // namespace
}  // namespace bulbus
