#pragma once
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/study/report/run_data.hpp"

namespace verp::report {

/// what() is one line with the remedy.
class ReportError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Written {
  std::filesystem::path page;
  /// One line; empty: all plots are there.
  std::string note;
  bool lost = false;  ///< a disk error, not a missing gnuplot
};

/// Is it a file of write_report() or of a map's page (host/study/survey)?
bool is_of_the_report(std::string_view name);

/// Removes an earlier run's files that would appear to be this run's. `files`: written by this run.
void remove_what_is_older(const std::filesystem::path& folder,
                          const std::vector<std::pair<std::string, std::string>>& files);

/// Writes index.html (self-contained) and CSV; creates `folder`. Each file is complete or absent;
/// other files stay. Throws ReportError.
Written write_report(const std::filesystem::path& folder, const Run& run);

}  // namespace verp::report
