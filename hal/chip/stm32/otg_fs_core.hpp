#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/chip/stm32/io.hpp"
#include "hal/chip/stm32/registers/memory_map.hpp"
#include "hal/chip/stm32/registers/otg_fs.hpp"

/// OTG_FS as a device controller, one packet at a time. It interprets no USB request. Every wait
/// ends; timeouts are counted.
namespace verp::hal::stm32 {

template <Io Access>
class OtgFsCore {
 public:
  static constexpr unsigned kEndpoints = 3;  ///< control, bulk, notification
  static constexpr std::uint32_t kPacket = 64;

  OtgFsCore(Family family, Access io) : io_(io), family_(family) {}

  /// False: no 48 MHz clock, or no core.
  bool reset() {
    write(otg_fs::kGahbcfg, 0);
    if (!wait_for(otg_fs::kGrstctl, otg_fs::kGrstctlAhbidl, otg_fs::kGrstctlAhbidl)) return false;
    set(otg_fs::kGrstctl, otg_fs::kGrstctlCsrst);
    return wait_for(otg_fs::kGrstctl, otg_fs::kGrstctlCsrst, 0) &&
           wait_for(otg_fs::kGrstctl, otg_fs::kGrstctlAhbidl, otg_fs::kGrstctlAhbidl);
  }
  /// Ignores the ID pin; holds after kForceModeTime_ms, see is_device().
  void force_device(std::uint32_t hclk_hz) {
    modify32(io_, at(otg_fs::kGusbcfg),
             otg_fs::kGusbcfgTrdt | otg_fs::kGusbcfgSrpcap | otg_fs::kGusbcfgHnpcap,
             otg_fs::kGusbcfgFdmod | otg_fs::turnaround(hclk_hz) << otg_fs::kGusbcfgTrdtShift);
  }
  bool is_device() { return (read(otg_fs::kGintsts) & otg_fs::kGintCmod) == 0; }

  /// Call before connect(). With `sense_vbus` pin PA9 detects the host.
  void set_up(bool sense_vbus, std::uint32_t interrupts) {
    set(otg_fs::kDctl, otg_fs::kDctlSdis);
    write(otg_fs::kPcgcctl, 0);
    choose_vbus(sense_vbus);
    modify32(io_, at(otg_fs::kDcfg), otg_fs::kDcfgDspd | otg_fs::kDcfgDad,
             otg_fs::kDcfgDspdFullSpeed);
    share_memory();
    write(otg_fs::kDiepmsk, otg_fs::kDiepXfrc);
    write(otg_fs::kDoepmsk, otg_fs::kDoepXfrc | otg_fs::kDoepStup);
    write(otg_fs::kDaintmsk, 0);
    write(otg_fs::kGotgint, read(otg_fs::kGotgint));
    write(otg_fs::kGintsts, interrupts & kClearable);
    write(otg_fs::kGintmsk, interrupts);
    write(otg_fs::kGahbcfg, otg_fs::kGahbcfgGint);
  }
  void connect() { modify32(io_, at(otg_fs::kDctl), otg_fs::kDctlSdis, 0); }

  // Enabled interrupts that are pending.
  std::uint32_t pending() { return read(otg_fs::kGintsts) & read(otg_fs::kGintmsk); }
  void clear(std::uint32_t flags) { write(otg_fs::kGintsts, flags & kClearable); }
  void ignore(std::uint32_t flags) { modify32(io_, at(otg_fs::kGintmsk), flags, 0); }
  std::uint32_t take_otg() {
    const std::uint32_t flags = read(otg_fs::kGotgint);
    write(otg_fs::kGotgint, flags);
    return flags;
  }
  /// Reads and clears the endpoint's flags.
  std::uint32_t take_in(unsigned endpoint) {
    const std::uint32_t flags = read(otg_fs::diepint(endpoint)) & otg_fs::kDiepXfrc;
    if (flags != 0) write(otg_fs::diepint(endpoint), flags);
    return flags;
  }
  std::uint32_t take_out(unsigned endpoint) {
    const std::uint32_t flags =
        read(otg_fs::doepint(endpoint)) & (otg_fs::kDoepXfrc | otg_fs::kDoepStup);
    if (flags != 0) clear_out(endpoint, flags);
    return flags;
  }

