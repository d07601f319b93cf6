#include "host/study/report/page.hpp"

#include <fmt/format.h>

#include "host/study/report/document.hpp"
#include "host/study/report/maybe.hpp"

namespace verp::report {
namespace {

std::string sweep_table(const Run& run) {
  if (run.sweep.empty()) return "";
  std::string out =
      "<section><h2>Step length sweep</h2><p class=\"quiet\">The same walk at each step length, "
      "with the multibody "
      "ZMP correction on and off.</p><div class=\"wide\"><table><tr><th class=\"n\">step</th><th "
      "class=\"n\">walked</th><th class=\"n\">speed</th><th class=\"n\">ZMP bias, with</th><th "
      "class=\"n\">ZMP bias, "
      "without</th></tr>\n";
  bool limited = false;
  for (const SweepRow& row : run.sweep) {
    limited |= row.limited();
    out += fmt::format(
        "<tr><td class=\"n\">{:.1f} cm</td><td class=\"n\">{}</td><td class=\"n\">{}</td>"
        "<td class=\"n\">{}</td><td class=\"n\">{}</td></tr>\n",
        100 * row.step_m, walked_step(row.with), or_dash(row.with.speed_m_s, 3, " m/s"),
        bias_or_end(row.with), bias_or_end(row.without));
  }
  out += "</table></div>";
  if (limited) out += fmt::format("<p class=\"quiet\">{}</p>", escape(kLimitedNote));
  return out + "</section>\n";
}

}  // namespace

std::string page(const Run& run, const std::vector<Picture>& pictures, const std::string& note,
                 const std::vector<std::pair<std::string, std::string>>& files) {
  std::string out = facts(run.facts);
  if (!note.empty()) out += fmt::format("<section><p>{}</p></section>\n", escape(note));
  out += run.replay_html;
  out += sweep_table(run);
  for (const Picture& picture : pictures) out += section(picture);
  out += table("Numbers and trace", rows(files, true)) +
         table("What is not as by default", rows(run.changed, false)) +
         table("How it was made", rows(run.provenance, false));
  return document(run.title, run.verdict, run.good, out);
}

}  // namespace verp::report
