#pragma once
#include <cstddef>
#include <cstdint>

#include "common/protocol/canopen/emcy.hpp"
#include "common/protocol/canopen/nmt.hpp"
#include "common/protocol/canopen/pdo_record.hpp"
#include "common/protocol/canopen/sync.hpp"

/// A device's objects 1000h to 1FFFh (CiA 301).
namespace verp::canopen {

/// The text must outlive it.
struct Identity {
  std::uint32_t device_type = 0;  ///< 1000h: 00020192h is a CiA 402 servo drive
  const char* name = "";          ///< 1008h
  std::uint32_t vendor = 0;       ///< 1018h: vendor, product, revision, serial number
  std::uint32_t product = 0;
  std::uint32_t revision = 0;
  std::uint32_t serial = 0;
};

/// Lets PDOs map an application's objects:
///  - mappable(at, bits, receive): kNone if an RPDO (TPDO) may map it.
///  - get(at, bits), put(at, bits, value): its low bits.
template <class A>
concept Application = Dictionary<A> &&
    requires(A& application, Address at, std::uint8_t bits, std::uint64_t value) {
  { application.mappable(at, bits, true) } -> std::same_as<Abort>;
  { application.get(at, bits) } -> std::same_as<std::uint64_t>;
  { application.put(at, bits, value) } -> std::same_as<void>;
};

struct DeviceSize {
  std::size_t rpdos = 1;
  std::size_t tpdos = 1;
  std::size_t entries = 8;       ///< of a mapping; 8: classic frames
  std::size_t watched = 1;       ///< nodes, 1016h
  bool beats = true;             ///< false: another sender beats for it, and 1017h is read-only
  bool falls_back = true;        ///< 1029h; false: stays operational after errors
  bool stores = false;           ///< 1010h, 1011h
  std::size_t further_sdos = 0;  ///< 1201h and on
};
inline constexpr std::size_t kErrorHistory = 4;

/// Orders by 1010h:1 and 1011h:1. Defaults take effect at the next reset.
enum class StoreOrder : std::uint8_t { kNone, kStore, kRestore };
inline constexpr std::uint32_t kSaveSignature = 0x65766173;  ///< "save"
inline constexpr std::uint32_t kLoadSignature = 0x64616F6C;  ///< "load"

template <Application A, DeviceSize kSize>
class CommunicationObjects {
 public:
  using Record = PdoRecord<kSize.entries>;

  CommunicationObjects(A& application, const Identity& identity, std::uint8_t node)
      : producer(node), application_(application), identity_(identity), node_(node) {
    for (std::size_t i = 0; i < kSize.rpdos; ++i) {
      rpdos[i] = off(Direction::kReceive, i, rpdo_id(static_cast<unsigned>(i + 1), node));
    }
    for (std::size_t i = 0; i < kSize.tpdos; ++i) {
      tpdos[i] = off(Direction::kTransmit, i, tpdo_id(static_cast<unsigned>(i + 1), node));
    }
  }

