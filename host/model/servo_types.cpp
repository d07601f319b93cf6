#include "host/model/servo_types.hpp"

#include <cmath>
#include <numbers>

#include "host/model/entity.hpp"

namespace verp::model {

const std::vector<ServoType>& servo_types() {
  constexpr auto kSerial = BusProtocol::kDynamixel2;
  constexpr auto kCan = BusProtocol::kCia402;
  // e-Manual pages x/xm430-w210, x/xm430-w350 and mx/mx-28-2, "Specifications" at 12.0 V and
  // "Control Table". The CiA 402 drive is the twin's own (host/can): motor, gears and housing of
  // the XM430-W210 behind a 14-bit encoder, as magnetic encoders in joint drives have (ams
  // AS5048A), so that the same stiffness takes a quarter of the P gain. Its product code is the
  // profile's number.
  static const std::vector<ServoType> kTypes = {
      {"xm430_w210", "XM430-W210-R", kSerial, 1030, 3.0, 77, 2.3, 4096, 0.082, true, 800},
      {"xm430_w350", "XM430-W350-R", kSerial, 1020, 4.1, 46, 2.3, 4096, 0.082, true, 800},
      {"mx28", "MX-28(2.0)", kSerial, 30, 2.5, 55, 1.4, 4096, 0.077, false, 850},
      {"cia402_w210", "CiA 402 drive with the XM430-W210's motor", kCan, 402, 3.0, 77, 2.3, 16384,
       0.082, false, 200},
  };
  return kTypes;
}

const ServoType* find_servo_type(std::string_view name) {
  for (const ServoType& type : servo_types()) {
    if (name == type.name) return &type;
  }
  return nullptr;
}

const char* protocol_name(BusProtocol protocol) {
  return protocol == BusProtocol::kCia402 ? "cia402" : "dynamixel2";
}

const std::vector<ImuType>& imu_types() {
  constexpr double kDegree = std::numbers::pi / 180;
  constexpr double kG = 9.80665;
  // TDK InvenSense ICM-20648 datasheet DS-000179: +-2000 dps at 16.4 LSB/dps, +-4 g at 8192 LSB/g;
  // noise densities 0.015 dps/sqrt(Hz) and 190 ug/sqrt(Hz), over the noise bandwidth of the 24 Hz
  // filters (DLPF 4: about 36 Hz; host/sim/sensors.hpp says why). Its zero-rate output (5 dps) and
  // zero-g offset (25 mg) are calibrated in the factory and at rest; what remains, 0.1 dps and 5
  // mg, is our assumption: a few times the noise of a one-second mean, and temperature drift.
  static const double kBandwidth = std::sqrt(36.0);
  static const std::vector<ImuType> kTypes = {
      {"icm20648", kDegree / 16.4, kG / 8192, 0.015 * kDegree * kBandwidth, 0.1 * kDegree,
       190e-6 * kG * kBandwidth, 5e-3 * kG},
  };
  return kTypes;
}

const ImuType* find_imu_type(std::string_view name) {
  for (const ImuType& type : imu_types()) {
    if (name == type.name) return &type;
  }
  return nullptr;
}

}  // namespace verp::model
