#include "firmware/app/controller_objects.hpp"

namespace verp::app {

canopen::Abort ControllerObjects::find(canopen::Address at, canopen::Entry& entry) {
  if (is_image(at.index)) return find_image(at, entry);
  Place place;
  const canopen::Abort refused = look(at, place);
  if (refused == canopen::Abort::kNone) {
    entry = {true, place.writable, place.bytes, place.bytes, place.bytes};
  }
  return refused;
}

canopen::Abort ControllerObjects::read(canopen::Address at, std::uint32_t offset,
                                       std::uint8_t* buffer, std::uint32_t size) {
  if (is_image(at.index)) {
    store_.read(kind_of(at.index), offset, buffer, size);
    return canopen::Abort::kNone;
  }
  Place place;
  const canopen::Abort refused = look(at, place);
  if (refused != canopen::Abort::kNone) return refused;
  if (place.is_count) {
    buffer[0] = place.count;
    return canopen::Abort::kNone;
  }
  const std::uint8_t* bytes = registers_.read(place.address, place.bytes);
  if (bytes == nullptr) return canopen::Abort::kNoObject;
  __builtin_memcpy(buffer, bytes + offset, size);
  return canopen::Abort::kNone;
}

canopen::Abort ControllerObjects::write(canopen::Address at, const std::uint8_t* data,
                                        std::uint32_t size) {
  if (is_image(at.index)) {
    const canopen::Abort refused = write_part(at, 0, data, size);
    return refused == canopen::Abort::kNone ? write_done(at, size) : refused;
  }
  Place place;
  const canopen::Abort refused = look(at, place);
  if (refused != canopen::Abort::kNone) return refused;
  return abort_for(registers_.write(place.address, data, size), place);
}

canopen::Abort ControllerObjects::write_part(canopen::Address at, std::uint32_t offset,
                                             const std::uint8_t* data, std::uint32_t size) {
  if (registers_.armed()) return canopen::Abort::kDeviceState;
  if (offset == 0) {
    store_.begin(kind_of(at.index));
    registers_.show_window(table::WindowState::kIdle);
    crc_ = 0;
  }
  const Taken taken = store_.write(kind_of(at.index), offset, data, size);
  if (taken == Taken::kNotYet) return canopen::Abort::kDeviceState;
  if (taken == Taken::kNo) {
    registers_.show_window(table::WindowState::kRefused, kBlockNotKept);
    return canopen::Abort::kHardware;
  }
  crc_ = crc32(data, size, crc_);
  return canopen::Abort::kNone;
}

canopen::Abort ControllerObjects::write_done(canopen::Address at, std::uint32_t) {
  if (registers_.armed()) return canopen::Abort::kDeviceState;
  return registers_.commit(kind_of(at.index), crc_) ? canopen::Abort::kNone
                                                    : canopen::Abort::kIncompatibleParameter;
}

canopen::Abort ControllerObjects::mappable(canopen::Address at, std::uint8_t bits, bool receive) {
  Place place;
  const canopen::Abort refused = look(at, place);
  if (refused != canopen::Abort::kNone) return refused;
  const bool fits = place.bytes <= kMaxCanData && bits == 8 * place.bytes;
  const bool obeyed = place.writable && registers_.obeys(place.address);
  if (place.is_count || !fits || (receive && !obeyed)) {
    return canopen::Abort::kNotMappable;
  }
  return canopen::Abort::kNone;
}

std::uint64_t ControllerObjects::get(canopen::Address at, std::uint8_t bits) {
  std::uint8_t bytes[8] = {};
  read(at, 0, bytes, bits / 8u);
  return canopen::get_le(bytes, bits / 8u);
}

void ControllerObjects::put(canopen::Address at, std::uint8_t bits, std::uint64_t value) {
  std::uint8_t bytes[8];
  canopen::put_le(bytes, value, bits / 8u);
  write(at, bytes, bits / 8u);
}

bool ControllerObjects::is_image(std::uint16_t index) {
  return index > kImageIndex && index <= kImageIndex + static_cast<int>(ImageKind::kTicks);
}

ImageKind ControllerObjects::kind_of(std::uint16_t index) {
  return static_cast<ImageKind>(index - kImageIndex);
}

canopen::Abort ControllerObjects::find_image(canopen::Address at, canopen::Entry& entry) const {
  if (at.subindex != 0) return canopen::Abort::kNoSubindex;
  const ImageKind kind = kind_of(at.index);
  const auto size = static_cast<std::uint32_t>(store_.size(kind));
  const auto room = static_cast<std::uint32_t>(store_.room(kind));
  if (size == 0 && room == 0) return canopen::Abort::kNoData;  // not kept here, or not now
  entry = {size > 0, room > 0, size, kind == ImageKind::kActions ? 1 : room, room};
  return canopen::Abort::kNone;
}

canopen::Abort ControllerObjects::look(canopen::Address at, Place& place) {
  if (at.index < kFirst || at.index - kFirst >= table::kTableBytes) {
    return canopen::Abort::kNoObject;
  }
  const auto address = static_cast<std::uint16_t>(at.index - kFirst);
  const table::Rule* rule = table::rule_at(address);
  if (rule == nullptr || rule->address != address) return canopen::Abort::kNoObject;
  place.writable = rule->access != table::Access::kRead;
  place.only_disarmed = rule->access == table::Access::kDisarmed;
  place.address = address;
  place.bytes = rule->size;
  if (rule->count == 1 || rule->is_text) {
    place.bytes = static_cast<std::uint8_t>(rule->size * rule->count);
    return at.subindex == 0 ? canopen::Abort::kNone : canopen::Abort::kNoSubindex;
  }
  place.count = static_cast<std::uint8_t>(rule->count);
  if (at.subindex > place.count) return canopen::Abort::kNoSubindex;
  if (at.subindex == 0) {
    place.is_count = true;
    place.writable = false;
    place.bytes = 1;
  } else {
    place.address = static_cast<std::uint16_t>(address + (at.subindex - 1) * rule->size);
  }
  return canopen::Abort::kNone;
}

canopen::Abort ControllerObjects::abort_for(dxl::Error error, const Place& place) const {
  switch (error) {
    case dxl::Error::kNone:
      return canopen::Abort::kNone;
    case dxl::Error::kDataRange:
      return canopen::Abort::kValueRange;
    case dxl::Error::kDataLimit:
      return canopen::Abort::kValueTooHigh;
    case dxl::Error::kDataLength:
      return canopen::Abort::kLength;
    case dxl::Error::kAccess:
      if (!registers_.obeys(place.address)) return canopen::Abort::kLocalControl;
      return place.only_disarmed ? canopen::Abort::kDeviceState : canopen::Abort::kReadOnly;
    case dxl::Error::kResultFail:
      return canopen::Abort::kDeviceState;
    default:
      return canopen::Abort::kGeneral;
  }
}

}  // namespace verp::app
