#include "app/records/folder.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/base/error.hpp"
#include "core/io/output.hpp"
#include "core/io/table.hpp"
#include "core/io/text_file.hpp"

namespace bulbus::inline app {
namespace {

namespace fs = std::filesystem;

InputError no_folder(const std::string& folder, const std::string& why) {
  return input_error(folder + ": cannot be made a folder of results: " + why, "Name another with -o.");
}

// A full disk is no wrong input.
template <class Work>
void on_first_rank(const std::string& folder, const Comm& comm, Work work) {
  std::string full;
  comm.together([&] {
    try {
      if (comm.rank() == 0) work();
    } catch (const fs::filesystem_error& e) {
      const int error = e.code().value();
      if (error != ENOSPC && error != EDQUOT && error != EFBIG) throw no_folder(folder, e.code().message());
      full = not_written(e.path2().empty() ? e.path1() : e.path2(), error);
    } catch (const InputError&) {
      throw;
    } catch (const std::runtime_error& e) {
      full = e.what();
    }
  });
  write_together(comm, [&] {
    if (!full.empty()) throw std::runtime_error(full);
  });
}

bool is_there(const fs::path& path) { return fs::exists(fs::symlink_status(path)); }

// The folder, or the first one around it that is there.
fs::path standing(const std::string& folder) {
  fs::path at = fs::absolute(folder).lexically_normal();
  while (!is_there(at) && at.has_relative_path()) at = at.parent_path();
  return at;
}

void refuse_unwritable(const std::string& folder) {
  const fs::path at = standing(folder);
  if (!fs::exists(at)) throw no_folder(folder, at.string() + " is a link that leads nowhere");
  if (!fs::is_directory(at)) throw no_folder(folder, at.string() + " is a file");
  if (access(at.c_str(), R_OK | W_OK | X_OK) != 0)
    throw no_folder(folder, at.string() + " cannot be written: " + std::strerror(errno));
}

InputError of_someone_else(const fs::path& file) {
  return input_error(file.string() +
                         ": no run wrote this file (manifest.txt beside it does not list it), but this one "
                         "would write one of this name",
                     "Move it away, or name another folder with -o.");
}

}  // namespace

void make_folder(const std::string& folder, const Comm& comm) {
  on_first_rank(folder, comm, [&] { fs::create_directories(folder); });
}

ResultsFolder::ResultsFolder(std::string path, RecordNames wanted, const Comm& comm, std::string checkpoint)
    : path_(std::move(path)), wanted_(std::move(wanted)), comm_(comm), checkpoint_(std::move(checkpoint)) {
  on_first_rank(path_, comm_, [&] {
    refuse_unwritable(path_);
    if (fs::is_directory(path_)) hold();
  });
}

void ResultsFolder::hold() {
  lock_.emplace(path_);
  manifest_.emplace(path_);
  refuse_files_of_others();
}

void ResultsFolder::refuse_files_of_others() const {
  for (const auto& entry : fs::directory_iterator(path_)) {
    std::string name = entry.path().filename().string();
    if (name.ends_with(".tmp")) name.resize(name.size() - 4);
    if (wanted_.contains(name)) refuse(entry.path(), name);
  }
}

void ResultsFolder::refuse(const fs::path& file, const std::string& name) const {
  if (fs::is_directory(file))
    throw no_folder(path_, file.string() + " is a folder, where a file is to be written");
  const bool given = !checkpoint_.empty() && fs::exists(checkpoint_) && fs::equivalent(file, checkpoint_);
  if (!given && !manifest_->lists(name)) throw of_someone_else(file);
  if (!checkpoint_.empty() && access(file.c_str(), W_OK) != 0)
    throw no_folder(path_, file.string() + " cannot be written: " + std::strerror(errno));
}

void ResultsFolder::open() {
  fs::create_directories(path_);
  if (!lock_) hold();
}

void ResultsFolder::make() {
  on_first_rank(path_, comm_, [&] { open(); });
}

void ResultsFolder::begin() {
  on_first_rank(path_, comm_, [&] {
    open();
    manifest_->remove_files();
  });
}

void ResultsFolder::go_on(const std::string& from, int last) {
  on_first_rank(path_, comm_, [&] {
    open();
    if (fs::equivalent(from, path_))
      manifest_->add({checkpoint_file});
    else
      take_over(from, last);
    remove_after(last);
  });
}

void ResultsFolder::take_over(const std::string& from, int last) {
  manifest_->remove_files();
  for (const auto& entry : fs::directory_iterator(from)) {
    const std::string name = entry.path().filename().string(), temporary = path_ + "/" + name + ".tmp";
    if (!is_continued(name) && (increment_of(name) < 0 || increment_of(name) > last)) continue;
    manifest_->add({name});
    fs::copy_file(entry.path(), temporary, fs::copy_options::overwrite_existing);
    settle(temporary, path_ + "/" + name);
  }
}

void ResultsFolder::remove_after(int last) {
  // The indices are written again from the checkpoint.
  for (const char* file : {summary_file, series_file, bodies_index, lines_index})
    manifest_->remove_file(file);
  for (const std::string& name : manifest_->names())
    if (increment_of(name) > last) manifest_->remove_file(name);
  for (const char* table : {history_file, krylov_file}) cut_table(path_ + "/" + table, last);
  cut_half_line(path_ + "/" + log_file);
}

void ResultsFolder::claim(const std::vector<std::string>& names) {
  write_together(comm_, [&] {
    if (comm_.rank() != 0) return;
    for (const std::string& name : names)
      if (!manifest_->lists(name) && is_there(path_ + "/" + name)) throw of_someone_else(path_ + "/" + name);
    manifest_->add(names);
  });
}

}  // namespace bulbus::inline app
