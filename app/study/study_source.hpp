#pragma once
#include "app/study/study_design.hpp"

namespace bulbus::inline app {

/// The scene of a run as data: the file, then `set`, then --set, then the values of the factors. Throws
/// InputError as set_at does.
YamlNode source_of(const Study& study, const Levels& levels);

/// Throws InputError where a value of the study has no effect, as another overwrites it, or where factors
/// vary the same key or parts of it, whatever the paths call the entries of lists; and for `run` as source_of
/// does.
void refuse_overwritten(const Study& study, const StudyRun& run);

}  // namespace bulbus::inline app
