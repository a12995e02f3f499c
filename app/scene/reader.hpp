#pragma once
#include <string>
#include <vector>

#include "app/scene/value.hpp"
#include "app/scene/yaml_node.hpp"
#include "core/base/error.hpp"
#include "core/mesh/mesh.hpp"

/// Reads a YamlNode into any struct that describes itself. Every fault is an InputError that names the
/// place, the key, the value and the remedy. `key` is the path of the value, such as `solver.linear.gamma`.
namespace bulbus::inline app::reader {

[[noreturn]] void refuse(const YamlNode& entry, const std::string& key, const std::string& what,
                         const std::string& remedy);
/// Refuses an entry of another kind.
void expect(const YamlNode& entry, YamlNode::Kind kind, const std::string& key);
/// Refuses the first key of a map that is not known.
void check_keys(const YamlNode& map, const std::string& key, const std::vector<std::string>& known);
/// Refuses the name that the key `name` had in older scenes.
void refuse_former(const YamlNode& map, const std::string& key, const std::string& former,
                   const std::string& name);
/// Refuses a word that is none of `choices`.
void check_choice(const YamlNode& entry, const std::string& key, const std::vector<std::string>& choices);
[[noreturn]] void refuse_missing(const YamlNode& map, const std::string& key, const std::string& name,
                                 const About& about);
/// Refuses a name that would break the lines of records; `place` is where it stands.
void check_name(const Place& place, const std::string& key, const std::string& name);
/// The path of what is called `name` within `key`.
std::string below(const std::string& key, const std::string& name);

void read(const YamlNode& entry, const std::string& key, const About& about, bool& value);
void read(const YamlNode& entry, const std::string& key, const About& about, int& value);
void read(const YamlNode& entry, const std::string& key, const About& about, double& value);
void read(const YamlNode& entry, const std::string& key, const About& about, std::string& value);
void read(const YamlNode& entry, const std::string& key, const About& about, Point& value);

/// Reads what may stand at `value`. Of a struct, keys that are not given keep their defaults.
void read(const YamlNode& entry, const std::string& key, const About& about, const Value& value);
/// The same of a whole file.
void read(const YamlNode& root, const Value& group);

}  // namespace bulbus::inline app::reader
