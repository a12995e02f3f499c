#include "app/scene/scene.hpp"
#include "app/scene/writer.hpp"

namespace bulbus::inline app {

std::string resolved_yaml(const Scene& scene) {
  Scene copy = scene;  // values may change what they refer to
  return to_yaml(entry_of(parameters_of(copy)));
}

}  // namespace bulbus::inline app
