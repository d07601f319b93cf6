#pragma once
#include <string>
#include <vector>

#include "host/study/report/run_data.hpp"

/// The pictures of a report as gnuplot scripts with their data inside.
namespace verp::report {

/// A script plots to stdout in a terminal that is already set, `width` by `height` pixels.
struct Plot {
  std::string id, title, caption;
  int width = 0, height = 0;
  std::string script;
};

/// Those plots of the page the run has data for.
std::vector<Plot> plots(const Run& run);

}  // namespace verp::report
