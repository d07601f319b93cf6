#include "host/twin/bus/modem_device.hpp"

#include <algorithm>
#include <utility>

namespace verp::bus {
namespace {

namespace at = dxl::address;

std::vector<Register> modem_registers(std::uint32_t baud, const Aerial& aerial) {
  std::vector<Register> registers = {
      {at::kModelNumber, 2, false, modem::kModel},
      {at::kModelInformation, 4, false, 0},
      {at::kFirmwareVersion, 1, false, 1},
      {at::kId, 1, true, modem::kId, 0, dxl::kMaxId},
      {at::kBaudRate, 1, true, dxl::baud_rate_code(baud), 0, 7},
      {at::kReturnDelay, 1, true, 0, 0, 254},
      {modem::kNumber, 1, false, aerial.number()},
      {modem::kMostBytes, 1, false, aerial.most_bytes()},
      {modem::kSaid, 2, false},
      {modem::kRefused, 2, false},
      {modem::kHeard, 2, false},
      {modem::kMissed, 2, false},
      {modem::kTo, 1, true, modem::kEverybody, 0, 0xFF},
      {modem::kSaySize, 1, true, 0, 0, aerial.most_bytes()},
  };
  const auto block = [&](std::uint16_t address, bool writable) {
    for (std::uint16_t i = 0; i < modem::kMostData; ++i) {
      const auto here = static_cast<std::uint16_t>(address + i);
      registers.push_back({here, 1, writable, 0, 0, 0xFF});
    }
  };
  block(modem::kSayData, true);
  for (const std::uint16_t address :
       {modem::kWaiting, modem::kHeardNumber, modem::kHeardFrom, modem::kHeardSize})
    registers.push_back({address, 1, false});
  block(modem::kHeardData, false);
  registers.push_back({modem::kTake, 1, true, 0, 0, 0xFF});
  return registers;
}

bool covers(std::uint16_t address, std::uint16_t length, std::uint16_t reg) {
  return address <= reg && reg < address + length;
}

}  // namespace

ModemDevice::ModemDevice(std::uint32_t baud, Aerial& aerial)
    : Device(modem_registers(baud, aerial)), aerial_(aerial) {}

void ModemDevice::hear(std::uint8_t from, std::string data) {
  count(modem::kHeard);
  if (inbox_.size() >= modem::kMostWaiting || data.size() > modem::kMostData)
    return count(modem::kMissed);
  inbox_.push_back({numbers_++, from, std::move(data)});
}

void ModemDevice::refresh(std::uint16_t address, std::uint16_t length) {
  if (address + length <= modem::kNumber) return;
  aerial_.listen();
  const Message none{0, 0, {}};
  const Message& first = inbox_.empty() ? none : inbox_.front();
  table_.set(modem::kWaiting, static_cast<std::int64_t>(inbox_.size()));
  table_.set(modem::kHeardNumber, first.number);
  table_.set(modem::kHeardFrom, first.from);
  table_.set(modem::kHeardSize, static_cast<std::int64_t>(first.data.size()));
  for (std::uint16_t i = 0; i < modem::kMostData; ++i) {
    const auto byte = i < first.data.size() ? static_cast<std::uint8_t>(first.data[i]) : 0;
    table_.set(static_cast<std::uint16_t>(modem::kHeardData + i), byte);
  }
}

dxl::Error ModemDevice::write(std::uint16_t address, std::span<const std::uint8_t> data) {
  const dxl::Error stored = Device::write(address, data);
  const dxl::Error said = std::exchange(said_, dxl::Error::kNone);
  return stored != dxl::Error::kNone ? stored : said;
}

void ModemDevice::written(std::uint16_t address, std::uint16_t length) {
  if (covers(address, length, modem::kSaySize)) say();
  if (covers(address, length, modem::kTake))
    take(static_cast<std::uint8_t>(table_.get(modem::kTake)));
}

void ModemDevice::say() {
  const std::span<const std::uint8_t> data =
      table_.bytes(modem::kSayData, static_cast<std::uint16_t>(table_.get(modem::kSaySize)));
  said_ = aerial_.say(static_cast<std::uint8_t>(table_.get(modem::kTo)),
                      std::string(data.begin(), data.end()));
  count(said_ == dxl::Error::kNone ? modem::kSaid : modem::kRefused);
}

void ModemDevice::take(std::uint8_t number) {
  if (!inbox_.empty() && inbox_.front().number == number) inbox_.pop_front();
}

}  // namespace verp::bus
