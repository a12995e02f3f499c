#include "core/io/manifest.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/base/error.hpp"
#include "core/io/text_file.hpp"

namespace bulbus::inline io {
namespace {

namespace fs = std::filesystem;

const std::string headline =
    "# Files that bulbus wrote into this folder: a later run may write them again or take them away.";

// Nobody's manifest reaches out of its folder.
bool is_inside(const fs::path& name) {
  return !name.empty() && name.is_relative() && std::ranges::count(name, fs::path("..")) == 0;
}

}  // namespace

Manifest::Manifest(std::string folder) : folder_(std::move(folder)) {
  const std::string path = folder_ + "/manifest.txt";
  if (!fs::exists(fs::symlink_status(path))) return;
  std::ifstream in(path, std::ios::binary);
  std::string line;
  if (!std::getline(in, line) || line != headline)
    throw input_error(path + ": this file is not of a run, but a run would write one of this name",
                      "Move it away, or name another folder with -o.");
  while (std::getline(in, line))
    if (is_inside(line)) names_.insert(line);
}

void Manifest::add(const std::vector<std::string>& names) {
  const std::size_t before = names_.size();
  names_.insert(names.begin(), names.end());
  if (names_.size() > before) write();
}

void Manifest::remove_file(const std::string& name) const {
  if (!lists(name)) return;
  for (const char* ending : {"", ".tmp"}) {
    const fs::path file = folder_ + "/" + name + ending;
    const auto kind = fs::symlink_status(file).type();
    if (kind == fs::file_type::regular || kind == fs::file_type::symlink) fs::remove(file);
  }
}

void Manifest::remove_files() {
  for (const std::string& name : names_) remove_file(name);
  names_.clear();
  write();
}

void Manifest::write() const {
  std::string text = headline + "\n";
  for (const std::string& name : names_) text += name + "\n";
  write_whole(folder_ + "/manifest.txt", text);
}

}  // namespace bulbus::inline io
