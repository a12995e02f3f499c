#pragma once
#include <string>

namespace bulbus {

/// The bytes of a file, which a message calls `what` ("mesh file"). Throws InputError if there is no such
/// file, if it is a folder or a device, or if it is larger than a quarter of this machine's memory.
std::string whole_file(const std::string& path, const std::string& what);

}  // namespace bulbus
