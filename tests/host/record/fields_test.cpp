#include "host/trace/record/fields.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/control/state.hpp"
#include "common/model/params.hpp"

namespace verp::record {
namespace {

struct Foot {
  float x_m = 0;
  std::int16_t count = 0;
  std::uint16_t flags = 0;
  VERP_FIELDS(x_m, count, flags)
};
VERP_PACKED(Foot);

struct Walk {
  Foot step[2];
  std::uint32_t tick = 0;
  VERP_FIELDS(step, tick)
};
VERP_PACKED(Walk);

TEST(Fields, EqualStructsHaveNoDifference) {
  EXPECT_TRUE(diff_fields(Walk{}, Walk{}).empty());
}

TEST(Fields, DifferenceNamesPathDecimalAndBits) {
  Walk left, right;
  left.step[1].x_m = 0.5f;
  right.step[1].count = -12;
  const auto differences = diff_fields(left, right);
  ASSERT_EQ(differences.size(), 2u);
  EXPECT_EQ(differences[0].path, "step[1].x_m");
  EXPECT_EQ(differences[0].left, "0.5 (0x3f000000)");
  EXPECT_EQ(differences[0].right, "0 (0x00000000)");
  EXPECT_EQ(differences[1].path, "step[1].count");
  EXPECT_EQ(differences[1].right, "-12 (0xfff4)");
}

TEST(Fields, ComparesBitsNotValues) {
  Foot plus, minus;
  minus.x_m = -0.0f;
  EXPECT_EQ(diff_fields(plus, minus).size(), 1u);
  Foot nan;
  nan.x_m = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(diff_fields(nan, nan).empty());
}

TEST(Fields, OneUlpIsVisible) {
  EXPECT_NE(scalar_text(0.1f), scalar_text(std::nextafter(0.1f, 1.0f)));
  EXPECT_NE(scalar_plain(0.1f), scalar_plain(std::nextafter(0.1f, 1.0f)));
}

// Any flipped byte names one field.
TEST(Fields, EveryByteOfStateIsNamed) {
  const State state;
  for (std::size_t i = 0; i < sizeof(State); ++i) {
    State other = state;
    reinterpret_cast<unsigned char*>(&other)[i] ^= 1;
    EXPECT_EQ(diff_fields(state, other).size(), 1u) << "byte " << i;
  }
}

TEST(Fields, LayoutListsOffsetTypeAndPath) {
  const std::string layout = describe_layout<Walk>("Walk");
  EXPECT_NE(layout.find("# Walk: little-endian, packed, 20 bytes"), std::string::npos);
  EXPECT_NE(layout.find("     8 float32  step[1].x_m"), std::string::npos);
  EXPECT_NE(layout.find("    16 uint32   tick"), std::string::npos);
  EXPECT_NE(describe_layout<Params>("Params").find("char     name[24]"), std::string::npos);
}

TEST(Fields, PrintGivesEveryScalar) {
  const auto rows = print_fields(Walk{});
  ASSERT_EQ(rows.size(), 7u);
  EXPECT_EQ(rows[6].first, "tick");
  EXPECT_EQ(rows[6].second, "0");
}

}  // namespace
}  // namespace verp::record
