#pragma once
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/command_line.hpp"

namespace bulbus::test {

/// What a call of the command left behind, in the folder `out` beside its scene.
struct Ran {
  std::filesystem::path folder;
  int status = 0;
  std::string err;
  bool wrote(const std::string& file) const { return std::filesystem::exists(folder / "out" / file); }
  nlohmann::json summary() const { return nlohmann::json::parse(text("summary.json")); }
  std::string text(const std::string& file) const {
    std::ifstream in(folder / "out" / file);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::vector<std::string> lines(const std::string& file) const {
    std::istringstream in(text(file));
    std::vector<std::string> all;
    for (std::string line; std::getline(in, line);) all.push_back(line);
    return all;
  }
};

inline Ran run_scene(const std::string& yaml, const std::vector<std::string>& set = {},
                     const std::string& command = "run") {
  namespace fs = std::filesystem;
  Ran r{fs::temp_directory_path() / "bulbus_run"};
  fs::remove_all(r.folder);
  fs::create_directories(r.folder);
  std::ofstream(r.folder / "scene.yaml") << yaml;
  std::vector<std::string> arguments{command, r.folder / "scene.yaml"};
  if (command == "run") arguments.insert(arguments.end(), {"-o", r.folder / "out"});
  for (const std::string& s : set) arguments.insert(arguments.end(), {"--set", s});
  std::ostringstream out, err;
  r.status = command_line(arguments, Comm(MPI_COMM_SELF), out, err);
  r.err = err.str();
  return r;
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace bulbus::test
