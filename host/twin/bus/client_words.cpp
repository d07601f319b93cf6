#include "host/twin/bus/client_words.hpp"

#include "common/protocol/dynamixel2.hpp"
#include "common/protocol/feetech.hpp"
#include "firmware/app/bus_master.hpp"
#include "firmware/app/feetech_master.hpp"

namespace verp::bus {
namespace {

template <class Words>
class ClientWordsOf : public ClientWords {
 public:
  explicit ClientWordsOf(hal::FrameBus& bus) : master_(bus) {}

  const app::BusCounters& counters() const override { return master_.counters(); }
  std::uint32_t damaged() const override { return master_.crc_errors(); }
  std::uint32_t noise_bytes() const override { return master_.noise_bytes(); }
  int late_answers(std::uint8_t id, std::span<const std::uint8_t> bytes, bool anew) override {
    if (anew) late_.reset();
    int count = 0;
    for (const std::uint8_t byte : bytes) {
      for (bool found = late_.push(byte); found; found = late_.next()) {
        count += Words::answers(late_.packet(), nullptr, 0) && late_.packet().id == id ? 1 : 0;
      }
    }
    return count;
  }

 protected:
  std::uint8_t* frame() { return master_.frame(); }
  static constexpr std::size_t capacity() { return app::RequestMaster<Words>::capacity(); }
  app::RequestMaster<Words> master_;

 private:
  typename Words::Parser late_;
};

class DynamixelClientWords final : public ClientWordsOf<app::DynamixelWords> {
 public:
  using ClientWordsOf::ClientWordsOf;
  BusProtocol protocol() const override { return BusProtocol::kDynamixel2; }
  std::size_t encode_ping(std::uint8_t id) override {
    return dxl::encode_ping(frame(), capacity(), id);
  }
  std::size_t encode_read(std::uint8_t id, std::uint16_t address, std::uint16_t length) override {
    return dxl::encode_read(frame(), capacity(), id, address, length);
  }
  std::size_t encode_write(std::uint8_t id, std::uint16_t address,
                           std::span<const std::uint8_t> data) override {
    return dxl::encode_write(frame(), capacity(), id, address, data.data(), data.size());
  }
  bool request(std::size_t size, std::uint32_t timeout_us, const Take& take) override {
    return master_.request(size, timeout_us, [&](const dxl::Packet& packet) {
      return take({packet.id,
                   static_cast<std::uint8_t>(packet.error & ~dxl::kAlert),
                   {packet.parameters, packet.size}});
    });
  }
  std::size_t status_bytes() const override { return dxl::kStatusBytes; }
};

class FeetechClientWords final : public ClientWordsOf<app::FeetechWords> {
 public:
  using ClientWordsOf::ClientWordsOf;
  BusProtocol protocol() const override { return BusProtocol::kFeetech; }
  std::size_t encode_ping(std::uint8_t id) override {
    return feetech::encode_ping(frame(), capacity(), id);
  }
  std::size_t encode_read(std::uint8_t id, std::uint16_t address, std::uint16_t length) override {
    if (address > 0xFF || length > feetech::kMostParameters) return 0;
    return feetech::encode_read(frame(), capacity(), id, static_cast<std::uint8_t>(address),
                                static_cast<std::uint8_t>(length));
  }
  std::size_t encode_write(std::uint8_t id, std::uint16_t address,
                           std::span<const std::uint8_t> data) override {
    if (address > 0xFF) return 0;
    return feetech::encode_write(frame(), capacity(), id, static_cast<std::uint8_t>(address),
                                 data.data(), data.size());
  }
  bool request(std::size_t size, std::uint32_t timeout_us, const Take& take) override {
    return master_.request(size, timeout_us, [&](const feetech::Packet& packet) {
      return take({packet.id, 0, {packet.parameters, packet.size}});
    });
  }
  std::size_t status_bytes() const override { return feetech::kStatusBytes; }
};

}  // namespace

std::unique_ptr<ClientWords> make_client_words(BusProtocol protocol, hal::FrameBus& bus) {
  if (protocol == BusProtocol::kFeetech) return std::make_unique<FeetechClientWords>(bus);
  return std::make_unique<DynamixelClientWords>(bus);
}

}  // namespace verp::bus
