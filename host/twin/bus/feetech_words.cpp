#include "host/twin/bus/feetech_words.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "host/twin/bus/virtual_bus.hpp"

namespace verp::bus {
namespace {

std::vector<std::uint8_t> status(FeetechDevice& device, std::span<const std::uint8_t> data) {
  std::vector<std::uint8_t> packet(feetech::kMaxPacket);
  packet.resize(feetech::encode_status(packet.data(), packet.size(), device.id(), device.status(),
                                       data.data(), data.size()));
  return packet;
}

}  // namespace

bool FeetechWords::begins_tick(const feetech::Packet& packet) {
  if (packet.id != feetech::kBroadcast || packet.size < 2 ||
      packet.code != static_cast<std::uint8_t>(feetech::Instruction::kSyncRead)) {
    return false;
  }
  const unsigned begin = packet.parameters[0], end = begin + packet.parameters[1];
  return begin <= feetech::address::kPresentPosition &&
         end >= feetech::address::kPresentPosition + 2u;
}

bool FeetechWords::begins_tick(std::span<const std::uint8_t> frame) const {
  feetech::Parser parser;
  return std::any_of(frame.begin(), frame.end(), [&](std::uint8_t byte) {
    return parser.push(byte) && begins_tick(parser.packet());
  });
}

std::size_t FeetechWords::frame_size(std::span<const std::uint8_t> bytes) const {
  const std::size_t size = bytes.size() < feetech::kHeaderBytes
                               ? bytes.size()
                               : feetech::kHeaderBytes + bytes[feetech::kHeaderBytes - 1];
  return std::min(size, bytes.size());
}

std::vector<FeetechDevice*> FeetechWords::devices(std::uint8_t id) const {
  std::vector<FeetechDevice*> all;
  for (FeetechDevice* each : devices_) {
    const bool asked = id == feetech::kBroadcast || each->id() == id;
    if (asked && line_.hears(*each)) all.push_back(each);
  }
  return all;
}

void FeetechWords::handle(std::uint64_t end_ns) {
  const feetech::Packet& packet = parser_.packet();
  line_.request_ended(end_ns);
  const std::span<const std::uint8_t> parameters(packet.parameters, packet.size);
  const bool has_data = packet.size > 1;
  switch (static_cast<feetech::Instruction>(packet.code)) {
    case feetech::Instruction::kPing:
      return answer(packet.id);
    case feetech::Instruction::kRead:
      if (packet.size == 2 && packet.id != feetech::kBroadcast)
        read(packet.id, parameters[0], parameters[1]);
      return;
    case feetech::Instruction::kWrite:
      return command(packet.id, [&](FeetechDevice& each) {
        if (has_data) each.write(parameters[0], parameters.subspan(1));
      });
    case feetech::Instruction::kRegWrite:
      return command(packet.id, [&](FeetechDevice& each) {
        if (has_data) each.reg_write(parameters[0], parameters.subspan(1));
      });
    case feetech::Instruction::kAction:
      return command(packet.id, [](FeetechDevice& each) { each.action(); });
    case feetech::Instruction::kSyncRead:
      return sync_read(parameters);
    case feetech::Instruction::kSyncWrite:
      return sync_write(parameters);
  }
}

void FeetechWords::answer(std::uint8_t id) {
  line_.speak(devices(id), false, [&](FeetechDevice& each) {
    line_.advance_to_answer();
    return status(each, {});
  });
}

void FeetechWords::read(std::uint8_t id, std::uint8_t address, std::uint8_t length) {
  line_.speak(devices(id), false, [&](FeetechDevice& each) {
    line_.advance_to_answer();
    return status(each, each.read(address, std::min(length, std::uint8_t{200})));
  });
}

// The answer has the id of the request, even after the write changed it.
template <class Apply>
void FeetechWords::command(std::uint8_t id, Apply apply) {
  std::vector<FeetechDevice*> speakers = devices(id);
  for (FeetechDevice* each : speakers) apply(*each);
  std::erase_if(speakers, [](const FeetechDevice* each) { return !each->answers_all(); });
  if (id == feetech::kBroadcast) return;
  line_.speak(speakers, false, [id](FeetechDevice& each) {
    std::vector<std::uint8_t> packet(feetech::kStatusBytes);
    feetech::encode_status(packet.data(), packet.size(), id, each.status(), nullptr, 0);
    return packet;
  });
}

// A silent device silences those behind it.
void FeetechWords::sync_read(std::span<const std::uint8_t> parameters) {
  if (parameters.size() < 3) return;
  for (const std::uint8_t id : parameters.subspan(2)) {
    if (id == feetech::kBroadcast || devices(id).empty()) return;
    read(id, parameters[0], parameters[1]);
  }
}

void FeetechWords::sync_write(std::span<const std::uint8_t> parameters) {
  if (parameters.size() < 2) return;
  const std::size_t length = parameters[1];
  for (std::size_t i = 2; i + 1 + length <= parameters.size(); i += 1 + length) {
    for (FeetechDevice* each : devices(parameters[i])) {
      each->write(parameters[0], parameters.subspan(i + 1, length));
    }
  }
}

SpokenBus make_feetech_bus(const Params& params, sim::Plant& plant, VirtualBus& line) {
  auto words = std::make_unique<FeetechWords>(line);
  SpokenBus spoken;
  const auto add = [&](std::unique_ptr<FeetechDevice> device) {
    words->add(*device);
    spoken.devices.push_back(std::move(device));
  };
  for (int j = 0; j < params.servo_count(); ++j) {
    const JointParams& joint = params.joint[j];
    const ServoProfile& profile = params.servo[joint.servo_profile % kServoProfiles];
    add(std::make_unique<FeetechServo>(
        feetech_bus::Identity{joint.servo_id, profile.model_number, params.baud, plant.rating(j)},
        plant, j));
  }
  if (params.imu.device_id != 0) {
    add(std::make_unique<FeetechImu>(params.imu.device_id, params.baud, plant));
  }
  for (int foot = 0; foot < kFeet; ++foot) {
    const std::uint8_t id = params.feet.device_id[foot];
    if (id != 0) add(std::make_unique<FeetechFoot>(id, params.baud, plant, foot));
  }
  spoken.words = std::move(words);
  return spoken;
}

}  // namespace verp::bus
