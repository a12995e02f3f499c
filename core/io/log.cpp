#include "core/io/log.hpp"

#include <spdlog/logger.h>
#include <spdlog/sinks/ansicolor_sink.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "core/base/clock.hpp"
#include "core/io/output.hpp"

namespace bulbus::inline io {
namespace {

using Sinks = std::vector<spdlog::sink_ptr>;

constexpr double moment = 0.1;  // s between two lines of progress: more cannot be read

// Warnings and errors in colour, where the terminal has it.
template <class Sink>
spdlog::sink_ptr screen_sink(int descriptor, spdlog::level::level_enum least) {
  const auto mode = terminal_of(descriptor).colour ? spdlog::color_mode::always : spdlog::color_mode::never;
  auto sink = std::make_shared<Sink>(mode);
  sink->set_color(spdlog::level::info, "");
  sink->set_color(spdlog::level::debug, "");
  sink->set_level(least);
  return sink;
}

spdlog::level::level_enum least_shown(Log::Screen screen) {
  return screen == Log::Screen::verbose ? spdlog::level::debug
         : screen == Log::Screen::quiet ? spdlog::level::warn
                                        : spdlog::level::info;
}

std::shared_ptr<spdlog::logger> logger_to(const Sinks& sinks, spdlog::level::level_enum least,
                                          const std::shared_ptr<int>& fault) {
  auto logger = std::make_shared<spdlog::logger>("bulbus", sinks.begin(), sinks.end());
  logger->set_pattern("%^%v%$");
  logger->set_level(least);
  logger->flush_on(spdlog::level::debug);
  logger->set_error_handler([fault](const std::string&) {
    if (*fault == 0) *fault = errno ? errno : EIO;
  });
  return logger;
}

}  // namespace

Log::Log(const std::string& path, const Comm& comm, Screen screen, FileStart start) : path_(path) {
  Sinks report, errors;
  bool failed = false;
  try {
    if (comm.rank() == 0 && screen >= Screen::quiet) {
      report.push_back(
          screen_sink<spdlog::sinks::ansicolor_stdout_sink_st>(STDOUT_FILENO, least_shown(screen)));
      errors.push_back(
          screen_sink<spdlog::sinks::ansicolor_stderr_sink_st>(STDERR_FILENO, spdlog::level::err));
    }
    if (comm.rank() == 0 && !path.empty()) {
      report.push_back(std::make_shared<spdlog::sinks::basic_file_sink_st>(path, start == FileStart::anew));
      errors.push_back(report.back());
    }
  } catch (const spdlog::spdlog_ex&) {
    failed = true;
  }
  if (comm.any(failed))
    throw OutputError(path + ": cannot be written (no such folder, no permission, or a full disk?)");
  if (comm.rank() == 0 && screen != Screen::silent && screen != Screen::quiet)
    terminal_ = terminal_of(STDOUT_FILENO);
  report_ = logger_to(report, screen == Screen::verbose ? spdlog::level::debug : spdlog::level::info, fault_);
  errors_ = logger_to(errors, spdlog::level::err, fault_);
}

Log::~Log() { clear_progress(); }

// The text goes in as an argument: braces in it are not a format.
void Log::info(const std::string& line) const {
  clear_progress();
  report_->info("{}", line);
}
void Log::info(const std::vector<std::string>& lines) const {
  for (const std::string& line : lines) info(line);
}
void Log::detail(const std::string& line) const {
  if (!report_->should_log(spdlog::level::debug)) return;
  clear_progress();
  report_->debug("{}", line);
}
void Log::warn(const std::string& line) const {
  clear_progress();
  report_->warn("warning: {}", line);
}
void Log::error(const std::string& line) const {
  clear_progress();
  errors_->error("error: {}", line);
}

bool Log::wants_progress() const { return terminal_.width > 0 && Clock::now() - shown_ >= moment; }

void Log::progress(const std::string& line) const {
  if (!wants_progress()) return;
  const std::string fitting = line.substr(0, terminal_.width - 1);  // a full line would begin the next one
  std::fprintf(stdout, "\r%s\033[K", fitting.c_str());
  std::fflush(stdout);
  pending_ = true;
  shown_ = Clock::now();
}

void Log::clear_progress() const {
  if (!pending_) return;
  std::fputs("\r\033[K", stdout);
  std::fflush(stdout);
  pending_ = false;
}

void Log::require_written() const {
  if (*fault_ != 0) throw std::runtime_error(not_written(path_, *fault_));
}

}  // namespace bulbus::inline io
