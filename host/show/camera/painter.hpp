#pragma once
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "host/show/camera/drawing_program.hpp"
#include "host/show/camera/wire.hpp"

namespace verp::camera {

/// Has a moment drawn when it is asked to, and waits for the picture: for whoever looks into a run
/// now and then. (A run that keeps all its pictures has a Rig, which draws while it goes on.) Works
/// on any thread, one at a time.
class Painter {
 public:
  using Seconds = DrawingProgram::Seconds;

  /// Starts `program` and waits until it can draw. Throws CameraError. The patience only ends what
  /// hangs: a PC that does much else may need minutes for a picture.
  Painter(const std::filesystem::path& program, const Stage& stage, Seconds patience = Seconds(600))
      : program_(std::make_unique<DrawingProgram>(program, stage, DrawingProgram::Life::kOfSocket,
                                                  patience)) {}

  /// What the cameras of moment.robot see that look in it: of each one picture, of colour with
  /// depth two. Throws CameraError once the program has ended, or does not answer: it then is of no
  /// further use.
  std::vector<Picture> look(const Moment& moment);
  /// From outside, rgb8. Besides throws std::invalid_argument: there is no such view.
  Picture look(const Moment& moment, const Outside& from);
  /// It can be asked again.
  bool works() const { return program_ != nullptr; }

 private:
  std::vector<Picture> ask(Kind kind, std::string_view data);
  [[noreturn]] void fail();

  std::unique_ptr<DrawingProgram> program_;
};

}  // namespace verp::camera
