#include "firmware/store/shared_page.hpp"

#include <algorithm>
#include <vector>

#include "firmware/store/flash_store.hpp"
#include "hal/chip/stm32/flash_pages.hpp"
#include "hal/chip/stm32/watchdog.hpp"
#include "tests/host/stm32_drivers/rig.hpp"
#include "tests/support/stm32/flash_model.hpp"

// Too slow for an emulated board, which leaves this file out (boards/mps2/images.cmake).
namespace verp::hal::stm32::test {
namespace {

using SectorDog = IndependentWatchdog<Io>;
using Sectors = SectorPages<Io, Timer, SectorDog>;

/// At the processor's addresses, not the model's.
struct Mapped : Sectors {
  using Sectors::Sectors;
  const std::uint8_t* memory(std::size_t page) const {
    seen[page].resize(page_bytes(page));
    read(page, 0, seen[page].data(), seen[page].size());
    return seen[page].data();
  }
  mutable std::vector<std::uint8_t> seen[2];
};
static_assert(store::MappedPages<Mapped> && store::MappedPages<Sectors>);

std::vector<std::uint8_t> bytes_from(int first, std::size_t size) {
  std::vector<std::uint8_t> bytes(size);
  for (std::size_t i = 0; i < size; ++i) {
    bytes[i] = static_cast<std::uint8_t>(first + 7 * static_cast<int>(i));
  }
  return bytes;
}

class SharedSector : public EachFamily {
 protected:
  Rig rig{GetParam()};
  SectorDog dog{ResetCause::kPowerOn, rig.machine.io()};
};
INSTANTIATE_TEST_SUITE_P(, SharedSector, kFamilies, name_of);

// Thousands of units at the slowest speed; the watchdog would not wait for all.
TEST_P(SharedSector, ReplacesHalfAPageUnderAWatchdogAndKeepsTheOther) {
  constexpr std::size_t kSecond = 8192;
  const auto robot = bytes_from(1, 6000), old = bytes_from(2, 500), fresh = bytes_from(3, 3001);
  Mapped home(GetParam(), 1, 1, rig.timer, dog, rig.machine.io());
  Mapped other(GetParam(), 2, 3, rig.timer, dog, rig.machine.io());
  const auto feed = [this] { dog.feed(); };
  ASSERT_TRUE(home.erase(0));
  ASSERT_TRUE(store::program_bytes(home, 0, 0, robot.data(), robot.size(), feed));
  ASSERT_TRUE(store::program_bytes(home, 0, kSecond, old.data(), old.size(), feed));
  rig.machine.flash().program_time = us(100);
  ASSERT_TRUE(dog.start(100'000));
  store::FlashStore<Mapped> log(other);
  log.open();
  store::WaitingRoom room(home, kSecond, 4096, other, log);
  room.begin();
  room.work(true);
  for (std::size_t at = 0; at < fresh.size(); at += 7) {  // CAN's pieces
    ASSERT_TRUE(room.write(at, fresh.data() + at, std::min<std::size_t>(7, fresh.size() - at)));
    dog.feed();
  }
  EXPECT_TRUE(room.replace(nullptr, robot.size(), fresh.size(), old.size(), feed));
  EXPECT_TRUE(std::equal(robot.begin(), robot.end(), home.memory(0)));
  EXPECT_TRUE(std::equal(fresh.begin(), fresh.end(), home.memory(0) + kSecond));
  EXPECT_EQ(rig.machine.resets(), 0u);
}

}  // namespace
}  // namespace verp::hal::stm32::test
