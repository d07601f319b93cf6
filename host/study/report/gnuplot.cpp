#include "host/study/report/gnuplot.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

#include "host/os/files/temporary_directory.hpp"
#include "host/os/files/whole.hpp"
#include "host/os/process/child.hpp"
#include "host/study/report/palette.hpp"

namespace verp::report {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLeastSpace_bytes = 4096;  // less may truncate a file

/// Output goes to files; returns an error, or nothing.
std::string run_gnuplot(const std::string& argument, const std::string& out,
                        const std::string& error) {
  try {
    // After Ctrl-C the report must still be written.
    process::Child gnuplot({.words = {"gnuplot", argument},
                            .input = {},
                            .output = {.file = out},
                            .error = process::Stream{.file = error}});
    const int status = gnuplot.wait();
    if (status > 128) return fmt::format("it was ended by signal {}", status - 128);
    return status == 0 ? "" : fmt::format("it ended with status {}", status);
  } catch (const std::system_error& failed) {
    return fmt::format("it cannot be started: {}", failed.code().message());
  }
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
    text.replace(at, from.size(), to);
    at += to.size();
  }
}

/// gnuplot has #rrggbb (fills), rgb(%3d, %3d, %3d) (lines) and rgb(%d,%d,%d) (text).
void replace_colour(std::string& svg, const Colour& colour) {
  const std::string variable = fmt::format("var({})", colour.variable);
  const unsigned long rgb = std::strtoul(colour.sentinel + 1, nullptr, 16);
  const unsigned long r = rgb >> 16, g = rgb >> 8 & 0xFF, b = rgb & 0xFF;
  replace_all(svg, fmt::format("rgb({:3}, {:3}, {:3})", r, g, b), variable);
  replace_all(svg, fmt::format("rgb({},{},{})", r, g, b), variable);
  replace_all(svg, fmt::format("#{:02x}{:02x}{:02x}", r, g, b), variable);
  replace_all(svg, fmt::format("#{:02X}{:02X}{:02X}", r, g, b), variable);
}

std::string for_page(std::string svg) {
  const std::size_t start = svg.find("<svg");
  if (start == std::string::npos) return {};
  svg.erase(0, start);
  for (const Colour& colour : kPalette) replace_colour(svg, colour);
  replace_all(svg, "fill=\"black\"", "fill=\"var(--ink)\"");
  return svg;
}

std::optional<std::string> output_of(const std::string& script, std::string& error) {
  const files::TemporaryDirectory scratch;
  const fs::path file = scratch.path() / "plot.gp";
  const files::Trouble trouble = files::create(file, script);
  if (trouble.any()) throw files::FileError(file.string() + ": " + trouble.text() + " with TMPDIR");
  const fs::path out = scratch.path() / "plot", problems = scratch.path() / "stderr";
  const std::string failure = run_gnuplot(file.string(), out.string(), problems.string());
  // On a full disk gnuplot may exit with 0.
  std::error_code error_code;
  if (fs::space(scratch.path(), error_code).available < kLeastSpace_bytes && !error_code) {
    throw files::FileError(scratch.path().parent_path().string() +
                           ": the disk is full; free space there, or point TMPDIR elsewhere");
  }
  if (failure.empty()) return files::read(out).value_or("");
  const std::string text = files::read(problems).value_or("");
  const std::size_t start = text.find_first_not_of(" \n");
  error = start == std::string::npos ? failure : text.substr(start, text.find('\n', start) - start);
  return std::nullopt;
}

std::optional<std::string> svg_of(const Plot& plot, const std::string& script,
                                  const char* background, std::string& error) {
  const std::string terminal =
      fmt::format("set terminal svg size {},{} dynamic enhanced rounded font 'sans-serif,13' {}\n",
                  plot.width, plot.height, background);
  std::optional<std::string> svg = output_of(terminal + script, error);
  if (svg && svg->find("</svg>") == std::string::npos) {
    error = "it made no picture";
    svg.reset();
  }
  return svg;
}

std::string light(std::string script) {
  for (const Colour& colour : kPalette) replace_all(script, colour.sentinel, colour.light);
  return script;
}

}  // namespace

bool gnuplot_available() {
  const char* path = std::getenv("PATH");
  std::string folders = path == nullptr ? "" : path;
  folders += ':';
  for (std::size_t at = 0, end; (end = folders.find(':', at)) != std::string::npos; at = end + 1) {
    if (end > at && ::access((folders.substr(at, end - at) + "/gnuplot").c_str(), X_OK) == 0)
      return true;
  }
  return false;
}

std::optional<std::string> draw(const Plot& plot, std::string& error) {
  std::optional<std::string> svg = svg_of(plot, plot.script, "", error);
  if (svg) *svg = for_page(std::move(*svg));
  return svg;
}

std::optional<std::string> draw_svg(const Plot& plot, std::string& error) {
  return svg_of(plot, light(plot.script), "background rgb '#ffffff'", error);
}

std::optional<std::string> draw_png(const Plot& plot, std::string& error) {
  constexpr double kScale = 1.3;  // sharp on a dense screen
  const std::string terminal = fmt::format(
      "set terminal pngcairo size {:.0f},{:.0f} enhanced rounded font 'sans,10' fontscale {} "
      "linewidth {} "
      "pointscale {} background rgb '#ffffff'\n",
      kScale * plot.width, kScale * plot.height, kScale, kScale, kScale);
  std::optional<std::string> png = output_of(terminal + light(plot.script), error);
  if (png && !png->starts_with("\x89PNG")) {
    error = "it made no picture";
    png.reset();
  }
  return png;
}

}  // namespace verp::report
