#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/records/record_names.hpp"
#include "core/base/parallel.hpp"
#include "core/io/folder_lock.hpp"
#include "core/io/manifest.hpp"

namespace bulbus::inline app {

/// Makes a folder and those around it. Collective. Throws InputError on every rank if it cannot.
void make_folder(const std::string& folder, const Comm& comm);

/// The folder into which a run, a study or a trade writes: held against others while this lives, by the first
/// rank. Of what is in it only files that its manifest lists are written again or taken away. Members are
/// collective and throw InputError or OutputError on every rank.
class ResultsFolder {
 public:
  /// Makes nothing. Throws if another holds the folder, if it cannot be made or written, or if it has a file
  /// of a `wanted` name that no run wrote. `checkpoint`: the run goes on from that file, which may stand in
  /// the folder under a wanted name.
  ResultsFolder(std::string path, RecordNames wanted, const Comm& comm, std::string checkpoint = "");

  /// Makes the folder where it is not there.
  void make();
  /// The same, and takes away what earlier runs left.
  void begin();
  /// For a run that goes on after the increment `last`: takes over the records of the folder `from`, if that
  /// is another one, and takes away what came after that increment.
  void go_on(const std::string& from, int last);
  /// Lists files, before they are written. Throws OutputError if there are such of someone else.
  void claim(const std::vector<std::string>& names);

  const std::string& path() const { return path_; }
  /// Is it kept from others? Not where the file system knows no locks. On the first rank.
  bool held() const { return lock_ && lock_->held(); }

 private:
  void hold();
  void open();
  void refuse_files_of_others() const;
  void refuse(const std::filesystem::path& file, const std::string& name) const;
  void take_over(const std::string& from, int last);
  void remove_after(int last);

  std::string path_;
  RecordNames wanted_;
  const Comm& comm_;
  std::string checkpoint_;
  std::optional<FolderLock> lock_;  // on the first rank, as the next
  std::optional<Manifest> manifest_;
};

}  // namespace bulbus::inline app
