#pragma once
#include <string>

namespace bulbus::inline io {

/// Text as it stands between or within tags of XML and HTML: &, <, > and quotes as entities.
std::string escaped_markup(const std::string& text);

}  // namespace bulbus::inline io
