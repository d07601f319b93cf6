#include "host/apps/tool/walk_files.hpp"

#include <fmt/format.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/os/files/folder_lock.hpp"
#include "host/os/files/shell_line.hpp"
#include "host/os/files/whole.hpp"
#include "host/show/web/replay_page.hpp"
#include "host/study/report/files.hpp"
#include "host/study/report/report.hpp"
#include "host/trace/record/trace_error.hpp"

namespace verp::tool {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTraceName = "run.mcap";

/// Command line without the folder of its program.
std::string words_of(int process) {
  std::string words = files::read(fmt::format("/proc/{}/cmdline", process)).value_or("");
  if (!words.empty()) words.pop_back();
  std::replace(words.begin(), words.end(), '\0', ' ');
  return words.substr(words.rfind('/', words.find(' ')) + 1);
}

/// The last to end would overwrite the other's trace.
void refuse_second_recorder(const std::string& command, const fs::path& file) {
  const int first = record::mcap::writer_of(file);
  if (first == 0) return;
  const std::string words = words_of(first);
  throw cli::ToolError(
      cli::kBadInput,
      fmt::format("{}: {}: process {}{} is recording to it; wait for its end, "
                  "or name another file with --record",
                  command, file.string(), first, words.empty() ? "" : " (" + words + ")"));
}

}  // namespace

void make_folder(const fs::path& folder) {
  report::make_folder(folder, "--report");
  std::string probe = (folder / ".verp-XXXXXX").string();
  const int descriptor = ::mkstemp(probe.data());
  if (descriptor < 0) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("{}: nothing can be written there ({}); choose another "
                                     "folder with --report",
                                     folder.string(), std::strerror(errno)));
  }
  ::close(descriptor);
  ::unlink(probe.c_str());
}

WalkFiles::WalkFiles(const WalkOptions& options, const WalkPlan& plan,
                     const record::mcap::StringMap& metadata, record::mcap::Listener* listener)
    : folder_(options.report_folder) {
  if (wants_report()) make_folder(folder_);
  if (!options.record_file.empty()) {
    trace_path_ = options.record_file;
  } else if (wants_report()) {
    trace_path_ = folder_ / kTraceName;
  }
  if (!trace_path_.empty() || listener != nullptr) open_trace(options, plan, metadata, listener);
}

void WalkFiles::open_trace(const WalkOptions& options, const WalkPlan& plan,
                           const record::mcap::StringMap& metadata,
                           record::mcap::Listener* listener) {
  if (trace_is_in_folder() && report::is_of_the_report(trace_path_.filename().string())) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("{}: the report has a file of that name; choose another "
                                     "with --record, such as run.mcap",
                                     trace_path_.string()));
  }
  std::optional<files::FolderLock> lock;  // runs that start together check in turn
  if (!options.record_file.empty()) {
    lock.emplace(trace_path_.has_parent_path() ? trace_path_.parent_path() : ".");
    refuse_second_recorder(options.command, trace_path_);
  }
  trace_ = std::make_unique<record::TraceWriter>(
      trace_path_, plan.params, metadata,
      record::TraceOptions{.every_state = options.record_state,
                           .actions = plan.actions,
                           .compress = options.compress,
                           .listener = listener});
}

bool WalkFiles::trace_is_in_folder() const {
  if (folder_.empty()) return false;
  std::error_code error;
  const fs::path beside = fs::weakly_canonical(fs::absolute(trace_path_, error), error);
  return beside.parent_path() == fs::weakly_canonical(fs::absolute(folder_ / ".", error), error);
}

void WalkFiles::finish(const WalkResult& result, report::Run run, const model::Entity* robot) {
  std::optional<files::FolderLock> lock;
  if (wants_report()) lock.emplace(folder_);
  if (trace_) close_trace(result);
  if (wants_report()) write_report(std::move(run), robot);
}

void WalkFiles::close_trace(const WalkResult& result) {
  try {
    if (!result.trace_failure.empty()) return lose_trace(result.trace_failure);
    trace_->close({{"digest", fmt::format("0x{:016x}", result.digest)},
                   {"failure", result.failure},
                   {"interrupted", result.interrupted ? "yes" : "no"}});
  } catch (const record::TraceError& error) {
    lose_trace(error.what());
  }
  trace_.reset();
}

void WalkFiles::lose_trace(const std::string& why) {
  const std::string name = trace_path_.string(), part = trace_->part_path().string();
  if (trace_->safe_ticks() > 0) {
    lost_.push_back(fmt::format(
        "{}: the trace breaks off: {}; `verp trace recover {} -o {}` gives what is there", name,
        why, files::shell_word(part), files::shell_word(name)));
  } else {
    trace_->discard();
    lost_.push_back(fmt::format("{}: no trace: {}", name, why));
  }
  trace_.reset();
  trace_path_.clear();
}

void WalkFiles::add_replay(report::Run& run, const model::Entity* robot) {
  if (trace_path_.empty()) return;
  try {
    web::Replay replay = web::replay_of(trace_path_, robot);
    run.replay_html = std::move(replay.html);
    if (!replay.note.empty()) cli::complain(replay.note);
  } catch (const record::TraceError&) {  // a walk without ticks
  }
}

void WalkFiles::write_report(report::Run run, const model::Entity* robot) {
  add_replay(run, robot);
  std::error_code ignored;
  if (!trace_path_.empty() && trace_is_in_folder()) {
    run.trace_file = trace_path_.filename().string();
  } else {
    fs::remove(folder_ / kTraceName, ignored);  // of an earlier run
  }
  try {
    const report::Written written = report::write_report(folder_, run);
    page_ = written.page.string();
    if (written.lost) {
      lost_.push_back(written.note);
    } else if (!written.note.empty()) {
      cli::complain(written.note);
    }
  } catch (const report::ReportError& error) {
    lost_.push_back(fmt::format("{}: the report is not whole: {}", folder_.string(), error.what()));
  }
}

void WalkFiles::add_to(cli::Json& json) const {
  if (!page_.empty()) json["report"] = page_;
  if (!trace_path_.empty()) json["trace"] = trace_path_.string();
  if (!lost_.empty()) json["lost"] = lost_;
}

std::string WalkFiles::text() const {
  std::string out;
  if (!page_.empty()) out += fmt::format("  {:<18}{}\n", "report", page_);
  if (!trace_path_.empty()) out += fmt::format("  {:<18}{}\n", "trace", trace_path_.string());
  return out;
}

}  // namespace verp::tool
