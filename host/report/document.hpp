#pragma once
#include <string>
#include <utility>
#include <vector>

#include "host/report/page.hpp"
#include "host/report/run_data.hpp"

/// Pieces of which pages are made: no scripts, no files beside them, light and dark.
namespace verp::report {

/// Text as HTML shows it.
std::string escape(const std::string& text);

/// A whole page: `body` is HTML, the rest is text.
std::string document(const std::string& title, const std::string& verdict, bool good,
                     const std::string& body);

/// Named numbers, side by side.
std::string facts(const std::vector<Fact>& facts);

/// A section with a picture.
std::string section(const Picture& picture);

/// Rows of a table with a name and a value each; `link`: the name is a file beside the page.
std::string rows(const std::vector<std::pair<std::string, std::string>>& entries, bool link);

}  // namespace verp::report
