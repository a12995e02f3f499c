#pragma once
#include <string>
#include <vector>

#include "app/scene/scene.hpp"

namespace bulbus::inline app {

/// A setting that a scene gives and that another choice of the scene leaves without effect.
struct UnusedSetting {
  std::string key;        ///< solver.linear.restart
  Condition condition;    ///< what does not hold
  std::string chosen;     ///< what the scene has in its place: "direct"
  std::string value;      ///< as resolved.yaml has it
  std::string otherwise;  ///< the value that it would have if it were not given

  /// Not so where the scene, as resolved.yaml does, gives the value that it would have anyway.
  bool differs() const { return value != otherwise; }
  /// With the key, what makes it so, and the remedy.
  InputError fault() const;
};

/// Every setting of a scene's data that has no effect (see About::only_with), in the order of describe().
/// `scene` is what was read from `root`.
std::vector<UnusedSetting> unused_settings(const YamlNode& root, const Scene& scene);

/// Throws InputError with the place of the first unused setting that differs.
void refuse_unused(const YamlNode& root, const Scene& scene);

}  // namespace bulbus::inline app
