#pragma once
#include <string>

#include "common/model/params.hpp"
#include "host/apps/cli/json.hpp"

namespace verp::tool {

/// Records, in a file, what `verp bus setup` did to each joint's servo. It is saved after each
/// joint, so that the next run continues there.
class SetupReport {
 public:
  /// Reads `file` if it exists. `writes`: save changes; requires room on the disk. Throws ToolError
  /// if the report is invalid, is of another robot, or cannot be read or written.
  SetupReport(std::string file, const Params& params, bool writes);

  /// The joint is complete: the user need not do anything more.
  bool done(const std::string& joint) const;
  /// The joint's entry; an empty object if there is none.
  cli::Json of(const std::string& joint) const;
  /// Saves `entry` for the joint. If the file cannot be written, prints the entry and throws
  /// ToolError.
  void keep(const std::string& joint, const cli::Json& entry);

  const cli::Json& json() const { return json_; }
  const std::string& file() const { return file_; }
  /// The file exists, from this run or an earlier one.
  bool written() const { return written_; }
  /// One line per joint of the robot.
  std::string text(const Params& params) const;

 private:
  void read(const Params& params);

  std::string file_;
  bool writes_;
  bool written_ = false;
  cli::Json json_;
};

}  // namespace verp::tool
