#include "host/study/survey/workers.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace verp::survey {
namespace {

TEST(Workers, DoEachPieceOnceAndSayHowFarTheyAre) {
  double share = -1;
  const Watch watch{.interrupted = {}, .went_on = [&](double now) { share = now; }, .threads = 4};
  std::vector<int> done(100);
  Workers workers(watch, done.size());
  workers.run(done.size(), [&](std::size_t i) {
    ++done[i];
    workers.step_done();
  });
  EXPECT_EQ(done, std::vector<int>(100, 1));
  EXPECT_EQ(share, 1);
  EXPECT_FALSE(workers.stopped());
}

// The waiting thread often wakes after the last piece.
TEST(Workers, SayInTheEndThatAllIsDoneHoweverFastItWas) {
  for (int survey = 0; survey < 500; ++survey) {
    double share = -1;
    const Watch watch{.interrupted = {}, .went_on = [&](double now) { share = now; }, .threads = 1};
    Workers workers(watch, 1);
    workers.run(1, [&](std::size_t) { workers.step_done(); });
    ASSERT_EQ(share, 1) << survey;
  }
}

TEST(Workers, OneThatThrowsEndsTheOthersAndIsHeardOf) {
  const Watch watch{.interrupted = {}, .went_on = {}, .threads = 3};
  Workers workers(watch, 3);
  const auto work = [&](std::size_t i) {
    if (i == 1) throw std::runtime_error("the second");
    while (!workers.stopped()) {
    }
  };
  try {
    workers.run(3, work);
    FAIL() << "nobody heard of it";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "the second");
  }
}

TEST(Workers, BeginNothingMoreOnceSomebodyInterrupts) {
  std::atomic<int> begun = 0;
  const Watch watch{.interrupted = [&] { return begun > 0; }, .went_on = {}, .threads = 2};
  Workers workers(watch, 1000);
  workers.run(1000, [&](std::size_t) {
    ++begun;
    while (!workers.stopped()) {
    }
  });
  EXPECT_LE(begun, 2);
  EXPECT_TRUE(workers.stopped());
}

}  // namespace
}  // namespace verp::survey
