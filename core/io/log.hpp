#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/base/parallel.hpp"
#include "core/io/text_file.hpp"

namespace spdlog {
class logger;
}

namespace bulbus::inline io {

/// The running report: the same lines on the screen and in run.log, from rank 0; the other ranks are silent.
class Log {
 public:
  enum class Screen { shown, silent };
  /// Collective. An empty path means the screen only. Throws OutputError on
  /// every rank if the file cannot be opened.
  Log(const std::string& path, const Comm& comm, Screen screen = Screen::shown,
      FileStart start = FileStart::anew);

  void info(const std::string& line) const;
  void info(const std::vector<std::string>& lines) const;
  /// The line behind "warning: ".
  void warn(const std::string& line) const;
  /// The line behind "error: ".
  void error(const std::string& line) const;
  /// Throws std::runtime_error if a line could not be written to the file. Not collective.
  void require_written() const;

 private:
  std::shared_ptr<spdlog::logger> logger_;
  std::shared_ptr<int> fault_ = std::make_shared<int>(0);  ///< errno of the first line that was not written
  std::string path_;
};

}  // namespace bulbus::inline io
