#include "host/apps/tool/study/bench_languages.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace verp::tool {

void add_language_row(const cli::Json& line, std::vector<BenchRow>& rows) {
  struct Language {
    const char* what;
    double at_least;  ///< ticks per second; 0: no limit
  };
  static const std::map<std::string, Language> kLanguages = {
      {"cpp", {"C++, libverp in the process", 0}},
      {"csharp", {"C#, mono", 0}},
      {"python", {"Python", 5000}},
      {"octave", {"Octave", 2000}},
      {"external", {"another process, over a Unix socket", 2000}}};
  const std::string name = line.at("language");
  const Language& language = kLanguages.at(name);
  BenchRow row{.name = name + "_ticks_per_s",
               .where = "languages",
               .what = language.what,
               .unit = "ticks/s",
               .bar = language.at_least > 0 ? Bar::kAtLeast : Bar::kNone,
               .limit = language.at_least};
  row.missing = line.value("missing", "");
  row.failed = line.value("failed", "");
  if (row.measured()) {
    const std::vector<double> values = line.at("ticks_per_s");
    row.value = median(values);
    row.least = *std::min_element(values.begin(), values.end());
    row.most = *std::max_element(values.begin(), values.end());
  }
  rows.push_back(std::move(row));
}

}  // namespace verp::tool
