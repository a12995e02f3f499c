#include "app/scene/input_files.hpp"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/mixed_bits.hpp"
#include "core/mesh/read_mesh.hpp"

namespace bulbus::inline app {
namespace {

std::uint64_t hash_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return 0;
  std::vector<char> block(1 << 20);
  std::uint64_t hash = 1469598103934665603u;
  for (std::streamsize read = 1; read > 0;) {
    in.read(block.data(), static_cast<std::streamsize>(block.size()));
    read = in.gcount();
    for (std::streamsize at = 0; at < read; at += 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, &block[at], static_cast<std::size_t>(std::min<std::streamsize>(8, read - at)));
      hash = mixed_bits(hash ^ word) * 1099511628211u;
    }
    hash = mixed_bits(hash + static_cast<std::uint64_t>(read));
  }
  return hash;
}

// Of an Abaqus file with those that it includes.
std::uint64_t hash_with_included(const std::string& path) {
  std::uint64_t hash = hash_of(path);
  for (const std::string& included : included_files(path)) hash = mixed_bits(hash ^ hash_of(included));
  return hash;
}

std::vector<InputFile> files_of(const Scene& scene) {
  std::vector<InputFile> files;
  if (scene.mesh.file) files.push_back({"mesh.file", *scene.mesh.file});
  for (const auto& [name, body] : scene.model.rigid_bodies)
    if (body.file) files.push_back({"rigid_bodies." + name + ".file.path", body.file->path});
  return files;
}

}  // namespace

std::string InputFile::hash() const { return fmt::format("{:016x}", content); }

std::vector<InputFile> input_files(const Scene& scene) {
  auto files = files_of(scene);
  for (InputFile& file : files) file.content = hash_with_included(file.path);
  return files;
}

std::vector<InputFile> input_files(const Scene& scene, const Comm& comm) {
  auto files = files_of(scene);
  std::vector<long long> contents;
  if (comm.rank() == 0)
    for (const InputFile& file : files)
      contents.push_back(static_cast<long long>(hash_with_included(file.path)));
  contents = comm.gather(contents);  // the first rank's: the others give none
  for (std::size_t i = 0; i < files.size(); ++i) files[i].content = static_cast<std::uint64_t>(contents[i]);
  return files;
}

nlohmann::json hashes_of(const std::vector<InputFile>& files) {
  nlohmann::json hashes = nlohmann::json::object();
  for (const InputFile& file : files) hashes[file.key] = file.hash();
  return hashes;
}

}  // namespace bulbus::inline app
