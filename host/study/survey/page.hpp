#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "host/study/report/plots.hpp"
#include "host/study/report/run_data.hpp"

namespace verp::survey {

struct Page {
  std::string title, verdict;
  bool good = true;
  std::vector<report::Fact> facts;
  std::vector<report::Plot> plots;  ///< the first one is also map.png
  std::string csv;                  ///< map.csv
  std::vector<std::pair<std::string, std::string>> changed, provenance;
};

struct WrittenPage {
  std::filesystem::path page;
  std::string note;  ///< why pictures are missing; or empty
};

/// Writes index.html, map.png and map.csv; creates `folder`; removes an earlier walk report there.
/// Throws report::ReportError.
WrittenPage write_page(const std::filesystem::path& folder, const Page& page);

}  // namespace verp::survey
