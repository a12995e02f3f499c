#include "app/records/result_files.hpp"

#include "app/records/result_fields.hpp"
#include "core/io/output.hpp"

namespace bulbus::inline app {

ResultFiles::ResultFiles(const OutputSettings& settings, const Problem& problem,
                         std::shared_ptr<const Interactions> interactions, ResultsFolder& folder)
    : settings_(settings),
      interactions_(interactions),
      folder_(folder),
      series_(folder.path() + "/" + series_file),
      bodies_(interactions, folder.path()),
      lines_(problem, interactions, folder.path()) {}

void ResultFiles::begin(Snapshot& snapshot) {
  if (saved_.empty()) save(snapshot);
}

void ResultFiles::increment_done(int number, double time, Snapshot& snapshot) {
  last_ = number;
  time_ = time;
  if (number % settings_.every == 0) save(snapshot);
}

void ResultFiles::finish(Snapshot& snapshot) {
  if (saved_.empty() || saved_[saved_.size() - 2] != last_) save(snapshot);
}

void ResultFiles::save(Snapshot& s) {
  if (!settings_.vtk) return;
  const std::string file = result_file(last_);
  claim(series_file, bodies_index, lines_index);
  claim(file, bodies_file(last_), lines_file(last_));
  const auto points = reference_points(s.problem.mesh());
  write_vtkhdf(folder_.path() + "/" + file, piece_of(s, *interactions_, settings_.fields, points),
               s.problem.comm());
  lines_.save(last_, s.state);
  write_together(s.problem.comm(), [&] {
    if (s.problem.comm().rank() != 0) return;
    bodies_.save(last_);
    list(last_, time_);
  });
  saved_.insert(saved_.end(), {static_cast<double>(last_), time_});
}

// Those of the three that this run has.
void ResultFiles::claim(const std::string& result, const std::string& bodies, const std::string& lines) {
  std::vector<std::string> names{result};
  if (!interactions_->bodies().empty()) names.push_back(bodies);
  if (lines_.any()) names.push_back(lines);
  folder_.claim(names);
}

void ResultFiles::list(int number, double time) {
  series_.add(result_file(number), time);
  bodies_.list(number, time);
  lines_.list(number, time);
}

void ResultFiles::serialize(Archive& archive, const Comm& comm) {
  archive.scalars("last result", last_, time_);
  archive.numbers("results", saved_);
  if (!archive.reading() || saved_.empty()) return;
  claim(series_file, bodies_index, lines_index);
  write_together(comm, [&] {
    for (std::size_t i = 0; i < saved_.size() && comm.rank() == 0; i += 2)
      list(static_cast<int>(saved_[i]), saved_[i + 1]);
  });
}

}  // namespace bulbus::inline app
