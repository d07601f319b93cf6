#pragma once
#include <cstddef>
#include <cstdint>

#include "common/base/crc32.hpp"
#include "common/protocol/canopen/communication.hpp"
#include "common/protocol/canopen/dictionary.hpp"
#include "common/protocol/canopen/frame.hpp"
#include "common/protocol/canopen/published_tick.hpp"
#include "common/protocol/canopen/robot_plan.hpp"
#include "firmware/app/operator_registers.hpp"

namespace verp::app {

/// The controller as a CANopen node, without device profile and CiA vendor id. The binding sends
/// its heartbeat.
inline constexpr canopen::DeviceSize kControllerSize{
    .rpdos = 2,
    .tpdos = 4,
    .watched = 2,
    .beats = false,
    .falls_back = false,
    .further_sdos = canopen::plan::kControllerSdos};
constexpr canopen::Identity controller_identity() {
  return {.name = "VERP controller", .product = table::kModel, .revision = table::kTableVersion};
}

/// One DOMAIN for each ImageKind.
inline constexpr std::uint16_t kImageIndex = 0x5000;

consteval canopen::Address object(const char* name) {
  return {table::find(name)->object_index(), 0};
}
constexpr canopen::PdoMapping<> controller_tpdo(unsigned number) {
  namespace published = canopen::published;
  canopen::PdoMapping<> mapping;
  if (number == published::kDigestPdo) mapping.add({object("digest"), 64});
  if (number == published::kRecordPdo) {
    mapping.add({object("tick_low"), 16});
    mapping.add({object("joints_fresh"), 32});
    mapping.add({object("inputs_flags"), 16});
  }
  if (number == published::kPartPdo) mapping.add({object("inputs_part"), 64});
  return mapping;
}
template <class Objects>
void publish_ticks(Objects& objects, std::uint8_t node, bool on) {
  for (unsigned number = canopen::published::kDigestPdo; number <= canopen::published::kPartPdo;
       ++number) {
    const std::uint32_t off = on ? 0 : canopen::kPdoInvalid;
    objects.tpdos[number - 1] = {canopen::Direction::kTransmit,
                                 canopen::tpdo_id(number, node) | off, canopen::kEventProfile,
                                 controller_tpdo(number)};
  }
}

/// The controller's registers as objects of a CANopen node (canopen::Application). Index 2000h +
/// address; array elements have subindices from 1; a text is one object. The registers decide the
/// effect of a write.
///
/// 5001h is the Params image, 5002h the actions. A downloaded image takes effect at the next start.
/// It is refused while any servo holds torque; actions also while their memory is being prepared:
/// retry a little later. 5003h and 5004h are the last tick and earlier ones (tick_log.hpp),
/// readable while register tick_hold is 1. TPDOs 2 to 4 report each tick
/// (canopen/published_tick.hpp) after publish_ticks().
class ControllerObjects {
 public:
  ControllerObjects(OperatorRegisters& registers, Images& store)
      : registers_(registers), store_(store) {}

  canopen::Abort find(canopen::Address at, canopen::Entry& entry);
  canopen::Abort read(canopen::Address at, std::uint32_t offset, std::uint8_t* buffer,
                      std::uint32_t size);
  canopen::Abort write(canopen::Address at, const std::uint8_t* data, std::uint32_t size);
  canopen::Abort write_part(canopen::Address at, std::uint32_t offset, const std::uint8_t* data,
                            std::uint32_t size);
  canopen::Abort write_done(canopen::Address at, std::uint32_t);

  // PDOs carry whole numbers of up to 8 bytes.
  canopen::Abort mappable(canopen::Address at, std::uint8_t bits, bool receive);
  std::uint64_t get(canopen::Address at, std::uint8_t bits);
  /// A refused value changes nothing: a PDO has no answer.
  void put(canopen::Address at, std::uint8_t bits, std::uint64_t value);

 private:
  struct Place {
    std::uint16_t address = 0;
    std::uint8_t bytes = 0;
    std::uint8_t count = 0;
    bool is_count = false;  ///< subindex 0 of an array
    bool writable = false;
    bool only_disarmed = false;
  };

  static bool is_image(std::uint16_t index);
  static ImageKind kind_of(std::uint16_t index);
  canopen::Abort find_image(canopen::Address at, canopen::Entry& entry) const;
  static canopen::Abort look(canopen::Address at, Place& place);
  canopen::Abort abort_for(dxl::Error error, const Place& place) const;

  static constexpr std::uint16_t kFirst = 0x2000;

  OperatorRegisters& registers_;
  Images& store_;
  std::uint32_t crc_ = 0;
};

}  // namespace verp::app
