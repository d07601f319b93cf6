#include "host/study/report/document.hpp"

#include <fmt/format.h>

#include <optional>

#include "host/os/files/markup_text.hpp"
#include "host/os/files/temporary_directory.hpp"
#include "host/study/report/files.hpp"
#include "host/study/report/gnuplot.hpp"
#include "host/study/report/palette.hpp"

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

}  // namespace

std::string escape(const std::string& text) {
  return files::markup_text(text);
}

std::string document(const std::string& title, const std::string& verdict, bool good,
                     const std::string& body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
      "<title>{0}</title><style>{1}</style></head><body><main>\n<h1>{0}</h1>\n"
      "<p class=\"verdict {2}\">{3}</p>\n{4}</main></body></html>\n",
      escape(title), style(), good ? "good" : "bad", escape(verdict), body);
}

std::string facts(const std::vector<Fact>& facts) {
  std::string out = "<div class=\"facts\">\n";
  for (const Fact& fact : facts) {
    out += fmt::format("<div class=\"fact\"><span>{}</span><b>{}</b><span>{}</span></div>\n",
                       escape(fact.name), escape(fact.value), escape(fact.note));
  }
  return out + "</div>\n";
}

std::string section(const Picture& picture) {
  return fmt::format("<section id=\"{}\"><h2>{}</h2><p class=\"quiet\">{}</p>\n{}</section>\n",
                     picture.plot.id, escape(picture.plot.title), escape(picture.plot.caption),
                     picture.svg);
}

Sections draw_sections(const std::vector<Plot>& plots, const std::filesystem::path& poster) {
  Sections out;
  if (!gnuplot_available()) {
    out.note = "no pictures: gnuplot is not installed (apt-get install gnuplot-nox)";
    return out;
  }
  std::string error;
  try {
    for (const Plot& plot : plots) {
      const std::optional<std::string> svg = draw(plot, error);
      if (svg) out.body += section({plot, *svg});
    }
    const auto png = plots.empty() ? std::nullopt : draw_png(plots.front(), error);
    if (png) write_file(poster, *png);
    out.poster = png.has_value();
  } catch (const files::FileError& failed) {
    error = failed.what();
  }
  if (!error.empty()) out.note = "pictures are missing: " + error;
  return out;
}

std::string table(const char* title, const std::string& rows) {
  if (rows.empty()) return "";
  return fmt::format(
      "<section><h2>{}</h2><div class=\"wide\"><table>\n{}</table></div></section>\n", title, rows);
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

}  // namespace verp::report
