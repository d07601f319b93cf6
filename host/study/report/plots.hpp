#pragma once
#include <string>
#include <vector>

#include "host/study/report/run_data.hpp"

namespace verp::report {

/// Plots to stdout; the caller sets the terminal, `width` by `height` pixels.
struct Plot {
  std::string id, title, caption;
  int width = 0, height = 0;
  std::string script;
};

std::vector<Plot> plots(const Run& run);

}  // namespace verp::report
