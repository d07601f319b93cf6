#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "tests/support/stm32/machine.hpp"
#include "tests/support/stm32/otg_fs_model.hpp"

/// The PC at the cable, in the machine's time. Calls return when the transfer is over or abandoned;
/// meanwhile interrupts and `firmware` run.
namespace verp::hal::stm32::model {

/// USB 2.0, 9.3.
struct UsbSetup {
  std::uint8_t type = 0;  ///< bit 7: the device sends
  std::uint8_t request = 0;
  std::uint16_t value = 0, index = 0, length = 0;
};

enum class UsbResult : std::uint8_t {
  kDone,
  kStalled,
  kNaked,    ///< NAK for longer than `patience`
  kNoAnswer  ///< no answer three times in a row
};

struct UsbReply {
  UsbResult result = UsbResult::kNoAnswer;
  std::vector<std::uint8_t> bytes;
};

class UsbHost {
 public:
  explicit UsbHost(Machine& machine) : machine_(machine), core_(machine.otg_fs()) {}

  // Script.
  Time patience = ms(50);
  Time retry = us(20);             ///< from a NAK to the next try
  std::function<void()> firmware;  ///< after each token, and every 100 us of pass()
  std::uint32_t lose_acks = 0;     ///< loses so many of the next acknowledgements
  std::uint32_t control_size = 64;
  std::uint32_t bulk_size = 64;

  /// Power, up to 1 s for the pull-up, 100 ms of rest (USB 2.0, 7.1.7.3), bus reset. False if no
  /// device appeared.
  bool plug();
  void unplug();
  /// SE0 and rest, 10 ms each. Then the address is 0, all toggles DATA0.
  bool reset();
  void suspend() { core_.idle(); }
  /// 20 ms of resume signalling.
  void resume();
  void pass(Time time);

  UsbReply control(const UsbSetup& setup, const std::vector<std::uint8_t>& data = {});
  /// 2 ms of rest follow.
  UsbResult set_address(std::uint8_t address);
  /// Toggles start at DATA0.
  UsbResult configure(std::uint8_t configuration);
  /// DATA0 for that endpoint; bit 7 of the address: IN.
  UsbResult clear_halt(std::uint8_t endpoint_address);
  /// Packets of bulk_size and a shorter last one; for no bytes, an empty one.
  UsbResult out(unsigned endpoint, const std::vector<std::uint8_t>& bytes);
  /// Until a short packet or `most` bytes.
  UsbReply in(unsigned endpoint, std::size_t most);

  std::uint8_t address() const { return address_; }
  std::uint32_t naks() const { return naks_; }
  std::uint32_t duplicates() const { return duplicates_; }  ///< IN packets with the old toggle
  std::size_t last_packet() const { return last_packet_; }

 private:
  UsbResult send(unsigned endpoint, bool& data1, const std::uint8_t* bytes, std::size_t count);
  UsbResult fetch(unsigned endpoint, bool& data1, std::vector<std::uint8_t>& bytes);
  UsbReply read_stage(const UsbSetup& setup);
  UsbReply write_stage(const std::vector<std::uint8_t>& data);
  void token(std::size_t bytes);
  /// For an answer other than ACK; true: try again.
  bool again(UsbAnswer answer, Time until, unsigned& silent, UsbResult& result);
  bool ack_arrives();
  void forget_toggles();

  static constexpr unsigned kEndpoints = 16;
  Machine& machine_;
  OtgFsModel& core_;
  std::uint8_t address_ = 0;
  bool in_data1_[kEndpoints] = {}, out_data1_[kEndpoints] = {};
  std::uint32_t naks_ = 0, duplicates_ = 0;
  std::size_t last_packet_ = 0;
};

}  // namespace verp::hal::stm32::model
