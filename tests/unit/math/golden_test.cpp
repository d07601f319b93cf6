#include "tests/unit/math/golden.hpp"

#include <gtest/gtest.h>

namespace verp::math::golden {

TEST(MathGolden, UnaryFunctionsGiveTheCommittedBits) {
  for (int f = 0; f < kFunctionCount; ++f) {
    for (int i = 0; i < kArgumentCount; ++i) {
      EXPECT_EQ(to_bits(kFunctions[f].call(kArguments[i])), kResults[f][i])
          << kFunctions[f].name << " of bits " << to_bits(kArguments[i]);
    }
  }
}

TEST(MathGolden, Atan2GivesTheCommittedBits) {
  for (int i = 0; i < kPointCount; ++i) {
    EXPECT_EQ(to_bits(atan2(kPoints[i].y, kPoints[i].x)), kAtan2Results[i]) << "point " << i;
  }
}

TEST(MathGolden, AllExponentsGiveTheCommittedHash) {
  for (int f = 0; f < kFunctionCount; ++f) {
    EXPECT_EQ(hash_of(kFunctions[f].call, kHashCount), kHashes[f]) << kFunctions[f].name;
  }
  EXPECT_EQ(hash_of_atan2(kHashCount), kAtan2Hash);
}

TEST(MathGolden, TheWorkingRangeGivesTheCommittedHash) {
  for (int f = 0; f < kFunctionCount; ++f) {
    EXPECT_EQ(hash_within(kFunctions[f].call, kHashBound[f], kHashCount), kHashesWithin[f])
        << kFunctions[f].name;
  }
}

}  // namespace verp::math::golden
