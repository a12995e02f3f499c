#include "core/base/memory.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

#include "core/base/memory_limits.hpp"

using namespace bulbus;
namespace fs = std::filesystem;

TEST(LargePages, HoldWhatAVectorHoldsAndBeginAtAPage) {
  for (std::size_t n : {1, 1000, 3000000}) {
    std::vector<float, LargePages<float>> v(n, 1.5f);
    v.resize(2 * n, 2.5f);
    EXPECT_EQ(v.front(), 1.5f);
    EXPECT_EQ(v[n - 1], 1.5f);
    EXPECT_EQ(v.back(), 2.5f);
    if (n > 1000000) {
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(v.data()) % (2 << 20), 0u);
    }
  }
}

// Files as Linux shows them of a process in nested control groups.
class ControlGroups : public testing::Test {
 protected:
  void SetUp() override {
    root = fs::temp_directory_path() / ("bulbus_cgroup_" + std::to_string(getpid()));
    fs::remove_all(root);
    fs::create_directories(root / "proc");
  }
  void TearDown() override { fs::remove_all(root); }

  void write(const fs::path& file, const std::string& text) const {
    fs::create_directories((root / file).parent_path());
    std::ofstream(root / file) << text;
  }
  std::size_t bytes() const { return cgroup_bytes((root / "proc").string()); }

  fs::path root;
};

TEST_F(ControlGroups, OfVersion2CountTheLeastOnTheWayUp) {
  write("proc/cgroup", "0::/user.slice/job/step\n");
  write("proc/mountinfo",
        "30 23 0:26 / " + (root / "fs").string() + " rw,nosuid shared:4 - cgroup2 cgroup2 rw,nsdelegate\n");
  write("fs/user.slice/job/step/memory.max", "max\n");
  EXPECT_EQ(bytes(), no_limit);
  write("fs/user.slice/job/memory.max", "2000000000\n");
  write("fs/user.slice/memory.max", "3000000000\n");
  EXPECT_EQ(bytes(), 2000000000u);
  write("fs/user.slice/memory.max", "1000000000\n");
  EXPECT_EQ(bytes(), 1000000000u);
}

TEST_F(ControlGroups, OfVersion1AreThoseOfTheMemoryController) {
  write("proc/cgroup", "5:cpu,cpuacct:/other\n4:memory:/job\n0::/\n");
  write("proc/mountinfo", "40 30 0:35 / " + (root / "fs/memory").string() +
                              " rw - cgroup cgroup rw,memory\n41 30 0:36 / " + (root / "fs/cpu").string() +
                              " rw - cgroup cgroup rw,cpu,cpuacct\n");
  write("fs/memory/memory.limit_in_bytes", "9223372036854771712\n");
  write("fs/memory/job/memory.limit_in_bytes", "500000000\n");
  write("fs/cpu/other/memory.limit_in_bytes", "7\n");
  EXPECT_EQ(bytes(), 500000000u);
}

TEST_F(ControlGroups, OfAContainerAreWhatIsMounted) {
  write("proc/cgroup", "4:memory:/docker/abc\n");
  write("proc/mountinfo",
        "40 30 0:35 /docker/abc " + (root / "fs").string() + " ro - cgroup cgroup rw,memory\n");
  write("fs/memory.limit_in_bytes", "400000000\n");
  EXPECT_EQ(bytes(), 400000000u);
  write("proc/cgroup", "4:memory:/elsewhere\n");
  EXPECT_EQ(bytes(), 400000000u);
}

TEST(MachineBytes, AreNoMoreThanTheShellAllows) {
  rlimit before{};
  getrlimit(RLIMIT_DATA, &before);
  const std::size_t machine = machine_bytes();
  rlimit less = before;
  less.rlim_cur = 600 << 20;
  setrlimit(RLIMIT_DATA, &less);
  EXPECT_EQ(machine_bytes(), std::min<std::size_t>(machine, 600 << 20));
  setrlimit(RLIMIT_DATA, &before);
  getrlimit(RLIMIT_AS, &before);
  less = before;
  less.rlim_cur = address_space_bytes() + (300 << 20);
  setrlimit(RLIMIT_AS, &less);
  EXPECT_NEAR(double(machine_bytes()), double(resident_bytes() + (300 << 20)), 2e6);
  setrlimit(RLIMIT_AS, &before);
  EXPECT_EQ(machine_bytes(), machine);
}