  /// After a bus reset: address 0, control endpoint only.
  void start_over() {
    set_address(0);
    for (unsigned endpoint = 0; endpoint < kEndpoints; ++endpoint) {
      cancel_send(endpoint);
      write(otg_fs::diepint(endpoint), otg_fs::kDiepXfrc);
      if (endpoint >= kOutEndpoints) continue;
      control(otg_fs::doepctl(endpoint), 0, otg_fs::kEpctlSnak);
      clear_out(endpoint, otg_fs::kDoepXfrc | otg_fs::kDoepStup);
    }
    write(otg_fs::kDaintmsk, 1u | 1u << otg_fs::kDaintOutShift);
    expect_setup();
  }
  void set_address(std::uint8_t address) {
    modify32(io_, at(otg_fs::kDcfg), otg_fs::kDcfgDad,
             std::uint32_t{address} << otg_fs::kDcfgDadShift);
  }

  /// Opens endpoint 1 or 2: on, empty, not halted, DATA0 next.
  void open_endpoint(std::uint8_t address, std::uint32_t type, std::uint32_t packet) {
    const unsigned endpoint = address & 0xFu;
    const bool in = is_in(address);
    if (in) cancel_send(endpoint);
    const std::uint32_t fifo = in ? endpoint << otg_fs::kDiepctlTxfnumShift : 0;
    control(control_of(address),
            otg_fs::kEpctlMpsiz | otg_fs::kEpctlEptyp | otg_fs::kEpctlStall |
                (in ? otg_fs::kDiepctlTxfnum : 0),
            packet | type << otg_fs::kEpctlEptypShift | fifo | otg_fs::kEpctlUsbaep |
                otg_fs::kEpctlSd0pid | otg_fs::kEpctlSnak);
    set(otg_fs::kDaintmsk, 1u << (endpoint + (in ? 0 : otg_fs::kDaintOutShift)));
  }
  void close_endpoint(std::uint8_t address) {
    const unsigned endpoint = address & 0xFu;
    if (is_in(address)) cancel_send(endpoint);
    modify32(io_, at(otg_fs::kDaintmsk),
             1u << (endpoint + (is_in(address) ? 0 : otg_fs::kDaintOutShift)), 0);
    control(control_of(address), otg_fs::kEpctlUsbaep, otg_fs::kEpctlSnak);
  }
  void stall(std::uint8_t address) { control(control_of(address), 0, otg_fs::kEpctlStall); }
  /// At endpoint 0 a new request ends the STALL.
  void unstall(std::uint8_t address) {
    control(control_of(address), otg_fs::kEpctlStall, otg_fs::kEpctlSd0pid);
  }

  /// Sends one packet, perhaps empty, after the previous one has gone; `byte(i)` is its i-th byte.
  /// False: an old packet is stuck; the endpoint is silent until the next bus reset.
  template <class Byte>
  bool send(unsigned endpoint, std::uint32_t size, Byte&& byte) {
    const std::uint32_t words = (size + 3) / 4;
    if (is_broken(endpoint)) return false;
    if (room(endpoint) < words) {
      ++stuck_;
      cancel_send(endpoint);
      if (is_broken(endpoint) || room(endpoint) < words) return false;
    }
    write(otg_fs::dieptsiz(endpoint), size | 1u << otg_fs::kTsizPktcntShift);
    control(otg_fs::diepctl(endpoint), 0, otg_fs::kEpctlEpena | otg_fs::kEpctlCnak);
    for (std::uint32_t at_byte = 0; at_byte < size; at_byte += 4) {
      std::uint32_t word = 0;
      for (std::uint32_t i = 0; i < 4 && at_byte + i < size; ++i) {
        word |= std::uint32_t{byte(at_byte + i)} << 8 * i;
      }
      write(otg_fs::fifo(endpoint), word);
    }
    return true;
  }
  /// Discards a packet that has not gone (RM0385 37.15).
  void cancel_send(unsigned endpoint) {
    const std::uint32_t was = read(otg_fs::diepctl(endpoint));
    if ((was & otg_fs::kEpctlEpena) != 0) {
      if ((was & otg_fs::kEpctlNaksts) == 0) {
        control(otg_fs::diepctl(endpoint), 0, otg_fs::kEpctlSnak);
        wait_for(otg_fs::diepint(endpoint), otg_fs::kDiepInepne, otg_fs::kDiepInepne);
      }
      control(otg_fs::diepctl(endpoint), 0, otg_fs::kEpctlSnak | otg_fs::kEpctlEpdis);
      if (!wait_for(otg_fs::diepint(endpoint), otg_fs::kDiepEpdisd, otg_fs::kDiepEpdisd)) {
        broken_ |= 1u << endpoint;
        return;
      }
      write(otg_fs::diepint(endpoint),
            otg_fs::kDiepEpdisd | otg_fs::kDiepInepne | otg_fs::kDiepXfrc);
    }
    broken_ &= ~(1u << endpoint);
    flush_sent(endpoint << otg_fs::kGrstctlTxfnumShift);
  }

