#include "host/action/robotis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <numeric>
#include <set>

#include "common/model/counts.hpp"
#include "common/model/tree.hpp"

namespace verp::action {
namespace {

// Of a page's header.
constexpr std::size_t kName = 0, kNameBytes = 14, kRepeat = 15, kSchedule = 16, kStepCount = 20,
                      kSpeed = 22, kAccel = 24, kNext = 25, kExit = 26, kChecksum = 31, kGain = 32;
// Of a step.
constexpr std::size_t kStepBytes = 64, kPause = 62, kTime = 63;
constexpr std::uint16_t kInvalid = 0x4000, kTorqueOff = 0x2000, kCount = 0x0FFF;
constexpr std::uint16_t kUnused = 0x9000;
constexpr double kUnit_s = 0.0078;  // of times
constexpr int kNormalSpeed = 32;

std::size_t step_at(std::size_t step) {
  return kStepBytes * (step + 1);
}

std::uint16_t word(const Page& page, std::size_t at) {
  return static_cast<std::uint16_t>(page[at] | page[at + 1] << 8);
}
void put_word(Page& page, std::size_t at, int value) {
  page[at] = static_cast<std::uint8_t>(value);
  page[at + 1] = static_cast<std::uint8_t>(value >> 8);
}

int sum_of(const Page& page) {
  return std::accumulate(page.begin(), page.end(), 0) & 0xFF;
}

double unit_s(const Page& page) {
  return kUnit_s * kNormalSpeed / std::max<int>(page[kSpeed], 1);
}

/// A word that a file may have for a name, and that is not taken yet.
std::string name_of_page(const Page& page, std::size_t number, std::set<std::string>& taken) {
  std::string name;
  for (std::size_t i = kName; i < kNameBytes && page[i] != 0; ++i) {
    const bool plain = std::isalnum(page[i]) != 0 || page[i] == '_' || page[i] == '-';
    name += plain ? static_cast<char>(std::tolower(page[i])) : '_';
  }
  if (name.empty() || name == "stand") name = fmt::format("page{}", number);
  while (!taken.insert(name).second) name += fmt::format("_{}", number);
  return name;
}

FrameText frame_of(const Params& params, const Page& page, std::size_t step) {
  FrameText frame;
  const std::size_t at = step_at(step);
  frame.time_s = std::max(1e-3 * kLeastFrame_ms, page[at + kTime] * unit_s(page));
  frame.hold_s = page[at + kPause] * unit_s(page);
  if (step == 0) frame.balance = false;  // its goals are of servos, whatever bears on them
  Stiffness off{{}, 0, 0}, on{{}, 100, 0};
  for (int j = 0; j < params.joint_count; ++j) {
    const JointParams& joint = params.joint[j];
    if (joint.servo_id >= kPageServos) continue;
    const std::uint16_t position = word(page, at + 2U * joint.servo_id);
    if ((position & kInvalid) != 0) continue;
    ((position & kTorqueOff) != 0 ? off : on).joints.emplace_back(joint.name);
    frame.goals.push_back(
        {joint.name, false, static_cast<double>(model::angle_of(joint, position & kCount)), 0});
  }
  if (!off.joints.empty()) {
    frame.stiffness.push_back(off);
    if (!on.joints.empty()) frame.stiffness.push_back(on);
  }
  return frame;
}

Document document_of(const Params& params, const Page& page) {
  Document document;
  const std::size_t steps = std::min<std::size_t>(page[kStepCount], kSteps);
  for (std::size_t i = 0; i < steps; ++i) document.frames.push_back(frame_of(params, page, i));
  if (page[kRepeat] > 1 && !document.frames.empty()) {
    document.frames.front().label = "first";
    document.frames.back().repeat = Repeat{page[kRepeat] - 1, {"first", 0}};
  }
  return document;
}

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
  const FrameText there = frame_of(params, page, step);
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

/// Where an action goes on, and with what force: pages have that, but it is not written to them.
std::string way_of(const Document& document) {
  const auto name = [](const std::optional<Target>& target) {
    return target ? target->name : std::string();
  };
  std::string way = name(document.link);
  for (const FrameText& frame : document.frames) {
    way += "|" + name(frame.exit);
    if (frame.repeat) way += fmt::format(" {} {}", frame.repeat->times, frame.repeat->from.name);
    for (const Stiffness& each : frame.stiffness) {
      way += fmt::format(" {}", each.percent);
      for (const std::string& joint : each.joints) way += " " + joint;
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

/// Empty: the page may be read.
std::string wrong_with(const Page& page) {
  if (sum_of(page) != 0xFF) return fmt::format("a wrong checksum (byte {})", kChecksum);
  if (page[kStepCount] > kSteps)
    return fmt::format("{} steps, it has room for {} (byte {})", page[kStepCount], kSteps,
                       kStepCount);
  for (std::size_t step = 0; step < page[kStepCount]; ++step) {
    for (std::size_t id = 1; id < kPageServos; ++id) {
      const std::size_t at = step_at(step) + 2 * id;
      if ((word(page, at) & kInvalid) != 0 || (word(page, at) & kUnused) == 0) continue;
      return fmt::format("0x{:04x} for the position of servo {} in step {} (byte {})",
                         word(page, at), id, step + 1, at);
    }
  }
  return "";
}

}  // namespace

Page blank_page() {
  Page page{};
  page[kRepeat] = 1;
  page[kSchedule] = 0x0A;  // times, not speeds
  page[kSpeed] = page[kAccel] = kNormalSpeed;
  std::fill_n(page.begin() + kGain, kPageServos, std::uint8_t{0x55});
  for (std::size_t step = 0; step < kSteps; ++step) {
    for (std::size_t id = 0; id < kPageServos; ++id)
      put_word(page, step_at(step) + 2 * id, kInvalid);
  }
  seal(page);
  return page;
}

void seal(Page& page) {
  page[kChecksum] = 0;
  page[kChecksum] = static_cast<std::uint8_t>(0xFF - sum_of(page));
}

Motion read_motion(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<char> bytes(kPages * kPageBytes + 1);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (static_cast<std::size_t>(stream.gcount()) != kPages * kPageBytes) {
    throw model::LoadError(file.string(), 0,
                           "is no ROBOTIS motion file of 256 pages (131072 bytes)",
                           "give a motion_*.bin");
  }
  Motion motion(kPages);
  for (std::size_t i = 0; i < kPages; ++i) {
    std::copy_n(bytes.data() + i * kPageBytes, kPageBytes, motion[i].begin());
    const std::string wrong = wrong_with(motion[i]);
    if (wrong.empty()) continue;
    throw model::LoadError(file.string(), 0,
                           fmt::format("page {} (from byte {}) has {}", i, i * kPageBytes, wrong),
                           "take an intact copy");
  }
  return motion;
}

std::vector<Document> from_motion(const Params& params, const Motion& motion) {
  std::set<std::string> taken;
  std::vector<Document> documents(kPages);
  const Page blank = blank_page();
  for (std::size_t i = 0; i < kPages; ++i) {
    if (motion[i] == blank) continue;
    documents[i] = document_of(params, motion[i]);
    documents[i].name = name_of_page(motion[i], i, taken);
    documents[i].page = PageText{static_cast<int>(i), {motion[i].begin(), motion[i].end()}};
  }
  for (Document& each : documents) {
    if (!each.page || each.frames.empty()) continue;
    const auto follow = [&](std::size_t at) -> const Document* {
      const std::size_t to = motion[static_cast<std::size_t>(each.page->number)][at];
      return to != 0 && !documents[to].frames.empty() ? &documents[to] : nullptr;
    };
    if (const Document* next = follow(kNext)) each.link = Target{next->name, 0};
    if (const Document* exit = follow(kExit)) each.frames.front().exit = Target{exit->name, 0};
  }
  std::erase_if(documents, [](const Document& each) { return !each.page; });
  return documents;
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
