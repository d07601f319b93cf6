#include "host/apps/tool/study/bench_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace verp::tool {
namespace {

std::string number(double value) {
  const bool whole = value == std::floor(value) || value >= 100;
  return fmt::format("{:.{}f}", value, whole ? 0 : value < 1 ? 3 : 2);
}

std::string with_unit(double value, const std::string& unit) {
  return number(value) + (unit.empty() ? "" : " ") + unit;
}

std::string verdict(const BenchRow& row) {
  if (row.bar == Bar::kNone) return "";
  if (row.held()) return "kept";
  return row.exact ? "MISSED" : "missed; a time, not judged";
}

std::string bar_text(const BenchRow& row) {
  if (row.bar == Bar::kNone) return "";
  return (row.bar == Bar::kAtMost ? "at most " : "at least ") + with_unit(row.limit, row.unit);
}

std::string range_text(const BenchRow& row) {
  if (std::isnan(row.least)) return "";
  return fmt::format("{} to {}", number(row.least), number(row.most));
}

std::string trimmed(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

}  // namespace

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values.at(half) : (values.at(half - 1) + values.at(half)) / 2;
}

std::string bench_table(const std::vector<BenchRow>& rows, const cli::Json& headings) {
  constexpr const char* kColumns = "  {:38} {:>14}  {:18} {:22} {}";
  std::string text =
      trimmed(fmt::format(kColumns, "", "measured", "least to most", "promised", ""));
  std::string where;
  for (const BenchRow& row : rows) {
    if (row.where != where) {
      where = row.where;
      text += fmt::format("{}: {}\n", where, headings.value(where, ""));
    }
    if (!row.measured()) {
      text += fmt::format("  {:38} {}\n", row.what,
                          row.failed.empty() ? "not measured; install it: " + row.missing
                                             : "FAILED: " + row.failed);
      continue;
    }
    text += trimmed(fmt::format(kColumns, row.what, with_unit(row.value, row.unit), range_text(row),
                                bar_text(row), verdict(row)));
  }
  return text;
}

cli::Json bench_json(const std::vector<BenchRow>& rows) {
  cli::Json array = cli::Json::array();
  for (const BenchRow& row : rows) {
    cli::Json json = {{"where", row.where}, {"name", row.name}};
    if (!row.measured()) {
      const bool failed = !row.failed.empty();
      json[failed ? "failed" : "missing"] = failed ? row.failed : row.missing;
      if (row.bar != Bar::kNone) json[row.bar == Bar::kAtMost ? "at_most" : "at_least"] = row.limit;
      array.push_back(json);
      continue;
    }
    json["value"] = row.value;
    if (!std::isnan(row.least)) json.update({{"least", row.least}, {"most", row.most}});
    if (row.bar != Bar::kNone) {
      json.update({{row.bar == Bar::kAtMost ? "at_most" : "at_least", row.limit},
                   {"kept", row.held()},
                   {"judged", row.exact}});
    }
    array.push_back(json);
  }
  return array;
}

bool bench_held(const std::vector<BenchRow>& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const BenchRow& row) {
    if (!row.measured()) return row.failed.empty();
    return !row.exact || row.held();
  });
}

}  // namespace verp::tool
