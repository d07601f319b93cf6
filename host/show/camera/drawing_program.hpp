#pragma once
#include <chrono>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "host/os/process/child.hpp"
#include "host/show/camera/wire.hpp"

namespace verp::camera {

/// The program that draws is not there, finds no OpenGL or a file that it cannot read, or has
/// ended: one line for people.
class CameraError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Where it is: as VERP_CAMERA_PROGRAM says; else in libexec/verp of the folder that this program
/// or library is installed in; else in the build tree.
std::filesystem::path find_program();

/// The program that draws, ready to, and this end of the socket to it. OpenGL is in there alone, so
/// that whoever asks for pictures needs none, and outlives a driver's crash.
class DrawingProgram {
 public:
  enum class Life {
    kOfThread,  ///< it ends with the thread that started it: make it on the main one
    kOfSocket   ///< it ends once nobody has the socket's end: for any thread
  };
  using Seconds = std::chrono::seconds;
  /// Starts it and waits until it can draw. Throws CameraError. The socket waits so long for it; 0:
  /// for ever.
  DrawingProgram(const std::filesystem::path& program, const Stage& stage,
                 Life life = Life::kOfThread, Seconds patience = Seconds(0));
  ~DrawingProgram();
  DrawingProgram(const DrawingProgram&) = delete;
  DrawingProgram& operator=(const DrawingProgram&) = delete;

  int socket() const { return socket_; }
  /// From now on whoever else wants a core comes first: a run that keeps real time must not wait
  /// for one on which its pictures are drawn.
  void step_back();
  pid_t process() const { return child_->id(); }
  /// Nothing came from the socket, as errno has it: ends the program if it still runs, and says
  /// which of both it was.
  std::string end();

 private:
  Seconds patience_;
  int socket_ = -1;
  std::unique_ptr<process::Child> child_;
};

}  // namespace verp::camera
