#pragma once
#include <optional>
#include <string>

namespace verp::report {

/// Whether gnuplot can be run here.
bool gnuplot_available();

/// Runs a script that plots to stdout in the svg terminal and returns the picture, ready to stand
/// inside a page: without XML prolog, the sentinel colours of plots.hpp replaced by the page's CSS
/// variables. Empty when gnuplot fails; `error` then holds its first line.
std::optional<std::string> draw(const std::string& script, std::string& error);

}  // namespace verp::report
