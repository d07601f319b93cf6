#pragma once
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "host/show/camera/drawing_program.hpp"
#include "host/show/camera/wire.hpp"

namespace verp::camera {

/// Draws a moment and waits. A Rig draws meanwhile, for runs that keep all pictures. Any thread,
/// one call at a time.
class Painter {
 public:
  using Seconds = DrawingProgram::Seconds;

  /// Waits until it can draw. Throws CameraError. `patience` is for a program that hangs: a busy PC
  /// may need minutes.
  Painter(const std::filesystem::path& program, const Stage& stage, Seconds patience = Seconds(600))
      : program_(std::make_unique<DrawingProgram>(program, stage, DrawingProgram::Life::kOfSocket,
                                                  patience)) {}

  /// One per camera of moment.robot that looks, with depth two. After CameraError the painter is
  /// useless.
  std::vector<Picture> look(const Moment& moment);
  /// rgb8. Also throws std::invalid_argument for an unknown view.
  Picture look(const Moment& moment, const Outside& from);
  bool works() const { return program_ != nullptr; }

 private:
  std::vector<Picture> ask(Kind kind, std::string_view data);
  [[noreturn]] void fail();

  std::unique_ptr<DrawingProgram> program_;
};

}  // namespace verp::camera
