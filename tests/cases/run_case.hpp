#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/support/run_scene.hpp"

namespace bulbus::test {

/// Calls the command on a copy of tests/cases/FOLDER; results are in the folder `out` of the copy.
inline Ran run_case(const std::string& folder, const std::vector<std::string>& set = {},
                    const std::string& file = "s.yaml", const std::string& command = "run") {
  const auto copy = fresh_folder("bulbus_case_" + std::to_string(getpid()));
  std::filesystem::copy(std::string(BULBUS_CASES) + "/" + folder, copy,
                        std::filesystem::copy_options::recursive);
  std::ifstream in(copy / file);
  return call(command, copy, file, {std::istreambuf_iterator<char>(in), {}}, set);
}

/// A probe's value at the end of a run.
inline double probe(const Ran& run, const std::string& name) {
  return run.summary()["probes"][name].get<double>();
}

/// Exit status 2 and one message that contains all of `parts`.
inline void expect_refused(const Ran& run, const std::vector<std::string>& parts) {
  EXPECT_EQ(run.status, 2) << run.err;
  for (const std::string& part : parts)
    EXPECT_NE(run.err.find(part), std::string::npos) << "no '" << part << "' in: " << run.err;
}

}  // namespace bulbus::test
