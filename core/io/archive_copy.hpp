#pragma once
#include "core/io/archive.hpp"

namespace bulbus::inline io {

/// Keeps in memory what is given to it, and gives it to another archive later: of what may have changed by
/// then.
class ArchiveCopy final : public Archive {
 public:
  explicit ArchiveCopy(const LocalMesh& mesh) : Archive(mesh) {}
  /// In the order in which it was kept. Collective where the other's members are.
  void give(Archive& other);

  bool reading() const override { return false; }
  bool knows(const std::string&) const override { return true; }
  void numbers(const std::string& name, std::vector<double>& values) override;
  void text(const std::string& name, std::string& value) override;
  void rows(const std::string& name, const Keys& keys, int width, std::vector<double>& values) override;

 private:
  enum class Kind { numbers, text, rows, nodes, hexes };
  struct Part {
    Kind kind;
    std::string path;
    Keys keys;  // of rows
    int width;
    std::vector<double> values;
    std::string text;
  };
  void mesh_table(const std::string& name, const std::string& of, const Keys& keys, int width,
                  std::vector<double>& values) override;
  static void give(Part& part, const std::string& path, Archive& other);

  std::vector<Part> parts_;
};

}  // namespace bulbus::inline io
