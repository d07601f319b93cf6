#pragma once
#include <filesystem>
#include <string>

#include "host/study/compare/compare.hpp"

namespace verp::compare {

struct WrittenPage {
  std::filesystem::path page;
  std::string note;  ///< why pictures are missing; empty: none is
};

/// Writes index.html, compare.png, joints.csv and angles.csv into `folder`, which is made if need
/// be. Throws report::ReportError.
WrittenPage write_page(const std::filesystem::path& folder, const record::Trace& a,
                       const record::Trace& b, const Comparison& comparison);

}  // namespace verp::compare
