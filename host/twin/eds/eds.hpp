#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/protocol/canopen/communication.hpp"

/// Electronic data sheets (EDS, CiA 306): what tools of other makers read to know a node's objects
/// before they have seen one.
namespace verp::eds {

/// Numbers of data types, as CiA 301 has them.
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
/// An integer's type by its size.
DataType integer(unsigned bytes, bool is_signed);

/// One value: an object, or a member of one.
struct Value {
  std::string name;
  DataType type = DataType::kUnsigned8;
  bool writable = false;
  bool mappable = false;
  bool commissioned = false;        ///< each node has its own there, which no sheet knows
  std::string initial = {};         ///< as EDS writes it: "", "0x20", "$NODEID+0x180"
  std::string low = {}, high = {};  ///< bounds of what may be written; empty: the type's
};

/// One index. One value without members stands at subindex 0; members stand from subindex 1 on, and
/// their number at 0.
struct Object {
  std::uint16_t index = 0;
  std::string name;
  std::vector<Value> values = {};
  bool has_members = false;
  bool is_array = false;                      ///< members alike, else a record
  bool count_writable = false;                ///< subindex 0 of members
  std::size_t count_initial = 0;              ///< what it is then
  std::vector<std::uint8_t> subindices = {};  ///< of the members, where they are not 1 to n
};

struct Description {
  std::string file;  ///< its own name
  std::string text;  ///< one line for a person
  canopen::Identity identity{};
  canopen::DeviceSize size{};
  bool is_master = false;       ///< starts the others, and obeys no NMT command
  std::vector<Object> objects;  ///< rising index
};

/// The file's text: the same description gives the same bytes.
std::string to_text(const Description& description);

/// The objects 1000h to 1FFFh that every canopen::Device of this size has.
std::vector<Object> communication_objects(const canopen::DeviceSize& size,
                                          const canopen::Identity& identity);

/// The robot's controller (firmware/app/controller_objects.hpp).
Description controller();

/// The twin's devices (host/twin/can/device_node.hpp): a drive of the ready robots, IMU, foot.
Description drive();
Description imu();
Description foot();

/// All of them, by the names that a person gives.
struct Sheet {
  const char* node;
  Description (*describe)();
  const char* shipped;  ///< where the file stands in the repository
};
std::span<const Sheet> sheets();

/// 2000h to 5FFFh: each manufacturer has its own objects there.
constexpr bool is_manufacturers(std::uint16_t index) {
  return index >= 0x2000 && index <= 0x5FFF;
}

/// One value where a client reaches it.
struct Entry {
  canopen::Address at;
  Value value;
};

/// What our sheets tell of a node that says this of itself; nothing if there is none for it. A CiA
/// 402 servo drive of another vendor or product has what the profiles define, not what we put in
/// the manufacturer's area.
std::vector<Entry> known_entries(const canopen::Identity& node);

}  // namespace verp::eds
