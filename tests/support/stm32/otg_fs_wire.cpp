#include <algorithm>
#include <string>

#include "tests/support/stm32/gpio_model.hpp"
#include "tests/support/stm32/machine.hpp"
#include "tests/support/stm32/otg_fs_model.hpp"
#include "tests/support/stm32/rcc_model.hpp"
#include "tests/support/stm32/registers/otg_fs_table.hpp"

namespace verp::hal::stm32::model {

using namespace otg_fs;

namespace {

constexpr Time kFrame = ms(1);
/// A device suspends after 3 ms without frames; the core reports it in two steps.
constexpr Time kEarlySuspend = ms(3), kSuspend = ms(6);
/// DM and DP are PA11 and PA12 (DS8626, DS10693, DS10916).
constexpr unsigned kMinusPin = 11, kPlusPin = 12, kFunction = 10;

}  // namespace

void OtgFsModel::changed() {
  refresh();
  machine().touch();
  machine().settle();
}

void OtgFsModel::set_vbus(bool on) {
  vbus_ = on;
  if (!on) {
    enumerated_ = false;
    idle();
  }
  changed();
}

bool OtgFsModel::pulled_up() const {
  const RccModel& rcc = machine().rcc();
  const GpioModel& port = machine().gpio('A');
  return rcc.enabled(gate()) && usb_clock_ok(rcc.usb_hz()) && session_valid() &&
         has(kGccfg, kGccfgPwrdwn) && !has(kDctl, kDctlSdis) && !has(kGrstctl, kGrstctlCsrst) &&
         machine().now() >= device_from_ && port.function(kMinusPin) == kFunction &&
         port.function(kPlusPin) == kFunction && vbus_;
}

bool OtgFsModel::wakes_host() const {
  return pulled_up() && has(kDctl, kDctlRwusig) && has(kDsts, kDstsSuspsts);
}

void OtgFsModel::begin_reset() {
  if (!pulled_up()) return;
  frame_at_ = early_suspend_at_ = suspend_at_ = kNever;
  enumerated_ = setup_open_ = control_open_ = checked_ = false;
  take_address();
  if (v2_ && has(kDsts, kDstsSuspsts)) set(kGintsts, kGintRstdet);
  clear(kDsts, kDstsSuspsts);
  for (unsigned e = 1; e < endpoints_; ++e) {
    clear(diepctl(e), kEpctlUsbaep);
    clear(doepctl(e), kEpctlUsbaep);
  }
  set(kGintsts, kGintUsbrst);
  changed();
}

void OtgFsModel::end_reset() {
  if (!pulled_up()) return;
  if ((reg(kDcfg) & kDcfgDspd) != kDcfgDspdFullSpeed) violate("DSPD is not full speed");
  clear(kDsts, kDstsEnumspd);
  set(kDsts, kEnumspdFullSpeed << kDstsEnumspdShift);
  set(kGintsts, kGintEnumdne);
  enumerated_ = true;
  frame_at_ = machine().now() + kFrame;
  changed();
}

void OtgFsModel::idle() {
  frame_at_ = kNever;
  early_suspend_at_ = machine().now() + kEarlySuspend;
  suspend_at_ = machine().now() + kSuspend;
  machine().touch();
}

void OtgFsModel::resume() {
  early_suspend_at_ = suspend_at_ = kNever;
  frame_at_ = machine().now() + kFrame;
  if (has(kDsts, kDstsSuspsts)) set(kGintsts, kGintWkup);
  clear(kDsts, kDstsSuspsts);
  changed();
}

void OtgFsModel::run_wire() {
  const Time now = machine().now();
  const bool alive = machine().rcc().enabled(gate()) && has(kGccfg, kGccfgPwrdwn);
  if (frame_at_ <= now) {
    frame_at_ += kFrame;
    frame_ = (frame_ + 1) & 0x7FF;
    clear(kDsts, kDstsFnsof);
    set(kDsts, frame_ << kDstsFnsofShift);
    if (pulled_up()) set(kGintsts, kGintSof);
  }
  if (early_suspend_at_ <= now) {
    early_suspend_at_ = kNever;
    if (alive) set(kGintsts, kGintEsusp);
  }
  if (suspend_at_ <= now) {
    suspend_at_ = kNever;
    if (alive) set(kGintsts, kGintUsbsusp);
    if (alive) set(kDsts, kDstsSuspsts);
  }
  machine().touch();
}

bool OtgFsModel::listens(unsigned address) const {
  return enumerated_ && pulled_up() && !has(kPcgcctl, kPcgcctlStppclk | kPcgcctlGatehclk) &&
         address == address_;
}

void OtgFsModel::take_address() {
  if (!control_open_) address_ = (reg(kDcfg) & kDcfgDad) >> kDcfgDadShift;
}

bool OtgFsModel::active(unsigned endpoint, bool in) const {
  return endpoint < endpoints_ && has(in ? diepctl(endpoint) : doepctl(endpoint), kEpctlUsbaep);
}

bool OtgFsModel::has_room(std::size_t bytes) const {
  const std::size_t words = 2 + (bytes + 3) / 4;  // status words
  return received_.size() + words <= std::min(reg(kGrxfsiz), kFifoWords);
}

void OtgFsModel::receive(std::uint32_t status, unsigned endpoint, bool data1,
                         const std::uint8_t* bytes, std::size_t count) {
  received_.push_back({true, endpoint | static_cast<std::uint32_t>(count) << kGrxstsBcntShift |
                                 (data1 ? kPidData1 : kPidData0) << kGrxstsDpidShift |
                                 status << kGrxstsPktstsShift |
                                 (frame_ & 15u) << kGrxstsFrmnumShift});
  for (std::size_t i = 0; i < count; i += 4) {
    std::uint32_t word = 0;
    for (std::size_t k = i; k < std::min(count, i + 4); ++k) {
      word |= static_cast<std::uint32_t>(bytes[k]) << (8 * (k - i));
    }
    received_.push_back({false, word});
  }
}

void OtgFsModel::check_ready() {
  if (checked_) return;
  checked_ = true;
  const std::uint32_t trdt = (reg(kGusbcfg) & kGusbcfgTrdt) >> kGusbcfgTrdtShift;
  if (trdt < turnaround(machine().rcc().hclk_hz())) violate("TRDT is too short for the AHB");
  if (reg(kGrxfsiz) < kFifoWordsMin) violate("GRXFSIZ is less than 16 words");
  if (reg(kGrxfsiz) > kFifoWords) violate("GRXFSIZ is more than there is");
}

UsbAnswer OtgFsModel::setup(unsigned address, const std::uint8_t (&request)[8]) {
  if (!listens(address)) return UsbAnswer::kNone;
  check_ready();
  if (!has_room(sizeof request)) return UsbAnswer::kNone;  // never NAK: the host repeats it
  receive(kPacketSetup, 0, false, request, sizeof request);
  const std::uint32_t left = (reg(doeptsiz(0)) & kDoeptsizStupcnt) >> kDoeptsizStupcntShift;
  if (left == 0) set(doepint(0), kDoepB2bstup);
  if (left != 0) reg(doeptsiz(0)) -= 1u << kDoeptsizStupcntShift;
  for (const std::uint32_t control : {diepctl(0), doepctl(0)}) {
    clear(control, kEpctlStall);
    set(control, kEpctlNaksts);
  }
  in_[0].data1 = out_[0].data1 = true;
  setup_open_ = control_open_ = true;
  changed();
  return UsbAnswer::kAck;
}

void OtgFsModel::end_setup() {
  if (!setup_open_) return;
  setup_open_ = false;
  receive(kPacketSetupDone, 0, false, nullptr, 0);
}

UsbAnswer OtgFsModel::out(unsigned address, unsigned endpoint, bool data1,
                          const std::uint8_t* bytes, std::size_t count) {
  if (!listens(address) || !active(endpoint, false)) return UsbAnswer::kNone;
  check_ready();
  if (endpoint == 0) end_setup();
  const std::uint32_t control = doepctl(endpoint);
  UsbAnswer answer = UsbAnswer::kNak;
  if (has(control, kEpctlStall)) {
    answer = UsbAnswer::kStall;
  } else if (!has(control, kEpctlEpena)) {
    if (endpoint == 0) set(doepint(0), kDoepOtepdis);
  } else if (has(control, kEpctlNaksts) || global_out_nak_ || !has_room(count) ||
             !has(doeptsiz(endpoint), kTsizPktcnt)) {
    if (v2_) set(doepint(endpoint), kDoepNak);
  } else if (data1 != out_[endpoint].data1) {
    answer = UsbAnswer::kAck;  // repeated because our ACK was lost
  } else {
    answer = UsbAnswer::kAck;
    receive(kPacketOut, endpoint, data1, bytes, count);
    packet_taken(endpoint, count);
  }
  changed();
  return answer;
}

void OtgFsModel::packet_taken(unsigned endpoint, std::size_t bytes) {
  const std::uint32_t size = doeptsiz(endpoint), control = doepctl(endpoint);
  const auto count = static_cast<std::uint32_t>(bytes);
  const std::uint32_t left = reg(size) & kTsizXfrsiz;
  if (count > left) violate(named(false, endpoint) + " got more than XFRSIZ");
  reg(size) = (reg(size) & ~kTsizXfrsiz) | (left - std::min(left, count));
  reg(size) -= 1u << kTsizPktcntShift;
  out_[endpoint].data1 = !out_[endpoint].data1;
  if (endpoint != 0) reg(control) ^= kEpctlDpid;
  if ((reg(size) & kTsizPktcnt) != 0 && count == max_packet(endpoint, false)) return;
  receive(kPacketOutDone, endpoint, false, nullptr, 0);
  set(control, kEpctlNaksts);
}

UsbPacket OtgFsModel::in(unsigned address, unsigned endpoint, bool acknowledged) {
  UsbPacket packet;
  if (!listens(address) || !active(endpoint, true)) return packet;
  check_ready();
  if (endpoint == 0) end_setup();
  const std::uint32_t control = diepctl(endpoint);
  In& in = in_[endpoint];
  const std::uint32_t bytes = std::min(in.total - in.sent, max_packet(endpoint, true));
  const bool held = has(control, kEpctlNaksts) || has(kDctl, kDctlGinsts) ||
                    !has(dieptsiz(endpoint), kTsizPktcnt);
  packet.answer = UsbAnswer::kNak;
  if (has(control, kEpctlStall)) {
    packet.answer = UsbAnswer::kStall;
  } else if (!has(control, kEpctlEpena) || held || in.fifo.size() < (bytes + 3) / 4) {
    if (in.fifo.empty()) set(diepint(endpoint), kDiepIttxfe);
    if (v2_) set(diepint(endpoint), kDiepNak);
  } else {
    packet.answer = UsbAnswer::kAck;
    packet.data1 = in.data1;
    for (std::uint32_t i = 0; i < bytes; ++i) {
      packet.bytes.push_back(static_cast<std::uint8_t>(in.fifo[i / 4] >> (8 * (i % 4))));
    }
    if (acknowledged) packet_sent(endpoint, bytes);
    if (!acknowledged && endpoint == 0) set(diepint(0), kDiepToc);
  }
  changed();
  return packet;
}

void OtgFsModel::packet_sent(unsigned endpoint, std::uint32_t bytes) {
  In& in = in_[endpoint];
  for (std::uint32_t i = 0; i < bytes; i += 4) in.fifo.pop_front();
  in.sent += bytes;
  in.data1 = !in.data1;
  if (endpoint != 0) reg(diepctl(endpoint)) ^= kEpctlDpid;
  if (endpoint == 0 && bytes == 0) control_open_ = false;
  take_address();
  reg(dieptsiz(endpoint)) -= 1u << kTsizPktcntShift;
  if ((reg(dieptsiz(endpoint)) & kTsizPktcnt) != 0) return;
  clear(diepctl(endpoint), kEpctlEpena);
  set(diepint(endpoint), kDiepXfrc);
}

}  // namespace verp::hal::stm32::model
