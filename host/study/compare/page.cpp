#include "host/study/compare/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "host/study/compare/words.hpp"
#include "host/study/report/document.hpp"
#include "host/study/report/files.hpp"
#include "host/study/report/maybe.hpp"
#include "host/study/report/palette.hpp"
#include "host/study/report/plots.hpp"
#include "host/study/report/script.hpp"

namespace verp::compare {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kShownCycles = 4, kShown_s = 4;
constexpr int kColumns = 3, kPanel_px = 170;

/// An interval in the middle, where both motions are steady.
std::pair<std::size_t, std::size_t> shown(const Comparison& c, const Pair& pair) {
  const double length_s = c.gait_hz ? kShownCycles / *c.gait_hz : kShown_s;
  const double middle_s = (c.from_s + c.to_s) / 2;
  const auto at = [&](double time_s) {
    return static_cast<std::size_t>(
        std::lower_bound(pair.time_s.begin(), pair.time_s.end(), time_s) - pair.time_s.begin());
  };
  return {at(middle_s - length_s / 2), at(middle_s + length_s / 2)};
}

/// Joints that move, the largest motion first; others show nothing.
std::vector<std::size_t> moving(const Comparison& c) {
  std::vector<std::size_t> joints;
  for (std::size_t j = 0; j < c.joints.size(); ++j) {
    if (c.joints[j].delay_s || c.joints[j].error_rms_rad > c.error_rms_rad) joints.push_back(j);
  }
  return joints;
}

/// Both angles of each joint over some cycles.
report::Plot angles_plot(const Comparison& c, const Pair& pair) {
  const auto [first, last] = shown(c, pair);
  const std::vector<std::size_t> joints = moving(c);
  report::Data data("angles");
  for (std::size_t i = first; i < last; ++i) {
    data.cell(pair.time_s[i] - c.from_s);
    for (const std::size_t j : joints) {
      data.cell(kDegrees * pair.a[j][i]).cell(kDegrees * pair.b[j][i]);
    }
    data.end_row();
  }
  const int count = std::max(static_cast<int>(joints.size()), 1);
  const int columns = std::min(kColumns, count), rows = (count + columns - 1) / columns;
  std::string script = report::preamble() + data.text();
  script += fmt::format(
      "set multiplot layout {},{}\nset tmargin 2.2\nset bmargin 2.2\n"
      "set lmargin 7\nset rmargin 1\n",
      rows, columns);
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const JointResult& joint = c.joints[joints[k]];
    const std::string delay =
        joint.delay_s ? fmt::format(", {:+.1f} ms", 1e3 * *joint.delay_s) : std::string();
    script += fmt::format(
        "set title '{}{}' noenhanced offset 0,-0.6\nset xrange [{:.6g}:{:.6g}]\n"
        "{}\nplot $angles using 1:{} with lines linetype 1 title 'A', "
        "$angles using 1:{} with lines linetype 2 title 'B'\n",
        report::plain(joint.name), delay, pair.time_s[first] - c.from_s,
        pair.time_s[last - 1] - c.from_s,
        k == 0 ? "set key at screen 0.99,0.015 right bottom horizontal" : "unset key", 2 * k + 2,
        2 * k + 3);
  }
  return {"angles",
          "Joint angles, laid over each other",
          "Measured angles in degrees over seconds since the command, a few cycles of them; with "
          "each joint the time by which B comes later.",
          920,
          40 + kPanel_px * rows,
          script + "unset multiplot\n"};
}

report::Plot joints_plot(const Comparison& c) {
  report::Data data("joints");
  for (std::size_t j = 0; j < c.joints.size(); ++j) {
    const JointResult& joint = c.joints[j];
    data.cell(static_cast<double>(j)).label(report::plain(joint.name));
    data.row(kDegrees * joint.error_rms_rad, joint.left_rad ? kDegrees * *joint.left_rad : kNone,
             kDegrees * joint.offset_rad, joint.delay_s ? 1e3 * *joint.delay_s : kNone);
  }
  std::string script = report::preamble() + data.text();
  script += fmt::format(
      "set multiplot layout 3,1\nset style fill solid 0.75 noborder\nset xrange [-0.7:{}.7]\n"
      "set lmargin 9\nset rmargin 9\nset xtics scale 0 noenhanced\nset format x ''\n"
      "set key outside top center horizontal\nset ylabel 'rms, degrees'\nset yrange [0:*]\n"
      "plot $joints using ($1-0.2):3:(0.36) with boxes linetype 1 title 'error', "
      "$joints using ($1+0.2):4:(0.36) with boxes linetype 3 title 'left without delay and "
      "offset'\n"
      "unset key\nset yrange [*<0:0<*]\nset ylabel 'offset, degrees'\n"
      "plot $joints using 1:5:(0.6) with boxes linetype 4\n"
      "set ylabel 'delay, ms'\nset format x '%s'\nset bmargin 6\n"
      "plot $joints using 1:6:(0.6):xtic(2) with boxes linetype 2\nunset multiplot\n",
      c.joints.size() - 1);
  const std::string rotate = "set xtics rotate by -40 left\n";
  script.insert(script.rfind("plot $joints"), rotate);
  return {
      "joints",
      "Error, offset and delay of each joint",
      "B against A, laid together by their command. No bar of delay: the joint hardly moves, or "
      "the two move differently.",
      920,
      620,
      script};
}

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
