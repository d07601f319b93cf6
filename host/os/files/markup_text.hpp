#pragma once
#include <string>
#include <string_view>

namespace verp::files {

/// A text as XML or HTML has it, also between quotes: & < > " are escaped.
std::string markup_text(std::string_view text);

}  // namespace verp::files
