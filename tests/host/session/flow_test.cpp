#include "host/run/session/flow.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace verp::session {
namespace {

TEST(Flow, RunsOnlyInsideResumeAndUpToItsPause) {
  std::string told;
  Flow flow([&](Flow& own) {
    told += "a";
    own.pause();
    told += "b";
    own.pause();
    told += "c";
  });
  EXPECT_EQ(told, "");
  EXPECT_TRUE(flow.resume());
  told += "1";
  EXPECT_TRUE(flow.resume());
  told += "2";
  EXPECT_FALSE(flow.resume());
  EXPECT_FALSE(flow.resume()) << "it has ended";
  EXPECT_EQ(told, "a1b2c");
}

TEST(Flow, ThrowsInResumeWhatItsBodyThrew) {
  Flow flow([](Flow& own) {
    own.pause();
    throw std::runtime_error("no servo");
  });
  EXPECT_TRUE(flow.resume());
  EXPECT_THROW(flow.resume(), std::runtime_error);
  EXPECT_FALSE(flow.resume());
}

TEST(Flow, UnwindsABodyThatNobodyRunsToItsEnd) {
  struct Leaves {
    ~Leaves() {
      flow.pause();  // no effect: no caller resumes
      left = true;
    }
    Flow& flow;
    bool& left;
  };
  bool left = false, went_on = false;
  {
    Flow flow([&](Flow& own) {
      const Leaves leaves{own, left};
      own.pause();
      went_on = true;
    });
    flow.resume();
    EXPECT_FALSE(left);
  }
  EXPECT_TRUE(left);
  EXPECT_FALSE(went_on);
}

TEST(Flow, HasACallMadeOnTheStackOfWhoeverResumes) {
  const char* resumed = nullptr;
  const auto far = [&resumed](const char* other) {
    return std::abs(reinterpret_cast<std::intptr_t>(resumed) -
                    reinterpret_cast<std::intptr_t>(other)) > (1 << 20);
  };
  bool body_is_far = false, call_is_far = true;
  std::string told;
  Flow flow([&](Flow& own) {
    body_is_far = far(static_cast<const char*>(__builtin_frame_address(0)));
    own.outside([&] { call_is_far = far(static_cast<const char*>(__builtin_frame_address(0))); });
    try {
      own.outside([] { throw std::runtime_error("no controller"); });
    } catch (const std::runtime_error& error) {
      told = error.what();
    }
    own.pause();
    own.outside([] { throw std::runtime_error("nobody catches it"); });
  });
  resumed = static_cast<const char*>(__builtin_frame_address(0));
  EXPECT_TRUE(flow.resume());
  EXPECT_TRUE(body_is_far);
  EXPECT_FALSE(call_is_far);
  EXPECT_EQ(told, "no controller");
  EXPECT_THROW(flow.resume(), std::runtime_error);
  EXPECT_FALSE(flow.resume());
}

TEST(Flow, ThatNeverRanNeverDoes) {
  bool ran = false;
  {
    const Flow flow([&](Flow&) { ran = true; });
  }
  EXPECT_FALSE(ran);
}

}  // namespace
}  // namespace verp::session
