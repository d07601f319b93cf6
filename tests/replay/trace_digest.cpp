#include "common/record/digest.hpp"
#include "tests/replay/long_trace.hpp"

namespace verp::replay {

std::uint64_t digest_of(const std::vector<Segment>& trace) {
  std::uint64_t digest = record::kChainSeed;
  for (const Segment& segment : trace) {
    digest = record::chain(digest, static_cast<std::uint32_t>(segment.digest()));
    digest = record::chain(digest, static_cast<std::uint32_t>(segment.digest() >> 32));
  }
  return digest;
}

}  // namespace verp::replay
