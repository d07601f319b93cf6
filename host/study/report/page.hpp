#pragma once
#include <string>
#include <utility>
#include <vector>

#include "host/study/report/plots.hpp"

namespace verp::report {

struct Picture {
  Plot plot;
  std::string svg;
};

/// No scripts, no external files, light and dark. `note`: why pictures are missing; `files`: those
/// beside the page, with their contents.
std::string page(const Run& run, const std::vector<Picture>& pictures, const std::string& note,
                 const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace verp::report
