#include "host/twin/eds/eds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <string>

#include "common/protocol/canopen/device.hpp"
#include "firmware/app/controller_objects.hpp"
#include "firmware/app/tick_log.hpp"
#include "host/twin/can/device_node.hpp"
#include "tests/host/bus/fake_plant.hpp"
#include "tests/unit/images/actions_board.hpp"
#include "tests/unit/support/test_robot.hpp"

// The test parses the EDS like another maker's tool.
namespace verp::eds {
namespace {

using canopen::Abort;
using Section = std::map<std::string, std::string>;
using Sections = std::map<std::string, Section>;

Sections parse(const std::string& text) {
  Sections sections;
  std::istringstream in(text);
  std::string line, name;
  while (std::getline(in, line)) {
    if (line.empty()) continue;
    if (line.front() == '[') {
      name = line.substr(1, line.find(']') - 1);
      EXPECT_EQ(sections.count(name), 0u) << name << " stands there twice";
      sections[name];
      continue;
    }
    const std::size_t equals = line.find('=');
    EXPECT_NE(equals, std::string::npos) << line;
    EXPECT_TRUE(sections[name].emplace(line.substr(0, equals), line.substr(equals + 1)).second)
        << name << ": " << line;
  }
  return sections;
}

std::uint32_t number(const Section& section, const char* key) {
  return static_cast<std::uint32_t>(std::stoul(section.at(key), nullptr, 0));
}

/// 0: variable.
std::uint32_t bytes_of(std::uint32_t type) {
  switch (static_cast<DataType>(type)) {
    case DataType::kInteger8:
    case DataType::kUnsigned8:
      return 1;
    case DataType::kInteger16:
    case DataType::kUnsigned16:
      return 2;
    case DataType::kInteger32:
    case DataType::kUnsigned32:
    case DataType::kReal32:
      return 4;
    case DataType::kUnsigned64:
      return 8;
    case DataType::kVisibleString:
    case DataType::kDomain:
      return 0;
  }
  ADD_FAILURE() << "no such type: " << type;
  return 0;
}

/// Null if no section has the value.
const Section* section_of(const Sections& sections, unsigned index, unsigned subindex) {
  char name[16];
  std::snprintf(name, sizeof name, "%X", index);
  const auto whole = sections.find(name);
  if (whole == sections.end()) return nullptr;
  if (whole->second.count("DataType") > 0) return subindex == 0 ? &whole->second : nullptr;
  std::snprintf(name, sizeof name, "%Xsub%X", index, subindex);
  const auto member = sections.find(name);
  return member == sections.end() ? nullptr : &member->second;
}

template <class Objects>
void expect_same(const Sections& sections, Objects& node, unsigned least = 101) {
  unsigned found = 0;
  for (unsigned index = 0x1000; index <= 0x9FFF; ++index) {
    for (unsigned subindex = 0; subindex <= 255; ++subindex) {
      const canopen::Address at{static_cast<std::uint16_t>(index),
                                static_cast<std::uint8_t>(subindex)};
      canopen::Entry entry;
      const Abort abort = node.find(at, entry);
      const Section* section = section_of(sections, index, subindex);
      ASSERT_EQ(section != nullptr, abort == Abort::kNone)
          << std::hex << index << " sub " << subindex;
      if (section == nullptr && subindex == 0) break;
      if (section == nullptr) continue;
      ++found;
      const std::uint32_t size = bytes_of(number(*section, "DataType"));
      EXPECT_TRUE(size == 0 || size == entry.max_size) << std::hex << index << " sub " << subindex;
      EXPECT_EQ(section->at("AccessType") == "rw", entry.writable) << std::hex << index;
      EXPECT_TRUE(entry.readable);
    }
  }
  EXPECT_GE(found, least);
}

/// "": no default.
std::string initial_of(const Section& section) {
  const auto found = section.find("DefaultValue");
  return found == section.end() ? "" : found->second;
}

/// Low bits of negative values.
std::uint64_t evaluate(const std::string& text, std::uint8_t node) {
  constexpr const char* kNode = "$NODEID+";
  if (text.rfind(kNode, 0) == 0) return node + std::stoull(text.substr(8), nullptr, 0);
  return text.front() == '-' ? static_cast<std::uint64_t>(std::stoll(text, nullptr, 0))
                             : std::stoull(text, nullptr, 0);
}

/// The objects hold the sheet's defaults and map as it allows.
template <class Node>
void expect_fresh(const Sections& sections, Node& node, std::uint8_t id) {
  int compared = 0;
  for (unsigned index = 0x1000; index <= 0x6FFF; ++index) {
    for (unsigned subindex = 0; subindex <= 255; ++subindex) {
      const canopen::Address at{static_cast<std::uint16_t>(index),
                                static_cast<std::uint8_t>(subindex)};
      canopen::Entry entry;
      const bool there = node.device().objects().find(at, entry) == Abort::kNone;
      if (!there && subindex == 0) break;
      if (!there) continue;
      const Section* section = section_of(sections, index, subindex);
      ASSERT_NE(section, nullptr);
      const auto bits = static_cast<std::uint8_t>(8 * entry.max_size);
      const bool mappable =
          index >= 0x2000 && (node.application().mappable(at, bits, true) == Abort::kNone ||
                              node.application().mappable(at, bits, false) == Abort::kNone);
      EXPECT_EQ(section->at("PDOMapping") == "1", mappable) << std::hex << index;
      const std::string initial = initial_of(*section);
      std::uint8_t bytes[8] = {};
      if (entry.max_size > 4 ||
          node.device().objects().read(at, 0, bytes, entry.max_size) != Abort::kNone)
        continue;
      if (initial.empty()) {
        EXPECT_TRUE(!entry.writable || index == can::kGains || can::is_commissioned(at))
            << std::hex << index << " sub " << subindex;
        continue;
      }
      const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
      EXPECT_EQ(canopen::get_le(bytes, 8), evaluate(initial, id) & mask)
          << std::hex << index << " sub " << subindex;
      ++compared;
    }
  }
  EXPECT_GT(compared, 20);
}

template <class Objects>
void expect_same_tpdos(const Sections& sections, Objects& node, std::uint8_t id) {
  for (unsigned index = 0x1801; index <= 0x1803; ++index) {
    for (const unsigned each : {index, index + 0x200}) {
      const bool mapping = each >= 0x1A00;
      for (unsigned subindex = mapping ? 0 : 1; subindex <= (mapping ? 8u : 2u); ++subindex) {
        std::uint8_t bytes[4] = {};
        const unsigned size = mapping ? (subindex == 0 ? 1 : 4) : (subindex == 1 ? 4 : 1);
        ASSERT_EQ(node.read({static_cast<std::uint16_t>(each), static_cast<std::uint8_t>(subindex)},
                            0, bytes, size),
                  Abort::kNone);
        std::string text = initial_of(*section_of(sections, each, subindex));
        EXPECT_NE(text, "") << std::hex << each << " sub " << subindex;
        const std::string relative = "$NODEID+";
        const bool adds = text.rfind(relative, 0) == 0;
        if (adds) text = text.substr(relative.size());
        const std::uint64_t value =
            (text.empty() ? 0 : std::stoul(text, nullptr, 0)) + (adds ? id : 0u);
        EXPECT_EQ(canopen::get_le(bytes, size), value) << std::hex << each << " sub " << subindex;
      }
    }
  }
}

void expect_listed(const Sections& sections) {
  std::map<unsigned, int> listed;
  for (const char* list : {"MandatoryObjects", "OptionalObjects", "ManufacturerObjects"}) {
    const Section& each = sections.at(list);
    const std::uint32_t count = number(each, "SupportedObjects");
    EXPECT_EQ(each.size(), count + 1) << list;
    for (std::uint32_t i = 1; i <= count; ++i) {
      ++listed[number(each, std::to_string(i).c_str())];
    }
  }
  unsigned objects = 0;
  for (const auto& [name, section] : sections) {
    const bool object = section.count("ObjectType") > 0 && name.find("sub") == std::string::npos;
    if (!object) continue;
    ++objects;
    EXPECT_EQ(listed[static_cast<unsigned>(std::stoul(name, nullptr, 16))], 1) << name;
    if (section.count("SubNumber") == 0) continue;
    std::uint32_t members = 0;
    for (unsigned subindex = 0; subindex < 256; ++subindex) {
      members += section_of(sections, static_cast<unsigned>(std::stoul(name, nullptr, 16)),
                            subindex) != nullptr;
    }
    EXPECT_EQ(number(section, "SubNumber"), members) << name;
  }
  EXPECT_EQ(listed.size(), objects);
}

template <class Node>
void expect_device(const Description& description, Node& node, std::uint8_t id, unsigned least) {
  const Sections sections = parse(to_text(description));
  expect_listed(sections);
  expect_same(sections, node.device().objects(), least);
  expect_fresh(sections, node, id);
}

TEST(Eds, TheControllersSheetIsWhatTheControllerAnswers) {
  const Sections sections = parse(to_text(controller()));
  expect_listed(sections);
  auto board = std::make_unique<app::test::FakeBoard>();
  using Log = app::TickLog;
  auto log = std::make_unique<Log>(board->images);
  log->keep({}, {});
  log->hold(Log::kAll);  // makes ticks readable
  auto registers =
      std::make_unique<app::OperatorRegisters>(test::kRobot, app::OperatorSetup{}, *log);
  app::ControllerObjects objects(*registers, *log);
  using Node = canopen::Device<app::ControllerObjects, app::kControllerSize>;
  constexpr std::uint8_t kNode = 127;
  auto node = std::make_unique<Node>(objects, app::controller_identity(), kNode);
  expect_same(sections, node->objects());
  app::publish_ticks(node->objects(), kNode, true);
  expect_same_tpdos(sections, node->objects(), kNode);
}

TEST(Eds, TheDevicesSheetsAreWhatTheyAnswer) {
  constexpr std::uint8_t kNode = 37;
  verp::test::FakePlant plant;
  // With a default of 0, a tool that writes defaults would erase the gains.
  const can::DriveSetup commissioned{
      .counts_per_rad = 2608, .p_gain = 778, .i_gain = 3, .d_gain = 91};
  can::DriveNode of_drive(can::drive_identity(402, kNode), kNode, plant, 0, commissioned);
  expect_device(drive(), of_drive, kNode, 100);
  can::ImuNode of_imu(can::imu_identity(kNode), kNode, plant);
  expect_device(imu(), of_imu, kNode, 60);
  can::FootNode of_foot(can::foot_identity(kNode), kNode, plant, 1);
  expect_device(foot(), of_foot, kNode, 40);
}

// A tool takes an empty default for 0 or an error.
TEST(Eds, AllThatIsSetUpOnTheBusHasADefaultAndNoneIsEmpty) {
  for (const Sheet& sheet : sheets()) {
    const Sections sections = parse(to_text(sheet.describe()));
    int writable = 0;
    for (const auto& [name, section] : sections) {
      const auto initial = section.find("DefaultValue");
      if (initial != section.end()) {
        EXPECT_NE(initial->second, "") << sheet.node << ' ' << name;
      }
      if (section.count("AccessType") == 0 || section.at("AccessType") != "rw") continue;
      if (std::stoul(name, nullptr, 16) >= 0x2000) continue;
      ++writable;
      EXPECT_NE(initial, section.end()) << sheet.node << ' ' << name;
    }
    EXPECT_GE(writable, 20) << sheet.node;
  }
}

TEST(Eds, AControllerWithoutImagesAnswersForThem) {
  app::OperatorRegisters registers(test::kRobot, app::OperatorSetup{}, app::no_images);
  app::ControllerObjects objects(registers, app::no_images);
  int domains = 0;
  for (const Object& each : controller().objects) {
    canopen::Entry entry;
    const Abort abort = objects.find({each.index, 0}, entry);
    if (each.values.front().type != DataType::kDomain) continue;
    ++domains;
    EXPECT_EQ(abort, Abort::kNoData) << std::hex << each.index;
  }
  EXPECT_EQ(domains, 4);
}

TEST(Eds, HowManyEntriesAnObjectHasIsKnownByName) {
  const auto known = known_entries(drive().identity);
  const auto count = [&](canopen::Address at) -> const Entry* {
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const Entry& each) { return each.at == at; });
    return found == known.end() ? nullptr : &*found;
  };
  ASSERT_NE(count({0x1A00, 0}), nullptr);
  EXPECT_TRUE(count({0x1A00, 0})->value.writable);
  ASSERT_NE(count({0x608F, 0}), nullptr);
  EXPECT_EQ(count({0x608F, 0})->value.name, "Position encoder resolution, entries");
}

