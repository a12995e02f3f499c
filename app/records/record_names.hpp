#pragma once
#include <set>
#include <string>

#include "app/scene/scene.hpp"

namespace bulbus::inline app {

/// Files of a run's folder.
inline constexpr const char *summary_file = "summary.json", *history_file = "history.csv",
                            *units_file = "history.units.json", *krylov_file = "krylov.csv",
                            *resolved_file = "resolved.yaml", *log_file = "run.log",
                            *series_file = "result.hdf.series", *bodies_index = "bodies.pvd",
                            *lines_index = "lines.pvd", *checkpoint_file = "checkpoint.h5",
                            *report_file = "report.html", *unloaded_file = "unloaded.msh";
/// Of the folder of a study.
inline constexpr const char* study_file = "study.json";
/// Of the folder of a trade.
inline constexpr const char* trade_file = "trade.csv";
/// Those of an increment: result_0012.hdf, bodies_0012.vtp, lines_0012.vtp.
std::string result_file(int increment);
std::string bodies_file(int increment);
std::string lines_file(int increment);
/// The increment of such a file, -1 of others.
int increment_of(const std::string& name);

/// Is it a record of many increments, which a run that goes on continues?
bool is_continued(const std::string& name);

/// The files that a run, a study or a trade writes, as far as that is known beforehand.
struct RecordNames {
  std::set<std::string> names;
  int increments = -1;  ///< of which it has files as well
  bool contains(const std::string& name) const;
};
/// Of a run of the scene: without increments that come of cuts.
RecordNames record_names(const Scene& scene);

/// Throws InputError if the folder is that of a study, where one of a run is wanted.
void refuse_study_folder(const std::string& folder);

/// Throws InputError if something of the scene would be written outside of the folder of the results, or in
/// place of a record.
void refuse_outside(const Scene& scene);

}  // namespace bulbus::inline app
