#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/model/params.hpp"

namespace verp::model {

/// One row per servo type at 12 V, from its page of the ROBOTIS e-Manual
/// (emanual.robotis.com/docs/en/dxl/...), or of a drive with such a motor. The twin's DC motor,
/// Params and `verp check` all use these; a robot's file only names the type.
struct ServoType {
  const char* name;  ///< as in <verp:servo type="...">
  const char* title;
  BusProtocol protocol;        ///< what it speaks
  std::uint16_t model_number;  ///< control table address 0; product code of a CiA 402 drive
  double stall_torque_n_m;
  double no_load_rev_min;
  double stall_current_a;
  double counts_per_rev;
  double mass_kg;
  bool fast_sync_read;           ///< answers instruction 0x8A
  std::uint16_t default_p_gain;  ///< control table units, or a drive's 2002h:1
};

/// Of rows as these, for a person to choose from.
template <class Type>
std::string names_of(const std::vector<Type>& types) {
  std::string list;
  for (const Type& type : types) list += (list.empty() ? "" : ", ") + std::string(type.name);
  return list;
}

/// nullptr when there is no such type.
const ServoType* find_servo_type(std::string_view name);
const std::vector<ServoType>& servo_types();

/// One row per IMU type: scales of its registers and noise, from the datasheet.
struct ImuType {
  const char* name;
  double gyro_rad_s_per_count;
  double accel_m_s2_per_count;
  double gyro_noise_rad_s;  ///< 1-sigma per sample
  double gyro_bias_rad_s;   ///< 1-sigma, what remains after calibration
  double accel_noise_m_s2;
  double accel_bias_m_s2;
};

const ImuType* find_imu_type(std::string_view name);
const std::vector<ImuType>& imu_types();

}  // namespace verp::model
