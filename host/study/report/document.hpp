#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "host/study/report/page.hpp"
#include "host/study/report/run_data.hpp"

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

/// Pictures of plots as sections, as far as gnuplot makes them.
struct Sections {
  std::string body;
  bool poster = false;  ///< the file was written
  std::string note;     ///< why pictures are missing; empty: none is
};
/// The first plot is also the file `poster`. Throws ReportError.
Sections draw_sections(const std::vector<Plot>& plots, const std::filesystem::path& poster);

/// A section with a table of such rows(); empty if there are none.
std::string table(const char* title, const std::string& rows);

/// Rows of a table with a name and a value each; `link`: the name is a file beside the page.
std::string rows(const std::vector<std::pair<std::string, std::string>>& entries, bool link);

}  // namespace verp::report
