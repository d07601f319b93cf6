#pragma once
#include <limits>
#include <string>
#include <vector>

#include "host/apps/cli/json.hpp"

namespace verp::tool {

enum class Bar { kNone, kAtMost, kAtLeast };

/// One measured cost beside what was promised.
struct BenchRow {
  std::string name;   ///< in JSON, with its unit
  std::string where;  ///< "pc" or a board
  std::string what;   ///< for people
  std::string unit;
  double value = 0;
  Bar bar = Bar::kNone;
  double limit = 0;
  bool exact = false;  ///< counted, so the same in every run; else a time, which is never judged
  double least = std::numeric_limits<double>::quiet_NaN();  ///< over the repetitions, if any
  double most = std::numeric_limits<double>::quiet_NaN();
  std::string missing = {};  ///< why there is no value here: what is not installed
  std::string failed = {};   ///< why there is none, though all is installed

  bool measured() const { return missing.empty() && failed.empty(); }
  bool held() const {
    return bar == Bar::kNone || (bar == Bar::kAtMost ? value <= limit : value >= limit);
  }
};

/// Of at least one.
double median(std::vector<double> values);

/// All rows; one heading a place, which `headings` may explain ("mps2_an386": "Cortex-M4F ...").
std::string bench_table(const std::vector<BenchRow>& rows, const cli::Json& headings);

cli::Json bench_json(const std::vector<BenchRow>& rows);

/// Whether every exact promise is kept, and nothing failed; what is not installed is no failure.
bool bench_held(const std::vector<BenchRow>& rows);

}  // namespace verp::tool
