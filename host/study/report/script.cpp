#include "host/study/report/script.hpp"

#include <cctype>

#include "host/study/report/palette.hpp"

namespace verp::report {

std::string preamble() {
  std::string text = fmt::format(
      "set border 3 linecolor rgb '{}' linewidth 1\n"
      "set tics nomirror textcolor rgb '{}' scale 0.5\n"
      "set grid linecolor rgb '{}' linewidth 0.6 dashtype solid\n"
      "set xlabel textcolor rgb '{}'\nset ylabel textcolor rgb '{}'\nset title textcolor rgb '{}'\n"
      "set key textcolor rgb '{}' samplen 1.5 spacing 1.1 noenhanced Left reverse\n",
      kSoft, kInk, kSoft, kInk, kInk, kInk, kInk);
  for (int i = 0; i < kSeriesCount; ++i) {
    text +=
        fmt::format("set linetype {} linecolor rgb '{}' linewidth 1.8 pointtype 7 pointsize 0.35\n",
                    i + 1, kSeries[i].sentinel);
  }
  return text;
}

std::string plain(const std::string& name) {
  std::string out;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-') out += c;
  }
  return out;
}

}  // namespace verp::report
