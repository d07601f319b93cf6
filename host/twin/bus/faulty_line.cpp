#include "host/twin/bus/faulty_line.hpp"

#include <algorithm>

#include "common/protocol/dynamixel2.hpp"

namespace verp::bus {
namespace {

constexpr std::uint32_t kLongestBurst = 24;  // bytes: a motor brush disturbs 0.1 ms

bool wants_answer(const std::uint8_t* frame, std::size_t size) {
  constexpr std::size_t kInstructionAt = 7;
  if (size <= kInstructionAt) return false;
  const auto instruction = static_cast<dxl::Instruction>(frame[kInstructionAt]);
  return instruction != dxl::Instruction::kSyncWrite && instruction != dxl::Instruction::kBulkWrite;
}

}  // namespace

void FaultyLine::note_spoilt() {
  if (reading_ && !spoilt_) ++damage_.spoilt_reads;
  spoilt_ = true;
}

std::vector<std::uint8_t> FaultyLine::spoilt(const std::vector<std::uint8_t>& bytes, bool inbound) {
  std::vector<std::uint8_t> left;
  const bool burst = !bytes.empty() && chance(faults.bursts);
  const std::size_t burst_at = burst ? random_() % (bytes.size() + 1) : 0;
  for (std::size_t i = 0; i <= bytes.size(); ++i) {
    if (burst && i == burst_at) {
      const auto count = static_cast<std::uint32_t>(1 + random_() % kLongestBurst);
      for (std::uint32_t n = 0; n < count; ++n) {
        left.push_back(static_cast<std::uint8_t>(random_() >> 8));
      }
      ++damage_.bursts;
      if (inbound) damage_.noise_heard += count;
    }
    if (i == bytes.size()) break;
    if (chance(faults.lost)) {
      ++damage_.lost;
      note_spoilt();
      continue;
    }
    std::uint8_t byte = bytes[i];
    if (chance(faults.flipped)) {
      byte = static_cast<std::uint8_t>(byte ^ (1u << (random_() % 8)));
      ++damage_.flipped;
      note_spoilt();
    }
    left.push_back(byte);
    if (chance(faults.doubled)) {
      left.push_back(byte);
      ++damage_.doubled;
    }
  }
  return left;
}

bool FaultyLine::send(const std::uint8_t* data, std::size_t size) {
  if (size == 0 || size > hal::kMaxFrame) return false;
  reading_ = wants_answer(data, size);
  spoilt_ = false;
  sent_us_ = bus_.now_us();
  if (faults.cut) {
    ++damage_.cut_frames;
    note_spoilt();
    return true;
  }
  std::vector<std::uint8_t> left = spoilt({data, data + size}, false);
  // More bytes than the longest frame follow as another frame.
  for (std::size_t at = 0; at < left.size(); at += hal::kMaxFrame) {
    const std::size_t count = std::min(hal::kMaxFrame, left.size() - at);
    bus_.send(left.data() + at, count);
    bus_sent_us_ = sent_us_ = bus_.now_us();
  }
  return true;
}

void FaultyLine::arrive(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return;
  if (faults.cut) {
    note_spoilt();
    return;
  }
  const std::vector<std::uint8_t> left = spoilt({data, data + size}, true);
  const bool late = chance(faults.delayed);
  const std::size_t late_from = late ? random_() % size : left.size();
  const std::uint64_t delay_us = late ? 1 + random_() % faults.delay_us : 0;
  damage_.delayed += late || faults.held_us > 0 ? 1 : 0;
  for (std::size_t i = 0; i < left.size(); ++i) {
    const std::uint64_t due_us = bus_.now_us() + faults.held_us + (i >= late_from ? delay_us : 0);
    inbox_.push_back({inbox_.empty() ? due_us : std::max(due_us, inbox_.back().due_us), left[i]});
  }
}

std::size_t FaultyLine::fetch(std::uint8_t* buffer, std::size_t capacity) {
  std::size_t count = 0;
  while (count < capacity && !inbox_.empty() && inbox_.front().due_us <= bus_.now_us()) {
    buffer[count++] = inbox_.front().byte;
    inbox_.pop_front();
  }
  return count;
}

std::size_t FaultyLine::poll(std::uint8_t* buffer, std::size_t capacity, std::uint32_t timeout_us) {
  const std::uint64_t deadline_us = std::max(bus_.now_us(), sent_us_ + timeout_us);
  for (;;) {
    const std::size_t count = fetch(buffer, capacity);
    if (count > 0 || capacity == 0) return count;
    const std::uint64_t until_us =
        inbox_.empty() ? deadline_us : std::min(deadline_us, inbox_.front().due_us);
    std::uint8_t piece[hal::kMaxFrame];
    const auto wait_us = static_cast<std::uint32_t>(until_us - std::min(until_us, bus_sent_us_));
    const std::size_t arrived = bus_.poll(piece, sizeof piece, wait_us);
    arrive(piece, arrived);
    if (arrived == 0 && bus_.now_us() >= deadline_us) return fetch(buffer, capacity);
  }
}

void FaultyLine::wait_until(std::uint64_t time_us) {
  while (bus_.now_us() < time_us) {
    std::uint8_t piece[hal::kMaxFrame];
    arrive(piece, bus_.bring_until(time_us, piece, sizeof piece));
  }
}

}  // namespace verp::bus
