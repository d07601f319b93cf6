#pragma once
#include <span>
#include <string>

#include "host/run/session/plan.hpp"

namespace verp::scenario {

enum class BugFamily { kBus, kServo, kImu, kModel, kPower };
/// The part that finds a bug. kCheck and kBringUp find it before a servo has torque.
enum class Catcher { kCheck, kBringUp, kTable, kTwin, kNobody };

inline constexpr double kBegins_s = 2;  ///< of most bugs, into the gait

/// How a bug comes into a run: a quantity of the twin, a mistake in the robot's file, or a change
/// of the plan. {trunk}, {knee}, {thigh} and {foot} are names of the robot's trunk and left leg.
struct Injection {
  const char* text;                              ///< quantity; or place in the file; or in words
  const char *tag = nullptr, *value = nullptr;   ///< in the file: after this, write that
  void (*change)(session::WalkPlan&) = nullptr;  ///< of the plan
};

/// A mistake that builders of robots reported in public.
struct FieldBug {
  const char* name;
  BugFamily family;
  const char* what;    ///< is wrong, as a person would tell it
  const char* thread;  ///< "owner/repository#number"; empty: common knowledge
  Catcher catcher;     ///< expected
  const char* word;    ///< expected in the line that the user sees; uncaught: the reason
  Injection injection;

  bool in_file() const { return injection.tag != nullptr; }
};

std::span<const FieldBug> field_bugs();
/// Throws ScenarioError (where: "fault") with the known names.
const FieldBug& field_bug(const std::string& name);
/// As a person would inject it.
std::string how(const FieldBug& bug, const model::Entity& entity);

/// The robot's Params from its file with the bug's mistake; throws model::LoadError where it is
/// found. Other bugs: from the file as it is.
Params params_of(const FieldBug& bug, const model::Entity& entity);
/// Puts the bug into a run. Throws ScenarioError if the robot lacks the part.
void inject(const FieldBug& bug, session::WalkPlan& plan);

struct Trial {
  Catcher catcher = Catcher::kNobody;
  double after_s = -1;  ///< from the bug's begin to a fault or fall; negative: none
  std::string line;     ///< the first one that the user sees
};
/// Walks this robot with the bug for 5 s.
Trial try_bug(const FieldBug& bug, const model::Entity& entity);

const char* in_words(BugFamily family);
const char* in_words(Catcher catcher);

}  // namespace verp::scenario
