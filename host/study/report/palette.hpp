#pragma once

namespace verp::report {

/// Plots use a sentinel colour, which gnuplot.cpp replaces by the CSS variable: one picture suits
/// light and dark pages.
struct Colour {
  const char* variable;
  const char* sentinel;
  const char* light;
  const char* dark;
};

inline constexpr Colour kPalette[] = {
    {"--ink", "#010101", "#22262b", "#e4e7ea"},   // text and outlines
    {"--soft", "#020202", "#d5d8dc", "#3a4149"},  // grid and borders
    {"--s1", "#100001", "#2563a8", "#6ea8e6"},    // series
    {"--s2", "#100002", "#c2571a", "#f0955a"},   {"--s3", "#100003", "#2f8557", "#68c292"},
    {"--s4", "#100004", "#8a4fa3", "#c391da"},   {"--s5", "#100005", "#b08900", "#e0bd4f"},
    {"--s6", "#100006", "#5c6670", "#a9b3bd"},
};
inline constexpr const char* kInk = kPalette[0].sentinel;
inline constexpr const char* kSoft = kPalette[1].sentinel;
inline constexpr const Colour* kSeries = kPalette + 2;
inline constexpr int kSeriesCount = 6;

}  // namespace verp::report