std::size_t count_of(const std::vector<Entry>& entries, std::uint16_t first, std::uint16_t last) {
  return static_cast<std::size_t>(std::count_if(
      entries.begin(), entries.end(),
      [&](const Entry& each) { return each.at.index >= first && each.at.index <= last; }));
}

TEST(Eds, AnotherMakersDriveHasOnlyTheProfilesNames) {
  const canopen::Identity ours = drive().identity;
  const auto known = known_entries(ours);
  EXPECT_EQ(count_of(known, 0x2000, 0x5FFF), 5u);  // telemetry, three gains and a count
  canopen::Identity others[] = {ours, ours};
  others[0].vendor = 0x22;
  others[1].product += 1;
  for (const canopen::Identity& each : others) {
    const auto foreign = known_entries(each);
    EXPECT_EQ(count_of(foreign, 0x2000, 0x5FFF), 0u);
    EXPECT_EQ(foreign.size(), known.size() - 5);
    EXPECT_GT(count_of(foreign, 0x6000, 0x9FFF), 0u);
  }
  EXPECT_TRUE(known_entries({.device_type = 0x00020191, .vendor = 0x22}).empty());
}

TEST(Eds, KnownEntriesStandWhereTheSheetHasThem) {
  std::map<std::uint32_t, std::string> names;
  for (const Entry& each : known_entries(drive().identity)) {
    EXPECT_TRUE(names.emplace(each.at.index << 8 | each.at.subindex, each.value.name).second);
  }
  EXPECT_EQ(names.at(0x100000), "Device type");
  EXPECT_EQ(names.at(0x140005), "Event timer");
  EXPECT_EQ(names.at(0x200203), "D gain");
}

TEST(Eds, ShippedSheetsAreUpToDate) {
  for (const Sheet& each : sheets()) {
    std::ifstream in(std::string(VERP_SOURCE_DIR "/") + each.shipped);
    const std::string shipped{std::istreambuf_iterator<char>(in), {}};
    EXPECT_TRUE(shipped == to_text(each.describe()))
        << "out of date: ./verp bus eds " << each.node << " > " << each.shipped;
  }
}

}  // namespace
}  // namespace verp::eds
