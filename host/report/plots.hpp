#pragma once
#include <string>
#include <vector>

#include "host/report/csv.hpp"
#include "host/report/run_data.hpp"

/// The pictures of a report as gnuplot scripts with their data inside.
namespace verp::report {

/// Colours that stand for the page's CSS variables (gnuplot.cpp replaces them), so that one picture
/// suits a light and a dark page.
inline constexpr const char* kInk = "#010101";
inline constexpr const char* kSoft = "#020202";  ///< grid and outlines
inline constexpr const char* kSeries[6] = {"#100001", "#100002", "#100003",
                                           "#100004", "#100005", "#100006"};

struct Plot {
  std::string id, title, caption, script;
};

/// Those plots the run has data for.
std::vector<Plot> plots(const Run& run);

}  // namespace verp::report
