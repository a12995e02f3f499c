#pragma once
#include "app/study/study.hpp"

namespace bulbus::inline app {

/// Which value every factor has, counted from 0.
using Levels = std::vector<int>;

/// The levels of every run: the product, its last factor varying fastest; or the baseline, then the other
/// values of each factor in turn.
std::vector<Levels> levels_of(const Study& study);

/// "close 0.5 mm, spacing 8 mm"; without the factor `but`.
std::string words_of(const Study& study, const Levels& levels, int but = -1);

/// Runs that differ in one factor only, by rising value of it (in the order of the file, if it has no
/// numbers).
struct Line {
  int factor;
  std::vector<int> runs;  ///< at least two
};

/// All lines along a factor. None if it has one value.
std::vector<Line> lines_along(int factor, const Study& study, const std::vector<Levels>& runs);

/// Where a level stands along its factor: its number, or its place in the file.
double abscissa(const Factor& factor, int level);

struct StudyRun {
  std::string name;  ///< of its folder: run_001
  Levels levels;
  Scene scene;
};

/// The runs with their scenes, as far as they can be judged without the mesh. Throws InputError that names
/// the line, in study or scene, and the run.
std::vector<StudyRun> plan(const Study& study);

/// The figures of the study: those wanted, or every probe. Throws InputError if a run lacks one, or has it in
/// another unit.
std::vector<std::string> figures_of(const Study& study, const std::vector<StudyRun>& runs);

/// A fault of one run: placed, and with the run's name and levels.
InputError fault_of(const InputError& fault, const Study& study, const StudyRun& run);

/// Does work for a run; an InputError comes out as fault_of says.
template <class Work>
auto of_run(const Study& study, const StudyRun& run, Work work) {
  try {
    return work();
  } catch (const InputError& fault) {
    throw fault_of(fault, study, run);
  }
}

/// "12 runs, every combination: close (3), spacing (2), force (2)".
std::string size_text(const Study& study);

}  // namespace bulbus::inline app