  Abort find(Address at, Entry& entry) {
    if (!mine(at)) return application_.find(at, entry);
    if (at == kName) {
      const std::uint32_t size = text_size();
      entry = {true, false, size, size, size};
      return Abort::kNone;
    }
    Number number;
    const Abort refused = look(at, number);
    if (refused == Abort::kNone || refused == Abort::kNoData) {
      entry = {true, number.writable, number.bytes, number.bytes, number.bytes};
      return Abort::kNone;
    }
    return refused;
  }
  Abort read(Address at, std::uint32_t offset, std::uint8_t* buffer, std::uint32_t size) {
    if (!mine(at)) return application_.read(at, offset, buffer, size);
    if (at == kName) {
      for (std::uint32_t i = 0; i < size; ++i) {
        buffer[i] = static_cast<std::uint8_t>(identity_.name[offset + i]);
      }
      return Abort::kNone;
    }
    Number number;
    const Abort refused = look(at, number);
    if (refused == Abort::kNone) put_le(buffer, number.value, size);
    return refused;
  }
  Abort write(Address at, const std::uint8_t* data, std::uint32_t size) {
    if (!mine(at)) return application_.write(at, data, size);
    const auto value = static_cast<std::uint32_t>(get_le(data, size));
    if (at.index == 0x1003) return history.write(at.subindex, value);
    if (at.index == 0x1016) return consumer.write(at.subindex, value);
    if (at.index == 0x1017) {
      producer.set_period_ms(static_cast<std::uint16_t>(value));
      return Abort::kNone;
    }
    if (at.index == kStore || at.index == kRestore) {
      const bool stores = at.index == kStore;
      if (value != (stores ? kSaveSignature : kLoadSignature)) return Abort::kCannotStore;
      order_ = stores ? StoreOrder::kStore : StoreOrder::kRestore;
      return Abort::kNone;
    }
    if (at.index == kErrorBehaviour) {
      if (value > static_cast<std::uint8_t>(ErrorBehaviour::kStop)) return Abort::kValueRange;
      error_behaviour = static_cast<ErrorBehaviour>(value);
      return Abort::kNone;
    }
    if (at.index == 0x1019) {
      const Abort refused = check_sync_overflow(static_cast<std::uint8_t>(value));
      if (refused == Abort::kNone) sync_overflow = static_cast<std::uint8_t>(value);
      return refused;
    }
    return write_pdo(at, value);
  }
  Abort write_part(Address at, std::uint32_t offset, const std::uint8_t* data,
                   std::uint32_t size) requires StreamingDictionary<A> {
    return application_.write_part(at, offset, data, size);
  }
  Abort write_done(Address at, std::uint32_t size) requires StreamingDictionary<A> {
    return application_.write_done(at, size);
  }

  StoreOrder take_store_order() {
    const StoreOrder order = order_;
    order_ = StoreOrder::kNone;
    return order;
  }
  /// Restores from `stored` what 1010h stores.
  void restore(const CommunicationObjects& stored) {
    for (std::size_t i = 0; i < kSize.rpdos; ++i) rpdos[i] = stored.rpdos[i];
    for (std::size_t i = 0; i < kSize.tpdos; ++i) tpdos[i] = stored.tpdos[i];
    producer.set_period_ms(stored.producer.period_ms());
    for (std::uint8_t i = 1; i <= kSize.watched; ++i) consumer.write(i, stored.consumer.value(i));
    sync_overflow = stored.sync_overflow;
    error_behaviour = stored.error_behaviour;
  }

  // The application sets defaults before a start; then the bus changes them.
  Record rpdos[kSize.rpdos];
  Record tpdos[kSize.tpdos];
  HeartbeatProducer producer;
  HeartbeatConsumer<kSize.watched> consumer;
  ErrorHistory<kErrorHistory> history;
  std::uint8_t error_register = 0;
  std::uint8_t sync_overflow = 0;
  ErrorBehaviour error_behaviour = ErrorBehaviour::kPreOperational;

 private:
  /// Off until configured; the first four have predefined identifiers.
  static Record off(Direction direction, std::size_t number, std::uint16_t id) {
    return {direction, number < kPdosOfSet ? id | kPdoInvalid : kPdoInvalid, kEventProfile, {}};
  }
  static constexpr Address kName{0x1008, 0};
  static constexpr std::uint16_t kStore = 0x1010, kRestore = 0x1011, kErrorBehaviour = 0x1029;
  struct Number {
    std::uint8_t bytes = 0;
    bool writable = false;
    std::uint32_t value = 0;
  };
  static bool mine(Address at) { return at.index >= 0x1000 && at.index <= 0x1FFF; }
  std::uint32_t text_size() const {
    std::uint32_t size = 0;
    while (identity_.name[size] != 0) ++size;
    return size;
  }

