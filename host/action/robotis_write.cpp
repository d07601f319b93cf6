#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "common/model/counts.hpp"
#include "host/action/robotis_page.hpp"

// Actions onto pages: what was changed is written, what a page would not keep is refused.
namespace verp::action {
namespace {

using namespace page;

[[noreturn]] void refuse(const Document& document, int line, const std::string& what,
                         const std::string& fix) {
  throw model::LoadError(document.file.string(), line, what, fix);
}

std::uint8_t in_units(const Document& document, const FrameText& frame, double time_s,
                      const Page& page) {
  const double units = std::round(time_s / unit_s(page));
  if (units <= 255) return static_cast<std::uint8_t>(units);
  refuse(document, frame.line, fmt::format("{:g} s is longer than a page can say", time_s),
         fmt::format("give at most {:.2f} s, or another frame", 255 * unit_s(page)));
}

const JointGoal* goal_in(const FrameText& frame, const char* joint) {
  const auto found = std::find_if(frame.goals.begin(), frame.goals.end(),
                                  [&](const JointGoal& goal) { return goal.joint == joint; });
  return found == frame.goals.end() ? nullptr : &*found;
}

/// Writes what the frame has otherwise than the page.
void put_frame(const Params& params, const Document& document, const FrameText& frame,
               std::size_t step, Page& page) {
  constexpr double kSame_s = 1e-5, kSame_rad = 1e-5;
  const std::size_t at = step_at(step);
  const FrameText there = frame_of_page(params, page, step);
  if (frame.body || frame.foot[0] || frame.foot[1] || frame.over_left || frame.wait) {
    refuse(document, frame.line, "pages know joints only, no body, feet or conditions",
           "give the joints' angles (verp action convert to CSV has them)");
  }
  if (std::abs(frame.time_s - there.time_s) > kSame_s) {
    page[at + kTime] = in_units(document, frame, frame.time_s, page);
  }
  if (std::abs(frame.hold_s - there.hold_s) > kSame_s) {
    page[at + kPause] = in_units(document, frame, frame.hold_s, page);
  }
  for (int j = 0; j < params.joint_count; ++j) {
    const JointParams& joint = params.joint[j];
    if (joint.servo_id >= kPageServos) continue;
    const JointGoal* now = goal_in(frame, joint.name);
    const JointGoal* before = goal_in(there, joint.name);
    if (now == nullptr && before == nullptr) continue;
    const std::size_t place = at + 2U * joint.servo_id;
    if (now == nullptr) {
      put_word(page, place, kInvalid);
      continue;
    }
    if (before != nullptr && !now->from_stand &&
        std::abs(now->angle_rad - before->angle_rad) < kSame_rad) {
      continue;
    }
    const double from_rad = now->from_stand ? static_cast<double>(joint.stand_rad) : 0.0;
    const int count = model::count_of(joint, static_cast<float>(from_rad + now->angle_rad));
    if (count < 0 || count > kCount) {
      refuse(document, now->line,
             fmt::format("joint '{}' is beyond what a page can say", joint.name),
             "give an angle of less than half a turn");
    }
    put_word(page, place, count | (before == nullptr ? 0 : word(page, place) & kTorqueOff));
  }
}

void refuse_unknown_joints(const Params& params, const Document& document) {
  const auto check = [&](const std::string& joint, int line) {
    const auto* end = params.joint + params.joint_count;
    if (std::any_of(params.joint, end, [&](const auto& each) { return joint == each.name; }))
      return;
    refuse(document, line, fmt::format("the robot has no joint '{}'", joint),
           "verp check lists its joints");
  };
  for (const FrameText& frame : document.frames) {
    for (const JointGoal& goal : frame.goals) check(goal.joint, goal.line);
    for (const Stiffness& stiffness : frame.stiffness) {
      for (const std::string& joint : stiffness.joints) check(joint, stiffness.line);
    }
  }
}

/// Where an action goes on, and which joints are not stiff: pages have that, but it is not written
/// to them.
std::string way_of(const Document& document) {
  const auto name = [](const std::optional<Target>& target) {
    return target ? target->name : std::string();
  };
  std::string way = name(document.link);
  for (const FrameText& frame : document.frames) {
    way += "|" + name(frame.exit);
    if (frame.repeat) way += fmt::format(" {} {}", frame.repeat->times, frame.repeat->from.name);
    std::map<std::string, int> slack;
    for (const Stiffness& each : frame.stiffness) {
      if (each.joints.empty()) slack = {{"all", each.percent}};
      for (const std::string& joint : each.joints) slack[joint] = each.percent;
    }
    for (const auto& [joint, percent] : slack) {
      if (percent != 100) way += fmt::format(" {} {}", joint, percent);
    }
  }
  return way;
}

/// What the page does not keep is refused: it would be lost without a word.
void refuse_what_is_lost(const Document& document, const Document& kept) {
  if (document.page && document.name != kept.name) {
    refuse(document, document.line,
           fmt::format("the page of '{}' is called '{}'", document.name, kept.name),
           "keep its name, or leave its 'robotis' words out");
  }
  if (document.mirror) {
    refuse(document, document.mirror->line, "a page cannot be the mirror of another",
           "give its joints' angles");
  }
  if (way_of(document) != way_of(kept)) {
    refuse(
        document, document.line,
        fmt::format("the link, exit, repeat or stiffness of '{}' is not what its page has",
                    document.name),
        "leave these as they came from the motion file: of a page's, angles and times are written");
  }
}

void put_document(const Params& params, const Document& document, Page& page) {
  refuse_unknown_joints(params, document);
  if (document.frames.size() > kSteps) {
    refuse(document, document.frames[kSteps].line, "a page has no more than 7 steps",
           "move the rest into an action of its own, and link it");
  }
  for (std::size_t i = 0; i < document.frames.size(); ++i) {
    put_frame(params, document, document.frames[i], i, page);
  }
  if (document.frames.size() != std::min<std::size_t>(page[kStepCount], kSteps)) {
    page[kStepCount] = static_cast<std::uint8_t>(document.frames.size());
  }
}

}  // namespace

Motion to_motion(const Params& params, const std::vector<Document>& documents) {
  Motion motion(kPages, blank_page());
  std::set<int> taken;
  for (const Document& each : documents) {
    if (each.page && !taken.insert(each.page->number).second) {
      refuse(each, each.line, fmt::format("page {} is another action's already", each.page->number),
             "give each its own");
    }
  }
  int free = 1;
  std::vector<std::pair<int, const Document*>> placed;
  for (const Document& each : documents) {
    while (!each.page && taken.contains(free)) ++free;
    const int number = each.page ? each.page->number : free;
    if (number >= static_cast<int>(kPages))
      refuse(each, each.line, "no page is left", "leave it out");
    taken.insert(number);
    Page& page = motion[static_cast<std::size_t>(number)];
    if (each.page) {
      std::copy(each.page->bytes.begin(), each.page->bytes.end(), page.begin());
    } else {
      std::copy_n(each.name.begin(), std::min(each.name.size(), kNameBytes - 1), page.begin());
    }
    const Page before = page;
    put_document(params, each, page);
    if (page != before || !each.page) seal(page);
    placed.emplace_back(number, &each);
  }
  const std::vector<Document> kept = from_motion(params, motion);
  for (const auto& [number, document] : placed) {
    const auto found = std::find_if(
        kept.begin(), kept.end(),
        [number = number](const Document& each) { return each.page->number == number; });
    refuse_what_is_lost(*document, found == kept.end() ? Document{} : *found);
  }
  return motion;
}

}  // namespace verp::action
