#pragma once
#include <cstdint>

#include "common/protocol/canopen/dictionary.hpp"
#include "host/sim/plant.hpp"

namespace verp::can {

/// The application of an IMU node: gyro 2010h:1 to 3, accelerometer 2011h:1 to 3, i16, IMU frame.
class ImuApplication {
 public:
  explicit ImuApplication(sim::Plant& plant) : plant_(plant) {}
  canopen::Abort find(canopen::Address at, canopen::Entry& entry) const;
  canopen::Abort read(canopen::Address at, std::uint32_t offset, std::uint8_t* buffer,
                      std::uint32_t size) const;
  canopen::Abort write(canopen::Address at, const std::uint8_t* data, std::uint32_t size) const;
  canopen::Abort mappable(canopen::Address at, std::uint8_t bits, bool receive) const;
  std::uint64_t get(canopen::Address at, std::uint8_t bits) const;
  void put(canopen::Address, std::uint8_t, std::uint64_t) const {}

 private:
  sim::Plant& plant_;
};

/// The application of a foot's node: four forces, 2020h:1 to 4, u16: front-left, front-right,
/// back-left, back-right.
class FootApplication {
 public:
  FootApplication(sim::Plant& plant, int foot) : plant_(plant), foot_(foot) {}
  canopen::Abort find(canopen::Address at, canopen::Entry& entry) const;
  canopen::Abort read(canopen::Address at, std::uint32_t offset, std::uint8_t* buffer,
                      std::uint32_t size) const;
  canopen::Abort write(canopen::Address at, const std::uint8_t* data, std::uint32_t size) const;
  canopen::Abort mappable(canopen::Address at, std::uint8_t bits, bool receive) const;
  std::uint64_t get(canopen::Address at, std::uint8_t bits) const;
  void put(canopen::Address, std::uint8_t, std::uint64_t) const {}

 private:
  sim::Plant& plant_;
  int foot_;
};

}  // namespace verp::can
