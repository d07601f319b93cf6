#pragma once
#include <cstddef>
#include <cstdint>

#include "common/protocol/controller_table.hpp"

namespace verp::app {

namespace table = dxl::controller;

/// Address of a register; a wrong name does not compile.
consteval std::uint16_t reg(const char* name) {
  return table::find(name)->address;
}
consteval std::uint16_t reg_end(const char* name) {
  return static_cast<std::uint16_t>(table::find(name)->address + table::find(name)->bytes());
}
constexpr std::uint16_t element(std::uint16_t array, int index, int size) {
  return static_cast<std::uint16_t>(array + index * size);
}

/// Bytes in wire order: little-endian, as every supported core is.
class RegisterImage {
 public:
  template <class Value>
  Value get(std::uint16_t address) const {
    Value value;
    __builtin_memcpy(&value, bytes_ + address, sizeof value);
    return value;
  }
  template <class Value>
  void set(std::uint16_t address, Value value) {
    __builtin_memcpy(bytes_ + address, &value, sizeof value);
  }
  template <class Value, std::size_t kCount>
  void set(std::uint16_t address, const Value (&values)[kCount]) {
    __builtin_memcpy(bytes_ + address, values, sizeof values);
  }
  std::uint8_t* at(std::uint16_t address) { return bytes_ + address; }
  const std::uint8_t* at(std::uint16_t address) const { return bytes_ + address; }

  static constexpr bool holds(std::uint16_t address, std::size_t size) {
    return size > 0 && address + size <= table::kTableBytes;
  }

 private:
  std::uint8_t bytes_[table::kTableBytes] = {};
};

}  // namespace verp::app