  /// Allows one packet; until then the host gets NAK.
  void expect(unsigned endpoint) {
    if ((read(otg_fs::doepctl(endpoint)) & otg_fs::kEpctlEpena) == 0) {
      write(otg_fs::doeptsiz(endpoint),
            kPacket | 1u << otg_fs::kTsizPktcntShift | (endpoint == 0 ? kSetups : 0));
    }
    control(otg_fs::doepctl(endpoint), 0, otg_fs::kEpctlEpena | otg_fs::kEpctlCnak);
  }
  /// Allows requests: at most three in a row; the last counts.
  void expect_setup() {
    if ((read(otg_fs::doepctl(0)) & otg_fs::kEpctlEpena) != 0) return;
    write(otg_fs::kDoeptsiz, kSetups | 1u << otg_fs::kTsizPktcntShift | kSetupBytes);
  }

  struct Arrival {
    std::uint32_t what = 0;  ///< kPacketOut and so on; 0: nothing
    unsigned endpoint = 0;
    std::uint32_t size = 0;  ///< bytes that take() must fetch
  };
  Arrival arrival() {
    if ((read(otg_fs::kGintsts) & otg_fs::kGintRxflvl) == 0) return {};
    const std::uint32_t status = read(otg_fs::kGrxstsp);
    return {.what = (status & otg_fs::kGrxstsPktsts) >> otg_fs::kGrxstsPktstsShift,
            .endpoint = status & otg_fs::kGrxstsEpnum,
            .size = (status & otg_fs::kGrxstsBcnt) >> otg_fs::kGrxstsBcntShift};
  }
  template <class Put>
  void take(std::uint32_t size, Put&& put) {
    std::uint32_t word = 0;
    for (std::uint32_t i = 0; i < size; ++i, word >>= 8) {
      if (i % 4 == 0) word = read(otg_fs::fifo(0));
      put(static_cast<std::uint8_t>(word));
    }
  }

  /// Times a bit did not change in time.
  std::uint32_t stuck() const { return stuck_; }
  void count_stuck() { ++stuck_; }

 private:
  static constexpr unsigned kOutEndpoints = 2;
  // All polls take at least 100 us at 216 MHz. A core reset takes microseconds; a packet ends
  // within 50.
  static constexpr int kPolls = 4000;
  static constexpr std::uint32_t kClearable = otg_fs::kGintUsbsusp | otg_fs::kGintUsbrst |
                                              otg_fs::kGintEnumdne | otg_fs::kGintSrq |
                                              otg_fs::kGintWkup;
  static constexpr std::uint32_t kSetups = 3u << otg_fs::kDoeptsizStupcntShift;
  static constexpr std::uint32_t kSetupBytes = 3 * 8;

