#pragma once
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "host/show/camera/drawing_program.hpp"
#include "host/show/camera/wire.hpp"

namespace verp::camera {

/// Draws a moment on request and waits for the picture, for callers that look into a run now and
/// then. Works on any thread, one call at a time. A run that keeps all its pictures uses a Rig,
/// which draws while the run goes on.
class Painter {
 public:
  using Seconds = DrawingProgram::Seconds;

  /// Starts `program` and waits until it can draw. Throws CameraError. `patience` only ends a
  /// program that hangs: a busy PC may need minutes for a picture.
  Painter(const std::filesystem::path& program, const Stage& stage, Seconds patience = Seconds(600))
      : program_(std::make_unique<DrawingProgram>(program, stage, DrawingProgram::Life::kOfSocket,
                                                  patience)) {}

  /// One picture, with depth two, from each camera of moment.robot that looks in this moment.
  /// Throws CameraError if the program has ended or does not answer; the painter is then useless.
  std::vector<Picture> look(const Moment& moment);
  /// A picture from outside, rgb8. Also throws std::invalid_argument if there is no such view.
  Picture look(const Moment& moment, const Outside& from);
  /// True while the painter can be asked again.
  bool works() const { return program_ != nullptr; }

 private:
  std::vector<Picture> ask(Kind kind, std::string_view data);
  [[noreturn]] void fail();

  std::unique_ptr<DrawingProgram> program_;
};

}  // namespace verp::camera
