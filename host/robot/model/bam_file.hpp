#pragma once
#include <string>
#include <vector>

#include "host/robot/model/entity.hpp"

namespace verp::model {

constexpr double kMostTorque_n_m = 1e4;
constexpr double kMostArmature_kg_m2 = 100;
constexpr double kMostLoad = 0.99;  // share lost to friction: at 1 the gears would lock
constexpr double kMostQuadratic = 10;

/// A servo as "Better Actuator Models" of Rhoban identify it (models M1 to M6): a JSON file.
struct Bam {
  std::string file, model, actuator;
  double kt_n_m_a = 0, resistance_ohm = 0;  ///< 0: not in the file
  double current_limit_a = 0;               ///< 0: none
  Gearbox gearbox;
  std::vector<std::string> unread;  ///< names of numbers that the twin has no use for

  bool has_motor() const { return kt_n_m_a > 0 && resistance_ohm > 0; }
  std::string source() const;
  std::string unread_text() const;  ///< one line; empty: none
};

/// Throws LoadError at the number's line.
Bam read_bam(const std::string& file);

}  // namespace verp::model
