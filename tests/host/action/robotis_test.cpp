#include "host/author/action/robotis.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <fstream>

#include "host/author/action/csv.hpp"
#include "tests/host/action/robots.hpp"

namespace verp::action {
namespace {

using test::Robot;

constexpr std::size_t kStepCount = 20, kFirstStep = 64;

const Robot& op3() {
  static const Robot robot("op3");
  return robot;
}

/// Some are blank or unused, with torque off and bytes of unknown meaning.
Motion some_motion() {
  Motion motion(kPages, blank_page());
  std::uint32_t random = 7;
  const auto next = [&] { return (random = random * 1664525U + 1013904223U) >> 16; };
  for (std::size_t i = 1; i < kPages; i += 3) {
    Page& page = motion[i];
    page[kStepCount] = static_cast<std::uint8_t>(next() % 8);
    for (std::size_t k = 0; k < 13; ++k) page[k] = static_cast<std::uint8_t>(next());
    page[14] = static_cast<std::uint8_t>(next());
    page[15] = static_cast<std::uint8_t>(next() % 4);
    page[22] = static_cast<std::uint8_t>(16 + next() % 64);
    page[25] = static_cast<std::uint8_t>(next());
    page[26] = static_cast<std::uint8_t>(next());
    for (std::size_t at = kFirstStep; at < kPageBytes; at += 2) {
      const unsigned flags = next() % 8 == 0 ? 0x4000 : next() % 16 == 0 ? 0x2000 : 0;
      const unsigned word = (next() & 0xFFF) | flags;
      page[at] = static_cast<std::uint8_t>(word);
      page[at + 1] = static_cast<std::uint8_t>(word >> 8);
    }
    seal(page);
  }
  return motion;
}

TEST(RobotisMotion, GoesThroughActionFilesByteForByte) {
  const Motion motion = some_motion();
  std::vector<Document> documents;
  for (const Document& each : from_motion(op3().params, motion)) {
    documents.push_back(parse_document(each.name + ".action", text_of(each)));
  }
  EXPECT_EQ(documents.size(), 85U);
  EXPECT_TRUE(to_motion(op3().params, documents) == motion);
}

TEST(RobotisMotion, AnEditOfAnAngleIsOneOfItsPage) {
  Motion motion(kPages, blank_page());
  Page& page = motion[9];
  page[kStepCount] = 1;
  page[kFirstStep + 2 * 3] = 0x00;  // servo 3 at zero
  page[kFirstStep + 2 * 3 + 1] = 0x08;
  page[kFirstStep + 63] = 125;
  seal(page);
  std::vector<Document> documents = from_motion(op3().params, motion);
  ASSERT_EQ(documents.size(), 1U);
  ASSERT_EQ(documents[0].frames[0].goals.size(), 1U);
  EXPECT_NEAR(documents[0].frames[0].time_s, 0.975, 1e-6);
  documents[0].frames[0].goals[0].angle_rad = 0.5;
  const Motion edited = to_motion(op3().params, documents);
  const int count = edited[9][kFirstStep + 6] | edited[9][kFirstStep + 7] << 8;
  EXPECT_EQ(std::abs(count - 2048), 326) << "half a radian of 651.9 counts";
  documents = from_motion(op3().params, edited);
  EXPECT_NEAR(documents[0].frames[0].goals[0].angle_rad, 0.5, 1e-3);
}

TEST(RobotisMotion, AnAngleIsAddedBesideAServoWithoutTorque) {
  Motion motion(kPages, blank_page());
  const auto put = [&](std::size_t id, std::uint16_t word) {
    motion[1][kFirstStep + 2 * id] = static_cast<std::uint8_t>(word);
    motion[1][kFirstStep + 2 * id + 1] = static_cast<std::uint8_t>(word >> 8);
  };
  motion[1][kStepCount] = 1;
  put(1, 0x2800);  // torque off
  put(3, 0x0800);
  seal(motion[1]);
  std::vector<Document> documents = from_motion(op3().params, motion);
  ASSERT_EQ(documents.size(), 1U);
  const std::size_t goals = documents[0].frames[0].goals.size();
  ASSERT_EQ(goals, 2U);
  documents[0].frames[0].goals.push_back({"head_pan", false, 0.25, 0});
  documents = from_motion(op3().params, to_motion(op3().params, documents));
  EXPECT_EQ(documents[0].frames[0].goals.size(), goals + 1);
}

TEST(RobotisMotion, EditsOfLinkExitRepeatAndTorqueAreOfItsPage) {
  const Params& params = op3().params;
  Motion motion(kPages, blank_page());
  for (const std::size_t page : {1U, 2U}) {
    motion[page][0] = static_cast<std::uint8_t>('a' + page);
    motion[page][kStepCount] = 2;
    for (const std::size_t step : {kFirstStep, kFirstStep + 64}) {
      motion[page][step + 2 * 3 + 1] = 0x08;  // servo 3
      motion[page][step + 2 * 3] = 0x00;
    }
    seal(motion[page]);
  }
  std::vector<Document> documents = from_motion(params, motion);
  ASSERT_EQ(documents.size(), 2U);
  Document& b = documents[0];
  ASSERT_EQ(b.frames.size(), 2U);
  b.link = Target{"c", 1};
  b.frames[0].exit = Target{"new", 1};
  b.frames[0].label = "start";
  b.frames[1].repeat = Repeat{4, {"start", 1}};
  b.frames[0].stiffness = {{{b.frames[0].goals[0].joint}, 0, 1}};
  b.frames[1].stiffness = {{{}, 100, 1}};
  Document added = documents[1];
  added.page.reset();
  added.name = "new";
  added.link = Target{"b", 1};
  documents.push_back(added);

  const Motion edited = to_motion(params, documents);
  constexpr std::size_t kRepeatAt = 15, kNextAt = 25, kExitAt = 26;
  EXPECT_EQ(edited[1][kNextAt], 2);
  EXPECT_EQ(edited[1][kExitAt], 3) << "the first free page";
  EXPECT_EQ(edited[1][kRepeatAt], 5) << "once, and four times more";
  EXPECT_EQ(edited[3][kNextAt], 1);
  EXPECT_EQ(edited[1][kFirstStep + 2 * 3 + 1] & 0x20, 0x20);
  EXPECT_EQ(edited[1][kFirstStep + 64 + 2 * 3 + 1] & 0x20, 0);
  EXPECT_TRUE(edited[2] == motion[2]);

  documents = from_motion(params, edited);
  ASSERT_EQ(documents.size(), 3U);
  ASSERT_TRUE(documents[0].link && documents[0].frames[0].exit && documents[0].frames[1].repeat);
  EXPECT_EQ(documents[0].link->name, "c");
  EXPECT_EQ(documents[0].frames[0].exit->name, "new");
  EXPECT_EQ(documents[0].frames[1].repeat->times, 4);
  EXPECT_TRUE(to_motion(params, documents) == edited);
  documents[0].link.reset();
  EXPECT_EQ(to_motion(params, documents)[1][kNextAt], 0);
}

// Two pages share a name; a third has the name that one of them would get.
TEST(RobotisMotion, EachPageHasANameOfItsOwn) {
  Motion motion(kPages, blank_page());
  const auto call = [&](std::size_t page, const std::string& name) {
    std::copy(name.begin(), name.end(), motion[page].begin());
    seal(motion[page]);
  };
  call(1, "foo");
  call(3, "foo_5");
  call(5, "foo");
  const std::vector<Document> documents = from_motion(op3().params, motion);
  ASSERT_EQ(documents.size(), 3U);
  EXPECT_NE(documents[2].name, documents[1].name);
  EXPECT_NE(documents[2].name, documents[0].name);
  EXPECT_TRUE(to_motion(op3().params, documents) == motion);
}

TEST(RobotisMotion, WhatNoPageWouldKeepIsRefused) {
  Motion motion(kPages, blank_page());
  for (const std::size_t page : {1U, 2U}) {
    motion[page][0] = static_cast<std::uint8_t>('a' + page);
    motion[page][kStepCount] = 1;
    seal(motion[page]);
  }
  const std::vector<Document> good = from_motion(op3().params, motion);
  ASSERT_EQ(good.size(), 2U);
  ASSERT_TRUE(to_motion(op3().params, good) == motion);
  const auto expect_refused = [&](const char* what, const auto& spoil) {
    std::vector<Document> documents = good;
    spoil(documents);
    try {
      to_motion(op3().params, documents);
      ADD_FAILURE() << what << " is lost without a word";
    } catch (const model::LoadError& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  };
  using Documents = std::vector<Document>;
  expect_refused("no joint 'nose'", [](Documents& all) {
    all[0].frames[0].goals.push_back({"nose", false, 0.1, 3});
  });
  expect_refused("another action's", [](Documents& all) { all[1].page->number = 1; });
  expect_refused("is called", [](Documents& all) { all[0].name = "zoo"; });
  expect_refused("reached as 'd'", [](Documents& all) { all[0].link = Target{"d", 2}; });
  expect_refused("repeat", [](Documents& all) {
    all[0].frames[0].repeat = Repeat{2, {"first", 2}};
  });
  expect_refused("stiffness", [](Documents& all) { all[0].frames[0].stiffness = {{{}, 30, 2}}; });
  expect_refused("reached as 'd'", [](Documents& all) { all[0].frames[0].exit = Target{"d", 2}; });
  expect_refused("one exit", [](Documents& all) {
    all[0].frames.push_back(all[0].frames[0]);
    all[0].frames[1].exit = Target{"c", 2};
  });
  expect_refused("joints that it moves", [](Documents& all) {
    all[0].frames[0].goals.clear();
    all[0].frames[0].stiffness = {{{"head_pan"}, 0, 2}};
  });
  expect_refused("mirror", [](Documents& all) {
    all.push_back({});
    all.back().name = "m";
    all.back().mirror = Target{"b", 2};
  });
}

TEST(RobotisMotion, FilesOfAnotherSizeOrADamagedPageAreRefused) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("motion" + std::to_string(getpid()) + ".bin");
  const auto write = [&](const Motion& motion, std::size_t bytes) {
    std::ofstream stream(file, std::ios::binary | std::ios::trunc);
    stream.write(reinterpret_cast<const char*>(motion.data()), static_cast<std::streamsize>(bytes));
  };
  Motion motion = some_motion();
  write(motion, kPages * kPageBytes);
  EXPECT_TRUE(read_motion(file) == motion);
  write(motion, kPages * kPageBytes - 1);
  EXPECT_THROW(read_motion(file), model::LoadError);
  motion[200][70] = static_cast<std::uint8_t>(motion[200][70] + 1);
  write(motion, kPages * kPageBytes);
  EXPECT_THROW(read_motion(file), model::LoadError);
  std::filesystem::remove(file);
}

// Their checksums are right.
TEST(RobotisMotion, PagesOfMoreStepsThanTheyHoldOrOfNoPositionsAreRefusedByNumber) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("rubbish" + std::to_string(getpid()) + ".bin");
  const auto why = [&](const auto& spoil) {
    Motion motion = some_motion();
    motion[9][kStepCount] = 7;
    spoil(motion[9]);
    seal(motion[9]);
    std::ofstream(file, std::ios::binary | std::ios::trunc)
        .write(reinterpret_cast<const char*>(motion.data()), kPages * kPageBytes);
    try {
      read_motion(file);
    } catch (const model::LoadError& error) {
      return error.message;
    }
    return std::string();
  };
  constexpr std::size_t kLastStep = kPageBytes - 64;
  EXPECT_EQ(why([](Page&) {}), "");
  EXPECT_EQ(why([](Page& page) { page[kStepCount] = 8; }),
            "page 9 (from byte 4608) has 8 steps, it has room for 7 (byte 20)");
  EXPECT_EQ(why([](Page& page) { page[kLastStep + 2 * 30 + 1] = 0x90; }).substr(0, 32),
            "page 9 (from byte 4608) has 0x90")
      << "of the last servo in the last step";
  EXPECT_EQ(why([](Page& page) { page[kLastStep + 2 * 30 + 1] = 0xF0; }), "")
      << "not to be used, whatever else it says";
  std::filesystem::remove(file);
}

TEST(ActionCsv, TableAndBackIsTheSameLibrary) {
  const CompiledActions made =
      op3().make({"action a\nframe 0.5 hold 0.2\n head_pan 20\n body z -0.02\n"
                  "frame 0.4\n head_pan -20\n body stand\n"});
  const std::string table = to_csv(op3().params, made, 1);
  const CompiledActions again =
      make_library(op3().params, {from_csv(op3().params, "a.csv", table, "a")});
  ASSERT_EQ(again.library().action(1).frames, 2);
  for (int i = 0; i < 2; ++i) {
    const Frame &one = made.library().frame(i), &other = again.library().frame(i);
    EXPECT_EQ(one.time_ms, other.time_ms);
    EXPECT_EQ(one.pause_ms, other.pause_ms);
    EXPECT_EQ(one.joints, other.joints);
    for (int j = 0; j < kMaxJoints; ++j) {
      EXPECT_NEAR(one.goal_tenth_mrad[j], other.goal_tenth_mrad[j], 1);
    }
  }
}

TEST(ActionCsv, BadTablesAreRefusedAtTheirLine) {
  const auto why = [](const std::string& table) {
    try {
      from_csv(op3().params, "t.csv", table, "t");
    } catch (const model::LoadError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(why("a,b\n1,2\n").substr(0, 8), "t.csv:1:");
  EXPECT_EQ(why("time_s,hold_s,head_pan\n1,0,0.1\n1,0\n").substr(0, 8), "t.csv:3:");
  EXPECT_EQ(why("time_s,hold_s,head_pan\n1,0,many\n").substr(0, 8), "t.csv:2:");
  EXPECT_EQ(why("time_s,hold_s,tail\n1,0,0.1\n").substr(0, 36),
            "t.csv:1: op3 has no joint 'tail'; it");
}

}  // namespace
}  // namespace verp::action
