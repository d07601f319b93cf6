#include "tests/support/can/zynqmp_can_model.hpp"
#include "tests/support/can/zynqmp_can_table.hpp"

namespace verp::test {

using namespace hal::zynqmp_can;

namespace {
constexpr std::uint32_t kExtendedFlag = 0x80000000u, kRemoteFlag = 0x40000000u;  // linux/can.h
}  // namespace

void ZynqmpCanRegisters::violate(const char* what, std::uint32_t offset) {
  if (violations_++ == 0) first_violation_ = std::string(what) + " " + std::to_string(offset);
}

std::uint32_t ZynqmpCanRegisters::read32(std::uint32_t offset) {
  advance(kAccess_us);
  bool known = false;
  for (const Register& reg : kTable) known = known || (reg.offset == offset && reg.readable != 0);
  if (!known) violate("read of", offset);
  switch (offset) {
    case kSrr:
      return srr_;
    case kBrpr:
      return brpr_;
    case kBtr:
      return btr_;
    case kEsr:
      return esr_;
    case kSr:
      return joined() ? kSrNormal | (off_ ? kSrBusOff : 0) : kSrConfig;
    case kIsr:
      return isr_ | (rx_.empty() ? 0 : kIsrNotEmpty);
    case kIer:
      return ier_;
    case kRxId:
    case kRxDlc:
    case kRxData1:
    case kRxData2: {
      if (rx_.empty()) violate("read of the empty receive FIFO", offset);
      const std::uint32_t word = received_word(offset);
      if (offset == kRxData2 && !rx_.empty()) rx_.pop_front();
      return word;
    }
    default:
      return 0;
  }
}

void ZynqmpCanRegisters::write32(std::uint32_t offset, std::uint32_t value) {
  advance(kAccess_us);
  const Register* rule = nullptr;
  for (const Register& reg : kTable) rule = reg.offset == offset ? &reg : rule;
  if (rule == nullptr || (value & ~rule->writable) != 0) {
    violate("write of", offset);
    return;
  }
  if (rule->config_only && joined()) violate("write outside of configuration mode of", offset);
  if (offset == kSrr && (value & kSrrReset) != 0) return reset();
  if (offset == kSrr) srr_ = value;
  if (offset == kBrpr) brpr_ = value;
  if (offset == kBtr) btr_ = value;
  if (offset == kEsr) esr_ &= ~value;
  if (offset == kIer) ier_ = value;
  if (offset == kIcr) isr_ &= ~value;
  if (offset >= kTxId && offset <= kTxData2) out_[(offset - kTxId) / 4] = value;
  if (offset == kTxData2) queue_transmission();
}

void ZynqmpCanRegisters::reset() {
  srr_ = brpr_ = btr_ = isr_ = ier_ = esr_ = 0;
  tx_.clear();
  rx_.clear();
  off_ = false;
  errors_.clear();
}

void ZynqmpCanRegisters::queue_transmission() {
  if (!joined()) violate("a frame to send outside of normal mode", kTxData2);
  if (tx_.size() == kFifoFrames) return violate("a frame for the full transmit FIFO", kTxData2);
  tx_.push_back(from_words());
}

void ZynqmpCanRegisters::sent() {
  tx_.pop_front();
  errors_.good();
  isr_ |= kIsrSent;
}

void ZynqmpCanRegisters::failed() {
  isr_ |= kIsrError;
  esr_ |= 1;
  if (!errors_.error()) return;
  off_ = true;
  isr_ |= kIsrBusOff;
}

void ZynqmpCanRegisters::heard(const CanFrame& frame) {
  if (!joined() || off_) return;
  if (rx_.size() == kFifoFrames) {
    isr_ |= kIsrOverrun;
    return;
  }
  rx_.push_back(frame);
  isr_ |= kIsrReceived;
}

CanFrame ZynqmpCanRegisters::from_words() {
  CanFrame frame;
  const std::uint32_t id = out_[0];
  frame.extended = (id & (as_qemu_ ? kExtendedFlag : kIdExtended)) != 0;
  if (as_qemu_) {
    frame.remote = (id & kRemoteFlag) != 0;
    frame.id = id & 0x1FFFFFFFu;
  } else {
    frame.remote = (id & (frame.extended ? kIdRemoteExtended : kIdRemote)) != 0;
    frame.id = frame.extended ? (id >> 21) << 18 | (id >> 1 & 0x3FFFFu) : id >> 21;
    if (frame.extended && (id & kIdRemote) == 0) violate("an extended frame without SRR", kTxId);
  }
  frame.size = static_cast<std::uint8_t>(out_[1] >> kDlcShift);
  for (unsigned i = 0; i < frame.size && i < kMaxCanData; ++i) {
    const unsigned place = as_qemu_ ? i % 4 : 3 - i % 4;
    frame.data[i] = static_cast<std::uint8_t>(out_[2 + i / 4] >> (8 * place));
  }
  return frame;
}

std::uint32_t ZynqmpCanRegisters::received_word(std::uint32_t offset) const {
  if (rx_.empty()) return 0xDEADBEEFu;
  const CanFrame& frame = rx_.front();
  if (offset == kRxId) {
    if (!as_qemu_) return can_rank(frame);
    return frame.id | (frame.extended ? kExtendedFlag : 0) | (frame.remote ? kRemoteFlag : 0);
  }
  if (offset == kRxDlc) {  // and an unused time stamp
    return static_cast<std::uint32_t>(frame.size) << kDlcShift |
           static_cast<std::uint32_t>(wire.now_us() & 0xFFFF);
  }
  std::uint32_t word = 0;
  const unsigned first = offset == kRxData1 ? 0 : 4;
  for (unsigned i = first; i < first + 4 && i < frame.size; ++i) {
    const unsigned place = as_qemu_ ? i % 4 : 3 - i % 4;
    word |= static_cast<std::uint32_t>(frame.data[i]) << (8 * place);
  }
  return word;
}

}  // namespace verp::test
