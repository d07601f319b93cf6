#include "host/show/camera/drawing_program.hpp"

#include <dlfcn.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "host/os/files/places.hpp"

namespace verp::camera {
namespace {

namespace fs = std::filesystem;

std::unique_ptr<process::Child> start(const fs::path& program, int socket, bool with_thread) {
  try {
    return std::make_unique<process::Child>(
        process::Command{.words = {program.string()},
                         .input = {.descriptor = socket},
                         .output = {},
                         .error = process::Stream{.descriptor = STDERR_FILENO},
                         .ends_with_thread = with_thread});
  } catch (const std::system_error& error) {
    throw CameraError(
        "cameras: the program that draws, " + program.string() + ", cannot be started (" +
        error.code().message() +
        "): `ninja -C build/host-release verp_camera` builds it, the package verp has "
        "it, and VERP_CAMERA_PROGRAM says where another is");
  }
}

}  // namespace

fs::path find_program() {
  const char* named = std::getenv("VERP_CAMERA_PROGRAM");
  if (named != nullptr && *named != '\0') return named;
  Dl_info own = {};
  dladdr(reinterpret_cast<void*>(&find_program), &own);
  for (const char* file : {own.dli_fname, "/proc/self/exe"}) {
    std::error_code ignored;
    fs::path folder = file == nullptr ? fs::path() : fs::canonical(file, ignored).parent_path();
    if (folder.string().starts_with(files::build_dir().string())) break;  // not installed
    // PREFIX/bin, PREFIX/lib or PREFIX/lib/ARCHITECTURE.
    for (int up = 0; up < 3 && folder.has_relative_path(); ++up, folder = folder.parent_path()) {
      fs::path installed = folder / "libexec/verp/verp_camera";
      if (fs::exists(installed, ignored)) return installed;
    }
  }
  return files::build_dir() / "host/show/camera/program/verp_camera";
}

DrawingProgram::DrawingProgram(const fs::path& program, const Stage& stage, Life life,
                               Seconds patience)
    : patience_(patience) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw std::system_error(errno, std::generic_category(), "socketpair");
  socket_ = ends[0];
  const timeval time{.tv_sec = patience.count(), .tv_usec = 0};
  for (const int direction : {SO_RCVTIMEO, SO_SNDTIMEO})
    ::setsockopt(socket_, SOL_SOCKET, direction, &time, sizeof time);
  try {
    child_ = start(program, ends[1], life == Life::kOfThread);
    ::close(std::exchange(ends[1], -1));
    send(socket_, Kind::kStage, pack(stage));
    errno = 0;
    const std::optional<Message> answer = receive(socket_);
    if (answer && answer->kind == Kind::kReady) return;
    throw CameraError("cameras: " + (answer ? answer->data : end()));
  } catch (...) {
    if (ends[1] >= 0) ::close(ends[1]);
    ::close(socket_);
    throw;
  }
}

DrawingProgram::~DrawingProgram() {
  ::close(socket_);
}

void DrawingProgram::step_back() {
  constexpr int kLastOfAll = 19;
  // The whole group, because a process id means only its first thread. This cannot fail: every user
  // may lower a priority.
  ::setpriority(PRIO_PGRP, static_cast<id_t>(process()), kLastOfAll);
}

std::string DrawingProgram::end() {
  constexpr int kSignals = 128, kMost_ms = 1000;
  if (errno == EAGAIN || errno == EWOULDBLOCK) {
    child_->tell(SIGKILL);
    return "their program has not answered for " + std::to_string(patience_.count()) +
           " s, and is ended";
  }
  for (int ms = 0; ms < kMost_ms && !child_->status(); ++ms)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const int status = child_->status().value_or(kSignals);
  if (status == kSignals) child_->tell(SIGKILL);
  return "their program has ended, " +
         (status > kSignals    ? "killed by signal " + std::to_string(status - kSignals)
          : status == kSignals ? "for it said what nobody expects"
                               : "with status " + std::to_string(status)) +
         "; what it said is above";
}

}  // namespace verp::camera
