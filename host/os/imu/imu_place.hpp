#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace verp::imu {

enum class Chip : std::uint8_t { kBno055, kMpu6050, kIcm42688p };

/// Where an IMU of this PC is, as users write it:
///
///     i2c:/dev/i2c-1,bno055                 a chip on an I2C bus, at its usual address
///     i2c:/dev/i2c-1,bno055,address=0x29
///     serial:/dev/ttyUSB0,bno055            a BNO055 by its UART protocol
///     ...,mount=-y:x:z                      its x points to the robot's right (-y), its y ahead
///                                           (x), its z up; else as in the file
struct ImuPlace {
  bool serial = false;
  std::string device;
  Chip chip = Chip::kBno055;
  std::uint8_t address = 0;  ///< on I2C
  /// IMU to body, row-major; empty: as in the robot's file.
  std::optional<std::array<float, 9>> body_imu;
};

/// Throws link::EndpointError.
ImuPlace parse_imu(const std::string& text);

const char* name_of(Chip chip);

/// "bno055 on /dev/i2c-1, address 0x28".
std::string to_text(const ImuPlace& place);

}  // namespace verp::imu
