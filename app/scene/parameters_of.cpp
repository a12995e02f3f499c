#include "app/scene/scene.hpp"
#include "app/scene/value_of.hpp"

namespace bulbus::inline app {

Value parameters_of(Scene& scene) { return value_of(scene); }

}  // namespace bulbus::inline app
