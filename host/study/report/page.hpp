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

/// The whole page: no scripts, no files beside it, light and dark. `note` is shown where pictures
/// are missing; `files` are names beside the page with what they hold.
std::string page(const Run& run, const std::vector<Picture>& pictures, const std::string& note,
                 const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace verp::report
