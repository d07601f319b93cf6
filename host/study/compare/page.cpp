#include "host/study/compare/page.hpp"

#include <fmt/format.h>

#include "host/study/compare/draw.hpp"
#include "host/study/compare/words.hpp"
#include "host/study/report/document.hpp"
#include "host/study/report/files.hpp"
#include "host/study/report/maybe.hpp"

namespace verp::compare {
namespace {

std::vector<report::Fact> facts_of(const Comparison& c) {
  const std::string delay = c.delay_s ? fmt::format("{:.1f} ms", 1e3 * *c.delay_s) : "-";
  return {
      {"B comes later by", delay, "all joints that move, together"},
      {"error", fmt::format("{:.2f}°", kDegrees * c.error_rms_rad), "rms over all joints"},
      {"most at", c.worst().name, fmt::format("{:.2f}° rms", kDegrees * c.worst().error_rms_rad)},
      {"in common", fmt::format("{:.2f} s", c.to_s - c.from_s), name_of(c.alignment)}};
}

std::string table_of(const Comparison& c) {
  std::string out =
      "<section><h2>Joint by joint</h2><div class=\"wide\"><table><tr><th>joint</th>"
      "<th class=\"n\">error rms</th><th class=\"n\">max</th><th class=\"n\">offset</th>"
      "<th class=\"n\">delay</th><th class=\"n\">left</th><th class=\"n\">gain</th>"
      "<th class=\"n\">phase lag</th></tr>\n";
  const auto scaled = [](const std::optional<double>& value, double by) {
    return value ? std::optional(by * *value) : std::nullopt;
  };
  for (const JointResult& each : c.joints) {
    out += fmt::format(
        "<tr><td>{}</td><td class=\"n\">{:.2f}°</td><td class=\"n\">{:.2f}°</td>"
        "<td class=\"n\">{:.2f}°</td><td class=\"n\">{}</td><td class=\"n\">{}</td>"
        "<td class=\"n\">{}</td><td class=\"n\">{}</td></tr>\n",
        report::escape(each.name), kDegrees * each.error_rms_rad, kDegrees * each.error_most_rad,
        kDegrees * each.offset_rad,
        each.delay_s ? fmt::format("{:.1f} ms", 1e3 * *each.delay_s)
                     : report::escape(each.no_delay),
        report::or_dash(scaled(each.left_rad, kDegrees), 2, "°"), report::or_dash(each.gain, 2, ""),
        report::or_dash(scaled(each.phase_lag_rad, kDegrees), 1, "°"));
  }
  return out + "</table></div></section>\n";
}

std::string provenance_of(const char* which, const record::Trace& trace) {
  const auto revision = trace.metadata.find("source_revision");
  return report::rows(
      {{which, trace.file.string()},
       {"", fmt::format("{}, {:.2f} s, revision {}, digest 0x{:016x}", trace.params.name,
                        static_cast<double>(trace.ticks.size()) * trace.period_s(),
                        revision == trace.metadata.end() ? "unknown" : revision->second,
                        trace.digest())}},
      false);
}

}  // namespace

WrittenPage write_page(const std::filesystem::path& folder, const record::Trace& a,
                       const record::Trace& b, const Comparison& c) {
  report::make_folder(folder, "-o");
  const Pair pair = pair_of(Motion(a), Motion(b), c.shift_s, c.from_s, c.to_s);
  report::write_file(folder / "joints.csv", joints_csv(c));
  report::write_file(folder / "angles.csv", angles_csv(c, pair));
  std::string body = report::facts(facts_of(c));
  const report::Sections pictures =
      report::draw_sections({angles_plot(c, pair), joints_plot(c)}, folder / "compare.png");
  const WrittenPage written{folder / "index.html", pictures.note};
  for (const std::string& note : c.notes)
    body += "<section><p>" + report::escape(note) + "</p></section>\n";
  if (!written.note.empty()) {
    body += "<section><p>" + report::escape(written.note) + "</p></section>\n";
  }
  body += pictures.body + table_of(c);
  body += report::table("Numbers and traces",
                        report::rows({{"joints.csv", "the table above, SI units"},
                                      {"angles.csv", "both angles of each joint, tick by tick"}},
                                     true) +
                            provenance_of("A", a) + provenance_of("B", b));
  report::write_file(
      written.page,
      report::document(
          fmt::format("{} against {}", b.file.filename().string(), a.file.filename().string()),
          fmt::format(
              "B comes {} after A, and is off by {:.2f}° rms",
              report::or_dash(c.delay_s ? std::optional(1e3 * *c.delay_s) : std::nullopt, 1, " ms"),
              kDegrees * c.error_rms_rad),
          true, body));
  return written;
}

}  // namespace verp::compare
