#pragma once
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "host/show/camera/drawing_program.hpp"
#include "host/show/camera/wire.hpp"

namespace verp::camera {

/// Draws a moment on request and waits for the picture. A run that keeps all its pictures uses a
/// Rig, which draws meanwhile. Works on any thread, one call at a time.
class Painter {
 public:
  using Seconds = DrawingProgram::Seconds;

  /// Starts `program` and waits until it can draw. Throws CameraError. `patience` only ends a
  /// program that hangs: a busy PC may need minutes for a picture.
  Painter(const std::filesystem::path& program, const Stage& stage, Seconds patience = Seconds(600))
      : program_(std::make_unique<DrawingProgram>(program, stage, DrawingProgram::Life::kOfSocket,
                                                  patience)) {}

  /// One picture, with depth two, per camera of moment.robot that looks. Throws CameraError if the
  /// program has ended or does not answer; the painter is then useless.
  std::vector<Picture> look(const Moment& moment);
  /// From outside, rgb8. Also throws std::invalid_argument for an unknown view.
  Picture look(const Moment& moment, const Outside& from);
  bool works() const { return program_ != nullptr; }

 private:
  std::vector<Picture> ask(Kind kind, std::string_view data);
  [[noreturn]] void fail();

  std::unique_ptr<DrawingProgram> program_;
};

}  // namespace verp::camera
