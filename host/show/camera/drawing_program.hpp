#pragma once
#include <chrono>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "host/os/process/child.hpp"
#include "host/show/camera/wire.hpp"

namespace verp::camera {

/// The drawing program is missing, finds no OpenGL, cannot read a file, or has ended; the message
/// is one line.
class CameraError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Path of the drawing program: VERP_CAMERA_PROGRAM if set; else libexec/verp where this program or
/// library is installed; else the build tree.
std::filesystem::path find_program();

/// The drawing program, ready, with this end of its socket. Only that program uses OpenGL, so the
/// caller needs none and survives a driver's crash.
class DrawingProgram {
 public:
  enum class Life {
    kOfThread,  ///< ends with the thread that started it: create it on the main thread
    kOfSocket   ///< ends when the socket closes: for any thread
  };
  using Seconds = std::chrono::seconds;
  /// Starts it and waits until it can draw. Throws CameraError. `patience` is the socket's time
  /// limit; 0: no limit.
  DrawingProgram(const std::filesystem::path& program, const Stage& stage,
                 Life life = Life::kOfThread, Seconds patience = Seconds(0));
  ~DrawingProgram();
  DrawingProgram(const DrawingProgram&) = delete;
  DrawingProgram& operator=(const DrawingProgram&) = delete;

  int socket() const { return socket_; }
  /// Gives the program the lowest priority, so that a run in real time never waits for a core that
  /// draws its pictures.
  void step_back();
  pid_t process() const { return child_->id(); }
  /// Call it when the socket gave nothing and errno says why. Ends the program if it still runs,
  /// and returns whether it hung or had ended.
  std::string end();

 private:
  Seconds patience_;
  int socket_ = -1;
  std::unique_ptr<process::Child> child_;
};

}  // namespace verp::camera
