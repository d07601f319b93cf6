#pragma once
#include <optional>
#include <string>

#include "host/study/report/plots.hpp"

namespace verp::report {

bool gnuplot_available();

/// SVG to embed: no XML prolog, the page's CSS variables as colours. On failure nullopt; `error` is
/// gnuplot's first line, or how it ended. Throws files::FileError if the script cannot be written.
std::optional<std::string> draw(const Plot& plot, std::string& error);

/// The plot as an SVG file, in light colours on white.
std::optional<std::string> draw_svg(const Plot& plot, std::string& error);

std::optional<std::string> draw_png(const Plot& plot, std::string& error);

}  // namespace verp::report
