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
  /// Why plots are missing, in one line; empty: all are there.
  std::string note;
  bool lost = false;  ///< plots are missing because of a disk error, not because gnuplot is missing
};

/// Whether write_report() or a map's page (host/study/survey) writes a file of that name.
bool is_of_the_report(std::string_view name);

/// Removes an earlier run's report files that this run did not write and that would appear to be
/// its own. `files`: the written names and their contents.
void remove_what_is_older(const std::filesystem::path& folder,
                          const std::vector<std::pair<std::string, std::string>>& files);

/// Writes index.html (self-contained, with plots) and the numbers as CSV into `folder`, created if
/// missing. Each file appears complete or not at all; other files stay. Throws ReportError.
Written write_report(const std::filesystem::path& folder, const Run& run);

}  // namespace verp::report
