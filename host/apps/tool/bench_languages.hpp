#pragma once
#include <vector>

#include "host/apps/cli/json.hpp"
#include "host/apps/tool/bench_report.hpp"

namespace verp::tool {

/// A row for one of language_bench's lines, beside what is promised of that language.
void add_language_row(const cli::Json& line, std::vector<BenchRow>& rows);

}  // namespace verp::tool
