#include "app/records/alike_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

#include "core/base/error.hpp"
#include "core/io/vtkhdf.hpp"

namespace bulbus::inline app {
namespace {

// Names by what they are in records, with the scene's keys that give them.
class NamesInRecords {
 public:
  void add(const std::string& name, const std::string& key) {
    const auto [other, fresh] = known_.try_emplace(in_records(name), name);
    if (!fresh && other->second != name)
      throw scene_error(key,
                        fmt::format("'{}' and '{}' would have one name in result files or checkpoints, where "
                                    "none of / | < > & \" ' can stand",
                                    other->second, name),
                        "Rename one of the two.");
  }

 private:
  // As safe_name and Archive::path_of change them.
  static std::string in_records(const std::string& name) {
    std::string changed = safe_name(name);
    std::ranges::replace(changed, '|', '_');
    return changed;
  }
  std::map<std::string, std::string> known_;
};

}  // namespace

void refuse_names_alike_in_records(const Model& model) {
  NamesInRecords regions, lines, bodies, contacts, probes, held;
  for (const auto& [name, spec] : model.regions) regions.add(name, "regions." + name);
  for (const auto& [name, spec] : model.bars) lines.add(name, "bars." + name);
  for (const auto& [name, spec] : model.sutures) lines.add(name, "sutures." + name);
  for (const auto& [name, spec] : model.rigid_bodies) bodies.add(name, "rigid_bodies." + name);
  for (std::size_t i = 0; i < model.contacts.size(); ++i)
    contacts.add(model.contacts[i].name, fmt::format("contacts.{}.name", i));
  for (std::size_t i = 0; i < model.probes.size(); ++i)
    probes.add(model.probes[i].name, fmt::format("probes.{}.name", i));
  for (std::size_t k = 0; k < model.steps.size(); ++k)
    for (std::size_t i = 0; i < model.steps[k].displace.size(); ++i)
      held.add(model.steps[k].displace[i].set, fmt::format("steps.{}.displace.{}.set", k, i));
}

}  // namespace bulbus::inline app
