#include "app/scene/scene.hpp"
#include "app/scene/writer.hpp"

namespace bulbus {

std::string resolved_yaml(const Scene& scene) {
  Scene copy = scene;  // describe() visits members that may change
  return to_yaml(writer::entry_of_struct(copy));
}

}  // namespace bulbus
