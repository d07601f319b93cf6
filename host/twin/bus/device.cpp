#include "host/twin/bus/device.hpp"

#include <algorithm>
#include <iterator>

namespace verp::bus {

namespace at = dxl::address;

std::uint16_t Device::meant(std::uint16_t address) const {
  for (const auto& [addresses, data, pairs] : indirect_) {
    if (address < data || address >= data + pairs) continue;
    const auto pointer = static_cast<std::uint16_t>(addresses + 2 * (address - data));
    return static_cast<std::uint16_t>(table_.get(pointer));
  }
  return address;
}

std::span<const std::uint8_t> Device::read(std::uint16_t address, std::uint16_t length) {
  refresh(address, length);
  const std::span<const std::uint8_t> direct = table_.bytes(address, length);
  answer_.assign(direct.begin(), direct.end());
  for (std::size_t i = 0; i < answer_.size(); ++i) {
    const auto here = static_cast<std::uint16_t>(address + i);
    const std::uint16_t there = meant(here);
    if (there == here) continue;
    refresh(there, 1);
    const std::span<const std::uint8_t> one = table_.bytes(there, 1);
    answer_[i] = one.empty() ? std::uint8_t{0} : one[0];
  }
  return answer_;
}

std::vector<Device::Piece> Device::pieces(std::uint16_t address,
                                          std::span<const std::uint8_t> data) const {
  std::vector<Piece> all;
  for (std::size_t i = 0; i < data.size(); ++i) {
    const std::uint16_t there = meant(static_cast<std::uint16_t>(address + i));
    if (all.empty() || there != all.back().address + all.back().data.size()) {
      all.push_back({there, {}});
    }
    all.back().data.push_back(data[i]);
  }
  return all;
}

dxl::Error Device::check(const std::vector<Piece>& pieces) const {
  if (pieces.empty()) return dxl::Error::kDataLength;
  for (const Piece& piece : pieces) {
    const dxl::Error error = check(piece.address, piece.data);
    if (error != dxl::Error::kNone) return error;
  }
  return dxl::Error::kNone;
}

dxl::Error Device::store(const std::vector<Piece>& pieces) {
  const dxl::Error error = check(pieces);
  if (error != dxl::Error::kNone) return error;
  for (const Piece& piece : pieces) {
    table_.store(piece.address, piece.data);
    written(piece.address, static_cast<std::uint16_t>(piece.data.size()));
  }
  return error;
}

dxl::Error Device::write(std::uint16_t address, std::span<const std::uint8_t> data) {
  return store(pieces(address, data));
}

dxl::Error Device::reg_write(std::uint16_t address, std::span<const std::uint8_t> data) {
  std::vector<Piece> all = pieces(address, data);
  const dxl::Error error = check(all);
  if (error != dxl::Error::kNone) return error;
  registered_ = std::move(all);
  table_.set(at::kRegisteredInstruction, 1);
  return error;
}

dxl::Error Device::action() {
  if (registered_.empty()) return dxl::Error::kInstruction;
  table_.set(at::kRegisteredInstruction, 0);
  return store(std::exchange(registered_, {}));  // may be refused now
}

void Device::lose_power() {
  registered_.clear();
  table_.restore_initial(at::kTorqueEnable, 0xFFFF);
  restarted();
}

void Device::reboot() {
  lose_power();
  started();
}

dxl::Error Device::factory_reset(dxl::Reset reset) {
  if (torque_on()) return dxl::Error::kResultFail;
  const std::int64_t id = table_.get(at::kId), baud = table_.get(at::kBaudRate);
  registered_.clear();
  table_.restore_initial(0, 0xFFFF);
  const bool all = reset == dxl::Reset::kAll;
  table_.set(at::kId, all ? dxl::kFactoryId : id);
  table_.set(at::kBaudRate,
             reset == dxl::Reset::kAllButIdAndBaud ? baud : dxl::baud_rate_code(dxl::kFactoryBaud));
  restarted();
  return dxl::Error::kNone;
}

dxl::Error Device::clear(std::span<const std::uint8_t> parameters) {
  if (!std::equal(parameters.begin(), parameters.end(), std::begin(dxl::kClearTurns),
                  std::end(dxl::kClearTurns))) {
    return dxl::Error::kDataRange;
  }
  return moving() ? dxl::Error::kResultFail : dxl::Error::kNone;
}

}  // namespace verp::bus
