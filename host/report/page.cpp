#include "host/report/page.hpp"

#include <fmt/format.h>

#include "host/report/maybe.hpp"
#include "host/report/palette.hpp"

namespace verp::report {
namespace {

constexpr const char* kStyle = R"(
* { box-sizing: border-box; }
body { margin:0; background:var(--page); color:var(--ink); font:16px/1.55 system-ui, "Segoe UI", Roboto, sans-serif; }
main { max-width:62rem; margin:0 auto; padding:2.5rem 1.25rem 4rem; }
h1 { font-size:1.9rem; line-height:1.2; margin:0 0 .3rem; letter-spacing:-.01em; }
h2 { font-size:1.15rem; margin:0 0 .15rem; }
p { margin:.2rem 0 .8rem; } .quiet { color:var(--quiet); }
.verdict { font-size:1.15rem; font-weight:600; } .good { color:var(--good); } .bad { color:var(--bad); }
.facts { display:grid; grid-template-columns:repeat(auto-fill,minmax(13rem,1fr)); gap:.75rem; margin:1.5rem 0 2rem; }
.fact { background:var(--card); border:1px solid var(--soft); border-radius:.6rem; padding:.7rem .9rem; }
.fact b { display:block; font-size:1.35rem; font-weight:650; font-variant-numeric:tabular-nums; line-height:1.3; }
.fact span { display:block; font-size:.85rem; color:var(--quiet); line-height:1.35; }
section { background:var(--card); border:1px solid var(--soft); border-radius:.6rem; padding:1.1rem 1.2rem; margin:0 0 1.2rem; }
section svg { width:100%; height:auto; display:block; }
table { border-collapse:collapse; width:100%; font-variant-numeric:tabular-nums; font-size:.95rem; }
th, td { text-align:left; padding:.35rem .8rem .35rem 0; border-bottom:1px solid var(--soft); vertical-align:top; }
td.n, th.n { text-align:right; } td { overflow-wrap:anywhere; } th { font-weight:600; white-space:nowrap; }
.wide { overflow-x:auto; } a { color:var(--s1); } code { font-size:.92em; }
)";

std::string colours(const char* Colour::*theme) {
  std::string out;
  for (const Colour& colour : kPalette)
    out += fmt::format(" {}:{};", colour.variable, colour.*theme);
  return out;
}

std::string style() {
  return ":root { color-scheme: light dark; --page:#fbfaf8; --card:#ffffff; --quiet:#626a73; "
         "--good:#1a7f4b; --bad:#b3261e;" +
         colours(&Colour::light) +
         " }\n@media (prefers-color-scheme: dark) { :root { --page:#15181c; --card:#1d2126; "
         "--quiet:#9aa3ad; --good:#5fc890; --bad:#ff8a80;" +
         colours(&Colour::dark) + " } }" + kStyle;
}

std::string escape(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string facts(const Run& run) {
  std::string out = "<div class=\"facts\">\n";
  for (const Fact& fact : run.facts) {
    out += fmt::format("<div class=\"fact\"><span>{}</span><b>{}</b><span>{}</span></div>\n",
                       escape(fact.name), escape(fact.value), escape(fact.note));
  }
  return out + "</div>\n";
}

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

std::string rows(const std::vector<std::pair<std::string, std::string>>& entries, bool link) {
  std::string out;
  for (const auto& [name, value] : entries) {
    const std::string shown =
        link ? fmt::format("<a href=\"{0}\">{0}</a>", escape(name)) : escape(name);
    out += fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", shown, escape(value));
  }
  return out;
}

}  // namespace

std::string page(const Run& run, const std::vector<Picture>& pictures, const std::string& note,
                 const std::vector<std::pair<std::string, std::string>>& files) {
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
      "<title>{}</title><style>{}</style></head><body><main>\n<h1>{}</h1>\n"
      "<p class=\"verdict {}\">{}</p>\n",
      escape(run.title), style(), escape(run.title), run.good ? "good" : "bad",
      escape(run.verdict));
  out += facts(run);
  if (!note.empty()) out += fmt::format("<section><p>{}</p></section>\n", escape(note));
  out += run.replay_html;
  out += sweep_table(run);
  for (const Picture& picture : pictures) {
    out += fmt::format("<section id=\"{}\"><h2>{}</h2><p class=\"quiet\">{}</p>\n{}</section>\n",
                       picture.plot.id, escape(picture.plot.title), escape(picture.plot.caption),
                       picture.svg);
  }
  out += "<section><h2>Numbers and trace</h2><div class=\"wide\"><table>\n" + rows(files, true) +
         "</table></div></section>\n";
  if (!run.changed.empty()) {
    out += "<section><h2>What is not as by default</h2><div class=\"wide\"><table>\n" +
           rows(run.changed, false) + "</table></div></section>\n";
  }
  out += "<section><h2>How it was made</h2><div class=\"wide\"><table>\n" +
         rows(run.provenance, false) + "</table></div></section>\n";
  return out + "</main></body></html>\n";
}

}  // namespace verp::report
