#pragma once
#include <cstddef>
#include <cstdint>

#include "common/protocol/control_table.hpp"

/// The control tables of the servos' models, as far as they differ. Source: ROBOTIS e-Manual, the
/// page of each model (docs/en/dxl/x, docs/en/dxl/mx), with its includes.
/// tests/dynamixel/control_tables.txt lists where older pages differ.
namespace verp::dxl {

enum ServoFeature : std::uint16_t {
  kCurrentControl = 1 << 0,     ///< 38, 102, 126 a current; Operating Modes 0 and 5
  kLoad = 1 << 1,               ///< 126 is a load, 0.1 %
  kAccelerationBound = 1 << 2,  ///< 40
  kExternalPorts = 1 << 3,      ///< 56 to 58, 152 to 156
  kStartup = 1 << 4,            ///< 60, 147; Control Table Backup
  kPwmSlope = 1 << 5,           ///< 62
  kFastSyncRead = 1 << 6,       ///< instruction 0x8A
};

/// Indirect Data n (1 byte) stands for the byte at Indirect Address n (2 bytes).
struct IndirectBlock {
  std::uint16_t addresses = 0;
  std::uint16_t data = 0;
  std::uint16_t pairs = 0;
};

struct ServoFamily {
  unsigned features = 0;
  std::uint16_t firmware = 0;  ///< the twin's
  std::uint16_t most_baud_code = 0;
  std::uint16_t most_drive_mode = 0;
  std::uint16_t least_protocol = 0, most_protocol = 0;
  std::uint16_t most_velocity = 0;  ///< 0.229 rev/min
  std::uint16_t current_unit_10ua = 0;
  const char* current_unit = "";
  IndirectBlock indirect[2] = {};
};

/// Volts in tenths; gains and limits are factory values.
struct ServoModel : ServoFamily {
  std::uint16_t number = 0;  ///< Model Number (0)
  const char* name = "";
  std::uint16_t nominal_dv = 0;
  std::uint16_t least_dv = 0, most_dv = 0;  ///< range of both Voltage Limits; Max is `most_dv`
  std::uint16_t low_dv = 0;                 ///< Min Voltage Limit
  std::uint16_t hot_c = 0;                  ///< Temperature Limit
  std::uint16_t current_limit = 0;          ///< and its range; 0: none
  std::uint16_t velocity_limit = 0;
  std::uint16_t velocity_i_gain = 0, velocity_p_gain = 0;
  std::uint16_t position_d_gain = 0, position_i_gain = 0, position_p_gain = 0;
  std::uint16_t moving_threshold = 10;
  std::uint16_t shutdown = 52;
  std::uint16_t pwm_slope = 0;

