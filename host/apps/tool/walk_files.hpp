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

/// Checked before a long walk. Throws ToolError.
void make_folder(const std::filesystem::path& folder);

/// A write error before the walk ends the program; a later one is reported and loses only that
/// file.
class WalkFiles {
 public:
  /// Opens the trace. Throws ToolError or TraceError. `listener`: receives the records, also
  /// without a file.
  WalkFiles(const WalkOptions& options, const WalkPlan& plan,
            const record::mcap::StringMap& metadata, record::mcap::Listener* listener = nullptr);

  /// Null without a trace file and a listener.
  record::TraceWriter* trace() { return trace_.get(); }
  bool wants_report() const { return !folder_.empty(); }

  void lose(const std::string& why) { lost_.push_back(why); }

  /// Ends the trace and writes the report, if the user wants them. Locks the folder: two runs must
  /// not mix files. `robot`: for the replay; null: it is read from its file.
  void finish(const WalkResult& result, report::Run run, const model::Entity* robot = nullptr);

  /// Empty until the trace is complete.
  const std::filesystem::path& trace_path() const { return trace_path_; }
  void add_to(cli::Json& json) const;
  std::string text() const;

  /// One line per lost file: what, where, remedy.
  const std::vector<std::string>& lost() const { return lost_; }

 private:
  void open_trace(const WalkOptions& options, const WalkPlan& plan,
                  const record::mcap::StringMap& metadata, record::mcap::Listener* listener);
  void close_trace(const WalkResult& result);
  void lose_trace(const std::string& why);
  void add_replay(report::Run& run, const model::Entity* robot);
  void write_report(report::Run run, const model::Entity* robot);
  bool trace_is_in_folder() const;

  std::filesystem::path folder_, trace_path_;
  std::unique_ptr<record::TraceWriter> trace_;
  std::string page_;
  std::vector<std::string> lost_;
};

}  // namespace verp::tool
