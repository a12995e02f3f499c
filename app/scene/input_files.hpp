#pragma once
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/scene/scene.hpp"
#include "core/base/parallel.hpp"

namespace bulbus::inline app {

/// A file that a scene names, and what it holds.
struct InputFile {
  std::string key;  ///< of the scene: "mesh.file"
  std::string path;
  std::uint64_t content = 0;  ///< hash of its bytes; 0 if it cannot be read

  /// `content` in hexadecimal digits.
  std::string hash() const;
};

/// Every file that the scene names, read once. Not collective.
std::vector<InputFile> input_files(const Scene& scene);
/// The same, read by the first rank. Collective.
std::vector<InputFile> input_files(const Scene& scene, const Comm& comm);

/// Hashes by their keys, as summary.json has them.
nlohmann::json hashes_of(const std::vector<InputFile>& files);

}  // namespace bulbus::inline app
