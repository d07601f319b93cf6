#include "host/study/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "host/os/files/temporary_directory.hpp"
#include "host/study/report/csv.hpp"
#include "host/study/report/figure.hpp"
#include "host/study/report/files.hpp"
#include "host/study/report/gnuplot.hpp"
#include "host/study/report/page.hpp"
#include "host/study/report/plots.hpp"

namespace verp::report {
namespace {

constexpr std::string_view kNames[] = {"index.html", "samples.csv", "zmp_bias.csv",
                                       "torque.csv", "asked.csv",   "sweep.csv",
                                       "walk.png",   "map.png",     "map.csv"};

/// If one picture fails, the rest remains.
struct Drawing {
  std::vector<Picture> pictures;
  std::string png;
  std::size_t wanted = 0, failed = 0;
  std::string problem;  ///< of the first failure
};

Drawing draw_all(const Run& run) {
  Drawing drawing;
  std::string error;
  const auto count = [&](bool drawn) {
    ++drawing.wanted;
    drawing.failed += drawn ? 0 : 1;
    if (!drawn && drawing.problem.empty()) drawing.problem = error;
  };
  for (Plot& plot : plots(run)) {
    std::optional<std::string> svg = draw(plot, error);
    count(svg.has_value());
    if (svg) drawing.pictures.push_back({std::move(plot), std::move(*svg)});
  }
  if (const std::optional<Plot> whole = poster(run)) {
    std::optional<std::string> png = draw_png(*whole, error);
    count(png.has_value());
    if (png) drawing.png = std::move(*png);
  }
  return drawing;
}

Drawing draw_what_can_be(const Run& run, Written& written) {
  const char* const kNumbers = "; the numbers are in the CSV files";
  const std::string page = written.page.string();
  if (!gnuplot_available()) {
    written.note =
        page + ": no plots: gnuplot is not installed (apt-get install gnuplot-nox)" + kNumbers;
    return {};
  }
  try {
    Drawing drawing = draw_all(run);
    if (drawing.failed > 0) {
      written.note = fmt::format(
          "{}: {} of {} plots are missing: gnuplot failed: {}; see that `gnuplot --version` works "
          "(apt-get install --reinstall gnuplot-nox){}",
          page, drawing.failed, drawing.wanted, drawing.problem, kNumbers);
    }
    return drawing;
  } catch (const files::FileError& error) {
    written.note = page + ": no plots: " + error.what() + kNumbers;
    written.lost = true;
    return {};
  }
}

}  // namespace

bool is_of_the_report(std::string_view name) {
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

void remove_what_is_older(const std::filesystem::path& folder,
                          const std::vector<std::pair<std::string, std::string>>& files) {
  for (const std::string_view name : kNames) {
    const bool written = std::any_of(files.begin(), files.end(),
                                     [&](const auto& file) { return file.first == name; });
    std::error_code error;
    if (!written && name != "index.html") std::filesystem::remove(folder / name, error);
  }
}

Written write_report(const std::filesystem::path& folder, const Run& run) {
  make_folder(folder, "--report");
  std::vector<std::pair<std::string, std::string>> files;
  const auto add = [&](const char* name, const std::string& content, const char* holds) {
    write_file(folder / name, content);
    files.emplace_back(name, holds);
  };
  add("samples.csv", samples_csv(run),
      "every control tick: body, feet, ZMP, joint angles, goals, torque use");
  add("zmp_bias.csv", bias_csv(run), "mean ZMP bias of each state of the cycle");
  add("torque.csv", torque_csv(run), "mean and peak torque use of each joint");
  add("asked.csv", asked_csv(run), "the way that was asked, from where the gait began");
  if (!run.sweep.empty()) add("sweep.csv", sweep_csv(run), "the sweep over step lengths");
  if (!run.trace_file.empty()) {
    files.emplace_back(run.trace_file, "the trace: verp replay, or any MCAP viewer");
  }
  Written written;
  written.page = folder / "index.html";
  const Drawing drawing = draw_what_can_be(run, written);
  std::string note = written.note;
  if (note.empty() && last_steady_cycle(run).empty()) {
    note = "No whole cycle was walked, so there are no pictures of one.";
  }
  if (!drawing.png.empty()) {
    add("walk.png", drawing.png, "one cycle in one picture, to show to others");
  }
  remove_what_is_older(folder, files);
  write_file(written.page, page(run, drawing.pictures, note, files));
  return written;
}

}  // namespace verp::report
