#pragma once
#include <cstdint>

#include "common/protocol/canopen/dictionary.hpp"
#include "host/twin/sim/plant.hpp"

namespace verp::can {

/// Arrays of 16-bit numbers that can be read and mapped.
class SensorApplication {
 public:
  canopen::Abort find(canopen::Address at, canopen::Entry& entry) const;
  canopen::Abort read(canopen::Address at, std::uint32_t offset, std::uint8_t* buffer,
                      std::uint32_t size) const;
  canopen::Abort write(canopen::Address at, const std::uint8_t* data, std::uint32_t size) const;
  canopen::Abort mappable(canopen::Address at, std::uint8_t bits, bool receive) const;
  std::uint64_t get(canopen::Address at, std::uint8_t bits) const;
  void put(canopen::Address, std::uint8_t, std::uint64_t) const {}

 protected:
  explicit SensorApplication(sim::Plant& plant) : plant_(plant) {}
  ~SensorApplication() = default;
  sim::Plant& plant_;

 private:
  /// Number of elements in an object; 0: no such object.
  virtual std::uint8_t count(std::uint16_t index) const = 0;
  virtual std::uint16_t number(std::uint16_t index, int i) const = 0;
};

/// IMU: gyro 2010h:1 to 3, accelerometer 2011h:1 to 3, i16, IMU frame.
class ImuApplication final : public SensorApplication {
 public:
  explicit ImuApplication(sim::Plant& plant) : SensorApplication(plant) {}

 private:
  std::uint8_t count(std::uint16_t index) const override;
  std::uint16_t number(std::uint16_t index, int i) const override;
};

/// Four forces, 2020h:1 to 4, u16: front-left, front-right, back-left, back-right.
class FootApplication final : public SensorApplication {
 public:
  FootApplication(sim::Plant& plant, int foot) : SensorApplication(plant), foot_(foot) {}

 private:
  std::uint8_t count(std::uint16_t index) const override;
  std::uint16_t number(std::uint16_t index, int i) const override;
  int foot_;
};

}  // namespace verp::can
