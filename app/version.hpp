#pragma once

namespace bulbus {

constexpr const char* version = "0.1.0";  ///< the VERSION of the project in CMakeLists.txt

}  // namespace bulbus
