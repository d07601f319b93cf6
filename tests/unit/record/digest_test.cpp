#include "common/record/digest.hpp"

#include <gtest/gtest.h>

#include "common/io/io.hpp"

namespace verp::record {
namespace {

std::uint32_t digest_of(const Inputs& inputs) {
  Digest32 digest(1);
  digest.add_struct(inputs);
  return digest.value();
}

TEST(Digest, HasTheSameValueOnEveryMachine) {
  Digest32 digest(0x12345678);
  digest.add(0xDEADBEEF);
  digest.add(0);
  EXPECT_EQ(digest.value(), 0x333E87BEu);
  EXPECT_EQ(chain(kChainSeed, digest.value()), 0xEC30EC6EF9F331F7ull);
}

TEST(Digest, SeesEveryBitOfAStruct) {
  const Inputs inputs;
  const std::uint32_t before = digest_of(inputs);
  for (std::size_t bit = 0; bit < sizeof(Inputs) * 8; ++bit) {
    Inputs changed = inputs;
    auto* bytes = reinterpret_cast<unsigned char*>(&changed);
    bytes[bit / 8] = static_cast<unsigned char>(bytes[bit / 8] ^ (1u << (bit % 8)));
    EXPECT_NE(digest_of(changed), before) << "bit " << bit;
  }
}

TEST(Digest, DoesNotLetTwoSignBitsCancel) {
  Inputs changed;
  changed.position_count[3] = std::int32_t{-2147483647 - 1};
  changed.position_count[4] = std::int32_t{-2147483647 - 1};
  EXPECT_NE(digest_of(changed), digest_of(Inputs{}));
}

TEST(Digest, ChainDependsOnOrder) {
  EXPECT_NE(chain(chain(kChainSeed, 1), 2), chain(chain(kChainSeed, 2), 1));
}

}  // namespace
}  // namespace verp::record
