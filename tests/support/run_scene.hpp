#pragma once
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/command_line.hpp"

namespace bulbus::test {

/// What a call of the command left behind, in the folder `out` beside its scene or study.
struct Ran {
  std::filesystem::path folder;
  int status = 0;
  std::string err, out;
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

/// Calls the command on a file of the folder, which gets this text.
inline Ran call(const std::string& command, const std::filesystem::path& folder, const std::string& file,
                const std::string& yaml, const std::vector<std::string>& set) {
  std::ofstream(folder / file) << yaml;
  std::vector<std::string> arguments{command, folder / file};
  if (command == "run" || command == "study") arguments.insert(arguments.end(), {"-o", folder / "out"});
  for (const std::string& s : set) arguments.insert(arguments.end(), {"--set", s});
  std::ostringstream out, err;
  const int status = command_line(arguments, Comm(MPI_COMM_SELF), out, err);
  return {folder, status, err.str(), out.str()};
}

inline std::filesystem::path fresh_folder(const std::string& name) {
  const auto folder = std::filesystem::temp_directory_path() / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

inline Ran run_scene(const std::string& yaml, const std::vector<std::string>& set = {},
                     const std::string& command = "run") {
  return call(command, fresh_folder("bulbus_run_" + std::to_string(getpid())), "scene.yaml", yaml, set);
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace bulbus::test
