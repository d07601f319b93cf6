#pragma once
#include <optional>
#include <string>

#include "host/study/report/plots.hpp"

namespace verp::report {

/// Whether gnuplot can be run here.
bool gnuplot_available();

/// The picture as SVG, ready to stand inside a page: without XML prolog, its colours the page's CSS
/// variables. Nothing when it fails; `error` then holds gnuplot's first line, or
/// how it ended. Throws files::FileError when there is no place for the script.
std::optional<std::string> draw(const Plot& plot, std::string& error);

/// The picture as an SVG file of its own, in the light colours, on white.
std::optional<std::string> draw_svg(const Plot& plot, std::string& error);

/// The picture as PNG in the light colours, on white.
std::optional<std::string> draw_png(const Plot& plot, std::string& error);

}  // namespace verp::report
