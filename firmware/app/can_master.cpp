#include "firmware/app/can_master.hpp"

namespace verp::app {

bool CanMaster::send(const CanFrame& frame) {
  const std::uint64_t now_us = bus_.now_us();
  accepted_ = bus_.send(frame);
  accepted_before_ = accepted_before_ || accepted_;
  if (!accepted_) refused_us_ = now_us;
  if (!accepted_) ++counters.refused;
  return accepted_;
}

bool CanMaster::receive(CanFrame& frame, std::uint32_t timeout_us) {
  if (accepted_) return bus_.poll(frame, timeout_us);
  return receive_until(frame, refused_us_ + timeout_us,
                       accepted_before_ ? timeout_us : refused_us_ + timeout_us - begin_us_);
}

bool CanMaster::receive_until(CanFrame& frame, std::uint64_t end_us) {
  const std::uint64_t now_us = bus_.now_us();
  return now_us < end_us ? receive_until(frame, end_us, end_us - now_us) : take_waiting(frame);
}

bool CanMaster::receive_until(CanFrame& frame, std::uint64_t end_us, std::uint64_t wait_us) {
  for (int polls = 0; polls < kMostPolls; ++polls) {
    if (bus_.poll(frame, static_cast<std::uint32_t>(wait_us))) return true;
    const std::uint64_t now_us = bus_.now_us();
    begin_us_ = now_us - wait_us;  // or earlier
    accepted_before_ = false;
    if (now_us >= end_us) return false;
    wait_us += end_us - now_us;
  }
  return false;
}

}  // namespace verp::app
