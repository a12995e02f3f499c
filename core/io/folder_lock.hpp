#pragma once
#include <string>

namespace bulbus::inline io {

/// Holds a folder against every other process and lock until it is destroyed. The system lets go of it
/// however the process ends. Not collective: for one rank.
class FolderLock {
 public:
  /// Throws InputError if another holds the folder, or it is none.
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Some file systems of networks know no locks: then nothing is held.
  bool held() const { return held_; }

 private:
  int folder_;
  bool held_;
};

}  // namespace bulbus::inline io
