#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace bulbus::inline mesh {

/// An element of a VTK XML file.
struct XmlElement {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<XmlElement> parts;
  std::string_view text;  ///< up to its first part; of <AppendedData>: the rest of the file
  int line = 0;

  /// Empty if it is not given.
  const std::string& attribute(std::string_view key) const;
  /// The first part of that name, or null.
  const XmlElement* part(std::string_view name) const;
};

/// Elements, attributes, comments and declarations: no more of XML is in such files. Reading ends at
/// <AppendedData>, whose content need not be text. Throws InputError with file and line.
XmlElement parse_xml(const std::string& path, std::string_view text);

}  // namespace bulbus::inline mesh
