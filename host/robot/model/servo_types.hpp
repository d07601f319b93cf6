#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host/robot/model/entity.hpp"

namespace verp::model {

/// Named by <verp:servo type="...">. For the twin, Params and `verp check`. A robot's own file may
/// add types (<verp:servo_type>, servo_type_facts.hpp).
struct ServoType {
  std::string name;   ///< as in <verp:servo type="...">
  std::string title;  ///< the maker's name
  BusProtocol protocol = BusProtocol::kDynamixel2;
  std::uint16_t model_number = 0;  ///< control table address 0; CiA 402 product code
  double stall_torque_n_m = 0;     ///< of the motor's line, nominal_v, without friction
  double peak_torque_n_m = 0;      ///< as in Servo
  double no_load_rev_min = 0;
  double stall_current_a = 0;
  double nominal_v = 12;
  double counts_per_rev = 4096;
  double encoder_noise_deg = 0.03;
  double loop_us = 1000, loop_delay_us = 0, goal_delay_us = 0;
  bool fast_sync_read = false;         ///< answers instruction 0x8A
  std::uint16_t default_p_gain = 800;  ///< control table units; drive: 2002h:1
  std::uint16_t default_d_gain = 0;
  double p_gain_unit = 128;  ///< as in Servo
  int most_gain = 16383;
  double gear_ratio = 1;
  Gearbox gearbox;
  /// Housing of an XM430: 82 g (e-Manual) of mostly aluminium, 0.9 kJ/(kg K); 77 cm2 of surface
  /// (28.5 x 46.5 x 34 mm) in still air at 10 W/(m2 K). An estimate: it sets only how fast a servo
  /// warms.
  double heat_capacity_j_k = 74, heat_resistance_k_w = 13;
  double armature_band = 0, friction_band = 0;  ///< as in Servo
  std::string source, estimated, unread;        ///< as in Servo
};

template <class Type>
std::string names_of(const std::vector<Type>& types) {
  std::string list;
  for (const Type& type : types) list += (list.empty() ? "" : ", ") + std::string(type.name);
  return list;
}

const std::vector<ServoType>& servo_types();
/// nullptr: no such type.
const ServoType* find_servo_type(const std::vector<ServoType>& types, std::string_view name);

/// Register scales and noise, from the datasheet.
struct ImuType {
  const char* name;
  double gyro_rad_s_per_count;
  double accel_m_s2_per_count;
  double gyro_noise_rad_s_rthz;  ///< density, one-sided: rad/s/sqrt(Hz)
  double gyro_bias_rad_s;        ///< 1-sigma, remaining after calibration
  double accel_noise_m_s2_rthz;
  double accel_bias_m_s2;
};

const ImuType* find_imu_type(std::string_view name);
const std::vector<ImuType>& imu_types();

}  // namespace verp::model