  constexpr bool has(unsigned feature) const {
    return ((features | (current_limit != 0 ? kCurrentControl : kLoad)) & feature) == feature;
  }
  constexpr std::uint16_t last_indirect() const {
    const IndirectBlock& last = indirect[indirect[1].pairs == 0 ? 0 : 1];
    return static_cast<std::uint16_t>(last.data + last.pairs - 1);
  }
};

inline constexpr IndirectBlock kTwoBlocks[2] = {
    {address::kIndirectAddress1, address::kIndirectData1, kIndirectBlock},
    {address::kIndirectAddress29, address::kIndirectData29, kIndirectBlock}};

inline constexpr ServoFamily kMx2 = {
    .features = kAccelerationBound,
    .firmware = 45,
    .most_baud_code = 7,
    .most_drive_mode = 5,
    .least_protocol = 1,
    .most_protocol = 2,
    .most_velocity = 1023,
    .current_unit_10ua = 336,
    .current_unit = "3.36 mA",
    .indirect = {kTwoBlocks[0], kTwoBlocks[1]},
};
inline constexpr ServoFamily kX = {
    .features = kStartup | kFastSyncRead,
    .firmware = 45,  // first with Fast Sync Read
    .most_baud_code = 7,
    .most_drive_mode = 13,
    .least_protocol = 1,
    .most_protocol = 2,
    .most_velocity = 1023,
    .current_unit_10ua = 269,
    .current_unit = "2.69 mA",
    .indirect = {kTwoBlocks[0], kTwoBlocks[1]},
};
inline constexpr ServoFamily kX540 = [] {
  ServoFamily family = kX;
  family.features |= kExternalPorts;
  return family;
}();
/// Before firmware 52 Indirect Data began at 224 (dynamixel_hardware_interface, *_fw52.model).
inline constexpr ServoFamily kX330 = {
    .features = kStartup | kFastSyncRead | kPwmSlope,
    .firmware = 52,
    .most_baud_code = 6,
    .most_drive_mode = 13,
    .least_protocol = 2,
    .most_protocol = 22,
    .most_velocity = 2047,
    .current_unit_10ua = 100,
    .current_unit = "1 mA",
    .indirect = {{168, 208, 20}},
};

// clang-format off
/// In the order of ServoModel's fields: family | number, name | volts: nominal, least, most, low |
/// hot | current, velocity | gains: velocity I, P, position D, I, P | others.
inline constexpr ServoModel kServoModels[] = {
    {kMx2,    30, "MX-28(2.0)",  120, 95, 160, 95, 80,    0,  230, 1920, 100,    0,   0,  850},
    {kMx2,   311, "MX-64(2.0)",  120, 95, 160, 95, 80, 1941,  285, 1920, 100,    0,   0,  850},
    {kMx2,   321, "MX-106(2.0)", 120, 95, 160, 95, 80, 2047,  210, 1920, 100,    0,   0,  850},
    {kX,    1000, "XH430-W350",  120, 95, 160, 95, 80,  648,  130, 1920, 100,    0,   0,  900},
    {kX,    1010, "XH430-W210",  120, 95, 160, 95, 80,  648,  210, 1920, 100,    0,   0,  900},
    {kX,    1020, "XM430-W350",  120, 95, 160, 95, 80, 1193,  200, 1920, 100,    0,   0,  800},
    {kX,    1030, "XM430-W210",  120, 95, 160, 95, 80, 1193,  330, 1920, 100,    0,   0,  800},
    {kX,    1060, "XL430-W250",  111, 60, 140, 60, 72,    0,  265, 1000, 100, 4000,   0,  640},
    {kX,    1070, "XC430-W150",  120, 60, 160, 60, 80,    0,  460, 1920, 100,    0,   0,  460, 20},
    {kX,    1080, "XC430-W240",  120, 60, 160, 60, 80,    0,  306, 1920, 100,    0,   0,  700},
    {kX540, 1100, "XH540-W270",  120, 95, 160, 95, 80, 2047,  167, 1920, 100,    0,   0,  800},
    {kX540, 1110, "XH540-W150",  120, 95, 160, 95, 80, 2047,  300, 1920, 100,    0,   0,  800},
    {kX540, 1120, "XM540-W270",  120, 95, 160, 95, 80, 2047,  128, 1920, 100,    0,   0,  800},
    {kX540, 1130, "XM540-W150",  120, 95, 160, 95, 80, 2047,  230, 1920, 100,    0,   0,  800},
    {kX330, 1190, "XL330-M077",   50, 31,  70, 35, 70, 1750, 1620,  400,  40,    0, 400,  400, 10, 53, 140},
    {kX330, 1200, "XL330-M288",   50, 31,  70, 35, 70, 1750,  445, 1600, 180,    0,   0,  400, 10, 53, 140},
    {kX330, 1210, "XC330-T181",  111, 55, 140, 55, 70,  910,  510, 1200,  40,    0,   0,  900, 10, 52, 255},
    {kX330, 1220, "XC330-T288",  111, 55, 140, 55, 70,  910,  320, 1200,  40,    0,   0,  900, 10, 52, 255},
    {kX330, 1230, "XC330-M181",   50, 31,  70, 35, 70, 2352,  545, 1400, 100,  500,   0, 1200, 10, 52, 140},
    {kX330, 1240, "XC330-M288",   50, 31,  70, 35, 70, 2352,  350, 1600,  50,  500,   0, 1100, 10, 52, 140},
};
// clang-format on

/// nullptr: no page was read for that number.
constexpr const ServoModel* find_servo_model(std::uint16_t number) {
  for (const ServoModel& model : kServoModels) {
    if (model.number == number) return &model;
  }
  return nullptr;
}

}  // namespace verp::dxl
