#pragma once
#include <limits>
#include <string>
#include <vector>

#include "host/apps/cli/json.hpp"

namespace verp::tool {

enum class Bar { kNone, kAtMost, kAtLeast };

/// One measured cost and its promised limit.
struct BenchRow {
  std::string name;   ///< JSON key, including the unit
  std::string where;  ///< "pc" or a board
  std::string what;   ///< description
  std::string unit;
  double value = 0;
  Bar bar = Bar::kNone;
  double limit = 0;
  bool exact = false;  ///< a count, equal in every run; otherwise a time, which is never judged
  double least = std::numeric_limits<double>::quiet_NaN();  ///< over the repetitions; NaN: none
  double most = std::numeric_limits<double>::quiet_NaN();
  std::string missing = {};  ///< no value: what is not installed
  std::string failed = {};   ///< no value although all is installed: why

  bool measured() const { return missing.empty() && failed.empty(); }
  bool held() const {
    return bar == Bar::kNone || (bar == Bar::kAtMost ? value <= limit : value >= limit);
  }
};

/// `values` must not be empty.
double median(std::vector<double> values);

/// All rows, with one heading per place; `headings` may describe a place ("mps2_an386": "Cortex-M4F
/// ...").
std::string bench_table(const std::vector<BenchRow>& rows, const cli::Json& headings);

cli::Json bench_json(const std::vector<BenchRow>& rows);

/// True if nothing failed and every exact limit holds. Programs that are not installed do not
/// count.
bool bench_held(const std::vector<BenchRow>& rows);

}  // namespace verp::tool
