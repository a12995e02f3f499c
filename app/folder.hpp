#pragma once
#include <string>

#include "core/base/parallel.hpp"

namespace bulbus {

/// Makes a folder and those around it. Collective. Throws InputError on every rank if it cannot.
void make_folder(const std::string& folder, const Comm& comm);

/// The same, and takes away what an earlier run left there under the names of records. Collective.
void make_results_folder(const std::string& folder, const Comm& comm);

/// For a run that goes on after the increment `last`: takes over the records of the folder `from`, if that is another one, and takes
/// away what came after that increment. Collective.
void continue_results_folder(const std::string& from, const std::string& folder, int last, const Comm& comm);

}  // namespace bulbus
