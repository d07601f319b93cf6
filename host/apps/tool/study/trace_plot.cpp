#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/suggest.hpp"
#include "host/apps/tool/study/trace_words.hpp"
#include "host/study/report/files.hpp"
#include "host/study/report/gnuplot.hpp"
#include "host/study/signals/draw.hpp"

namespace verp::tool {
namespace {

constexpr std::size_t kMostPanels = 40;  // per picture; more are illegible

using signals::Column;

[[noreturn]] void refuse_plot(const std::string& why) {
  throw cli::ToolError(cli::kBadInput, "verp trace plot: " + why);
}

int list_signals(const std::vector<Column>& columns) {
  std::string text;
  for (const Column& column : columns) text += column.name + '\n';
  cli::answer(text);
  return cli::kGood;
}

/// Each column once, in the order of the user's words.
std::vector<std::size_t> chosen(const TraceWords& words, const std::vector<Column>& columns) {
  std::vector<std::string> names;
  for (const Column& column : columns) names.push_back(column.name);
  std::vector<std::size_t> all;
  for (const std::string& word : words.signals) {
    const std::vector<std::size_t> found = signals::matching(columns, word);
    if (found.empty()) {
      refuse_plot(fmt::format("--signal {}: {} has no signal of that name{}; --list prints them",
                              word, words.file, cli::did_you_mean(word, names)));
    }
    for (const std::size_t i : found) {
      if (std::find(all.begin(), all.end(), i) == all.end()) all.push_back(i);
    }
  }
  return all;
}

std::optional<std::string> draw_as(const std::string& ending, const report::Plot& plot) {
  if (!report::gnuplot_available()) {
    throw cli::ToolError(cli::kNoDevice,
                         "verp trace plot: gnuplot is not installed (apt-get install gnuplot-nox)");
  }
  std::string error;
  auto picture = ending == ".png" ? report::draw_png(plot, error) : report::draw_svg(plot, error);
  if (!picture) throw cli::ToolError(cli::kRunFailed, "verp trace plot: gnuplot: " + error);
  return picture;
}

}  // namespace

int plot_trace(const TraceWords& words) {
  const std::string ending = std::filesystem::path(words.output).extension().string();
  if (!words.list) {
    if (words.signals.empty()) refuse_plot("name what to draw with --signal; --list prints names");
    if (ending != ".png" && ending != ".svg") {
      refuse_plot(words.output.empty() ? "name the picture with -o FILE.png or -o FILE.svg"
                                       : "-o " + words.output + ": pictures end in .png or .svg");
    }
  }
  const record::Trace trace = load_trace(words);
  const std::vector<Column> all = signals::columns_of(trace.params, true);
  if (words.list) return list_signals(all);
  const std::vector<std::size_t> columns = chosen(words, all);
  const bool states = std::any_of(columns.begin(), columns.end(), [&](std::size_t i) {
    return all[i].format == signals::Format::kState;  // last columns, and slow
  });
  signals::Table table(trace, states);
  const record::TickRange ticks = record::ticks_between(trace, words.from_s, words.to_s);
  if (ticks.first == ticks.last)
    refuse_plot("one tick is in that time, and a line needs two; set --from and --to apart");
  const signals::Series series = signals::series_of(table, columns, ticks);
  if (const std::size_t panels = signals::panels_of(series.columns).size(); panels > kMostPanels) {
    refuse_plot(fmt::format("{} signals would be {} panels, of at most {}; name fewer",
                            columns.size(), panels, kMostPanels));
  }
  report::write_file(words.output, *draw_as(ending, signals::plot_of(series, words.file)));
  tell_of_other_decisions(trace, table.other_from());
  cli::answer(words.output + '\n');
  return cli::kGood;
}

}  // namespace verp::tool
