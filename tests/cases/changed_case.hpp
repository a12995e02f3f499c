#pragma once
#include <functional>

#include "tests/cases/run_case.hpp"

namespace bulbus::test {

using Edit = std::function<std::string(std::string)>;

/// The case with one of its files changed.
inline Ran run_changed(const std::string& folder, const std::string& file, const Edit& edit,
                       const std::vector<std::string>& set = {}, const std::string& scene = "s.yaml") {
  const auto copy = fresh_folder("bulbus_case_" + std::to_string(getpid()));
  std::filesystem::copy(std::string(BULBUS_CASES) + "/" + folder, copy,
                        std::filesystem::copy_options::recursive);
  const auto text = [&](const std::string& name) {
    std::ifstream in(copy / name);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const std::string changed = edit(text(file));
  std::ofstream(copy / file) << changed;
  return call("run", copy, scene, text(scene), set);
}

inline Edit replacing(const std::string& from, const std::string& to) {
  return [=](const std::string& text) {
    EXPECT_NE(text.find(from), std::string::npos) << from;
    return replaced(text, from, to);
  };
}

inline std::string warnings(const Ran& run) { return run.summary()["warnings"].dump(); }

inline void expect_warning(const Ran& run, const std::vector<std::string>& parts) {
  ASSERT_EQ(run.status, 0) << run.err;
  for (const std::string& part : parts)
    EXPECT_NE(warnings(run).find(part), std::string::npos) << "no '" << part << "' in: " << warnings(run);
  EXPECT_NE(run.text("run.log").find("warning: "), std::string::npos);
}

inline void expect_no_warning(const Ran& run) {
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(warnings(run), "[]");
}

}  // namespace bulbus::test
