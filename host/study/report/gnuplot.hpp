#pragma once
#include <optional>
#include <string>

#include "host/study/report/plots.hpp"

namespace verp::report {

bool gnuplot_available();

/// The plot as SVG for embedding in a page: no XML prolog, colours as the page's CSS variables. On
/// failure nullopt; `error` is gnuplot's first line, or how it ended. Throws files::FileError if
/// the script cannot be written.
std::optional<std::string> draw(const Plot& plot, std::string& error);

/// The plot as an SVG file, in light colours on white.
std::optional<std::string> draw_svg(const Plot& plot, std::string& error);

/// The plot as PNG, in light colours on white.
std::optional<std::string> draw_png(const Plot& plot, std::string& error);

}  // namespace verp::report