  Abort look(Address at, Number& number) const {
    switch (at.index) {
      case 0x1003:
        number = {static_cast<std::uint8_t>(at.subindex == 0 ? 1 : 4), at.subindex == 0, 0};
        return history.read(at.subindex, number.value);
      case kStore:
      case kRestore:
        if (!kSize.stores) return Abort::kNoObject;
        if (at.subindex > 1) return Abort::kNoSubindex;
        number = {static_cast<std::uint8_t>(at.subindex == 0 ? 1 : 4), at.subindex == 1, 1};
        return Abort::kNone;
      case 0x1016:
        number = {4, true, 0};
        if (at.subindex == 0) number = {1, false, kSize.watched};
        if (at.subindex > kSize.watched) return Abort::kNoSubindex;
        if (at.subindex != 0) number.value = consumer.value(at.subindex);
        return Abort::kNone;
      case 0x1018:
        return look_identity(at.subindex, number);
      case kErrorBehaviour:
        if (!kSize.falls_back) return Abort::kNoObject;
        if (at.subindex > 1) return Abort::kNoSubindex;
        number = {1, at.subindex == 1, 1};
        if (at.subindex == 1) number.value = static_cast<std::uint8_t>(error_behaviour);
        return Abort::kNone;
      default:
        break;
    }
    if (at.index >= 0x1400) return look_pdo(at, number);
    if (at.index >= 0x1200) return look_sdo(at, number);
    return look_single(at, number);
  }
  Abort look_single(Address at, Number& number) const {
    switch (at.index) {
      case 0x1000:
        number = {4, false, identity_.device_type};
        break;
      case 0x1001:
        number = {1, false, error_register};
        break;
      case 0x1005:
        number = {4, false, kSyncId};
        break;
      case 0x1014:
        number = {4, false, emcy_id(node_)};
        break;
      case 0x1017:
        number = {2, kSize.beats, producer.period_ms()};
        break;
      case 0x1019:
        number = {1, true, sync_overflow};
        break;
      default:
        return at.index == kName.index ? Abort::kNoSubindex : Abort::kNoObject;
    }
    return at.subindex == 0 ? Abort::kNone : Abort::kNoSubindex;
  }
  Abort look_identity(std::uint8_t subindex, Number& number) const {
    const std::uint32_t values[] = {4, identity_.vendor, identity_.product, identity_.revision,
                                    identity_.serial};
    if (subindex > 4) return Abort::kNoSubindex;
    number = {static_cast<std::uint8_t>(subindex == 0 ? 1 : 4), false, values[subindex]};
    return Abort::kNone;
  }

  Abort look_sdo(Address at, Number& number) const {
    const unsigned channel = at.index - 0x1200u;
    if (kSize.further_sdos == 0 || channel > kSize.further_sdos) return Abort::kNoObject;
    const SdoChannel ids = channel == 0 ? default_sdo(node_) : further_sdo(channel);
    const std::uint32_t values[] = {2, ids.request, ids.response};
    if (at.subindex > 2) return Abort::kNoSubindex;
    number = {static_cast<std::uint8_t>(at.subindex == 0 ? 1 : 4), false, values[at.subindex]};
    return Abort::kNone;
  }
  /// Null: none. 200h indices each: RPDO communication, mapping, TPDO communication, mapping.
  const Record* record(std::uint16_t index) const {
    if (index < 0x1400 || index >= 0x1C00) return nullptr;
    const std::size_t number = index & 0x1FFu;
    const bool receive = index < 0x1800;
    if (number >= (receive ? kSize.rpdos : kSize.tpdos)) return nullptr;
    return receive ? &rpdos[number] : &tpdos[number];
  }
  static bool is_mapping(std::uint16_t index) { return ((index - 0x1400) / 0x200) % 2 == 1; }
  Abort look_pdo(Address at, Number& number) const {
    const Record* found = record(at.index);
    if (found == nullptr) return Abort::kNoObject;
    if (is_mapping(at.index)) {
      number = {static_cast<std::uint8_t>(at.subindex == 0 ? 1 : 4), true, 0};
      return found->read_mapping(at.subindex, number.value);
    }
    constexpr std::uint8_t kBytes[] = {1, 4, 1, 2, 0, 2, 1};
    if (at.subindex >= sizeof kBytes) return Abort::kNoSubindex;
    number = {kBytes[at.subindex], at.subindex != 0, 0};
    return found->read_communication(at.subindex, number.value);
  }
  Abort write_pdo(Address at, std::uint32_t value) {
    auto* found = const_cast<Record*>(record(at.index));
    if (found == nullptr) return Abort::kNoObject;
    if (!is_mapping(at.index)) return found->write_communication(at.subindex, value);
    const bool receive = at.index < 0x1800;
    return found->write_mapping(at.subindex, value, [&](Address object, std::uint8_t bits) {
      return application_.mappable(object, bits, receive);
    });
  }

  A& application_;
  Identity identity_;
  std::uint8_t node_;
  StoreOrder order_ = StoreOrder::kNone;
};

}  // namespace verp::canopen
