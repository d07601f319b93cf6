#include "common/protocol/servo_models.hpp"
#include "tests/host/run/lone_servo.hpp"
#include "tests/host/tool/program.hpp"

// tests/dynamixel/control_tables.py has tables of its own.
namespace verp::tool::test {
namespace {

using verp::test::LoneServo;

class ControlTables : public Program {
 protected:
  std::string port() const { return (folder_ / "tty").string(); }
};

TEST_F(ControlTables, OfEveryServoModelAreTheManuals) {
  LoneServo servos(port());
  std::uint8_t id = 0;
  for (const dxl::ServoModel& model : dxl::kServoModels) {
    const double volts = model.nominal_dv / 10.0;
    servos.connect({.id = ++id, .model = model.number, .rating = {.nominal_v = volts}},
                   {.duty = 0.5, .current_a = 1, .voltage_v = volts});
  }
  const Outcome outcome = shell("timeout 100 python3 " VERP_CONTROL_TABLES " " + port());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

}  // namespace
}  // namespace verp::tool::test
