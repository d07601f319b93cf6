#pragma once
#include <cstdint>
#include <vector>

#include "hal/chip/stm32/clock.hpp"
#include "hal/chip/stm32/registers/gpio.hpp"
#include "hal/chip/stm32/registers/otg_fs.hpp"
#include "tests/host/stm32_model/chip.hpp"
#include "tests/support/stm32/gpio_model.hpp"
#include "tests/support/stm32/otg_fs_model.hpp"
#include "tests/support/stm32/usb_host.hpp"

/// The least firmware by the manual's model, polled. Answers any IN request on endpoint 0 with
/// `answer`; keeps data of control writes, and endpoint 1's until the test sends.
namespace verp::hal::stm32::model {

/// Neighbours differ.
inline std::vector<std::uint8_t> ramp(std::size_t count) {
  std::vector<std::uint8_t> bytes(count);
  for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::uint8_t>(3 * i + 1);
  return bytes;
}

struct UsbDevice {
  explicit UsbDevice(Family family, Time crystal_start = ms(2))
      : machine(family), io(machine.io()), core(machine.otg_fs()), host(machine) {
    machine.rcc().hse_start = crystal_start;
    ClockTree<ModelIo>(family,
                       {.crystal_hz = 8'000'000,
                        .external = false,
                        .vco_hz = 336'000'000,
                        .sysclk_hz = 168'000'000},
                       machine.io())
        .start();
    enable(io, rcc::kAhb1enr, rcc::kAhb1GpioA);
    modify32(io, base::gpio('A') + gpio::kAfrh, 0xFF000, 0xAA000);
    modify32(io, base::gpio('A') + gpio::kModer, 0xFu << 22, 0xAu << 22);
    enable(io, rcc::kAhb2enr, rcc::kAhb2OtgFs);
    host.firmware = [this] { poll(); };
  }

  std::uint32_t get(std::uint32_t offset) { return io.read32(base::kOtgFs + offset); }
  void put(std::uint32_t offset, std::uint32_t value) { io.write32(base::kOtgFs + offset, value); }
  void change(std::uint32_t offset, std::uint32_t off, std::uint32_t on) {
    modify32(io, base::kOtgFs + offset, off, on);
  }

  /// The newer core stays disconnected until SDIS is cleared.
  void start(bool sense_vbus = true) {
    using namespace otg_fs;
    change(kGusbcfg, kGusbcfgTrdt, kGusbcfgFdmod | 6u << kGusbcfgTrdtShift);
    machine.advance(ms(kForceModeTime_ms));
    put(kGrxfsiz, 128);
    put(kDieptxf0, 128 | 64u << kDieptxfDepthShift);
    put(dieptxf(1), 192 | 64u << kDieptxfDepthShift);
    change(kDcfg, 0, kDcfgDspdFullSpeed);
    if (machine.family() == Family::kF405) {
      put(kGccfg, kGccfgPwrdwn | (sense_vbus ? kGccfgVbusbsenF405 : kGccfgNovbussensF405));
    } else {
      if (!sense_vbus) change(kGotgctl, 0, kGotgctlBvaloen | kGotgctlBvaloval);
      put(kGccfg, kGccfgPwrdwn | (sense_vbus ? kGccfgVbden : 0));
    }
    change(kDctl, kDctlSdis, 0);
  }

  void poll() {
    using namespace otg_fs;
    if (!polling) return;
    const std::uint32_t flags = get(kGintsts);
    if ((flags & kGintUsbrst) != 0) bus_reset();
    if ((flags & kGintEnumdne) != 0) put(kGintsts, kGintEnumdne);
    while ((get(kGintsts) & kGintRxflvl) != 0) receive();
    if ((get(doepint(0)) & kDoepStup) != 0) request();
    for (unsigned e = 0; e < 2; ++e) {
      if ((get(doepint(e)) & kDoepXfrc) == 0) continue;
      acknowledge(e, kDoepXfrc);
      if (e == 0 && receives) {
        receives = false;
        send(0, {});
      } else if (e == 1) {
        listen(1, window);
      }
    }
  }

  /// Bit 7 is reserved and set.
  void acknowledge(unsigned endpoint, std::uint32_t flag) {
    put(otg_fs::doepint(endpoint), flag | (get(otg_fs::doepint(endpoint)) & bit(7)));
  }

