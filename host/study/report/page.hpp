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

/// The complete page: no scripts, no external files, light and dark. `note` is shown if pictures
/// are missing; `files` lists the files beside the page and their contents.
std::string page(const Run& run, const std::vector<Picture>& pictures, const std::string& note,
                 const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace verp::report
