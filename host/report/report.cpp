#include "host/report/report.hpp"

#include "host/report/csv.hpp"
#include "host/report/figure.hpp"
#include "host/report/files.hpp"
#include "host/report/gnuplot.hpp"
#include "host/report/page.hpp"
#include "host/report/plots.hpp"

namespace verp::report {
namespace {

std::vector<Picture> draw_all(const Run& run, std::string& note) {
  std::vector<Picture> pictures;
  if (!gnuplot_available()) {
    note =
        "No plots: gnuplot is not installed (apt-get install gnuplot-nox); the numbers are in the "
        "CSV files.";
    return pictures;
  }
  for (Plot& plot : plots(run)) {
    std::string error;
    if (auto svg = draw(plot, error)) {
      pictures.push_back({std::move(plot), std::move(*svg)});
    } else {
      note += "The plot '" + plot.title + "' failed: " + error + ". ";
    }
  }
  return pictures;
}

}  // namespace

Written write_report(const std::filesystem::path& folder, const Run& run) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder)) {
    throw ReportError(folder.string() +
                      ": not a folder and cannot be made; choose another with --report");
  }
  std::vector<std::pair<std::string, std::string>> files;
  const auto add = [&](const char* name, const std::string& content, const char* holds) {
    write_file(folder / name, content);
    files.emplace_back(name, holds);
  };
  add("samples.csv", samples_csv(run),
      "every control tick: body, feet, ZMP, joint angles, torque use");
  add("zmp_bias.csv", bias_csv(run), "mean ZMP bias of each state of the cycle");
  add("torque.csv", torque_csv(run), "mean and peak torque use of each joint");
  if (!run.sweep.empty()) add("sweep.csv", sweep_csv(run), "the sweep over step lengths");
  if (!run.trace_file.empty()) {
    files.emplace_back(run.trace_file, "the trace: verp replay, or any MCAP viewer");
  }
  Written written;
  written.page = folder / "index.html";
  const std::vector<Picture> pictures = draw_all(run, written.note);
  if (const std::optional<Plot> whole = poster(run); whole && !pictures.empty()) {
    std::string problem;
    if (const auto png = draw_png(*whole, problem)) {
      add("walk.png", *png, "one cycle in one picture, to show to others");
    } else {
      written.note += "walk.png failed: " + problem + ". ";
    }
  }
  write_file(written.page, page(run, pictures, written.note, files));
  return written;
}

}  // namespace verp::report
