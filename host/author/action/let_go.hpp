#pragma once
#include <string>

#include "host/robot/model/entity.hpp"
#include "host/run/session/plan.hpp"
#include "host/twin/sim/world.hpp"

namespace verp::action {

/// The end of a robot in the twin that is asked to relax.
struct LetGo {
  bool tried = false;       ///< it has legs, stood, and let go
  bool by_action = false;   ///< it lay down by its action lie_down
  bool good = false;        ///< torque went without a fall
  std::string ends;         ///< "lies on its front"
  double moved_rad = 0;     ///< change of the body's tilt after torque went
  double fell_s = 0;        ///< from then until it lay; 0: it did not fall
  double lay_rad = 0;       ///< tilt when torque went
  double down_m_s = 0;      ///< fastest that the centre of mass came down
  double fall_percent = 0;  ///< the free fall that gives this speed, of its height

  /// `robot`: as a user calls it.
  std::string words(const std::string& robot = "ROBOT") const;
};

/// With as little friction in the gears as servos of its types may have. Takes half a second.
/// Throws LoadError for a wrong action.
LetGo let_go(const model::Entity& entity);
/// For a robot and a floor of the caller's.
LetGo let_go(session::WalkPlan plan, const sim::WorldOptions& world);

}  // namespace verp::action
