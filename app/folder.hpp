#pragma once
#include <string>

#include "core/base/parallel.hpp"

namespace bulbus {

/// Makes a folder and those around it. Collective. Throws InputError on every rank if it cannot.
void make_folder(const std::string& folder, const Comm& comm);

/// The same, and takes away what an earlier run left there under the names of records. Collective.
void make_results_folder(const std::string& folder, const Comm& comm);

}  // namespace bulbus
