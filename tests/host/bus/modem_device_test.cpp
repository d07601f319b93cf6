#include "host/twin/bus/modem_device.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "host/twin/bus/virtual_bus.hpp"
#include "tests/host/bus/fake_plant.hpp"

// Write sends, Read receives.

namespace verp::bus {
namespace {

using Bytes = std::vector<std::uint8_t>;

struct Air final : Aerial {
  std::uint8_t number() const override { return 2; }
  std::uint8_t most_bytes() const override { return 90; }
  dxl::Error say(std::uint8_t to, const std::string& data) override {
    if (to != modem::kEverybody && to > 2) return dxl::Error::kDataRange;
    if (full) return dxl::Error::kResultFail;
    said.emplace_back(to, data);
    return dxl::Error::kNone;
  }
  void listen() override {
    for (auto& [from, data] : std::exchange(coming, {})) device->hear(from, data);
  }
  ModemDevice* device = nullptr;
  bool full = false;
  std::vector<std::pair<int, std::string>> said;
  std::vector<std::pair<std::uint8_t, std::string>> coming;
};

class Modem : public ::testing::Test {
 protected:
  Modem() {
    auto device = std::make_unique<ModemDevice>(params.baud, air);
    air.device = device.get();
    bus.add(std::move(device));
  }

  /// Error, then data; empty: no answer.
  Bytes answer(const Bytes& frame) {
    bus.send(frame.data(), frame.size());
    Bytes bytes(512);
    bytes.resize(bus.poll(bytes.data(), bytes.size(), 20'000));
    dxl::Parser parser;
    for (const std::uint8_t byte : bytes) {
      if (!parser.push(byte)) continue;
      const dxl::Packet& packet = parser.packet();
      EXPECT_EQ(packet.id, modem::kId);
      Bytes all{packet.error};
      all.insert(all.end(), packet.parameters, packet.parameters + packet.size);
      return all;
    }
    return {};
  }
  dxl::Error write(std::uint16_t address, const Bytes& data) {
    Bytes frame(512);
    frame.resize(dxl::encode_write(frame.data(), frame.size(), modem::kId, address, data.data(),
                                   data.size()));
    const Bytes said = answer(frame);
    EXPECT_EQ(said.size(), 1u);
    return static_cast<dxl::Error>(said.empty() ? 0xFF : said[0]);
  }
  dxl::Error say(std::uint8_t to, const std::string& data) {
    Bytes block{to, static_cast<std::uint8_t>(data.size())};
    block.insert(block.end(), data.begin(), data.end());
    return write(modem::kTo, block);
  }
  Bytes read(std::uint16_t address, std::uint16_t length) {
    Bytes frame(64);
    frame.resize(dxl::encode_read(frame.data(), frame.size(), modem::kId, address, length));
    Bytes all = answer(frame);
    EXPECT_FALSE(all.empty());
    if (!all.empty()) all.erase(all.begin());
    return all;
  }

  Params params = test::bus_params(3);
  test::FakePlant plant;
  VirtualBus bus{params, plant};
  Air air;
};

TEST_F(Modem, OneWriteSaysAndOneReadHears) {
  const std::string bytes("\xFF\xFF\xFD\x00 any", 8);
  EXPECT_EQ(say(modem::kEverybody, bytes), dxl::Error::kNone);
  EXPECT_EQ(say(1, ""), dxl::Error::kNone);
  EXPECT_EQ(air.said, (std::vector<std::pair<int, std::string>>{{255, bytes}, {1, ""}}));
  EXPECT_EQ(read(modem::kNumber, 6), (Bytes{2, 90, 2, 0, 0, 0}));

  EXPECT_EQ(read(modem::kWaiting, 6), (Bytes{0, 0, 0, 0, 0, 0}));
  air.coming = {{0, bytes}, {1, "no"}};
  Bytes first = read(modem::kWaiting, 4 + 8);
  EXPECT_EQ(Bytes(first.begin(), first.begin() + 4), (Bytes{2, 0, 0, 8}));
  EXPECT_EQ(std::string(first.begin() + 4, first.end()), bytes);
  EXPECT_EQ(read(modem::kWaiting, 12), first) << "until it is taken";
  EXPECT_EQ(write(modem::kTake, {0}), dxl::Error::kNone);
  EXPECT_EQ(write(modem::kTake, {0}), dxl::Error::kNone) << "again: the answer may have been lost";
  EXPECT_EQ(read(modem::kWaiting, 7), (Bytes{1, 1, 1, 2, 'n', 'o', 0})) << "nothing of the first";
}

TEST_F(Modem, WhatCannotBeSaidIsRefusedAndNothingIsSaid) {
  EXPECT_EQ(say(3, "x"), dxl::Error::kDataRange);
  EXPECT_EQ(write(modem::kSaySize, {91}), dxl::Error::kDataRange) << "too long for this radio";
  EXPECT_EQ(say(1, std::string(97, 'x')), dxl::Error::kDataRange) << "too long for the registers";
  EXPECT_EQ(write(modem::kTo, {1, 90}), dxl::Error::kNone) << "zeros are bytes, too";
  EXPECT_EQ(write(modem::kHeardData, {1}), dxl::Error::kAccess);
  EXPECT_EQ(write(modem::kNumber, {1}), dxl::Error::kAccess);
  air.full = true;
  EXPECT_EQ(say(1, "x"), dxl::Error::kResultFail);
  air.full = false;
  EXPECT_EQ(write(dxl::address::kTorqueEnable, {1}), dxl::Error::kAccess);
  EXPECT_EQ(air.said.size(), 1u);
  EXPECT_EQ(read(modem::kSaid, 4), (Bytes{1, 0, 2, 0}));
}

TEST_F(Modem, RubbishToItsAddressIsAnsweredAsAServoWould) {
  std::uint32_t state = 1;
  const auto random = [&] { return state = state * 1664525 + 1013904223, state >> 16; };
  for (int i = 0; i < 3000; ++i) {
    Bytes data(random() % 120);
    for (std::uint8_t& each : data) each = static_cast<std::uint8_t>(random());
    const auto address = static_cast<std::uint16_t>(64 + random() % 600);  // keeps id and rate
    Bytes frame(512);
    frame.resize(random() % 2 == 0
                     ? dxl::encode_write(frame.data(), frame.size(), modem::kId, address,
                                         data.data(), data.size())
                     : dxl::encode_read(frame.data(), frame.size(), modem::kId, address,
                                        static_cast<std::uint16_t>(random() % 600)));
    air.coming.emplace_back(0, std::string(data.begin(), data.end()));
    EXPECT_FALSE(answer(frame).empty());
  }
}

TEST_F(Modem, KeepsTheFirstThatNobodyTookAndCountsTheRest) {
  for (int i = 0; i < 70; ++i) air.coming.emplace_back(1, std::to_string(i));
  EXPECT_EQ(read(modem::kWaiting, 5), (Bytes{64, 0, 1, 1, '0'}));
  EXPECT_EQ(read(modem::kHeard, 4), (Bytes{70, 0, 6, 0}));
}

}  // namespace
}  // namespace verp::bus
