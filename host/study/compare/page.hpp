#pragma once
#include <filesystem>
#include <string>

#include "host/study/compare/compare.hpp"

namespace verp::compare {

struct WrittenPage {
  std::filesystem::path page;
  std::string note;  ///< why pictures are missing; empty: all are there
};

/// Writes index.html, compare.png, joints.csv and angles.csv into `folder`, created if missing.
/// Throws report::ReportError.
WrittenPage write_page(const std::filesystem::path& folder, const record::Trace& a,
                       const record::Trace& b, const Comparison& comparison);

}  // namespace verp::compare
