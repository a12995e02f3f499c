#pragma once
#include <set>
#include <string>
#include <vector>

namespace bulbus::inline io {

/// manifest.txt of a folder: the names of the files that runs wrote there, and may write again or take away.
/// A name is listed before its file is there. Not collective: for one rank. Disk faults are
/// std::runtime_error.
class Manifest {
 public:
  /// Throws InputError if the file of that name is no manifest.
  explicit Manifest(std::string folder);

  bool lists(const std::string& name) const { return names_.contains(name); }
  const std::set<std::string>& names() const { return names_; }
  void add(const std::vector<std::string>& names);
  /// Takes a listed file away, and the beginnings of it that were left; its name stays listed.
  void remove_file(const std::string& name) const;
  /// Takes all of them away; then none is listed.
  void remove_files();

 private:
  void write() const;

  std::string folder_;
  std::set<std::string> names_;
};

}  // namespace bulbus::inline io
