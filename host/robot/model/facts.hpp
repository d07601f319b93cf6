#pragma once
#include <optional>
#include <string>
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/robot/model/xml_source.hpp"

/// A <model>'s verp: elements, range-checked, with their XML elements for errors. load.cpp resolves
/// names; robot-file.md of the guide lists them all.
namespace verp::model {

struct BodyFact {
  XmlElement at;
  std::string link;
  Transform pose = Transform::Identity();
};
struct LimbFact {
  XmlElement at;
  std::string name, base, tip;
};
struct ServoFact {
  XmlElement at;
  std::string joint;
  Servo servo;
  std::optional<double> lower_rad, upper_rad;
  bool gives_p_gain = true;  ///< else the type's, until the robot is known
  bool gives_d_gain = true;  ///< otherwise none, until then
};
struct ImuFact {
  XmlElement at;
  std::string sensor, link;
  ImuSensor imu;
};
struct LatencyFact {
  XmlElement at;
  std::string sensor;
  double latency_s = 0;
};
struct TruthFact {
  XmlElement at;
  std::string link;
  TruthSensor truth;  ///< pose in that link's frame
};
struct FeetFact {
  XmlElement at;
  FootSensor feet;
};
struct SupplyFact {
  XmlElement at;
  Supply supply;
};
struct PoseFact {
  XmlElement at;
  std::string pose, joint;
  double rad = 0;
};
struct TuningFact {
  XmlElement at;
  std::string name;
  double value = 0;
};
struct InertiaFact {
  XmlElement at;
  std::string link;  ///< "*": all
  double scale = 1;
  std::optional<Vec3> com_m;  ///< replaces the file's, link frame; never for "*"
  /// Only for a URDF's link: the radius of a ball whose moments replace the file's; the mass.
  std::optional<double> ball_m, mass_kg;
};
struct BoxFact {
  XmlElement at;
  std::string frame;
  Collision box;
};
/// A part of the file that is ignored.
struct DropFact {
  XmlElement at;
  std::string what;  ///< collision, massless_link, mimic, sensor
  std::string name;  ///< "*": all
};

/// A moving joint of the file that is fixed.
struct FixFact {
  XmlElement at;
  std::string joint;  ///< a final * matches any ending
  double rad = 0;
  bool fixes(const std::string& name) const;
};

struct MimicFact {
  XmlElement at;
  std::string joint, driver;
  double multiplier = 1, offset_rad = 0;
};

struct NoCollideFact {
  XmlElement at;
  std::string link, other;  ///< both "*": all that overlap in a pose
  bool is_any() const { return link == "*" && other == "*"; }
};

/// Sensors have the same ids on each bus.
struct BusFact {
  XmlElement at;
  std::string name;
  BusProtocol protocol = BusProtocol::kDynamixel2;
  std::uint32_t baud = 2000000;
  std::uint32_t period_us = 10000;
  std::uint8_t rise_torque_percent = kRiseTorquePercent;
  std::vector<ServoFact> servos;
};

struct Facts {
  std::optional<BodyFact> body;
  std::vector<LimbFact> limbs;
  std::vector<BusFact> buses;  ///< at least one
  std::size_t used = 0;        ///< index of the bus in use
  std::optional<ImuFact> imu;
  std::optional<FeetFact> feet;
  std::optional<SupplyFact> supply;
  std::optional<FrictionFrom> friction;
  std::vector<LatencyFact> latencies;
  std::vector<TruthFact> truths;
  std::vector<PoseFact> poses;
  std::vector<TuningFact> tuning;
  std::vector<InertiaFact> inertias;
  std::vector<BoxFact> boxes;
  std::vector<DropFact> drops;
  std::vector<FixFact> fixes;
  std::vector<MimicFact> mimics;  ///< with the URDF's, once they are read
  std::vector<NoCollideFact> no_collides;

  const BusFact& bus() const { return buses[used]; }
  bool is_dropped(const std::string& what, const std::string& name) const;
  const FixFact* fix_of(const std::string& joint) const;      ///< nullptr: it may turn
  const MimicFact* mimic_of(const std::string& joint) const;  ///< nullptr: own servo
};

/// Throws LoadError for an unknown or missing element or attribute, a bad number, a duplicate id.
/// `bus`: to use, empty: the first; all are checked.
Facts read_facts(const XmlElement& model, const std::string& bus);

}  // namespace verp::model
