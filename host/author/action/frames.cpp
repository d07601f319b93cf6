#include "host/author/action/frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/model/coupling.hpp"
#include "common/model/leg.hpp"
#include "common/model/tree.hpp"
#include "host/robot/model/params.hpp"

namespace verp::action {
namespace {

constexpr std::size_t kJoints = kMaxJoints;

int joint_of(const Params& params, const Document& document, int line, const std::string& name) {
  return joint_named(params, name, document.file, line);
}

/// State from one frame to the next.
struct Held {
  bool smooth = true, balance = true;
  Stance stance = Stance::kBoth;
  bool legs_used = false;
  Poser::Legs legs;
  std::array<bool, kJoints> has_goal{};
  std::array<float, kJoints> goal_rad{};
  std::array<std::uint8_t, kJoints> stiff{};
};

void take(const Params& params, const Poser& poser, const Document& document, const FrameText& text,
          Held& held) {
  if (text.smooth) held.smooth = *text.smooth;
  if (text.balance) held.balance = *text.balance;
  if (text.stance) held.stance = *text.stance;
  if (text.over_left) held.legs.over_left = text.over_left;
  if (text.body) held.legs.body = *text.body;
  for (int side = 0; side < kFeet; ++side) {
    if (text.foot[side]) held.legs.foot[side] = *text.foot[side];
    held.legs_used = held.legs_used || text.foot[side];
  }
  held.legs_used = held.legs_used || text.over_left || text.body;
  for (const JointGoal& goal : text.goals) {
    const auto j = static_cast<std::size_t>(joint_of(params, document, goal.line, goal.joint));
    const double stand_rad = goal.from_stand ? poser.stand_rad()[j] : 0;
    held.has_goal[j] = true;
    held.goal_rad[j] = static_cast<float>(stand_rad + goal.angle_rad);
    const JointParams& joint = params.joint[j];
    constexpr float kRounding_rad = 1e-4F;
    if (held.goal_rad[j] < joint.lower_rad - kRounding_rad ||
        held.goal_rad[j] > joint.upper_rad + kRounding_rad) {
      constexpr float kDegrees = 57.29578F;
      throw model::LoadError(document.file.string(), goal.line,
                             fmt::format("joint '{}' at {:.1f} degrees is beyond its limits",
                                         goal.joint, kDegrees * held.goal_rad[j]),
                             fmt::format("give {:.1f} to {:.1f}", kDegrees * joint.lower_rad,
                                         kDegrees * joint.upper_rad));
    }
  }
  for (const Stiffness& stiff : text.stiffness) {
    if (stiff.joints.empty()) held.stiff.fill(static_cast<std::uint8_t>(stiff.percent));
    for (const std::string& name : stiff.joints) {
      const auto j = static_cast<std::size_t>(joint_of(params, document, stiff.line, name));
      held.stiff[j] = static_cast<std::uint8_t>(stiff.percent);
    }
  }
}

/// Sets followers from drivers; refuses a frame that separates them.
void couple(const Params& params, const Document& document, const FrameText& text,
            Angles& angle_rad) {
  constexpr float kApart_rad = 0.01F, kDegrees = 57.29578F;
  for (int j = params.servo_count(); j < params.joint_count; ++j) {
    const JointParams& follower = params.joint[j];
    const auto named =
        std::find_if(text.goals.begin(), text.goals.end(),
                     [&](const JointGoal& goal) { return goal.joint == follower.name; });
    const bool asked =
        named != text.goals.end() || text.body || text.over_left || text.foot[0] || text.foot[1];
    const int d = model::driver_of(params, j);
    const JointParams& driver = params.joint[d];
    float& angle = angle_rad[static_cast<std::size_t>(j)];
    const float led = model::followed(driver, follower, angle_rad[static_cast<std::size_t>(d)]);
    if (asked && std::abs(angle - led) > kApart_rad) {
      throw model::LoadError(
          document.file.string(), named != text.goals.end() ? named->line : text.line,
          fmt::format("joint '{}' follows '{}', whose motor takes it to {:.1f} degrees, not to "
                      "{:.1f}",
                      follower.name, driver.name, kDegrees * led, kDegrees * angle),
          fmt::format("give '{}' alone, or turn both feet as their one motor does", driver.name));
    }
    angle = led;
  }
}

std::uint16_t to_ms(double time_s) {
  return static_cast<std::uint16_t>(std::lround(1e3 * time_s));
}

void set_goals(const Params& params, const Angles& angle_rad, Frame& frame) {
  for (int j = 0; j < params.joint_count; ++j) {
    if ((frame.joints >> j & 1U) == 0) continue;
    frame.goal_tenth_mrad[j] = static_cast<std::int16_t>(
        std::clamp(std::lround(1e4F * angle_rad[static_cast<std::size_t>(j)]), -32767L, 32767L));
  }
}

bool feels(const Params& params, Condition condition) {
  const bool left = params.feet.device_id[0] != 0, right = params.feet.device_id[1] != 0;
  if (condition == Condition::kLeftFoot) return left;
  if (condition == Condition::kRightFoot) return right;
  return condition < Condition::kBothFeet || (left && right);
}

Frame make_frame(const Params& params, const Document& document, const FrameText& text,
                 const Held& held, std::uint32_t joints) {
  Frame frame;
  frame.time_ms = to_ms(text.time_s);
  frame.pause_ms = to_ms(text.hold_s);
  frame.stance = held.stance;
  frame.balance = held.balance ? 1 : 0;
  frame.joints = joints;
  frame.smooth = held.smooth ? joints : 0;
  std::copy(held.stiff.begin(), held.stiff.end(), frame.stiffness_percent);
  if (!text.wait) return frame;
  frame.condition = text.wait->condition;
  frame.wait_ms = to_ms(text.wait->at_most_s);
  if (!feels(params, frame.condition)) {
    throw model::LoadError(document.file.string(), text.line,
                           fmt::format("the feet of {} feel nothing", params.name),
                           fmt::format("leave 'wait {}' out", name_of(frame.condition)));
  }
  return frame;
}

std::uint32_t leg_joints(const Params& params) {
  std::uint32_t joints = 0;
  for (const LegParams& leg : params.leg) {
    if (leg.solver == LegSolver::kNone) continue;
    joints |= model::joints_of(leg);
  }
  return joints;
}

/// Joints with a goal in any frame; before its first goal a joint stands.
std::uint32_t joints_of(const Params& params, const Document& document) {
  std::uint32_t joints = 0;
  for (const FrameText& text : document.frames) {
    for (const JointGoal& goal : text.goals) {
      joints |= 1U << joint_of(params, document, goal.line, goal.joint);
    }
    if (text.body || text.foot[0] || text.foot[1] || text.over_left) joints |= leg_joints(params);
  }
  return joints;
}

std::string other_side(std::string name) {
  const auto swap_at = [&](std::size_t at, char left, char right) {
    if (name[at] == left) return name[at] = right, true;
    if (name[at] == right) return name[at] = left, true;
    return false;
  };
  if (name.size() > 2 && name[1] == '_' && swap_at(0, 'l', 'r')) return name;
  if (name.size() > 2 && std::isupper(static_cast<unsigned char>(name[1])) != 0 &&
      swap_at(0, 'L', 'R')) {
    return name;
  }
  for (const auto& [from, to] : {std::pair("left", "right"), std::pair("right", "left")}) {
    const std::size_t at = name.find(from);
    if (at != std::string::npos) return name.replace(at, std::string(from).size(), to);
  }
  return name;
}

/// A reflection at y = 0 turns a rotation about (x, y, z) into one about (-x, y, -z).
float sign_of(const JointParams& joint, const JointParams& other) {
  const float along =
      -joint.axis.x * other.axis.x + joint.axis.y * other.axis.y - joint.axis.z * other.axis.z;
  return along > 0 ? 1.0F : -1.0F;
}

Condition other_side(Condition condition) {
  switch (condition) {
    case Condition::kLiesLeft:
      return Condition::kLiesRight;
    case Condition::kLiesRight:
      return Condition::kLiesLeft;
    case Condition::kLeftFoot:
      return Condition::kRightFoot;
    case Condition::kRightFoot:
      return Condition::kLeftFoot;
    default:
      return condition;
  }
}

}  // namespace

int joint_named(const Params& params, const std::string& name, const std::filesystem::path& file,
                int line) {
  const int joint = model::find_joint(params, model::short_name(name).c_str());
  if (joint >= 0) return joint;
  std::string names;
  for (int j = 0; j < params.joint_count; ++j) {
    names += (j > 0 ? ", " : "") + std::string(params.joint[j].name);
  }
  throw model::LoadError(file.string(), line,
                         fmt::format("{} has no joint '{}'", params.name, name),
                         "it has: " + names);
}

Draft draft(const Params& params, const Poser& poser, const Document& document) {
  const std::uint32_t joints = joints_of(params, document);
  Draft draft;
  Held held;
  held.stiff.fill(100);
  Angles angle_rad = poser.stand_rad();
  for (const FrameText& text : document.frames) {
    take(params, poser, document, text, held);
    for (std::size_t j = 0; j < kJoints; ++j) {
      if (held.has_goal[j]) angle_rad[j] = held.goal_rad[j];
    }
    if (held.legs_used) {
      const std::string trouble = poser.bend(held.legs, angle_rad);
      if (!trouble.empty()) {
        throw model::LoadError(document.file.string(), text.line, trouble,
                               "lower the body, or move it and the feet less");
      }
      for (const JointGoal& goal : text.goals) {
        const auto j = static_cast<std::size_t>(joint_of(params, document, goal.line, goal.joint));
        angle_rad[j] = held.goal_rad[j];
      }
    }
    couple(params, document, text, angle_rad);
    Frame frame = make_frame(params, document, text, held, joints);
    set_goals(params, angle_rad, frame);
    draft.frames.push_back(frame);
    draft.line.push_back(text.line);
    draft.angle_rad.push_back(angle_rad);
  }
  return draft;
}

Draft mirrored(const Params& params, const Draft& draft, const Document& document) {
  std::array<std::size_t, kJoints> other{};
  for (std::size_t j = 0; j < params.joint_count; ++j) {
    const std::string name = other_side(params.joint[j].name);
    const int found = model::find_joint(params, name.c_str());
    if (found < 0) {
      throw model::LoadError(document.file.string(), document.mirror->line,
                             fmt::format("joint '{}' of {} has no '{}' on the other side",
                                         params.joint[j].name, params.name, name),
                             "write this action's frames out");
    }
    other[j] = static_cast<std::size_t>(found);
  }
  Draft result = draft;
  for (std::size_t i = 0; i < draft.frames.size(); ++i) {
    const Frame& from = draft.frames[i];
    Frame& to = result.frames[i];
    to.joints = to.smooth = 0;
    if (from.stance < Stance::kBoth) {
      to.stance = from.stance == Stance::kLeft ? Stance::kRight : Stance::kLeft;
    }
    to.condition = other_side(from.condition);
    for (std::size_t j = 0; j < params.joint_count; ++j) {
      const std::size_t k = other[j];
      const float sign = sign_of(params.joint[j], params.joint[k]);
      result.angle_rad[i][k] = sign * draft.angle_rad[i][j];
      to.joints |= (from.joints >> j & 1U) << k;
      to.smooth |= (from.smooth >> j & 1U) << k;
      to.stiffness_percent[k] = from.stiffness_percent[j];
      to.goal_tenth_mrad[k] = 0;
    }
    set_goals(params, result.angle_rad[i], to);
    result.line[i] = document.mirror->line;
  }
  return result;
}

}  // namespace verp::action
