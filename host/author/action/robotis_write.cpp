#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "common/model/counts.hpp"
#include "host/author/action/robotis_page.hpp"

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

using Percents = std::map<std::string, int>;  // joints below full stiffness

Percents stiffness_after(const Params& params, const FrameText& frame, Percents slack) {
  for (const Stiffness& each : frame.stiffness) {
    if (each.joints.empty()) {
      for (int j = 0; j < params.joint_count; ++j) slack[params.joint[j].name] = each.percent;
    }
    for (const std::string& joint : each.joints) slack[joint] = each.percent;
  }
  std::erase_if(slack, [](const auto& each) { return each.second == 100; });
  return slack;
}

int torque_bit(const Document& document, const FrameText& frame, const Percents& slack,
               const char* joint) {
  const auto found = slack.find(joint);
  if (found == slack.end()) return 0;
  if (found->second == 0) return kTorqueOff;
  refuse(document, frame.line,
         fmt::format("a page has no stiffness of {} % (joint '{}')", found->second, joint),
         "give 0 or 100");
}

void put_frame(const Params& params, const Document& document, const FrameText& frame,
               const Percents& slack, std::size_t step, Page& page) {
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
    const int torque = torque_bit(document, frame, slack, joint.name);
    if (before != nullptr && !now->from_stand &&
        std::abs(now->angle_rad - before->angle_rad) < kSame_rad) {
      put_word(page, place, (word(page, place) & ~kTorqueOff) | torque);
      continue;
    }
    const double from_rad = now->from_stand ? static_cast<double>(joint.stand_rad) : 0.0;
    const int count = model::count_of(joint, static_cast<float>(from_rad + now->angle_rad));
    if (count < 0 || count > kCount) {
      refuse(document, now->line,
             fmt::format("joint '{}' is beyond what a page can say", joint.name),
             "give an angle of less than half a turn");
    }
    put_word(page, place, count | torque);
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

using Numbers = std::map<std::string, int>;  // pages by action name

/// A target's page; 0: there is none.
int page_of(const Document& document, const std::optional<Target>& target, const Numbers& numbers) {
  if (!target) return 0;
  const auto found = numbers.find(target->name);
  if (found != numbers.end() && found->second != 0) return found->second;
  refuse(document, target->line, fmt::format("no page can be reached as '{}'", target->name),
         "a page's link and exit are actions that are written with it, on pages 1 to 255");
}

struct Way {
  int next = 0, exit = 0, repeat = 1;
  auto operator<=>(const Way&) const = default;
};

Way way_of(const Document& document, const Numbers& numbers) {
  Way way;
  way.next = page_of(document, document.link, numbers);
  if (document.frames.empty()) return way;
  way.exit = page_of(document, document.frames.front().exit, numbers);
  for (const FrameText& frame : document.frames) {
    const bool first = &frame == &document.frames.front(), last = &frame == &document.frames.back();
    if (frame.exit && !first) {
      refuse(document, frame.exit->line, "a page has one exit", "give it in the first frame");
    }
    if (!frame.repeat) continue;
    if (!last || frame.repeat->from.name != document.frames.front().label) {
      refuse(document, frame.repeat->from.line, "a page repeats as a whole",
             "repeat in its last frame, from its first");
    }
    way.repeat = frame.repeat->times + 1;
    if (way.repeat > 255) {
      refuse(document, frame.repeat->from.line, "a page repeats 254 times at most", "give 254");
    }
  }
  return way;
}

void put_way(const Way& now, const Way& before, Page& page) {
  if (now.next != before.next) page[kNext] = static_cast<std::uint8_t>(now.next);
  if (now.exit != before.exit) page[kExit] = static_cast<std::uint8_t>(now.exit);
  if (now.repeat != before.repeat) page[kRepeat] = static_cast<std::uint8_t>(now.repeat);
}

std::vector<Percents> stiffness_of(const Params& params, const Document& document) {
  std::vector<Percents> all;
  for (const FrameText& frame : document.frames) {
    all.push_back(stiffness_after(params, frame, all.empty() ? Percents{} : all.back()));
  }
  return all;
}

/// Throws for content that would be lost silently.
void refuse_what_is_lost(const Params& params, const Document& document, const Document& kept) {
  if (document.page && document.name != kept.name) {
    refuse(document, document.line,
           fmt::format("the page of '{}' is called '{}'", document.name, kept.name),
           "keep its name, or leave its 'robotis' words out");
  }
  if (document.mirror) {
    refuse(document, document.mirror->line, "a page cannot be the mirror of another",
           "give its joints' angles");
  }
  const auto stiffness = stiffness_of(params, document), read = stiffness_of(params, kept);
  const auto there =
      std::mismatch(stiffness.begin(), stiffness.end(), read.begin(), read.end()).first;
  if (there == stiffness.end()) return;
  const auto nth = static_cast<std::size_t>(there - stiffness.begin());
  refuse(document, document.frames[nth].line,
         "a page has the stiffness only of joints that it moves", "give these an angle, too");
}

void put_document(const Params& params, const Document& document, Page& page) {
  refuse_unknown_joints(params, document);
  if (document.frames.size() > kSteps) {
    refuse(document, document.frames[kSteps].line, "a page has no more than 7 steps",
           "move the rest into an action of its own, and link it");
  }
  Percents slack;
  for (std::size_t i = 0; i < document.frames.size(); ++i) {
    slack = stiffness_after(params, document.frames[i], slack);
    put_frame(params, document, document.frames[i], slack, i, page);
  }
  if (document.frames.size() != std::min<std::size_t>(page[kStepCount], kSteps)) {
    page[kStepCount] = static_cast<std::uint8_t>(document.frames.size());
  }
}

/// A motion, read back.
class Kept {
 public:
  Kept(const Params& params, const Motion& motion) {
    for (Document& each : from_motion(params, motion)) {
      numbers_[each.name] = each.page->number;
      documents_[each.page->number] = std::move(each);
    }
  }
  const Document& at(int number) const {
    static const Document kBlank;
    const auto found = documents_.find(number);
    return found == documents_.end() ? kBlank : found->second;
  }
  Way way(int number) const { return way_of(at(number), numbers_); }

 private:
  std::map<int, Document> documents_;
  Numbers numbers_;
};

using Placed = std::vector<std::pair<int, const Document*>>;

void put_ways(const Params& params, const Placed& placed, const Numbers& numbers, Motion& motion) {
  const Kept before(params, motion);
  for (const auto& [number, document] : placed) {
    put_way(way_of(*document, numbers), before.way(number),
            motion[static_cast<std::size_t>(number)]);
  }
}

}  // namespace

