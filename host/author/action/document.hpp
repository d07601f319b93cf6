#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/action/library.hpp"
#include "host/robot/model/load_error.hpp"

/// An action as in its file (host/guide/actions.md), not compiled.
namespace verp::action {

/// How far body or sole is moved from the stand, relative to the ground.
struct Offset {
  std::array<double, 3> move_m{};
  std::array<double, 3> turn_rad{};  ///< roll, pitch, yaw
};

struct JointGoal {
  std::string joint;
  bool from_stand = false;  ///< `angle_rad` is relative to the stand
  double angle_rad = 0;
  int line = 0;
};

struct Stiffness {
  std::vector<std::string> joints;  ///< empty: all
  int percent = 100;
  int line = 0;
};

/// A frame of this action by label, another action, or the stand.
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

/// Unset members keep the previous frame's values.
struct FrameText {
  int line = 0;
  std::string label;
  double time_s = 0, hold_s = 0;
  std::optional<bool> smooth, balance;
  std::optional<Stance> stance;
  std::optional<double> over_left;  ///< centre of mass: 1 over the left sole, 0 over the right
  int over_line = 0;
  std::optional<Offset> body, foot[kFeet];
  std::vector<JointGoal> goals;
  std::vector<Stiffness> stiffness;
  std::optional<Target> exit;
  std::optional<Wait> wait;
  std::optional<Repeat> repeat;
};

/// Parts of a ROBOTIS page (robotis.hpp) that frames cannot express.
struct PageText {
  int number = 0;
  std::vector<std::uint8_t> bytes;
};

struct Document {
  std::filesystem::path file;
  int line = 0;  ///< line of its name
  std::string name, note;
  std::optional<Target> mirror;  ///< then `frames` is empty
  std::vector<FrameText> frames;
  std::optional<PageText> page;  ///< with a page, `frames` may be empty
  std::optional<Target> link;    ///< after the last frame; empty: the stand
};

/// Throws LoadError with file and line.
Document read_document(const std::filesystem::path& file);
Document parse_document(const std::filesystem::path& file, const std::string& text);

/// Text that parse_document() reads back.
std::string text_of(const Document& document);

/// As in files: "left_foot".
const char* name_of(Condition condition);

}  // namespace verp::action