  void bus_reset() {
    using namespace otg_fs;
    put(kGintsts, kGintUsbrst);
    change(kDcfg, kDcfgDad, 0);
    put(doeptsiz(0), 3u << kDoeptsizStupcntShift);
  }

  void receive() {
    using namespace otg_fs;
    const std::uint32_t status = get(kGrxstsp);
    const std::uint32_t count = (status & kGrxstsBcnt) >> kGrxstsBcntShift;
    const std::uint32_t what = (status & kGrxstsPktsts) >> kGrxstsPktstsShift;
    std::vector<std::uint8_t> bytes;
    for (std::uint32_t i = 0; i < count; i += 4) {
      const std::uint32_t word = get(fifo(0));
      for (std::uint32_t k = i; k < count && k < i + 4; ++k) {
        bytes.push_back(static_cast<std::uint8_t>(word >> (8 * (k - i))));
      }
    }
    if (what == kPacketSetup) setup = bytes;
    if (what != kPacketOut) return;
    auto& kept = (status & kGrxstsEpnum) == 0 ? written : received;
    kept.insert(kept.end(), bytes.begin(), bytes.end());
  }

  void request() {
    using namespace otg_fs;
    acknowledge(0, kDoepStup);
    const unsigned length = setup[6] + 256u * setup[7];
    if (refuse) {
      change(diepctl(0), 0, kEpctlStall);
      change(doepctl(0), 0, kEpctlStall);
      return;
    }
    if (setup[1] == 5)
      change(kDcfg, kDcfgDad, static_cast<std::uint32_t>(setup[2]) << kDcfgDadShift);
    if (setup[1] == 9) open_bulk();
    if ((setup[0] & 0x80) != 0) {
      send(0, answer);
      listen(0, 64);
    } else if (length != 0) {
      receives = true;
      listen(0, 64);
    } else {
      send(0, {});
    }
  }

  void open_bulk() {
    using namespace otg_fs;
    const std::uint32_t bulk = 64 | kEpctlUsbaep | kTypeBulk << kEpctlEptypShift | kEpctlSd0pid;
    put(diepctl(1), bulk | 1u << kDiepctlTxfnumShift | kEpctlSnak);
    put(doepctl(1), bulk);
    listen(1, window);
  }

  void listen(unsigned endpoint, std::uint32_t bytes) {
    using namespace otg_fs;
    const std::uint32_t setups = endpoint == 0 ? 3u << kDoeptsizStupcntShift : 0;
    put(doeptsiz(endpoint), bytes | (bytes + 63) / 64 << kTsizPktcntShift | setups);
    change(doepctl(endpoint), 0, kEpctlEpena | kEpctlCnak);
  }

  void announce(unsigned endpoint, std::uint32_t bytes) {
    using namespace otg_fs;
    const std::uint32_t packets = bytes == 0 ? 1 : (bytes + 63) / 64;
    put(dieptsiz(endpoint), bytes | packets << kTsizPktcntShift);
    change(diepctl(endpoint), 0, kEpctlEpena | kEpctlCnak);
  }
  void send(unsigned endpoint, const std::vector<std::uint8_t>& bytes) {
    announce(endpoint, static_cast<std::uint32_t>(bytes.size()));
    for (std::size_t i = 0; i < bytes.size(); i += 4) {
      std::uint32_t word = 0;
      for (std::size_t k = i; k < bytes.size() && k < i + 4; ++k) {
        word |= static_cast<std::uint32_t>(bytes[k]) << (8 * (k - i));
      }
      put(otg_fs::fifo(endpoint), word);
    }
  }

  bool ready() {
    start();
    return host.plug() && host.set_address(7) == UsbResult::kDone &&
           host.configure(1) == UsbResult::kDone;
  }

  Machine machine;
  ModelIo io;
  OtgFsModel& core;
  UsbHost host;
  bool polling = true, refuse = false, receives = false;
  std::uint32_t window = 64;  ///< bytes that endpoint 1 takes
  std::vector<std::uint8_t> answer = {18, 1, 0, 2}, setup, written, received;
};

}  // namespace verp::hal::stm32::model
