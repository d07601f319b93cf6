#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "host/apps/cli/json.hpp"
#include "host/apps/tool/walk_options.hpp"
#include "host/apps/tool/walk_run.hpp"
#include "host/study/report/run_data.hpp"
#include "host/trace/record/trace_writer.hpp"

namespace verp::tool {

/// A folder into which a file can be put: known now, not after a long walk. Throws ToolError.
void make_folder(const std::filesystem::path& folder);

/// What a walk leaves on the disk: a trace and a report. What the disk refuses before the walk ends
/// the program; what it refuses later costs that file, is told, and never costs the walk's result.
class WalkFiles {
 public:
  /// Makes the folder, opens the trace. Throws ToolError or TraceError when there is no place.
  /// `listener` hears what the trace is given, be there a file or none.
  WalkFiles(const WalkOptions& options, const WalkPlan& plan,
            const record::mcap::StringMap& metadata, record::mcap::Listener* listener = nullptr);

  /// Null when none is wanted, and nobody listens.
  record::TraceWriter* trace() { return trace_.get(); }
  bool wants_report() const { return !folder_.empty(); }

  /// Something that was wanted is not there, and why.
  void lose(const std::string& why) { lost_.push_back(why); }

  /// Ends the trace and writes the report, if they are wanted, in one go: of two runs into one
  /// folder, the files of one stand there, not some of each.
  void finish(const WalkResult& result, report::Run run);

  /// The trace, if it is whole; empty: there is none.
  const std::filesystem::path& trace_path() const { return trace_path_; }
  void add_to(cli::Json& json) const;
  std::string text() const;

  /// One line for each thing that was wanted and is not there: what, where, how to get it back.
  const std::vector<std::string>& lost() const { return lost_; }

 private:
  void open_trace(const WalkOptions& options, const WalkPlan& plan,
                  const record::mcap::StringMap& metadata, record::mcap::Listener* listener);
  void close_trace(const WalkResult& result);
  void lose_trace(const std::string& why);
  void add_replay(report::Run& run);
  void write_report(report::Run run);
  bool trace_is_in_folder() const;

  std::filesystem::path folder_, trace_path_;
  std::unique_ptr<record::TraceWriter> trace_;
  std::string page_;
  std::vector<std::string> lost_;
};

}  // namespace verp::tool
