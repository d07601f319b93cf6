#include "tests/support/can/sja1000_model.hpp"
#include "tests/support/can/sja1000_table.hpp"

namespace verp::test {

using namespace hal::sja1000;

void Sja1000Model::violate(const char* what, std::uint32_t offset) {
  if (violations_++ == 0) first_violation_ = std::string(what) + " " + std::to_string(offset);
}

void Sja1000Model::advance(std::uint64_t microseconds) {
  for (std::uint64_t i = 0; i < microseconds; ++i) {
    wire.advance(1);
    if (off_ && !in_reset() && wire.now_us() >= recovers_us_) {
      off_ = false;
      errors_.clear();
      ir_ |= kIrWarning;
    }
  }
}

void Sja1000Model::doze_until(std::uint64_t us) {
  ++sleeps_;
  while (!interrupt() && wire.now_us() < us) advance(1);
}

std::uint8_t Sja1000Model::read8(std::uint32_t offset) {
  advance(kAccess_us);
  bool known = false;
  for (const Register& reg : kTable) known = known || (reg.offset == offset && reg.read);
  if (!known) violate("read of", offset);
  if (offset >= kBuffer && offset < kBuffer + 13) {
    if (in_reset()) return offset < kBuffer + 8 ? filter_[offset - kBuffer] : std::uint8_t{0};
    if (fifo_.empty()) violate("read of the empty receive buffer", offset);
    const std::size_t at = offset - kBuffer;
    return fifo_.empty() || at >= fifo_.front().size() ? std::uint8_t{0xA5} : fifo_.front()[at];
  }
  switch (offset) {
    case kMod:
      return mod_;
    case kSr:
      return static_cast<std::uint8_t>((fifo_.empty() ? 0 : kSrReceived) |
                                       (overrun_ ? kSrOverrun : 0) |
                                       (requested_ ? 0 : kSrBufferFree) |
                                       (complete_ ? kSrComplete : 0) | (off_ ? kSrBusOff : 0));
    case kIr: {
      const auto value =
          static_cast<std::uint8_t>((ir_ & ier_) | (fifo_.empty() ? 0 : ier_ & kIrReceive));
      ir_ = 0;
      return value;
    }
    case kIer:
      return ier_;
    case kCdr:
      return cdr_;
    case kBtr0:
    case kBtr1:
      return btr_[offset - kBtr0];
    case kEcc:
      ecc_read_ = true;
      return 0;
    case kRmc:
      return static_cast<std::uint8_t>(fifo_.size());
    default:
      return 0;
  }
}

void Sja1000Model::write8(std::uint32_t offset, std::uint8_t value) {
  advance(kAccess_us);
  const Register* rule = nullptr;
  for (const Register& reg : kTable) rule = reg.offset == offset ? &reg : rule;
  if (rule == nullptr || !(in_reset() ? rule->write_in_reset : rule->write)) {
    violate(in_reset() ? "write in reset mode of" : "write in operating mode of", offset);
    return;
  }
  if (offset >= kBuffer && offset < kBuffer + 13) {
    if (in_reset()) {
      filter_[offset - kBuffer] = value;
    } else if (requested_) {
      violate("write to the transmit buffer in use", offset);
    } else {
      buffer_[offset - kBuffer] = value;
    }
    return;
  }
  if (offset == kMod) mode(value);
  if (offset == kCmr) command(value);
  if (offset == kIer) ier_ = value;
  if (offset == kBtr0 || offset == kBtr1) btr_[offset - kBtr0] = value;
  if (offset == kOcr) ocr_ = value;
  if (offset == kCdr) cdr_ = value;
}

void Sja1000Model::mode(std::uint8_t value) {
  const bool was_reset = in_reset();
  mod_ = value;
  if (in_reset()) {
    requested_ = on_wire_ = abort_ = false;
    return;
  }
  if (!was_reset) return;
  if ((cdr_ & kCdrPeliCan) == 0) violate("left reset mode in BasicCAN mode", kMod);
  if (ocr_ == 0) violate("left reset mode with outputs off", kMod);
  if ((mod_ & kModSingleFilter) != 0) violate("single filter", kMod);
  for (int i = 4; i < 8; ++i) {
    if (filter_[i] != 0xFF) violate("a filter that is not open", kMask);
  }
  recovers_us_ = wire.now_us() + ErrorCounter::kRecovery_us;
}

void Sja1000Model::command(std::uint8_t value) {
  if (in_reset()) return;
  if ((value & kCmrTransmit) != 0) {
    if (requested_) violate("a second transmission request", kCmr);
    tx_ = frame_in_buffer();
    requested_ = true;
    abort_ = on_wire_ = complete_ = false;
  }
  if ((value & kCmrAbort) != 0 && requested_) {
    abort_ = true;
    if (!on_wire_) {
      requested_ = false;
      ir_ |= kIrTransmit;
    }
  }
  if ((value & kCmrRelease) != 0) {
    if (fifo_.empty()) {
      violate("release of an empty buffer", kCmr);
    } else {
      fifo_bytes_ -= fifo_.front().size();
      fifo_.pop_front();
    }
  }
  if ((value & kCmrClearOverrun) != 0) overrun_ = false;
}

void Sja1000Model::sent() {
  requested_ = on_wire_ = false;
  complete_ = true;
  errors_.good();
  ir_ |= kIrTransmit;
}

void Sja1000Model::failed() {
  on_wire_ = false;
  if (ecc_read_) ir_ |= kIrBusError;
  ecc_read_ = false;
  if (errors_.error()) {
    leave_bus();
  } else if (abort_) {
    requested_ = false;
    ir_ |= kIrTransmit;
  }
}

void Sja1000Model::leave_bus() {
  off_ = true;
  requested_ = on_wire_ = abort_ = false;
  mod_ |= kModReset;
  ir_ |= kIrWarning;
}

void Sja1000Model::heard(const CanFrame& frame) {
  if (in_reset() || off_) return;
  const Bytes bytes = bytes_of(frame);
  if (fifo_bytes_ + bytes.size() > kFifoBytes) {
    overrun_ = true;
    ir_ |= kIrOverrun;
    return;
  }
  fifo_bytes_ += bytes.size();
  fifo_.push_back(bytes);
}

CanFrame Sja1000Model::frame_in_buffer() const {
  CanFrame frame;
  frame.extended = (buffer_[0] & kFrameExtended) != 0;
  frame.remote = (buffer_[0] & kFrameRemote) != 0;
  frame.size = buffer_[0] & kFrameLength;
  if (frame.extended) {
    for (int i = 1; i <= 4; ++i) frame.id = frame.id << 8 | buffer_[i];
    frame.id >>= 3;
  } else {
    frame.id = (buffer_[1] * 256u + buffer_[2]) >> 5;
  }
  const unsigned data = frame.extended ? kLongHeaderBytes : kShortHeaderBytes;
  for (unsigned i = 0; i < frame.size && !frame.remote; ++i) frame.data[i] = buffer_[data + i];
  return frame;
}

Sja1000Model::Bytes Sja1000Model::bytes_of(const CanFrame& frame) {
  Bytes bytes = {static_cast<std::uint8_t>((frame.extended ? kFrameExtended : 0) |
                                           (frame.remote ? kFrameRemote : 0) | frame.size)};
  if (frame.extended) {
    for (int shift = 21; shift >= -3; shift -= 8) {
      bytes.push_back(static_cast<std::uint8_t>(shift < 0 ? frame.id << 3 : frame.id >> shift));
    }
  } else {
    bytes.push_back(static_cast<std::uint8_t>(frame.id >> 3));
    bytes.push_back(static_cast<std::uint8_t>(frame.id << 5));
  }
  for (unsigned i = 0; i < frame.size && !frame.remote; ++i) bytes.push_back(frame.data[i]);
  return bytes;
}

}  // namespace verp::test
