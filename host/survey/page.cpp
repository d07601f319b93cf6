#include "host/survey/page.hpp"

#include <optional>

#include "host/files/temporary_directory.hpp"
#include "host/report/document.hpp"
#include "host/report/files.hpp"
#include "host/report/gnuplot.hpp"
#include "host/report/report.hpp"

namespace verp::survey {
namespace {

constexpr const char* kPicture = "map.png";
constexpr const char* kNumbers = "map.csv";

/// Pictures as far as gnuplot makes them; says why not.
std::string draw_into(const std::filesystem::path& folder, const Page& page, std::string& body,
                      bool& picture) {
  if (!report::gnuplot_available()) {
    return "no pictures: gnuplot is not installed (apt-get install gnuplot-nox); the numbers are "
           "in map.csv";
  }
  std::string error;
  try {
    for (const report::Plot& plot : page.plots) {
      const std::optional<std::string> svg = report::draw(plot, error);
      if (svg) body += report::section({plot, *svg});
    }
    const auto png =
        page.plots.empty() ? std::nullopt : report::draw_png(page.plots.front(), error);
    if (png) report::write_file(folder / kPicture, *png);
    picture = png.has_value();
  } catch (const files::FileError& failed) {
    error = failed.what();
  }
  return error.empty() ? "" : "pictures are missing: " + error + "; the numbers are in map.csv";
}

std::string table(const char* title, const std::vector<std::pair<std::string, std::string>>& rows,
                  bool link) {
  if (rows.empty()) return "";
  return std::string("<section><h2>") + title + "</h2><div class=\"wide\"><table>\n" +
         report::rows(rows, link) + "</table></div></section>\n";
}

}  // namespace

WrittenPage write_page(const std::filesystem::path& folder, const Page& page) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder)) {
    throw report::ReportError(folder.string() +
                              ": not a folder and cannot be made; choose another with --report");
  }
  report::write_file(folder / kNumbers, page.csv);
  std::string pictures;
  bool picture = false;
  WrittenPage written{folder / "index.html", {}};
  written.note = draw_into(folder, page, pictures, picture);
  std::string body = report::facts(page.facts);
  if (!written.note.empty())
    body += "<section><p>" + report::escape(written.note) + "</p></section>\n";
  std::vector<std::pair<std::string, std::string>> files = {{kNumbers, "every cell of the map"}};
  if (picture) files.emplace_back(kPicture, "the map as a picture, to show to others");
  report::remove_what_is_older(folder, files);
  body += pictures + table("Numbers", files, true) +
          table("What is not as by default", page.changed, false) +
          table("How it was made", page.provenance, false);
  report::write_file(written.page, report::document(page.title, page.verdict, page.good, body));
  return written;
}

}  // namespace verp::survey
