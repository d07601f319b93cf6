#include "tests/support/rom_boot_loader.hpp"

#include <algorithm>
#include <numeric>

namespace verp::test {
namespace {

// AN3155, table of commands.
constexpr std::uint8_t kGet = 0x00, kGetVersion = 0x01, kGetId = 0x02, kReadMemory = 0x11,
                       kGo = 0x21, kWriteMemory = 0x31, kExtendedErase = 0x44, kWriteProtect = 0x63,
                       kWriteUnprotect = 0x73, kReadoutProtect = 0x82, kReadoutUnprotect = 0x92;
constexpr std::uint8_t kVersion = 0x31;

bool needs_no_protection(std::uint8_t command) {
  return command == kReadMemory || command == kGo || command == kWriteMemory ||
         command == kExtendedErase || command == kWriteProtect || command == kWriteUnprotect ||
         command == kReadoutProtect;
}

}  // namespace

RomBootLoader::RomBootLoader(Chip chip) : chip_(std::move(chip)) {
  auto& sectors = chip_.sector_bytes;
  if (sectors.empty()) {  // RM0090 3.3, 1 MB
    sectors.assign(12, 128 * 1024);
    std::fill(sectors.begin(), sectors.begin() + 4, 16 * 1024);
    sectors[4] = 64 * 1024;
  }
  flash.assign(std::accumulate(sectors.begin(), sectors.end(), 0U), 0xFF);
}

void RomBootLoader::take(std::uint8_t byte, Reply& reply) {
  switch (state_) {
    case State::kAsleep:
      if (byte == kSync) expect(State::kCommand, reply);
      return;
    case State::kCommand:
      command_ = byte;
      state_ = State::kComplement;
      return;
    case State::kComplement:
      if (byte != static_cast<std::uint8_t>(~command_)) return refuse(reply);
      return command(reply);
    case State::kRunning:
      return;
    default:
      got_.push_back(byte);
  }
  switch (state_) {
    case State::kAddress:
      return address(reply);
    case State::kReadLength:
      return read(reply);
    case State::kWriteData:
      return write(reply);
    case State::kErase:
      return erase(reply);
    default:
      return;
  }
}

void RomBootLoader::expect(State next, Reply& reply) {
  reply.push_back(kAck);
  got_.clear();
  state_ = next;
}

void RomBootLoader::refuse(Reply& reply) {
  reply.push_back(kNack);
  state_ = State::kCommand;
}

void RomBootLoader::command(Reply& reply) {
  if (chip_.readout_protected && needs_no_protection(command_)) return refuse(reply);
  switch (command_) {
    case kGet:
      reply.insert(reply.end(), {kAck, 11, kVersion, kGet, kGetVersion, kGetId, kReadMemory, kGo,
                                 kWriteMemory, kExtendedErase, kWriteProtect, kWriteUnprotect,
                                 kReadoutProtect, kReadoutUnprotect});
      return expect(State::kCommand, reply);
    case kGetVersion:
      reply.insert(reply.end(), {kAck, kVersion, 0, 0});
      return expect(State::kCommand, reply);
    case kGetId:
      reply.insert(reply.end(), {kAck, 1, static_cast<std::uint8_t>(chip_.device_id >> 8),
                                 static_cast<std::uint8_t>(chip_.device_id)});
      return expect(State::kCommand, reply);
    case kReadMemory:
    case kWriteMemory:
    case kGo:
      return expect(State::kAddress, reply);
    case kExtendedErase:
      return expect(State::kErase, reply);
    case kReadoutProtect:
      reply.push_back(kAck);
      chip_.readout_protected = true;
      return expect(State::kAsleep, reply);  // it resets
    case kReadoutUnprotect:
      reply.push_back(kAck);
      erase_all();
      chip_.readout_protected = false;
      return expect(State::kAsleep, reply);
    default:
      return refuse(reply);
  }
}

bool RomBootLoader::checksum_is_good(std::uint8_t seed) const {
  return std::accumulate(got_.begin(), got_.end() - 1, seed, [](std::uint8_t sum, std::uint8_t b) {
           return static_cast<std::uint8_t>(sum ^ b);
         }) == got_.back();
}

bool RomBootLoader::in_flash(std::uint32_t address, std::size_t bytes) const {
  return address >= kFlashBegin && address - kFlashBegin + bytes <= flash.size();
}

void RomBootLoader::address(Reply& reply) {
  if (got_.size() < 5) return;
  address_ = 0;
  for (int i = 0; i < 4; ++i) address_ = address_ << 8 | got_[static_cast<std::size_t>(i)];
  if (!checksum_is_good(0) || !in_flash(address_, 1)) return refuse(reply);
  if (command_ == kGo) {
    started = true;
    return expect(State::kRunning, reply);
  }
  expect(command_ == kReadMemory ? State::kReadLength : State::kWriteData, reply);
}

void RomBootLoader::read(Reply& reply) {
  if (got_.size() < 2) return;
  const std::size_t bytes = got_[0] + std::size_t{1};
  if (got_[1] != static_cast<std::uint8_t>(~got_[0]) || !in_flash(address_, bytes)) {
    return refuse(reply);
  }
  const auto from = flash.begin() + (address_ - kFlashBegin);
  expect(State::kCommand, reply);
  reply.insert(reply.end(), from, from + static_cast<std::ptrdiff_t>(bytes));
}

void RomBootLoader::write(Reply& reply) {
  const std::size_t bytes = got_[0] + std::size_t{1};
  if (got_.size() < bytes + 2) return;
  const auto hit = chip_.refused.lower_bound(address_);
  const bool refused = hit != chip_.refused.end() && *hit < address_ + bytes;
  if (!checksum_is_good(0) || refused || !in_flash(address_, bytes)) return refuse(reply);
  for (std::size_t i = 0; i < bytes; ++i) {  // only clears bits
    const auto at = static_cast<std::uint32_t>(address_ + i);
    flash[at - kFlashBegin] &= chip_.stuck.contains(at) ? std::uint8_t{0} : got_[i + 1];
  }
  ++writes;
  expect(State::kCommand, reply);
}

void RomBootLoader::erase_sector(std::size_t sector) {
  const auto& sectors = chip_.sector_bytes;
  const auto count = static_cast<std::ptrdiff_t>(sector);
  const auto begin = std::accumulate(sectors.begin(), sectors.begin() + count, 0);
  const auto bytes = static_cast<std::ptrdiff_t>(sectors[sector]);
  std::fill(flash.begin() + begin, flash.begin() + begin + bytes, 0xFF);
  ++erased_sectors;
}

void RomBootLoader::erase_all() {
  for (std::size_t i = 0; i < chip_.sector_bytes.size(); ++i) erase_sector(i);
}

void RomBootLoader::erase(Reply& reply) {
  if (got_.size() < 3) return;
  const std::uint32_t count = std::uint32_t{got_[0]} << 8 | got_[1];
  if (count >= 0xFFF0) {  // 0xFFFF: all; the only one of one-bank chips
    if (!checksum_is_good(0) || count != 0xFFFF) return refuse(reply);
    erase_all();
    return expect(State::kCommand, reply);
  }
  if (got_.size() < 2 + 2 * (count + 1) + 1) return;
  if (!checksum_is_good(0)) return refuse(reply);
  for (std::size_t i = 2; i + 1 < got_.size() - 1; i += 2) {
    const std::size_t sector = std::size_t{got_[i]} << 8 | got_[i + 1];
    if (sector >= chip_.sector_bytes.size()) return refuse(reply);
    erase_sector(sector);
  }
  expect(State::kCommand, reply);
}

}  // namespace verp::test
