#pragma once
#include <string>

#include "common/model/params.hpp"
#include "host/apps/cli/answers.hpp"
#include "host/apps/tool/robot/setup_report.hpp"
#include "host/twin/bus/servo_setup.hpp"

namespace verp::tool {

struct SetupChoice {
  std::string joint;     ///< empty: all undone ones
  bool wired = false;    ///< all servos stay connected
  bool dry_run = false;  ///< write nothing
};

/// Joint by joint it finds and configures the servo; then the user moves it by hand, torque off, to
/// set zero and direction.
class SetupGuide {
 public:
  SetupGuide(const Params& params, const link::Endpoint& endpoint, const SetupChoice& choice,
             SetupReport& report, cli::Answers& answers);

  /// False: the user stopped, or joints remain.
  bool run();

 private:
  /// The user's answer at a joint's turn or after an error.
  enum class Answer { kGoOn, kSkip };
  /// Thrown at the end of input, on interruption, or when the user enters q.
  struct Stop {};

  Answer ask(const std::string& question);
  /// False: something remains to do.
  bool joint(int index);
  /// Starts the joint's entry with the changes of earlier attempts.
  cli::Json begun(const JointParams& joint) const;
  void set_up(const JointParams& joint, cli::Json& entry);
  /// Saves a written change: a later step may fail.
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
