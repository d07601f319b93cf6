#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "host/study/report/page.hpp"
#include "host/study/report/run_data.hpp"

/// Pages without scripts and external files, light and dark.
namespace verp::report {

std::string escape(const std::string& text);

/// A complete page: `body` is HTML, the rest is text.
std::string document(const std::string& title, const std::string& verdict, bool good,
                     const std::string& body);

std::string facts(const std::vector<Fact>& facts);

std::string section(const Picture& picture);

struct Sections {
  std::string body;
  bool poster = false;  ///< the file was written
  std::string note;     ///< why pictures are missing; or empty
};
/// The first plot also becomes the file `poster`. Throws ReportError.
Sections draw_sections(const std::vector<Plot>& plots, const std::filesystem::path& poster);

/// A section; empty without rows.
std::string table(const char* title, const std::string& rows);

/// Names and values; `link`: the name is a file beside the page.
std::string rows(const std::vector<std::pair<std::string, std::string>>& entries, bool link);

}  // namespace verp::report
