#pragma once
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "tests/support/stm32/machine.hpp"
#include "tests/support/stm32/otg_fs_model.hpp"
#include "tests/support/stm32/usb_host.hpp"

/// A PC with a serial-port driver at the USB cable. Calls that make control transfers let time pass
/// and may not come from an event.
namespace verp::hal::stm32::model {

class SerialHost {
 public:
  using Bytes = std::vector<std::uint8_t>;

  explicit SerialHost(Machine& machine) : machine_(machine), usb_(machine.otg_fs()) { work(); }

  // Script.
  bool reading = true;
  unsigned deaf_every = 0;   ///< one ACK of the host in so many IN packets is lost; 0: never
  unsigned twice_every = 0;  ///< one ACK of the device in so many OUT packets is lost

  bool plug() { return bus_.plug() && meet(); }
  void unplug() {
    forget_session();
    bus_.unplug();
  }
  bool reset_bus() {
    forget_session();
    return bus_.reset();
  }
  /// Enumerates the device after a bus reset.
  bool meet() {
    std::optional<Bytes> device = ask(0x80, 6, 0x0100, 0, 8);
    if (!device || device->size() != 8 || !reset_bus()) return false;
    if (bus_.set_address(kAddress) != UsbResult::kDone) return false;
    device = ask(0x80, 6, 0x0100, 0, 18);
    std::optional<Bytes> tree = ask(0x80, 6, 0x0200, 0, 9);
    if (!device || device->size() != 18 || !tree || tree->size() != 9) return false;
    tree = ask(0x80, 6, 0x0200, 0, static_cast<std::uint16_t>((*tree)[2] | (*tree)[3] << 8));
    return tree && configure((*tree)[5]);
  }
  bool configure(std::uint8_t configuration) {
    forget_session();
    in_data1_ = out_data1_ = false;
    return bus_.configure(configuration) == UsbResult::kDone;
  }
  /// DTR and RTS.
  bool open() { return opened_ = tell(0x21, 0x22, 3, 0); }
  bool close() {
    forget_session();
    return tell(0x21, 0x22, 0, 0);
  }
  bool clear_halt(std::uint8_t endpoint) {
    ((endpoint & 0x80) != 0 ? in_data1_ : out_data1_) = false;
    return bus_.clear_halt(endpoint) == UsbResult::kDone;
  }

  bool opened() const { return opened_; }

  /// Bytes wait until the port accepts them.
  void send(const Bytes& bytes) { outbox_.insert(outbox_.end(), bytes.begin(), bytes.end()); }
  std::size_t unsent() const { return outbox_.size(); }
  Bytes take() { return std::exchange(inbox_, {}); }
  const Bytes& inbox() const { return inbox_; }
  /// Short packets, which end a message.
  unsigned ends() const { return ends_; }
  unsigned out_naks() const { return out_naks_; }
  unsigned stalls() const { return stalls_; }

  // Nothing if the device refused.
  std::optional<Bytes> ask(std::uint8_t type, std::uint8_t request, std::uint16_t value,
                           std::uint16_t index, std::uint16_t length) {
    UsbReply reply = bus_.control({type, request, value, index, length});
    if (reply.result != UsbResult::kDone) return std::nullopt;
    return std::move(reply.bytes);
  }
  bool tell(std::uint8_t type, std::uint8_t request, std::uint16_t value, std::uint16_t index,
            const Bytes& data = {}) {
    const UsbReply reply =
        bus_.control({type, request, value, index, static_cast<std::uint16_t>(data.size())}, data);
    return reply.result == UsbResult::kDone && reply.bytes.empty();
  }
  UsbHost& bus() { return bus_; }

 private:
  static constexpr std::size_t kPacket = 64;
  static constexpr std::uint8_t kAddress = 17;
  static constexpr unsigned kData = 1;
  static constexpr Time kTurn = us(100);  ///< about a full packet each way

  void forget_session() {
    opened_ = false;
    outbox_.clear();
  }
  void work() {
    if (opened_) {
      if (!outbox_.empty()) send_packet();
      if (reading) read_packet();
    }
    machine_.at(machine_.now() + kTurn, [this] { work(); });
  }
  void send_packet() {
    const std::size_t size = outbox_.size() < kPacket ? outbox_.size() : kPacket;
    const Bytes packet(outbox_.begin(), outbox_.begin() + static_cast<std::ptrdiff_t>(size));
    const UsbAnswer answer = usb_.out(bus_.address(), kData, out_data1_, packet.data(), size);
    if (answer == UsbAnswer::kNak) ++out_naks_;
    if (answer == UsbAnswer::kStall) ++stalls_;
    if (answer != UsbAnswer::kAck) return;
    if (twice_every != 0 && ++outs_ % twice_every == 0) return;  // repeated
    outbox_.erase(outbox_.begin(), outbox_.begin() + static_cast<std::ptrdiff_t>(size));
    out_data1_ = !out_data1_;
  }
  void read_packet() {
    const bool heard = deaf_every == 0 || (ins_ + 1) % deaf_every != 0;
    const UsbPacket packet = usb_.in(bus_.address(), kData, heard);
    if (packet.answer == UsbAnswer::kStall) ++stalls_;
    if (packet.answer != UsbAnswer::kAck) return;
    ++ins_;
    if (packet.data1 != in_data1_) return;  // repeated
    in_data1_ = !in_data1_;
    inbox_.insert(inbox_.end(), packet.bytes.begin(), packet.bytes.end());
    if (packet.bytes.size() < kPacket) ++ends_;
  }

  Machine& machine_;
  OtgFsModel& usb_;
  UsbHost bus_{machine_};
  bool opened_ = false;
  bool in_data1_ = false, out_data1_ = false;
  std::deque<std::uint8_t> outbox_;
  Bytes inbox_;
  unsigned ins_ = 0, outs_ = 0, ends_ = 0, out_naks_ = 0, stalls_ = 0;
};

}  // namespace verp::hal::stm32::model
