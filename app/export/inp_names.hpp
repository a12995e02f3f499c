#pragma once
#include <map>
#include <string>
#include <vector>

namespace bulbus::inline app {

/// Names that Abaqus and CalculiX read: they begin with a letter, have at most 80 letters, digits and any of
/// `_-.`, and differ by more than the case of their letters.
class InpNames {
 public:
  /// `kind` is what `notes` call them, which gain a sentence for every name that is changed.
  InpNames(const std::string& kind, const std::vector<std::string>& names, std::vector<std::string>& notes);
  const std::string& of(const std::string& name) const { return given_.at(name); }

 private:
  std::map<std::string, std::string> given_;
};

}  // namespace bulbus::inline app
