#include "firmware/app/bus_master.hpp"

namespace verp::app {

std::uint8_t BusMaster::spare_bytes() {
  if (missed_) spare_ = spare_ < kMostSpare ? static_cast<std::uint8_t>(spare_ + 1) : 0;
  missed_ = false;
  return spare_;
}

bool BusMaster::send(std::size_t size) {
  if (size != 0 && bus_.send(tx_, size)) return true;
  ++counters_.refused;
  return false;
}

void BusMaster::settle() {
  constexpr int kMostPieces = 8;  // a flooded bus must not block
  const auto stray = [](const dxl::Packet&) { return Take::kStray; };
  for (int i = 0; i < kMostPieces; ++i) {
    const std::size_t count = bus_.poll(rx_, sizeof rx_, 0);
    if (count == 0) break;
    digest(count, stray);
  }
  unsettled_ = false;
}

}  // namespace verp::app
