#pragma once
#include <vector>

#include "host/apps/cli/json.hpp"
#include "host/apps/tool/study/bench_report.hpp"

namespace verp::tool {

/// Adds the row of one line of language_bench, with its promise.
void add_language_row(const cli::Json& line, std::vector<BenchRow>& rows);

}  // namespace verp::tool
