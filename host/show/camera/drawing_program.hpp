#pragma once
#include <chrono>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "host/os/process/child.hpp"
#include "host/show/camera/wire.hpp"

namespace verp::camera {

/// The drawing program is missing, has ended, or lacks OpenGL or a file.
class CameraError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// VERP_CAMERA_PROGRAM, else the installed libexec/verp, else the build tree.
std::filesystem::path find_program();

/// The drawing program and our end of its socket. Only it uses OpenGL: the caller survives a
/// driver's crash.
class DrawingProgram {
 public:
  enum class Life {
    kOfThread,  ///< ends with its starting thread: use the main thread
    kOfSocket   ///< ends when the socket closes: any thread
  };
  using Seconds = std::chrono::seconds;
  /// Waits until it can draw. Throws CameraError. `patience`: 0: no limit.
  DrawingProgram(const std::filesystem::path& program, const Stage& stage,
                 Life life = Life::kOfThread, Seconds patience = Seconds(0));
  ~DrawingProgram();
  DrawingProgram(const DrawingProgram&) = delete;
  DrawingProgram& operator=(const DrawingProgram&) = delete;

  int socket() const { return socket_; }
  /// Lowest priority: a run in real time must not wait for it.
  void step_back();
  pid_t process() const { return child_->id(); }
  /// Call it for a silent socket, errno set. Ends the program; returns whether it hung or had
  /// ended.
  std::string end();

 private:
  Seconds patience_;
  int socket_ = -1;
  std::unique_ptr<process::Child> child_;
};

}  // namespace verp::camera
