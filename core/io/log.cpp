#include "core/io/log.hpp"

#include <spdlog/logger.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <cerrno>
#include <stdexcept>
#include <vector>

#include "core/io/output.hpp"

namespace bulbus::inline io {
namespace {

std::vector<spdlog::sink_ptr> open_sinks(const std::string& path, Log::Screen screen, FileStart start) {
  std::vector<spdlog::sink_ptr> sinks;
  if (screen == Log::Screen::shown) sinks.push_back(std::make_shared<spdlog::sinks::stdout_sink_st>());
  if (!path.empty())
    sinks.push_back(std::make_shared<spdlog::sinks::basic_file_sink_st>(path, start == FileStart::anew));
  return sinks;
}

}  // namespace

Log::Log(const std::string& path, const Comm& comm, Screen screen, FileStart start) : path_(path) {
  std::vector<spdlog::sink_ptr> sinks;
  bool failed = false;
  try {
    if (comm.rank() == 0) sinks = open_sinks(path, screen, start);
  } catch (const spdlog::spdlog_ex&) {
    failed = true;
  }
  if (comm.any(failed))
    throw OutputError(path + ": cannot be written (no such folder, no permission, or a full disk?)");
  logger_ = std::make_shared<spdlog::logger>("bulbus", sinks.begin(), sinks.end());
  logger_->set_pattern("%v");
  logger_->flush_on(spdlog::level::info);
  logger_->set_error_handler([fault = fault_](const std::string&) {
    if (*fault == 0) *fault = errno ? errno : EIO;
  });
}

// The text goes in as an argument: braces in it are not a format.
void Log::info(const std::string& line) const { logger_->info("{}", line); }
void Log::info(const std::vector<std::string>& lines) const {
  for (const std::string& line : lines) info(line);
}
void Log::warn(const std::string& line) const { logger_->warn("warning: {}", line); }
void Log::error(const std::string& line) const { logger_->error("error: {}", line); }

void Log::require_written() const {
  if (*fault_ != 0) throw std::runtime_error(not_written(path_, *fault_));
}

}  // namespace bulbus::inline io
