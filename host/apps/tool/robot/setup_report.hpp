#pragma once
#include <string>

#include "common/model/params.hpp"
#include "host/apps/cli/json.hpp"

namespace verp::tool {

/// Saved after each joint, so that the next run continues there.
class SetupReport {
 public:
  /// Reads `file` if it exists. `writes`: save changes. Throws ToolError for an invalid report,
  /// another robot's, or a failed access.
  SetupReport(std::string file, const Params& params, bool writes);

  bool done(const std::string& joint) const;
  /// The joint's entry; an empty object if there is none.
  cli::Json of(const std::string& joint) const;
  /// On failure prints the entry and throws ToolError.
  void keep(const std::string& joint, const cli::Json& entry);

  const cli::Json& json() const { return json_; }
  const std::string& file() const { return file_; }
  /// The file exists, from any run.
  bool written() const { return written_; }
  std::string text(const Params& params) const;

 private:
  void read(const Params& params);

  std::string file_;
  bool writes_;
  bool written_ = false;
  cli::Json json_;
};

}  // namespace verp::tool
