#pragma once
#include <string>

#include "app/export/export_file.hpp"
#include "app/export/exported_model.hpp"
#include "core/io/markup.hpp"

namespace bulbus::inline app {

/// Leaves out the steps from the first one on whose conditions have no simple form in FEBio.
void cut_steps_for_feb(ExportedModel& model);

/// Boundary, loads, load curves and steps. The time is the number of steps done, and each condition has a
/// curve of its own, on which its values at the ends of the steps are joined by straight lines.
void write_feb_loads(ExportFile& out, const ExportedModel& model);

/// For comments of XML.
std::string in_comment(const std::string& text);

}  // namespace bulbus::inline app
