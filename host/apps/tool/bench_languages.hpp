#pragma once
#include <vector>

#include "host/apps/cli/json.hpp"
#include "host/apps/tool/bench_report.hpp"

namespace verp::tool {

/// Row of one language_bench line, with its promise.
void add_language_row(const cli::Json& line, std::vector<BenchRow>& rows);

}  // namespace verp::tool
