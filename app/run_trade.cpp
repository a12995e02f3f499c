#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/records/finished.hpp"
#include "app/records/folder.hpp"
#include "app/records/progress_log.hpp"
#include "app/trade/trade_figure.hpp"
#include "app/trade/trade_records.hpp"
#include "core/base/interrupt.hpp"
#include "core/base/process.hpp"
#include "core/io/json_file.hpp"
#include "core/io/text_file.hpp"

namespace bulbus::inline app {
namespace {

using json = nlohmann::json;

constexpr double longest = 4;  // what takes longer than so many times the reference is never on the front

TradeResults nothing_yet(const Trade& trade) {
  TradeResults results;
  for (const ProbeSpec& p : trade.runs[0].scene.model.probes) {
    results.figures.push_back({p.name, ""});
    results.least.push_back(least_of(p));
  }
  for (const TradeRun& run : trade.runs) results.runs.push_back(run.name);
  results.rows.resize(trade.runs.size());
  results.megabytes.resize(trade.runs.size());
  results.extrapolated.resize(results.figures.size());
  return results;
}

/// Runs every scene of a trade as often as wanted, each as a process of its own, and keeps the records up to
/// date.
class TradeRunner {
 public:
  TradeRunner(Trade trade, std::string folder, const TradeOptions& options, const Comm& comm,
              Log::Screen screen)
      : trade_(std::move(trade)),
        folder_(std::move(folder)),
        options_(options),
        results_(nothing_yet(trade_)),
        log_(folder_ + "/trade.log", comm, screen) {}

  int march() {
    const InterruptsHeeded heeded;
    log_.info(fmt::format("{}: {} runs, each {} times", trade_.scene, trade_.runs.size(), options_.repeat));
    for (int round = 1; round <= options_.repeat; ++round)
      for (int run = 0; run < static_cast<int>(trade_.runs.size()); ++run) {
        solve(run, round);
        if (const int signal = interrupt_here()) {
          log_.warn(fmt::format("interrupted by {}: the same command goes on with {}",
                                name_of_interrupt(signal), trade_.runs[run].name));
          return 128 + signal;
        }
      }
    log_.info("");
    log_.info(lines_of(trade_, results_));
    log_.info("");
    log_.info("trade.csv and trade.svg in " + folder_);
    if (!results_.converged(0)) log_.error("the reference did not converge: " + results_.rows[0]->reason);
    return results_.converged(0) ? 0 : 1;
  }

 private:
  std::string folder_of(int run) const { return folder_ + "/" + trade_.runs[run].name; }

  // Processor seconds of every time that the run was made; none if it is of another scene.
  std::vector<double> times_of(int run) const {
    std::ifstream in(folder_of(run) + "/seconds.json");
    const json times = json::parse(in, nullptr, false);
    if (!times.is_array() || !is_finished(trade_.runs[run].scene, folder_of(run))) return {};
    return times.get<std::vector<double>>();
  }

  void solve(int run, int round) {
    std::vector<double> times = times_of(run);
    const bool there = static_cast<int>(times.size()) >= round;
    bool finished = there;
    std::string reason;
    if (!there) {
      const Ended e = run_process(command_of(run), run > 0 && trade_.runs[run].mesh == 0 ? allowed_ : 0);
      if (run == 0 && round == 1) allowed_ = static_cast<unsigned>(longest * e.cpu) + 10;
      times.push_back(e.cpu);
      reason = e.reason;
      finished = is_finished(trade_.runs[run].scene, folder_of(run));
      if (finished) write_json(folder_of(run) + "/seconds.json", times);
    }
    note(run, *std::ranges::min_element(times), finished, reason);
    tell(run, there);
    write();
  }

  std::vector<std::string> command_of(int run) const {
    std::vector<std::string> command{options_.program, "run", trade_.scene, "-o", folder_of(run)};
    for (const std::string& s : trade_.runs[run].set) command.insert(command.end(), {"--set", s});
    return command;
  }

  void note(int run, double seconds, bool finished, const std::string& reason) {
    if (!finished) {
      results_.rows[run] =
          StudyRow{.reason = reason, .values = std::vector<std::optional<double>>(results_.figures.size())};
    } else {
      const json summary = summary_in(folder_of(run));
      take(results_, run, summary);
      results_.megabytes[run] = summary.at("/memory_mb/process_peak/all_ranks"_json_pointer);
    }
    results_.rows[run]->seconds = seconds;
    extrapolate(trade_, results_);
  }

  void tell(int run, bool there) const {
    const StudyRow& row = *results_.rows[run];
    const TradeRun& of = trade_.runs[run];
    std::string end = row.converged ? "" : "; not converged: " + row.reason;
    if (const auto error = mesh_error(trade_, results_, run))
      end = fmt::format(", error {:.2g} %", 100 * error->value);
    log_.info(fmt::format("{} of {}: {} {}: {}{}, {} Newton and {} Krylov iterations{}", of.name,
                          trade_.runs.size(), of.parameter, of.value, duration(row.seconds),
                          there ? " (there already)" : "", row.newton_iterations, row.krylov_iterations,
                          end));
  }

  void write() const {
    const std::string table = folder_ + "/" + trade_file;
    write_whole(table, [&](const std::string& file) { write_trade_csv(file, trade_, results_); });
    write_whole(folder_ + "/trade.svg", svg_of(chart_of(read_trade_points(table))));
    log_.require_written();
  }

  const Trade trade_;
  std::string folder_;
  TradeOptions options_;
  TradeResults results_;
  Log log_;
  unsigned allowed_ = 0;  // processor seconds; 0: any
};

}  // namespace

int run_trade(const std::string& scene, const std::vector<std::string>& overrides, const std::string& out_dir,
              const TradeOptions& options, const Comm& comm, Log::Screen screen) {
  if (comm.size() > 1)
    throw input_error("a trade runs processes of its own, one after the other", "start it without mpirun");
  const Scene given = read_scene(scene, overrides);
  if (given.model.probes.empty())
    throw input_error(scene, 0, "has no probes: there is nothing to be accurate about", "add `probes`");
  const RecordNames records{{"trade.log", "trade.csv", "trade.svg"}};
  ResultsFolder folder(out_dir, records, comm);
  Trade trade = plan_trade(scene, overrides, prepare(given, comm));
  folder.make();
  folder.claim({records.names.begin(), records.names.end()});
  return TradeRunner(std::move(trade), out_dir, options, comm, screen).march();
}

}  // namespace bulbus::inline app
