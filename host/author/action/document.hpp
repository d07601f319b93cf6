#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/action/library.hpp"
#include "host/robot/model/load_error.hpp"

/// An action as its file has it (host/guide/actions.md), before it is made for a robot.
namespace verp::action {

/// A displacement from the stand: of the body, or of a sole, both over the ground.
struct Offset {
  std::array<double, 3> move_m{};
  std::array<double, 3> turn_rad{};  ///< roll, pitch, yaw
};

struct JointGoal {
  std::string joint;
  bool from_stand = false;  ///< `angle_rad` is added to where the joint stands
  double angle_rad = 0;
  int line = 0;
};

struct Stiffness {
  std::vector<std::string> joints;  ///< none: all
  int percent = 100;
  int line = 0;
};

/// Where else a player goes: a frame of this action by its label, another action, or the stand.
struct Target {
  std::string name;
  int line = 0;
};

struct Wait {
  Condition condition = Condition::kNone;
  double at_most_s = 0;
  std::optional<Target> otherwise;
};

struct Repeat {
  int times = 0;
  Target from;
};

/// What a frame does not say it has from the frame before.
struct FrameText {
  int line = 0;
  std::string label;
  double time_s = 0, hold_s = 0;
  std::optional<bool> smooth, balance;
  std::optional<Stance> stance;
  std::optional<double> over_left;  ///< the centre of mass: 1 over the left sole, 0 over the right
  int over_line = 0;
  std::optional<Offset> body, foot[kFeet];
  std::vector<JointGoal> goals;
  std::vector<Stiffness> stiffness;
  std::optional<Target> exit;
  std::optional<Wait> wait;
  std::optional<Repeat> repeat;
};

/// A page of a ROBOTIS motion file (robotis.hpp): what frames cannot say of it.
struct PageText {
  int number = 0;
  std::vector<std::uint8_t> bytes;
};

struct Document {
  std::filesystem::path file;
  int line = 0;  ///< of its name
  std::string name, note;
  std::optional<Target> mirror;  ///< of this action, which then has no frames of its own
  std::vector<FrameText> frames;
  std::optional<PageText> page;  ///< with one, there need be no frames
  std::optional<Target> link;    ///< what follows the last frame; none: the stand
};

/// Throws LoadError with file and line.
Document read_document(const std::filesystem::path& file);
Document parse_document(const std::filesystem::path& file, const std::string& text);

/// The text that parse_document() reads back as the same.
std::string text_of(const Document& document);

/// Of a condition, as in files: "left_foot".
const char* name_of(Condition condition);

}  // namespace verp::action
