#pragma once
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/study/report/run_data.hpp"

namespace verp::report {

/// The folder cannot be written; what() is one line with the remedy.
class ReportError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Written {
  std::filesystem::path page;
  /// One line the reader should know: that plots are missing and why; empty: nothing.
  std::string note;
  bool lost = false;  ///< they are missing because the disk refused, not for want of gnuplot
};

/// Whether write_report(), or a map's page (host/study/survey), writes a file of that name.
bool is_of_the_report(std::string_view name);

/// Removes those files that an earlier run left in this folder and this run has none of: they would
/// be taken for its own. `files`: what it wrote, with what they hold.
void remove_what_is_older(const std::filesystem::path& folder,
                          const std::vector<std::pair<std::string, std::string>>& files);

/// Writes index.html (self-contained, plots inside) and the numbers as CSV into `folder`, which is
/// made if need be. Each file appears whole or not at all; other files in the folder stay. Throws
/// ReportError.
Written write_report(const std::filesystem::path& folder, const Run& run);

}  // namespace verp::report
