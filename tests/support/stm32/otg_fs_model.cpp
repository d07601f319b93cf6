#include "tests/support/stm32/otg_fs_model.hpp"

#include <algorithm>
#include <string>

#include "tests/support/stm32/machine.hpp"
#include "tests/support/stm32/rcc_model.hpp"
#include "tests/support/stm32/registers/otg_fs_table.hpp"

namespace verp::hal::stm32::model {

using namespace otg_fs;

namespace {

/// The FIFO windows, which take 4 KB each on the bus.
constexpr std::uint32_t kFolded = 0xE40;
constexpr std::uint32_t kGated = kPcgcctlStppclk | kPcgcctlGatehclk;
constexpr Register kWindowRegisters[] = {
    {.name = "FIFO", .offset = 0, .paragraph = 1, .rw = bits(0, 32)}};
constexpr Table kWindow = make_table("OTG_FS FIFO", "RM0090 34.16.1", kWindowRegisters);

}  // namespace

OtgFsModel::OtgFsModel(Machine& machine)
    : Bank(machine, "OTG_FS", base::kOtgFs,
           machine.family() == Family::kF405 ? kTableF405 : kTableF7,
           {rcc::kAhb2enr, rcc::kAhb2OtgFs, rcc::kAhb2OtgFs}),
      v2_(machine.family() != Family::kF405),
      endpoints_(otg_fs::endpoints(machine.family())) {
  add_tables();
  widen(fifo(endpoints_));
  refresh();
}

void OtgFsModel::add_tables() {
  add_registers(v2_ ? kDeviceTableF7 : kDeviceTableF405, kDevice);
  add_registers(v2_ ? kIn0TableF7 : kIn0TableF405, diepctl(0));
  add_registers(v2_ ? kOut0TableF7 : kOut0TableF405, doepctl(0));
  add_registers(kPowerTable, kPcgcctl);
  for (unsigned e = 1; e < endpoints_; ++e) {
    add_registers(kFifoTable, dieptxf(e) - dieptxf(1));
    add_registers(v2_ ? kInTableF7 : kInTableF405, diepctl(e));
    add_registers(v2_ ? kOutTableF7 : kOutTableF405, doepctl(e));
  }
  for (unsigned e = 0; e < endpoints_; ++e) add_registers(kWindow, kFolded + 4 * e);
}

std::uint32_t OtgFsModel::fold(std::uint32_t offset) const {
  return offset < fifo(0) ? offset : kFolded + 4 * (offset / 0x1000 - 1);
}

void OtgFsModel::later(Time delay, std::function<void()> what) {
  due_.emplace_back(machine().now() + delay, std::move(what));
  machine().touch();
}

void OtgFsModel::reset() {
  reset_core();
  Bank::reset();
  device_from_ = 0;
  refresh();
}

/// Keeps what the manual names, and GCCFG: much software powers up the transceiver first.
void OtgFsModel::reset_core() {
  const std::uint32_t gccfg = reg(kGccfg), speed = reg(kDcfg) & kDcfgDspd, power = reg(kPcgcctl);
  Bank::reset();
  reg(kGccfg) = gccfg;
  reg(kDcfg) |= speed;
  reg(kPcgcctl) = power;
  for (In& in : in_) in = In{};
  for (Out& out : out_) out = Out{};
  received_.clear();
  due_.clear();
  enumerated_ = setup_open_ = control_open_ = global_out_nak_ = checked_ = false;
  take_address();
}

void OtgFsModel::run() {
  const Time now = machine().now();
  if (next() > now) return;
  for (std::size_t i = 0; i < due_.size();) {
    if (due_[i].first > now) {
      ++i;
      continue;
    }
    const auto what = std::move(due_[i].second);
    due_.erase(due_.begin() + static_cast<std::ptrdiff_t>(i));
    what();
    i = 0;
  }
  run_wire();
  refresh();
}

Time OtgFsModel::next() const {
  Time when = std::min({frame_at_, early_suspend_at_, suspend_at_});
  for (const auto& due : due_) when = std::min(when, due.first);
  return when;
}

bool OtgFsModel::interrupt(unsigned irq) const {
  return irq == irq::kOtgFs && has(kGahbcfg, kGahbcfgGint) &&
         (reg(kGintsts) & reg(kGintmsk) & ~kGintCmod) != 0;
}

bool OtgFsModel::session_valid() const {
  if (!v2_) return has(kGccfg, kGccfgNovbussensF405) || (vbus_ && has(kGccfg, kGccfgVbusbsenF405));
  if (has(kGotgctl, kGotgctlBvaloen)) return has(kGotgctl, kGotgctlBvaloval);
  return vbus_ && has(kGccfg, kGccfgVbden);
}

void OtgFsModel::refresh() {
  const bool session = session_valid();
  if (session != session_ && machine().rcc().enabled(gate())) {
    if (session) set(kGintsts, kGintSrq);
    if (!session) set(kGotgint, kGotgintSedet);
  }
  session_ = session;
  clear(kGotgctl, kGotgctlBsvld | kGotgctlAsvld);
  if (session) set(kGotgctl, kGotgctlBsvld);
  set(kGotgctl, kGotgctlCidsts);  // an open ID pin: a device
  clear(kGrstctl, kGrstctlAhbidl);
  if (!ahb_busy) set(kGrstctl, kGrstctlAhbidl);
  clear(kGintsts, kGintCmod | kGintRxflvl | kGintOtg | kGintIep | kGintOep);
  refresh_endpoints();
  if (!received_.empty()) set(kGintsts, kGintRxflvl);
  if (reg(kGotgint) != 0) set(kGintsts, kGintOtg);
  const std::uint32_t all = reg(kDaint) & reg(kDaintmsk);
  if ((all & 0xFFFF) != 0) set(kGintsts, kGintIep);
  if (all >> kDaintOutShift != 0) set(kGintsts, kGintOep);
}

void OtgFsModel::refresh_endpoints() {
  reg(kDaint) = 0;
  for (unsigned e = 0; e < endpoints_; ++e) {
    const auto words = static_cast<std::uint32_t>(in_[e].fifo.size());
    const std::uint32_t limit = has(kGahbcfg, kGahbcfgTxfelvl) ? 0 : depth(e) / 2;
    clear(diepint(e), kDiepTxfe);
    if (words <= limit) set(diepint(e), kDiepTxfe);
    reg(dtxfsts(e)) = depth(e) - std::min(depth(e), words);
    const bool empty = has(diepint(e), kDiepTxfe) && (reg(kDiepempmsk) >> e & 1u) != 0;
    if (empty || (reg(diepint(e)) & reg(kDiepmsk) & ~kDiepTxfe) != 0) set(kDaint, bit(e));
    if ((reg(doepint(e)) & reg(kDoepmsk)) != 0) set(kDaint, bit(kDaintOutShift + e));
  }
  reg(kHnptxsts) = (reg(kHnptxsts) & ~0xFFFFu) | reg(dtxfsts(0));
}

/// False during a core reset and, for most registers, without clock.
bool OtgFsModel::awake(std::uint32_t offset, const char* what) const {
  if (has(kGrstctl, kGrstctlCsrst) && offset != kGrstctl) {
    violate(std::string(what) + " while CSRST is set");
    return false;
  }
  const bool woken = offset == kPcgcctl || offset <= kGintmsk || offset == kDsts;
  if (has(kPcgcctl, kGated) && !woken) {
    violate(std::string(what) + " while PCGCCTL stops the core's clock");
    return false;
  }
  return true;
}

void OtgFsModel::before_read(std::uint32_t offset) {
  refresh();
  const bool some = !received_.empty();
  if (offset == kGrxstsr || offset == kGrxstsp) {
    reg(offset) = some ? received_.front().word : 0;
  } else if (offset >= kFolded) {
    reg(offset) = some && !received_.front().status ? received_.front().word : 0;
  }
}

void OtgFsModel::after_read(std::uint32_t offset) {
  awake(offset, "read");
  if (offset == kGrxstsp) pop_status();
  if (offset >= kFolded) pop_data();
  refresh();
}

void OtgFsModel::pop_data() {
  if (received_.empty() || received_.front().status) {
    violate("read of the receive FIFO beyond what the last status word announced");
    return;
  }
  received_.pop_front();
  machine().touch();
}

void OtgFsModel::pop_status() {
  machine().touch();
  if (received_.empty()) {
    violate("GRXSTSP read while RXFLVL is 0");
    return;
  }
  if (!received_.front().status) {
    violate("GRXSTSP read while data of the last packet is still in the FIFO");
    while (!received_.empty() && !received_.front().status) received_.pop_front();
    return;
  }
  const std::uint32_t word = received_.front().word;
  received_.pop_front();
  const std::uint32_t what = (word & kGrxstsPktsts) >> kGrxstsPktstsShift;
  const unsigned endpoint = word & kGrxstsEpnum;
  if (what == kPacketGlobalOutNak) {
    set(kDctl, kDctlGonsts);
    set(kGintsts, kGintGonakeff);
  } else if (what == kPacketOutDone || what == kPacketSetupDone) {
    clear(doepctl(endpoint), kEpctlEpena);
    set(doepint(endpoint), what == kPacketOutDone ? kDoepXfrc : kDoepStup);
  }
}

bool OtgFsModel::may_write(std::uint32_t offset, std::uint32_t raw) {
  if (!awake(offset, "write")) return false;
  if (offset == kGrxfsiz && !received_.empty()) violate("GRXFSIZ written while the FIFO has data");
  for (unsigned e = 0; e < endpoints_; ++e) {
    if (offset == dieptxf(e) && !in_[e].fifo.empty()) {
      violate("DIEPTXF" + std::to_string(e) + " written while the FIFO has data");
    }
  }
  return may_write_endpoint(offset, raw);
}

void OtgFsModel::on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t old) {
  for (unsigned e = 0; e < endpoints_; ++e) {
    if (offset == diepctl(e)) in_written(e, raw, old);
    if (offset == doepctl(e)) out_written(e, raw, old);
    if (offset == kFolded + 4 * e) push(e, raw);
  }
  if (offset == kGrstctl) reset_written(raw, old);
  if (offset == kDcfg) take_address();
  if (offset == kDctl) device_control_written(raw, old);
  if (offset == kGccfg && (raw & ~old & kGccfgPwrdwn) != 0) check_clocks();
  if (offset == kPcgcctl) power_written();
  if (offset == kGusbcfg) {
    if (has(kGusbcfg, kGusbcfgFhmod)) violate("only the device's side is modelled");
    const bool forced = has(kGusbcfg, kGusbcfgFdmod) && (old & kGusbcfgFdmod) == 0;
    if (forced) device_from_ = machine().now() + ms(kForceModeTime_ms);
  }
  if (!pulled_up()) enumerated_ = false;
  refresh();
}

}  // namespace verp::hal::stm32::model
