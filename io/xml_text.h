#pragma once
// Text in SVG and HTML.

#include <string>
#include <string_view>

namespace argil::io {

/// `text` as the content of an element or of an attribute in double quotes. Control characters, which XML 1.0 does
/// not have, become spaces; line ends and tabs stay.
[[nodiscard]] std::string xml_text(std::string_view text);

}  // namespace argil::io
