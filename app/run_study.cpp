#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/prepare.hpp"
#include "app/records/finished.hpp"
#include "app/records/folder.hpp"
#include "app/records/progress_log.hpp"
#include "app/study/study_figure.hpp"
#include "app/study/study_json.hpp"
#include "core/base/interrupt.hpp"
#include "core/io/json_file.hpp"
#include "core/io/output.hpp"
#include "core/io/text_file.hpp"

namespace bulbus::inline app {
namespace {

using json = nlohmann::json;

const RecordNames study_records{{"study.log", "study.csv", study_file, "study.svg"}};

void tell(const Log& log, const std::vector<std::string>& lines) {
  if (!lines.empty()) log.info("");
  log.info(lines);
}

StudyResults nothing_yet(const Study& study, const std::vector<StudyRun>& runs) {
  StudyResults results;
  for (const std::string& name : figures_of(study, runs)) results.figures.push_back({name, ""});
  for (const StudyRun& run : runs) {
    results.runs.push_back(run.name);
    results.levels.push_back(run.levels);
  }
  results.rows.resize(runs.size());
  return results;
}

/// Solves what is not done; rank 0 keeps the records up to date, so that a study may be stopped at any time.
class StudyRunner {
 public:
  StudyRunner(const Study& study, const std::string& folder, const Comm& comm, Log::Screen screen)
      : study_(study),
        folder_(folder),
        comm_(comm),
        screen_(screen),
        runs_(plan(study)),
        results_(nothing_yet(study, runs_)),
        held_(folder, study_records, comm) {
    for (const StudyRun& run : runs_) {
      done_.push_back(comm.rank() == 0 && is_finished(run.scene, folder_of(run)));
      done_.back() = comm.any(done_.back());
      if (done_.back()) continue;
      ResultsFolder(folder_of(run), record_names(run.scene), comm);  // is it free?
      of_run(study, run, [&] { prepare(run.scene, comm); });
    }
  }

  int march() {
    held_.make();
    held_.claim({study_records.names.begin(), study_records.names.end()});
    const Log log(folder_ + "/study.log", comm_, screen_);
    if (!study_.title.empty()) log.info(study_.title);
    log.info(size_text(study_));
    int failures = 0;
    const InterruptsHeeded heeded;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      failures += solve(i, log);
      if (const int signal = interrupt(comm_)) {
        log.warn(fmt::format("interrupted by {}: the same command goes on with {}", name_of_interrupt(signal),
                             runs_[i].name));
        return 128 + signal;
      }
    }
    tell(log, lines_of(study_, results_));
    tell(log, lines_of(study_, results_, trends_of(study_, results_)));
    log.info("");
    if (failures) log.error(fmt::format("{} of {} runs did not converge", failures, runs_.size()));
    log.info(fmt::format("{} of {} runs converged; study.csv, study.json and study.svg in {}",
                         runs_.size() - failures, runs_.size(), folder_));
    return failures ? 1 : 0;
  }

 private:
  std::string folder_of(const StudyRun& run) const { return folder_ + "/" + run.name; }

  Log::Screen screen_of_runs() const {
    return screen_ == Log::Screen::verbose ? Log::Screen::shown
           : screen_ == Log::Screen::shown ? Log::Screen::progress
                                           : Log::Screen::silent;
  }

  // 1 if the run does not converge.
  int solve(std::size_t i, const Log& log) {
    const StudyRun& run = runs_[i];
    const std::string folder = folder_of(run);
    if (!done_[i]) {
      log.info(fmt::format("{} of {}: {}", run.name, runs_.size(), words_of(study_, run.levels)));
      of_run(study_, run,
             [&] { return bulbus::run(run.scene, study_.scene, folder, comm_, screen_of_runs()); });
    }
    bool failed = false;
    write_together(comm_, [&] {
      if (comm_.rank() != 0) return;
      take(results_, static_cast<int>(i), summary_in(folder));
      failed = !results_.converged(static_cast<int>(i));
      write();
      log.info(done_[i] ? run.name + " is there already" : ending(*results_.rows[i]) + remaining(i));
      log.require_written();
    });
    return comm_.any(failed) ? 1 : 0;
  }

  static std::string ending(const StudyRow& row) {
    return "  " + (row.converged ? "converged" : "not converged: " + row.reason) + " in " +
           duration(row.seconds);
  }

  // Runs are taken to cost the same.
  std::string remaining(std::size_t last) const {
    double seconds = 0;
    for (std::size_t i = 0; i <= last; ++i) seconds += results_.rows[i]->seconds;
    const auto left = std::count(done_.begin() + last + 1, done_.end(), false);
    return left ? "; about " + duration(seconds / (last + 1) * left) + " to go" : "";
  }

  void write() const {
    write_whole(folder_ + "/study.csv",
                [&](const std::string& file) { write_study_csv(file, study_, results_); });
    write_json(folder_ + "/" + study_file, json_of(study_, results_, trends_of(study_, results_)));
    write_whole(folder_ + "/study.svg", svg_of(chart_of(study_, results_)));
  }

  const Study& study_;
  std::string folder_;
  const Comm& comm_;
  Log::Screen screen_;
  std::vector<StudyRun> runs_;
  StudyResults results_;
  std::vector<bool> done_;
  ResultsFolder held_;
};

}  // namespace

int run_study(const Study& study, const std::string& out_dir, const Comm& comm, Log::Screen screen) {
  return StudyRunner(study, out_dir, comm, screen).march();
}

}  // namespace bulbus::inline app
