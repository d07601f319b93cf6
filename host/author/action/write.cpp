#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numbers>

#include "host/author/action/robotis.hpp"
#include "host/author/action/words.hpp"

namespace verp::action {
namespace {

constexpr const char* kStances[] = {"left", "right", "both", "none"};

std::string degrees(double angle_rad) {
  const double angle_deg = angle_rad * 180 / std::numbers::pi;
  return fmt::format("{:.6g}", std::abs(angle_deg) < 1e-9 ? 0.0 : angle_deg);
}

std::string text_of(const Offset& offset) {
  constexpr const char* kMoves[] = {"x", "y", "z"};
  constexpr const char* kTurns[] = {"roll", "pitch", "yaw"};
  std::string text;
  for (std::size_t i = 0; i < 3; ++i) {
    if (offset.move_m[i] != 0) text += fmt::format(" {} {:.6g}", kMoves[i], offset.move_m[i]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (offset.turn_rad[i] != 0)
      text += fmt::format(" {} {}", kTurns[i], degrees(offset.turn_rad[i]));
  }
  return text.empty() ? " stand" : text;
}

std::string text_of(const FrameText& frame) {
  std::string text =
      fmt::format("\nframe {}{:g}", frame.label.empty() ? "" : frame.label + " ", frame.time_s);
  if (frame.hold_s > 0) text += fmt::format(" hold {:g}", frame.hold_s);
  const auto line = [&](const std::string& words) { text += "\n  " + words; };
  if (frame.smooth) line(*frame.smooth ? "smooth" : "cubic");
  if (frame.balance) line(*frame.balance ? "balance on" : "balance off");
  if (frame.stance) line(fmt::format("stance {}", kStances[static_cast<int>(*frame.stance)]));
  if (frame.over_left) line(fmt::format("over left {:g}", *frame.over_left));
  if (frame.body) line("body" + text_of(*frame.body));
  if (frame.foot[0]) line("left_foot" + text_of(*frame.foot[0]));
  if (frame.foot[1]) line("right_foot" + text_of(*frame.foot[1]));
  for (const JointGoal& goal : frame.goals) {
    const std::string angle = degrees(goal.angle_rad);
    const std::string value = !goal.from_stand        ? angle
                              : goal.angle_rad == 0.0 ? "stand"
                              : goal.angle_rad > 0.0  ? "stand+" + angle
                                                      : "stand" + angle;
    const bool quoted =
        std::find(std::begin(kLineWords), std::end(kLineWords), goal.joint) != std::end(kLineWords);
    line((quoted ? "joint " : "") + goal.joint + " " + value);
  }
  for (const Stiffness& stiff : frame.stiffness) {
    std::string words = fmt::format("stiff {}", stiff.percent);
    for (const std::string& joint : stiff.joints) words += " " + joint;
    line(words);
  }
  if (frame.exit) line("exit " + frame.exit->name);
  if (frame.wait) {
    line(fmt::format("wait {} {:g}{}", name_of(frame.wait->condition), frame.wait->at_most_s,
                     frame.wait->otherwise ? " else " + frame.wait->otherwise->name : ""));
  }
  if (frame.repeat) {
    line(fmt::format("repeat {} from {}", frame.repeat->times, frame.repeat->from.name));
  }
  return text + "\n";
}

/// Lines of 32 bytes, without those of a blank page.
std::string text_of(const PageText& page) {
  constexpr std::size_t kLine = 32;
  const Page blank = blank_page();
  std::string text = fmt::format("robotis page {}\n", page.number);
  for (std::size_t at = 0; at < kPageBytes; at += kLine) {
    const auto first = page.bytes.begin() + static_cast<std::ptrdiff_t>(at);
    if (std::equal(first, first + kLine, blank.begin() + static_cast<std::ptrdiff_t>(at))) continue;
    text += fmt::format("robotis {} ", at);
    for (std::size_t i = 0; i < kLine; ++i) text += fmt::format("{:02x}", page.bytes[at + i]);
    text += "\n";
  }
  return text;
}

}  // namespace

std::string text_of(const Document& document) {
  std::string text = "action " + document.name + "\n";
  if (!document.note.empty()) text += "note " + document.note + "\n";
  if (document.mirror) text += "mirror " + document.mirror->name + "\n";
  if (document.page) text += text_of(*document.page);
  for (const FrameText& frame : document.frames) text += text_of(frame);
  if (document.link) text += "\nlink " + document.link->name + "\n";
  return text;
}

}  // namespace verp::action
