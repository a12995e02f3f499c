#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/io/json_file.hpp"
#include "core/io/log.hpp"
#include "core/io/series.hpp"
#include "core/io/table.hpp"

namespace {

using namespace bulbus;
namespace fs = std::filesystem;

fs::path fresh_folder(const std::string& name) {
  const fs::path folder = fs::temp_directory_path() / ("bulbus_" + name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::size_t files_in(const fs::path& folder) {
  return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

TEST(Json, IsWrittenWholeAndLeavesNothingBeside) {
  const fs::path folder = fresh_folder("json");
  write_json(folder / "a.json", {{"x", 0.1}});
  write_json(folder / "a.json", {{"x", 1}, {"bad", std::numeric_limits<double>::quiet_NaN()}});
  const auto read = nlohmann::json::parse(text_of(folder / "a.json"));
  EXPECT_EQ(read["x"], 1);
  EXPECT_TRUE(read["bad"].is_null());
  EXPECT_EQ(files_in(folder), 1u);
}

TEST(Json, KeepsTheOldFileWhenTheNewOneFails) {
  const fs::path folder = fresh_folder("json_kept");
  write_json(folder / "a.json", {{"x", 1}});
  fs::create_directory(folder / "a.json.tmp");  // the temporary name is taken: opening it fails
  EXPECT_THROW(write_json(folder / "a.json", {{"x", 2}}), std::runtime_error);
  EXPECT_EQ(nlohmann::json::parse(text_of(folder / "a.json"))["x"], 1);
}

TEST(Json, NamesAFileThatCannotBeWritten) {
  try {
    write_json("/no/such/folder/a.json", 1);
    FAIL() << "written";
  } catch (const std::runtime_error& fault) {
    EXPECT_NE(std::string(fault.what()).find("/no/such/folder/a.json"), std::string::npos);
  }
}

TEST(Series, ListsEveryStateAfterEachAddition) {
  const fs::path path = fresh_folder("series") / "result.hdf.series";
  Series series(path);
  series.add("result_0.hdf", 0);
  EXPECT_EQ(nlohmann::json::parse(text_of(path))["files"].size(), 1u);
  series.add("result_1.hdf", .5);
  const auto read = nlohmann::json::parse(text_of(path));
  EXPECT_EQ(read["file-series-version"], "1.0");
  EXPECT_EQ(read["files"][1]["name"], "result_1.hdf");
  EXPECT_EQ(read["files"][1]["time"], .5);
}

TEST(Table, WritesHeaderFirstAndEveryRowAtOnce) {
  const fs::path path = fresh_folder("table") / "history.csv";
  CsvTable table(path, {"step", "pressure, mmHg", "iterations"});
  EXPECT_EQ(text_of(path), "step,\"pressure, mmHg\",iterations\n");
  table.append({"", 1.0 / 3, 7LL});
  table.append({"the \"last\"", 1e-20, -1LL});
  EXPECT_EQ(text_of(path),
            "step,\"pressure, mmHg\",iterations\n,0.333333333333,7\n\"the \"\"last\"\"\",1e-20,-1\n");
}

TEST(Table, RefusesARowOfAnotherLength) {
  CsvTable table(fresh_folder("table_length") / "history.csv", {"a", "b"});
  EXPECT_THROW(table.append({1.0}), std::invalid_argument);
}

TEST(Table, NoticesAFullDiskAndAMissingFolder) {
  EXPECT_THROW(CsvTable("/dev/full", {"a"}), std::runtime_error);
  EXPECT_THROW(CsvTable("/no/such/folder/history.csv", {"a"}), std::runtime_error);
}

TEST(Log, WritesTheSameLinesToScreenAndFile) {
  const fs::path path = fresh_folder("log") / "run.log";
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  {
    const Log log(path, Comm(MPI_COMM_SELF));
    log.info("step {1}: ok");
    log.detail("a detail");
    log.warn("slow");
    log.error("inverted");
    EXPECT_EQ(text_of(path), "step {1}: ok\nwarning: slow\nerror: inverted\n");  // flushed line by line
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), text_of(path));
}

/// What a log shows on standard output and error, and what it writes.
std::array<std::string, 3> logged(Log::Screen screen) {
  const fs::path path = fresh_folder("log") / "run.log";
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  {
    const Log log(path, Comm(MPI_COMM_SELF), screen);
    log.detail("d");
    log.info("i");
    log.progress("of a terminal");
    log.warn("w");
    log.error("e");
  }
  const std::string out = testing::internal::GetCapturedStdout();
  return {out, testing::internal::GetCapturedStderr(), text_of(path)};
}

TEST(Log, ShowsAsMuchAsIsAskedFor) {
  using Texts = std::array<std::string, 3>;
  const std::string warning = "warning: w\n", error = "error: e\n", all = "i\n" + warning + error;
  EXPECT_EQ(logged(Log::Screen::silent), (Texts{"", "", all}));
  EXPECT_EQ(logged(Log::Screen::progress), (Texts{"", "", all}));
  EXPECT_EQ(logged(Log::Screen::quiet), (Texts{warning, error, all}));
  EXPECT_EQ(logged(Log::Screen::shown), (Texts{"i\n" + warning, error, all}));
  EXPECT_EQ(logged(Log::Screen::verbose), (Texts{"d\ni\n" + warning, error, "d\n" + all}));
}

TEST(Terminal, BreaksTextBetweenWords) {
  EXPECT_EQ(wrapped("one two three", 0), "one two three");
  EXPECT_EQ(wrapped("one two three", 7), "one two\nthree");
  EXPECT_EQ(wrapped("one two three", 8, 2), "one two\n  three");
  EXPECT_EQ(wrapped("incompressibility is", 5), "incompressibility\nis");
  EXPECT_EQ(wrapped("µµµ µµµ", 7), "µµµ µµµ");
}

TEST(Log, MayDoWithoutAFileButNotWithoutAFolder) {
  testing::internal::CaptureStdout();
  Log("", Comm(MPI_COMM_SELF)).info("x");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "x\n");
  EXPECT_THROW(Log("/dev/null/run.log", Comm(MPI_COMM_SELF)), std::runtime_error);
}

}  // namespace
