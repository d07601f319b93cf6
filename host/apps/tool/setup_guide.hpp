#pragma once
#include <string>

#include "common/model/params.hpp"
#include "host/apps/cli/answers.hpp"
#include "host/apps/tool/setup_report.hpp"
#include "host/twin/bus/servo_setup.hpp"

namespace verp::tool {

struct SetupChoice {
  std::string joint;     ///< only this one; empty: all that are not done
  bool wired = false;    ///< all servos stay on the bus, under the ids they have
  bool dry_run = false;  ///< nothing is written
};

/// Leads a person through the servos of a robot, one joint at a time: who is there, what it is,
/// what it is to be; then zero and direction, by hand, torque off.
class SetupGuide {
 public:
  SetupGuide(const Params& params, const link::Endpoint& endpoint, const SetupChoice& choice,
             SetupReport& report, cli::Answers& answers);

  /// False: the person stopped, or joints are left to do.
  bool run();

 private:
  /// What a person answers when a joint comes up, or something is wrong with it.
  enum class Answer { kGoOn, kSkip };
  /// Thrown when the input ends, somebody interrupts, or says q.
  struct Stop {};

  Answer ask(const std::string& question);
  /// False: something is left to do.
  bool joint(int index);
  /// What is known of a joint whose turn it is: what earlier tries changed in its servo.
  cli::Json begun(const JointParams& joint) const;
  void set_up(const JointParams& joint, cli::Json& entry);
  /// Keeps what was just written to a servo, before anything else may fail.
  void note(const JointParams& joint, const bus::Change& change, cli::Json& entry);
  void skip(const JointParams& joint);
  bus::FoundServo meet(const JointParams& joint);
  void measure_zero(const JointParams& joint, bus::Client& client, std::uint8_t id,
                    cli::Json& entry);
  void check_direction(const JointParams& joint, bus::Client& client, std::uint8_t id,
                       cli::Json& entry);

  const Params& params_;
  bus::SetupLine line_;
  const SetupChoice& choice_;
  SetupReport& report_;
  cli::Answers& answers_;
};

}  // namespace verp::tool