std::string not_on_page(const Document& document) {
  const auto any = [&](const auto& has) {
    return std::any_of(document.frames.begin(), document.frames.end(), has);
  };
  std::string text;
  const auto add = [&](const char* name, bool is_there) {
    if (is_there) text += (text.empty() ? "" : ", ") + std::string(name);
  };
  add("note", !document.note.empty());
  add("interpolation", any([](const FrameText& each) { return each.smooth.has_value(); }));
  add("balance", any([](const FrameText& each) { return each.balance == true; }));
  add("stance", any([](const FrameText& each) { return each.stance.has_value(); }));
  return text;
}

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
  Placed placed;
  Motion untouched = motion;
  Numbers numbers;
  for (const Document& each : documents) {
    while (!each.page && taken.contains(free)) ++free;
    const int number = each.page ? each.page->number : free;
    if (number >= static_cast<int>(kPages))
      refuse(each, each.line, "no page is left", "leave it out");
    taken.insert(number);
    Page& page = motion[static_cast<std::size_t>(number)];
    if (each.page) {
      std::copy(each.page->bytes.begin(), each.page->bytes.end(), page.begin());
      untouched[static_cast<std::size_t>(number)] = page;
    } else {
      std::copy_n(each.name.begin(), std::min(each.name.size(), kNameBytes - 1), page.begin());
    }
    put_document(params, each, page);
    placed.emplace_back(number, &each);
    numbers[each.name] = number;
  }
  put_ways(params, placed, numbers, motion);
  for (const auto& [number, document] : placed) {
    const auto nth = static_cast<std::size_t>(number);
    if (motion[nth] != untouched[nth]) seal(motion[nth]);
  }
  const Kept kept(params, motion);
  for (const auto& [number, document] : placed)
    refuse_what_is_lost(params, *document, kept.at(number));
  return motion;
}

}  // namespace verp::action
