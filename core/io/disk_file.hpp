#pragma once
#include <string>
#include <string_view>

namespace bulbus::inline io {

/// A file for writing of which every byte is accounted for. All members throw std::runtime_error with file
/// and reason. Not collective.
class DiskFile {
 public:
  enum class Start { empty, end };
  DiskFile(std::string path, Start start);
  ~DiskFile();
  DiskFile(const DiskFile&) = delete;
  DiskFile& operator=(const DiskFile&) = delete;

  /// All or nothing: what was written before stays, a part of `text` does not.
  void write(std::string_view text);
  /// Takes room for so many bytes on the disk, where its file system can.
  void reserve(long long bytes);

 private:
  [[noreturn]] void fail(int error) const;

  std::string path_;
  int file_;
};

}  // namespace bulbus::inline io
