#include "host/trace/record/tick_range.hpp"

#include "tests/host/record/sample.hpp"

namespace verp::record::test {
namespace {

// 0.07 s has no exact binary form.
TEST(TickRange, TakesBothEndsAndRefusesWhatIsNotThere) {
  const Trace trace = sample_run(20);
  const auto range = [&](std::optional<double> from_s, std::optional<double> to_s) {
    const TickRange found = ticks_between(trace, from_s, to_s);
    return std::pair(found.first, found.last);
  };
  EXPECT_EQ(range({}, {}), std::pair(std::size_t{0}, std::size_t{19}));
  EXPECT_EQ(range(0.07, 0.14), std::pair(std::size_t{7}, std::size_t{14}));
  EXPECT_EQ(range(0.071, 9), std::pair(std::size_t{8}, std::size_t{19}));
  EXPECT_EQ(range({}, 0), std::pair(std::size_t{0}, std::size_t{0}));
  for (const auto& [from_s, to_s] : {std::pair(0.2, 3.0), std::pair(0.1, 0.05)}) {
    try {
      ticks_between(trace, from_s, to_s);
      ADD_FAILURE() << from_s << " to " << to_s;
    } catch (const TraceError& error) {
      EXPECT_NE(std::string(error.what()).find("ends at 0.19 s"), std::string::npos)
          << error.what();
    }
  }
  EXPECT_THROW(ticks_between(sample_run(0), {}, {}), TraceError);
}

}  // namespace
}  // namespace verp::record::test
