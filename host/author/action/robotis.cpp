#include "host/author/action/robotis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <numeric>
#include <set>

#include "common/model/counts.hpp"
#include "common/model/tree.hpp"
#include "host/author/action/robotis_page.hpp"

namespace verp::action {
namespace {

using namespace page;

int sum_of(const Page& page) {
  return std::accumulate(page.begin(), page.end(), 0) & 0xFF;
}

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

Document document_of(const Params& params, const Page& page) {
  Document document;
  const std::size_t steps = std::min<std::size_t>(page[kStepCount], kSteps);
  for (std::size_t i = 0; i < steps; ++i) document.frames.push_back(frame_of_page(params, page, i));
  if (page[kRepeat] > 1 && !document.frames.empty()) {
    document.frames.front().label = "first";
    document.frames.back().repeat = Repeat{page[kRepeat] - 1, {"first", 0}};
  }
  return document;
}

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

FrameText frame_of_page(const Params& params, const Page& page, std::size_t step) {
  FrameText frame;
  const std::size_t at = step_at(step);
  frame.time_s = std::max(1e-3 * kLeastFrame_ms, page[at + kTime] * unit_s(page));
  frame.hold_s = page[at + kPause] * unit_s(page);
  if (step == 0) frame.balance = false;  // its goals are servo angles under load
  Stiffness off{{}, 0, 0}, on{{}, 100, 0};
  bool was_off = false;  // torque stays off until a frame turns it on
  for (int j = 0; j < params.joint_count; ++j) {
    const JointParams& joint = params.joint[j];
    if (joint.servo_id >= kPageServos) continue;
    const std::uint16_t position = word(page, at + 2U * joint.servo_id);
    if ((position & kInvalid) != 0) continue;
    ((position & kTorqueOff) != 0 ? off : on).joints.emplace_back(joint.name);
    for (std::size_t i = 0; i < step; ++i)
      was_off |=
          (word(page, step_at(i) + 2U * joint.servo_id) & (kTorqueOff | kInvalid)) == kTorqueOff;
    frame.goals.push_back(
        {joint.name, false, static_cast<double>(model::angle_of(joint, position & kCount)), 0});
  }
  if (!off.joints.empty()) frame.stiffness.push_back(off);
  if (!on.joints.empty() && (was_off || !off.joints.empty())) frame.stiffness.push_back(on);
  return frame;
}

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
  if (!stream) {
    throw model::LoadError(file.string(), 0, "cannot be read", "give a motion_*.bin");
  }
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

}  // namespace verp::action
