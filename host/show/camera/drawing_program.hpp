#pragma once
#include <chrono>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "host/os/process/child.hpp"
#include "host/show/camera/wire.hpp"

namespace verp::camera {

/// The drawing program is missing, has ended, or lacks OpenGL or a file; one line.
class CameraError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// VERP_CAMERA_PROGRAM if set; else libexec/verp where this program or library is installed; else
/// the build tree.
std::filesystem::path find_program();

/// The running drawing program and this end of its socket. Only that program uses OpenGL, so the
/// caller needs none and survives a driver's crash.
class DrawingProgram {
 public:
  enum class Life {
    kOfThread,  ///< ends with its starting thread: create it on the main thread
    kOfSocket   ///< ends when the socket closes: for any thread
  };
  using Seconds = std::chrono::seconds;
  /// Starts it and waits until it can draw. Throws CameraError. `patience`: the socket's time
  /// limit; 0: none.
  DrawingProgram(const std::filesystem::path& program, const Stage& stage,
                 Life life = Life::kOfThread, Seconds patience = Seconds(0));
  ~DrawingProgram();
  DrawingProgram(const DrawingProgram&) = delete;
  DrawingProgram& operator=(const DrawingProgram&) = delete;

  int socket() const { return socket_; }
  /// Sets the lowest priority: a run in real time must not wait for a core that draws its pictures.
  void step_back();
  pid_t process() const { return child_->id(); }
  /// For a socket that gave nothing, with errno set. Ends the program; returns whether it hung or
  /// had ended.
  std::string end();

 private:
  Seconds patience_;
  int socket_ = -1;
  std::unique_ptr<process::Child> child_;
};

}  // namespace verp::camera
