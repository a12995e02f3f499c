#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/base/parallel.hpp"
#include "core/io/terminal.hpp"
#include "core/io/text_file.hpp"

namespace spdlog {
class logger;
}

namespace bulbus::inline io {

/// The running report: the same lines on the screen and in run.log, from rank 0; the other ranks are silent.
/// On the screen errors go to standard error, everything else to standard output.
class Log {
 public:
  /// What is shown of it: nothing; the line of progress() alone; warnings and errors; all; all with details,
  /// which then stand in the file as well.
  enum class Screen { silent, progress, quiet, shown, verbose };
  /// Collective. An empty path means the screen only. Throws OutputError on
  /// every rank if the file cannot be opened.
  Log(const std::string& path, const Comm& comm, Screen screen = Screen::shown,
      FileStart start = FileStart::anew);
  ~Log();
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  void info(const std::string& line) const;
  void info(const std::vector<std::string>& lines) const;
  /// A line for Screen::verbose alone.
  void detail(const std::string& line) const;
  /// The line behind "warning: ".
  void warn(const std::string& line) const;
  /// The line behind "error: ".
  void error(const std::string& line) const;
  /// Is a line of progress() due? Not without a terminal, on other ranks, or a moment after the last one.
  bool wants_progress() const;
  /// Shows a line on the terminal in place of the last one so shown, until the next line of the report.
  void progress(const std::string& line) const;
  /// Throws std::runtime_error if a line could not be written to the file. Not collective.
  void require_written() const;

 private:
  void clear_progress() const;

  std::shared_ptr<spdlog::logger> report_, errors_;
  std::shared_ptr<int> fault_ = std::make_shared<int>(0);  ///< errno of the first line that was not written
  std::string path_;
  Terminal terminal_;             // without a width: no progress is shown
  mutable bool pending_ = false;  // is a line of progress on the terminal?
  mutable double shown_ = 0;      // when the last one was
};

}  // namespace bulbus::inline io
