#include "host/study/survey/page.hpp"

#include "host/study/report/document.hpp"
#include "host/study/report/files.hpp"
#include "host/study/report/report.hpp"

namespace verp::survey {
namespace {

constexpr const char* kPicture = "map.png";
constexpr const char* kNumbers = "map.csv";

}  // namespace

WrittenPage write_page(const std::filesystem::path& folder, const Page& page) {
  report::make_folder(folder, "--report");
  report::write_file(folder / kNumbers, page.csv);
  const report::Sections pictures = report::draw_sections(page.plots, folder / kPicture);
  WrittenPage written{folder / "index.html", pictures.note};
  if (!written.note.empty()) written.note += "; the numbers are in map.csv";
  std::string body = report::facts(page.facts);
  if (!written.note.empty())
    body += "<section><p>" + report::escape(written.note) + "</p></section>\n";
  std::vector<std::pair<std::string, std::string>> files = {{kNumbers, "every cell of the map"}};
  if (pictures.poster) files.emplace_back(kPicture, "the map as a picture, to show to others");
  report::remove_what_is_older(folder, files);
  body += pictures.body + report::table("Numbers", report::rows(files, true)) +
          report::table("What is not as by default", report::rows(page.changed, false)) +
          report::table("How it was made", report::rows(page.provenance, false));
  report::write_file(written.page, report::document(page.title, page.verdict, page.good, body));
  return written;
}

}  // namespace verp::survey
