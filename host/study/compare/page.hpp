#pragma once
#include <filesystem>
#include <string>

#include "host/study/compare/compare.hpp"

namespace verp::compare {

struct WrittenPage {
  std::filesystem::path page;
  std::string note;  ///< why pictures are missing; or empty
};

/// Writes index.html, compare.png, joints.csv and angles.csv; creates `folder`. Throws
/// report::ReportError.
WrittenPage write_page(const std::filesystem::path& folder, const record::Trace& a,
                       const record::Trace& b, const Comparison& comparison);

}  // namespace verp::compare
