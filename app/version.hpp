#pragma once

namespace bulbus::inline app {

constexpr const char* version = "0.2.0";  ///< the VERSION of the project in CMakeLists.txt

}  // namespace bulbus::inline app