  // FIFO memory in words. Reception needs (RM0385 37.13, RxFIFO): 10 for requests, two packets with
  // their status, a word for each transfer's end, one for the global NAK. The rest is reserve.
  static constexpr std::uint32_t kReceiveWords = 128;
  static constexpr std::uint32_t kSendWords[kEndpoints] = {16, 64, 16};
  static_assert(kReceiveWords >= 10 + 2 * (kPacket / 4 + 1) + 2 * kOutEndpoints + 1);
  static_assert(kReceiveWords + kSendWords[0] + kSendWords[1] + kSendWords[2] <=
                otg_fs::kFifoWords);

  std::uint32_t at(std::uint32_t offset) const { return base::kOtgFs + offset; }
  std::uint32_t read(std::uint32_t offset) { return io_.read32(at(offset)); }
  void write(std::uint32_t offset, std::uint32_t value) { io_.write32(at(offset), value); }
  void set(std::uint32_t offset, std::uint32_t mask) { modify32(io_, at(offset), 0, mask); }
  /// Never writes a read EPENA back: the core may have cleared it.
  void control(std::uint32_t offset, std::uint32_t clear, std::uint32_t mask) {
    modify32(io_, at(offset), clear | otg_fs::kEpctlEpena | otg_fs::kEpctlEpdis, mask);
  }
  bool wait_for(std::uint32_t offset, std::uint32_t mask, std::uint32_t value) {
    for (int poll = 0; poll < kPolls; ++poll) {
      if ((read(offset) & mask) == value) return true;
    }
    ++stuck_;
    return false;
  }
  static constexpr bool is_in(std::uint8_t address) { return (address & 0x80) != 0; }
  static constexpr std::uint32_t control_of(std::uint8_t address) {
    return is_in(address) ? otg_fs::diepctl(address & 0xFu) : otg_fs::doepctl(address & 0xFu);
  }

  /// Bit 7 of DOEPINT is reserved but not 0: write it as read.
  void clear_out(unsigned endpoint, std::uint32_t flags) {
    write(otg_fs::doepint(endpoint), flags | (read(otg_fs::doepint(endpoint)) & bit(7)));
  }
  bool is_broken(unsigned endpoint) const { return (broken_ >> endpoint & 1u) != 0; }
  std::uint32_t room(unsigned endpoint) { return read(otg_fs::dtxfsts(endpoint)) & 0xFFFF; }
  void flush_sent(std::uint32_t fifo) {
    modify32(io_, at(otg_fs::kGrstctl), otg_fs::kGrstctlTxfnum, fifo | otg_fs::kGrstctlTxfflsh);
    wait_for(otg_fs::kGrstctl, otg_fs::kGrstctlTxfflsh, 0);
  }
  void share_memory() {
    write(otg_fs::kGrxfsiz, kReceiveWords);
    std::uint32_t start = kReceiveWords;
    for (unsigned endpoint = 0; endpoint < kEndpoints; ++endpoint) {
      write(otg_fs::dieptxf(endpoint), start | kSendWords[endpoint] << otg_fs::kDieptxfDepthShift);
      start += kSendWords[endpoint];
    }
    flush_sent(otg_fs::kGrstctlAllTxFifos);
    set(otg_fs::kGrstctl, otg_fs::kGrstctlRxfflsh);
    wait_for(otg_fs::kGrstctl, otg_fs::kGrstctlRxfflsh, 0);
  }
  void choose_vbus(bool sense) {
    if (family_ == Family::kF405) {
      write(otg_fs::kGccfg, otg_fs::kGccfgPwrdwn | (sense ? otg_fs::kGccfgVbusbsenF405
                                                          : otg_fs::kGccfgNovbussensF405));
      return;
    }
    write(otg_fs::kGccfg, otg_fs::kGccfgPwrdwn | (sense ? otg_fs::kGccfgVbden : 0));
    if (sense) return;
    set(otg_fs::kGotgctl, otg_fs::kGotgctlBvaloen);
    set(otg_fs::kGotgctl, otg_fs::kGotgctlBvaloval);
  }

  [[no_unique_address]] Access io_;
  Family family_;
  std::uint32_t stuck_ = 0;
  std::uint32_t broken_ = 0;  ///< bit mask of IN endpoints that could not be disabled
};

}  // namespace verp::hal::stm32
