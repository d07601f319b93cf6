#include "host/robot/model/servo_types.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "common/protocol/feetech_table.hpp"
#include "common/protocol/servo_models.hpp"
#include "host/robot/model/entity.hpp"

namespace verp::model {

namespace {

// All MX(2.0) and X-series servos. Encoder (e-Manual): ams AS5045, 0.03 degrees rms, 384 us delay
// in slow mode (data sheet); the XL and XC have an AS5601, taken as alike. The loop's rate is an
// estimate: gains are per millisecond.
ServoType dynamixel(const char* name, const char* title, std::uint16_t model_number) {
  ServoType type;
  type.name = name;
  type.title = title;
  type.model_number = model_number;
  const dxl::ServoModel& model = *dxl::find_servo_model(model_number);
  type.nominal_v = model.nominal_dv / 10.0;
  type.default_p_gain = model.position_p_gain;
  type.fast_sync_read = model.has(dxl::kFastSyncRead);
  type.loop_delay_us = 384;
  return type;
}

// The paper's table "identified parameters", seen from the joint.
ServoType identified(ServoType type, double gear_ratio, double kt_n_m_a, double resistance_ohm,
                     const Gearbox& gears) {
  type.gear_ratio = gear_ratio;
  type.stall_current_a = type.nominal_v / resistance_ohm;
  type.stall_torque_n_m = kt_n_m_a * type.stall_current_a;
  type.no_load_rev_min = type.nominal_v / kt_n_m_a * 60 / (2 * std::numbers::pi);
  type.gearbox = gears;
  type.source = "identified: Duclusaud and Passault, arXiv 2410.08650, M4";
  return type;
}

// No parameters of these motors are published. The motor's line is the data sheet's (e-Manual, at
// the nominal voltage), friction on top. For the identified MX-64 the sheet gives 6.0 N m and its
// line 6.3. Rotor and friction are means of the identified MX-64 and MX-106, as shares of what
// scales them:
//   rotor      0.95, 1.05 (XL-330: 1.10) e-5 kg m2 per N m of stall torque at the rotor, seen
//              through the gear ratio
//   f_base     0.98, 0 % of stall torque; f_strib 0.38, 0.93 %
//   l_base     0, 0.009; l_strib 0.234, 0.222: of the load, whatever the motor
//   f_visc     1.7, 2.4 % of the line's slope
// The band: half of each.
ServoType scaled(ServoType type, double gear_ratio, double stall_torque_n_m, double no_load_rev_min,
                 double stall_current_a) {
  type.gear_ratio = gear_ratio;
  type.stall_torque_n_m = stall_torque_n_m;
  type.no_load_rev_min = no_load_rev_min;
  type.stall_current_a = stall_current_a;
  const double slope = stall_torque_n_m / (no_load_rev_min * 2 * std::numbers::pi / 60);
  type.gearbox = {.armature_kg_m2 = 1.0e-5 * gear_ratio * stall_torque_n_m,
                  .f_base_n_m = 0.005 * stall_torque_n_m,
                  .f_strib_n_m = 0.0065 * stall_torque_n_m,
                  .l_base = 0.005,
                  .l_strib = 0.228,
                  .w_s_rad_s = 1.57,
                  .alpha = 1.33,
                  .f_visc_n_m_s = 0.02 * slope};
  type.armature_band = type.friction_band = 0.5;
  type.source = "scaled by stall torque and gear ratio from the identified MX-64 and MX-106";
  return type;
}

// The twin's drive (host/twin/can): an XM430-W210 with a 14-bit encoder (ams AS5048A, usual in
// joint drives). The same stiffness needs a quarter of the P gain.
ServoType drive_of(ServoType type) {
  type.name = "cia402_w210";
  type.title = "CiA 402 drive with the XM430-W210's motor";
  type.protocol = BusProtocol::kCia402;
  type.model_number = 402;
  type.counts_per_rev = 16384;
  type.default_p_gain = 200;
  type.fast_sync_read = false;
  return type;
}

// kt, R, rotor and friction: Rhoban/bam, params/feetech_sts3215_7_4V/m1.json (Coulomb and viscous
// friction only; commit 1b5a1ce). Encoder: taken as the Dynamixels'. The loop's rate is an
// estimate.
ServoType sts3215() {
  ServoType type;
  type.name = "sts3215";
  type.title = "Feetech STS3215, 7.4 V";
  type.protocol = BusProtocol::kFeetech;
  type.model_number = feetech::kModelSts3215;
  type.nominal_v = 7.4;
  type.counts_per_rev = feetech::kCountsPerTurn;
  type.default_p_gain = type.default_d_gain = 32;
  type.p_gain_unit = 1 / (885 * double{feetech::kDutyPerCount});
  type.most_gain = feetech::kMostGain;
  type.loop_delay_us = 384;
  type = identified(std::move(type), 345, 1.2116, 2.6762,
                    {.armature_kg_m2 = 0.0284, .f_base_n_m = 0.05239, .f_visc_n_m_s = 0.05909});
  type.source = "identified: Rhoban/bam, STS3215 7.4 V, M1";
  return type;
}

// The XL-330 is the M288 at 5 V.
ServoType xl330() {
  return identified(dynamixel("xl330", "XL330-M288-T", 1200), 288.35, 0.386, 3.40,
                    {.armature_kg_m2 = 0.00190,
                     .f_base_n_m = 0.0088,
                     .f_strib_n_m = 0,
                     .l_base = 0.0680,
                     .l_strib = 0.0738,
                     .w_s_rad_s = 2.56,
                     .alpha = 0.76,
                     .f_visc_n_m_s = 0.0046});
}

}  // namespace

const std::vector<ServoType>& servo_types() {
  static const std::vector<ServoType> kTypes = [] {
    const ServoType w210 =
        scaled(dynamixel("xm430_w210", "XM430-W210-R", 1030), 212.6, 3.0, 77, 2.3);
    return std::vector<ServoType>{
        w210,
        scaled(dynamixel("xm430_w350", "XM430-W350-R", 1020), 353.5, 4.1, 46, 2.3),
        scaled(dynamixel("xh430_w210", "XH430-W210-R", 1010), 212.6, 2.5, 50, 1.3),
        scaled(dynamixel("xh430_w350", "XH430-W350-R", 1000), 353.5, 3.4, 30, 1.3),
        scaled(dynamixel("xm540_w150", "XM540-W150-R", 1130), 152.3, 7.3, 53, 4.4),
        scaled(dynamixel("xm540_w270", "XM540-W270-R", 1120), 272.5, 10.6, 30, 4.4),
        scaled(dynamixel("xh540_w150", "XH540-W150-R", 1110), 152.3, 7.1, 70, 4.9),
        scaled(dynamixel("xh540_w270", "XH540-W270-R", 1100), 272.5, 9.9, 39, 4.9),
        xl330(),
        scaled(dynamixel("xl330_m077", "XL330-M077-T", 1190), 77.5, 0.215, 383, 1.47),
        scaled(dynamixel("xl430_w250", "XL430-W250-T", 1060), 258.5, 1.4, 57, 1.3),
        scaled(dynamixel("xc430_w150", "XC430-W150-T", 1070), 159.59, 1.6, 106, 1.4),
        scaled(dynamixel("xc430_w240", "XC430-W240-T", 1080), 245.22, 1.9, 70, 1.4),
        scaled(dynamixel("xc330_m181", "XC330-M181-T", 1230), 180.62, 0.60, 129, 1.80),
        scaled(dynamixel("xc330_m288", "XC330-M288-T", 1240), 288.35, 0.93, 81, 1.80),
        scaled(dynamixel("xc330_t181", "XC330-T181-T", 1210), 180.62, 0.76, 104, 0.80),
        scaled(dynamixel("xc330_t288", "XC330-T288-T", 1220), 288.35, 0.92, 65, 0.80),
        scaled(dynamixel("mx28", "MX-28(2.0)", 30), 193, 2.5, 55, 1.4),
        identified(dynamixel("mx64", "MX-64(2.0)", 311), 200, 1.663, 3.16,
                   {.armature_kg_m2 = 0.01096,
                    .f_base_n_m = 0.0616,
                    .f_strib_n_m = 0.0239,
                    .l_base = 0,
                    .l_strib = 0.234,
                    .w_s_rad_s = 1.52,
                    .alpha = 1.33,
                    .f_visc_n_m_s = 0.0148}),
        identified(dynamixel("mx106", "MX-106(2.0)", 321), 225, 2.231, 2.37,
                   {.armature_kg_m2 = 0.02457,
                    .f_base_n_m = 0,
                    .f_strib_n_m = 0.1049,
                    .l_base = 0.0092,
                    .l_strib = 0.2224,
                    .w_s_rad_s = 1.62,
                    .alpha = 1.32,
                    .f_visc_n_m_s = 0.0510}),
        drive_of(w210),
        sts3215(),
    };
  }();
  return kTypes;
}

const ServoType* find_servo_type(const std::vector<ServoType>& types, std::string_view name) {
  for (const ServoType& type : types) {
    if (name == type.name) return &type;
  }
  return nullptr;
}

const char* protocol_name(BusProtocol protocol) {
  return protocol == BusProtocol::kCia402    ? "cia402"
         : protocol == BusProtocol::kFeetech ? "feetech"
                                             : "dynamixel2";
}

const std::vector<ImuType>& imu_types() {
  constexpr double kDegree = std::numbers::pi / 180;
  constexpr double kG = 9.80665;
  // TDK InvenSense ICM-20648 datasheet DS-000179: +-2000 dps at 16.4 LSB/dps, +-4 g at 8192 LSB/g;
  // noise densities 0.015 dps/sqrt(Hz) and 190 ug/sqrt(Hz). Zero-rate output (5 dps) and zero-g
  // offset (25 mg) are calibrated in the factory and at rest; the rest, 0.1 dps and 5 mg, is
  // assumed: a few times a one-second mean's noise, and temperature drift.
  static const std::vector<ImuType> kTypes = {
      {"icm20648", kDegree / 16.4, kG / 8192, 0.015 * kDegree, 0.1 * kDegree, 190e-6 * kG,
       5e-3 * kG},
      // Bosch BNO055 data sheet BST-BNO055-DS000 without fusion: 16 LSB/dps and 100 LSB/(m/s^2) at
      // any range; 0.014 dps/sqrt(Hz) and 150 ug/sqrt(Hz). The rest is assumed as above.
      {"bno055", kDegree / 16, 0.01, 0.014 * kDegree, 0.1 * kDegree, 150e-6 * kG, 5e-3 * kG},
      // TDK InvenSense MPU-6050 (PS-MPU-6000A) and ICM-42688-P (DS-000347), ranges as the first.
      {"mpu6050", kDegree / 16.4, kG / 8192, 0.005 * kDegree, 0.1 * kDegree, 400e-6 * kG,
       5e-3 * kG},
      {"icm42688p", kDegree / 16.4, kG / 8192, 0.0028 * kDegree, 0.1 * kDegree, 70e-6 * kG,
       5e-3 * kG},
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
