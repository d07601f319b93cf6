#include "host/boards/flash/flasher.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdlib>

#include "host/boards/flash/diagnosis.hpp"
#include "host/boards/flash/flash_error.hpp"
#include "host/boards/flash/images.hpp"
#include "host/boards/flash/tool_run.hpp"
#include "host/os/files/places.hpp"
#include "host/os/files/whole.hpp"
#include "host/os/link/link_error.hpp"
#include "host/os/link/serial_check.hpp"
#include "host/os/process/child.hpp"

namespace verp::flash {
namespace {

using Kind = FlashError::Kind;

Kind kind_of(link::LinkError::Kind kind) {
  switch (kind) {
    case link::LinkError::Kind::kPermission:
      return Kind::kPermission;
    case link::LinkError::Kind::kBusy:
      return Kind::kBusy;
    default:
      return Kind::kNoDevice;
  }
}

/// Exclusive lock on the serial port while this object lives; the tool takes none.
class SerialPortLock {
 public:
  explicit SerialPortLock(const Job& job) {
    if (job.tool != Tool::kStm32flash) return;
    try {
      link::check_serial_port(job.port);
    } catch (const link::LinkError& error) {
      const bool permission = error.kind() == link::LinkError::Kind::kPermission;
      throw FlashError(kind_of(error.kind()),
                       error.what() + (permission ? "; or " + udev_advice(job.tool) : ""));
    }
    descriptor_ = ::open(job.port.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      ::close(descriptor_);
      throw FlashError(Kind::kBusy,
                       fmt::format("{0}: another program has it open; end that, fuser -v {0} names "
                                   "it",
                                   job.port));
    }
  }
  ~SerialPortLock() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  SerialPortLock(const SerialPortLock&) = delete;
  SerialPortLock& operator=(const SerialPortLock&) = delete;

 private:
  int descriptor_ = -1;
};

void run_step(const Job& job, const Step& step, const FlashHooks& hooks) {
  hooks.progress(step, 0);
  const ToolHooks tool_hooks{.share = [&](double share) { hooks.progress(step, share); },
                             .stop = hooks.stop};
  const ToolRun run = run_tool(step.command, name_of(job.tool), tool_hooks);
  if (run.interrupted) {
    throw FlashError(Kind::kInterrupted,
                     fmt::format("{}: interrupted while {}{}", job.recipe.board, step.label,
                                 step.kind == Step::Kind::kWrite
                                     ? "; the flash is not to be used before it is flashed again"
                                     : "; nothing is half written"));
  }
  if (run.status != 0) throw diagnose(job, step, run.output);
  if (step.kind == Step::Kind::kCheckChip) check_chip(job, run.output);
  std::error_code error;
  if (step.bytes > 0 && std::filesystem::file_size(step.file, error) != step.bytes) {
    throw FlashError(Kind::kOther,
                     fmt::format("{}: {}: {} did not read {} bytes; its last words: {}",
                                 job.recipe.board, step.file.string(), name_of(job.tool),
                                 step.bytes, process::last_line(run.output)));
  }
}

/// After a failed write: saves the sector's other contents. Returns the message.
std::string keep(const Step& step) {
  const std::string sector = files::read(step.file).value_or("");
  std::string told;
  for (const Piece& piece : step.neighbours) {
    const std::size_t offset = piece.region.begin - step.sectors.begin;
    if (offset >= sector.size()) continue;
    const std::string bytes = sector.substr(offset, piece.region.bytes);
    if (bytes.find_first_not_of('\xFF') == bytes.npos) continue;
    const bool kept =
        std::filesystem::exists(piece.file) || !files::create(piece.file, bytes).any();
    told += kept ? fmt::format(", and with it --{} {}", piece.what, piece.file.string())
                 : fmt::format(", and with --{}, which was lost: {} cannot be written", piece.what,
                               piece.file.string());
  }
  return told;
}

}  // namespace

void run(const Job& job, const std::vector<Step>& steps, const FlashHooks& hooks) {
  const SerialPortLock port(job);
  for (const Step& step : steps) {
    try {
      run_step(job, step, hooks);
    } catch (const FlashError& error) {
      if (step.neighbours.empty()) throw;
      throw FlashError(error.kind(), error.what() + keep(step));
    }
  }
  std::error_code error;  // an earlier run's; obsolete
  std::filesystem::remove(job.folder / "kept_params.bin", error);
  std::filesystem::remove(job.folder / kKeptActions, error);
}

std::filesystem::path work_root() {
  const char* folder = std::getenv("VERP_FLASH_DIR");
  return folder != nullptr ? std::filesystem::absolute(folder)
                           : files::source_dir() / "build" / "flash";
}

Workspace::Workspace(const std::string& board) : path_(work_root() / board) {
  std::error_code error;
  std::filesystem::create_directories(path_, error);
  lock_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (error || lock_ < 0 || ::access(path_.c_str(), W_OK) != 0) {
    throw FlashError(
        Kind::kUsage,
        path_.string() + ": cannot be written; set VERP_FLASH_DIR to a folder of yours");
  }
  if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    throw FlashError(Kind::kBusy,
                     fmt::format("{}: another verp flash is at work for this board; wait for its "
                                 "end, or set VERP_FLASH_DIR to another folder for a second board",
                                 path_.string()));
  }
  for (const auto& entry : std::filesystem::directory_iterator(path_, error)) {
    const bool kept = entry.path().filename().string().starts_with("kept_");
    if (!kept) std::filesystem::remove(entry.path(), error);
  }
}

void Workspace::hand_over() const {
  ::fcntl(lock_, F_SETFD, 0);  // stays open and locked after exec
}

Workspace::~Workspace() {
  if (lock_ >= 0) ::close(lock_);
}

}  // namespace verp::flash
