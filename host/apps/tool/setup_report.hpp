#pragma once
#include <string>

#include "common/model/params.hpp"
#include "host/apps/cli/json.hpp"

namespace verp::tool {

/// What `verp bus setup` did to each joint's servo, kept in a file from joint to joint, so that the
/// next run goes on where this one ended.
class SetupReport {
 public:
  /// Reads `file` if it is there; `writes`: it is kept up to date, and there is room for it. Throws
  /// ToolError if it is of another robot, no such report, or can't be read or written.
  SetupReport(std::string file, const Params& params, bool writes);

  /// That joint needs no more: nothing is left to do for a person.
  bool done(const std::string& joint) const;
  /// What is known of the joint; nothing: an empty object.
  cli::Json of(const std::string& joint) const;
  /// Keeps `entry` for the joint; if the file can't be written, prints the entry and throws
  /// ToolError.
  void keep(const std::string& joint, const cli::Json& entry);

  const cli::Json& json() const { return json_; }
  const std::string& file() const { return file_; }
  /// The file is there, as this report or an earlier one.
  bool written() const { return written_; }
  /// One line for each joint of the robot.
  std::string text(const Params& params) const;

 private:
  void read(const Params& params);

  std::string file_;
  bool writes_;
  bool written_ = false;
  cli::Json json_;
};

}  // namespace verp::tool
