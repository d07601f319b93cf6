#pragma once
#include <limits>
#include <string>
#include <vector>

#include "host/apps/cli/json.hpp"

namespace verp::tool {

enum class Bar { kNone, kAtMost, kAtLeast };

struct BenchRow {
  std::string name;   ///< JSON key with unit
  std::string where;  ///< "pc" or a board
  std::string what;   ///< description
  std::string unit;
  double value = 0;
  Bar bar = Bar::kNone;
  double limit = 0;
  bool exact = false;  ///< a count, equal in every run; times are never judged
  double least = std::numeric_limits<double>::quiet_NaN();  ///< over the repetitions
  double most = std::numeric_limits<double>::quiet_NaN();
  std::string missing = {};  ///< what is not installed
  std::string failed = {};   ///< why there is no value, although all is installed

  bool measured() const { return missing.empty() && failed.empty(); }
  bool held() const {
    return bar == Bar::kNone || (bar == Bar::kAtMost ? value <= limit : value >= limit);
  }
};

double median(std::vector<double> values);

/// One heading per place; `headings` describe places ("mps2_an386": "Cortex-M4F ...").
std::string bench_table(const std::vector<BenchRow>& rows, const cli::Json& headings);

cli::Json bench_json(const std::vector<BenchRow>& rows);

/// True if nothing failed and every exact limit holds. Missing programs do not count.
bool bench_held(const std::vector<BenchRow>& rows);

}  // namespace verp::tool
