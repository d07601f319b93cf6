#include <algorithm>
#include <optional>
#include <utility>

#include "common/base/crc32.hpp"
#include "common/protocol/controller_table.hpp"
#include "firmware/app/block_window.hpp"
#include "firmware/app/controller_objects.hpp"
#include "host/author/action/send.hpp"
#include "host/twin/bus/client.hpp"
#include "host/twin/bus/register_names.hpp"
#include "host/twin/can/client.hpp"

namespace verp::action {
namespace {

namespace table = dxl::controller;

/// An erase silences the chip for two seconds or four (hal/contract/flash_pages.hpp); a request is
/// made three times.
constexpr std::uint32_t kPatience_us = 2'000'000;
constexpr auto kKind = static_cast<std::uint8_t>(app::ImageKind::kActions);

class SerialPort : public ActionPort {
 public:
  SerialPort(const link::Endpoint& endpoint, std::uint8_t id)
      : own_(std::in_place, endpoint, kPatience_us), client_(*own_), id_(id) {}
  SerialPort(bus::Client& client, std::uint8_t id) : client_(client), id_(id) {}

  std::string place() const override { return client_.place(); }
  std::vector<std::uint8_t> read(const char* name) override {
    const table::Register& found = *table::find(name);
    return client_.read(id_, found.address, static_cast<std::uint16_t>(found.bytes()));
  }
  Offer offer(std::span<const std::uint8_t> image,
              const std::function<bool(std::size_t)>& went) override {
    try {
      return send(image, went);
    } catch (const bus::RefusedError& error) {
      if (error.error() == dxl::Error::kAccess) return Offer::kArmed;
      if (error.error() == dxl::Error::kDataLimit) return Offer::kNoRoom;
      if (error.error() == dxl::Error::kDataRange) return Offer::kNotHere;
      const auto state = static_cast<table::WindowState>(number("window_state"));
      return state == table::WindowState::kIdle ? Offer::kNotYet : Offer::kRefused;
    }
  }

 private:
  Offer send(std::span<const std::uint8_t> image, const std::function<bool(std::size_t)>& went) {
    write("window_kind", {kKind});
    // The last block first: too little room shows before an erase.
    const std::size_t last = (image.size() - 1) / table::kWindowBytes * table::kWindowBytes;
    put(image, last);
    for (std::size_t at = 0; at < last; at += table::kWindowBytes) {
      put(image, at);
      if (!went(at + table::kWindowBytes)) return Offer::kStopped;
    }
    write("window_crc", bytes_of(crc32(image.data(), image.size())));
    commit();
    return Offer::kTaken;
  }
  static std::vector<std::uint8_t> bytes_of(std::size_t number) {
    std::vector<std::uint8_t> bytes(4);
    dxl::put_u32(bytes.data(), static_cast<std::uint32_t>(number));
    return bytes;
  }
  void write(const char* name, const std::vector<std::uint8_t>& bytes) {
    client_.write(id_, table::find(name)->address, bytes);
  }
  /// The answer may be lost; the repeat may then reach a restarted controller.
  void commit() {
    try {
      write("window_commit", {1});
    } catch (const bus::RefusedError&) {
      if (number("window_kind") == kKind) throw;
    }
  }
  void put(std::span<const std::uint8_t> image, std::size_t at) {
    const std::size_t count = std::min<std::size_t>(table::kWindowBytes, image.size() - at);
    const std::vector<std::uint8_t> offset = bytes_of(at);
    std::vector<std::uint8_t> bytes(offset.size() + count);
    std::copy(offset.begin(), offset.end(), bytes.begin());
    std::copy_n(image.begin() + static_cast<std::ptrdiff_t>(at), count,
                bytes.begin() + static_cast<std::ptrdiff_t>(offset.size()));
    write("window_offset", bytes);
  }

  std::optional<bus::Client> own_;
  bus::Client& client_;
  std::uint8_t id_;
};

class CanPort : public ActionPort {
 public:
  CanPort(const link::Endpoint& endpoint, std::uint8_t node)
      : own_(std::in_place, endpoint, kPatience_us), client_(*own_), node_(node) {}
  CanPort(can::Client& client, std::uint8_t node) : client_(client), node_(node) {}

  std::string place() const override { return client_.place(); }
  std::vector<std::uint8_t> read(const char* name) override {
    return client_.read(node_, {table::find(name)->object_index(), 0});
  }
  Offer offer(std::span<const std::uint8_t> image,
              const std::function<bool(std::size_t)>&) override {
    using canopen::Abort;
    try {
      client_.write(node_, {static_cast<std::uint16_t>(app::kImageIndex + kKind), 0},
                    {image.begin(), image.end()});
      return Offer::kTaken;
    } catch (const can::AbortedError& error) {
      if (error.why() == Abort::kTooLong) return Offer::kNoRoom;
      if (error.why() == Abort::kNoData || error.why() == Abort::kNoObject) return Offer::kNotHere;
      if (error.why() != Abort::kDeviceState) return Offer::kRefused;
      return number("torque_enable") != 0 ? Offer::kArmed : Offer::kNotYet;
    }
  }

 private:
  std::optional<can::Client> own_;
  can::Client& client_;
  std::uint8_t node_;
};

}  // namespace

std::unique_ptr<ActionPort> serial_action_port(const link::Endpoint& endpoint, std::uint8_t id) {
  return std::make_unique<SerialPort>(endpoint, id);
}

std::unique_ptr<ActionPort> serial_action_port(bus::Client& client, std::uint8_t id) {
  return std::make_unique<SerialPort>(client, id);
}

std::unique_ptr<ActionPort> can_action_port(const link::Endpoint& endpoint, std::uint8_t id) {
  return std::make_unique<CanPort>(endpoint, id);
}

std::unique_ptr<ActionPort> can_action_port(can::Client& client, std::uint8_t id) {
  return std::make_unique<CanPort>(client, id);
}

}  // namespace verp::action
