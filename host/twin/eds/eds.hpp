#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/protocol/canopen/communication.hpp"

namespace verp::eds {

/// Data type numbers of CiA 301.
enum class DataType : std::uint16_t {
  kInteger8 = 0x02,
  kInteger16 = 0x03,
  kInteger32 = 0x04,
  kUnsigned8 = 0x05,
  kUnsigned16 = 0x06,
  kUnsigned32 = 0x07,
  kReal32 = 0x08,
  kVisibleString = 0x09,
  kDomain = 0x0F,
  kUnsigned64 = 0x1B,
};
DataType integer(unsigned bytes, bool is_signed);

struct Value {
  std::string name;
  DataType type = DataType::kUnsigned8;
  bool writable = false;
  bool mappable = false;
  bool commissioned = false;        ///< the sheet gives no value
  std::string initial = {};         ///< "", "0x20", "$NODEID+0x180"
  std::string low = {}, high = {};  ///< limits for writing; empty: the type's
};

/// A single value is at subindex 0; members start at 1, with their number at 0.
struct Object {
  std::uint16_t index = 0;
  std::string name;
  std::vector<Value> values = {};
  bool has_members = false;
  bool is_array = false;                      ///< members alike, else a record
  bool count_writable = false;                ///< subindex 0 of members
  std::size_t count_initial = 0;              ///< its initial value
  std::vector<std::uint8_t> subindices = {};  ///< empty: 1 to n
};

struct Description {
  std::string file;
  std::string text;
  canopen::Identity identity{};
  canopen::DeviceSize size{};
  bool is_master = false;       ///< obeys no NMT command
  std::vector<Object> objects;  ///< rising index
};

/// The same description gives the same bytes.
std::string to_text(const Description& description);

/// The objects 1000h to 1FFFh of a canopen::Device of this size.
std::vector<Object> communication_objects(const canopen::DeviceSize& size,
                                          const canopen::Identity& identity);

/// The robot's controller (firmware/app/controller_objects.hpp).
Description controller();

/// The twin's devices (host/twin/can/device_node.hpp): a drive of the ready robots, IMU, foot.
Description drive();
Description imu();
Description foot();

struct Sheet {
  const char* node;
  Description (*describe)();
  const char* shipped;  ///< path in the repository
};
std::span<const Sheet> sheets();

constexpr bool is_manufacturers(std::uint16_t index) {
  return index >= 0x2000 && index <= 0x5FFF;
}

struct Entry {
  canopen::Address at;
  Value value;
};

/// Entries of our sheets for this node; empty without a sheet. CiA 402 drives of other vendors: the
/// profile's entries.
std::vector<Entry> known_entries(const canopen::Identity& node);

}  // namespace verp::eds
