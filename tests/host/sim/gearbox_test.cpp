#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "host/robot/model/servo_types.hpp"
#include "host/twin/sim/robot.hpp"
#include "tests/host/sim/test_robots.hpp"

/// Against closed forms, and a separate integration of Duclusaud and Passault, arXiv 2410.08650,
/// with their numbers.
namespace verp::sim {
namespace {

model::Servo servo_of(const model::ServoType& type) {
  model::Servo servo = test::plain_servo();
  servo.stall_torque_n_m = type.stall_torque_n_m;
  servo.no_load_speed_rad_s = type.no_load_rev_min * 2 * std::numbers::pi / 60;
  servo.stall_current_a = type.stall_current_a;
  servo.nominal_v = type.nominal_v;
  servo.gearbox = type.gearbox;
  return servo;
}

model::Joint joint_with(const model::Gearbox& gearbox) {
  model::Joint joint = test::joint("j", 0, Vec3::Zero(), Vec3::UnitY());
  joint.servo.gearbox = gearbox;
  joint.lower_rad = -100;
  joint.upper_rad = 100;
  return joint;
}

struct Bench {
  explicit Bench(const model::Joint& joint, double inertia = 0.0, double step = 0.001)
      : inertia_kg_m2(inertia),
        step_s(step),
        volts(joint.servo.nominal_v),
        servo(joint, {.encoder = false}, Random(1, Draw::kEncoder), 0.0) {}

  void step(double external_n_m) {
    const Drive drive = servo.drive(setpoint, angle_rad, rate_rad_s, external_n_m, volts, step_s);
    const double inertia = inertia_kg_m2 / step_s;
    rate_rad_s = (inertia * rate_rad_s + external_n_m + drive.standstill_n_m) /
                 (inertia + drive.slope_n_m_s);
    angle_rad += rate_rad_s * step_s;
    servo.finish(rate_rad_s, step_s);
  }
  /// A far goal saturates the drive; the PWM limit sets the duty.
  void drive_by(double duty) {
    setpoint.torque_on = duty != 0;
    setpoint.p_gain = 16000;
    setpoint.goal_count = duty > 0 ? 1'000'000 : -1'000'000;
    setpoint.pwm_limit = static_cast<std::uint16_t>(std::lround(885 * std::abs(duty)));
  }

  double inertia_kg_m2, step_s, volts;
  ServoModel servo;
  ServoSetpoint setpoint{.torque_on = false, .goal_count = 2048, .p_gain = 3500};
  double angle_rad = 0, rate_rad_s = 0;
};

TEST(Gearbox, ARotorSpeedsUpAsItsInertiaAndTheTorqueSpeedLineSay) {
  Bench bench(joint_with({.armature_kg_m2 = 0.011}), 0.004, 0.0005);
  bench.drive_by(1);
  const double time_constant_s = 0.015 * 8.0 / 3.0;
  for (int step = 1; step <= 400; ++step) {
    bench.step(0);
    const double expected = 8.0 * (1 - std::exp(-0.0005 * step / time_constant_s));
    EXPECT_NEAR(bench.rate_rad_s, expected, 0.05) << step;
  }
}

TEST(Gearbox, AStuckJointHoldsBelowItsBudgetForAMinuteAndBeyondItSlidesByTheRest) {
  const model::Gearbox gearbox{
      .armature_kg_m2 = 0.01, .f_base_n_m = 0.06, .f_strib_n_m = 0.04, .alpha = 2};
  Bench stuck(joint_with(gearbox));
  for (int step = 0; step < 60'000; ++step) stuck.step(0.099);
  EXPECT_LT(std::abs(stuck.angle_rad), 1e-5);
  Bench pushed(joint_with(gearbox));
  for (int step = 0; step < 200; ++step) pushed.step(0.2);
  // Far above the Stribeck speed f_base remains: 0.14 N m on 0.01 kg m2.
  const double before = pushed.rate_rad_s;
  for (int step = 0; step < 100; ++step) pushed.step(0.2);
  EXPECT_NEAR(pushed.rate_rad_s - before, 0.14 / 0.01 * 0.1, 0.01);
}

TEST(Gearbox, FrictionStopsAJointAndLeavesItThere) {
  for (const double links : {0.0, 0.02}) {
    Bench bench(joint_with({.armature_kg_m2 = 0.01, .f_base_n_m = 0.1}), links);
    for (int step = 0; step < 20; ++step) bench.step(1.1);
    const double speed = bench.rate_rad_s;
    EXPECT_NEAR(speed, 0.02 * 1.0 / (0.01 + links), 0.1 / (1 + 100 * links));
    const double start = bench.angle_rad;
    for (int step = 0; step < 1000; ++step) bench.step(0);
    EXPECT_NEAR(bench.angle_rad - start, speed * speed * (0.01 + links) / 0.2, 0.01 * speed);
    EXPECT_LT(std::abs(bench.rate_rad_s), 1e-6);
  }
}

// More friction stopped a thrown leg at once and took 9 N m from its neighbours: hip and knee stuck
// for 60 ms, and a robot fell.
TEST(Gearbox, OfAJointThatIsThrownBackFrictionTakesNoMoreThanItsBudget) {
  constexpr double kFriction_n_m = 0.1, kArmature = 0.01, kLinks = 0.02;
  for (const double step_s : {0.001, 0.002}) {
    for (const double thrown_rad_s : {-1.1, -0.3, 1.1}) {
      Bench bench(joint_with({.armature_kg_m2 = kArmature, .f_base_n_m = kFriction_n_m}), kLinks,
                  step_s);
      for (int step = 0; step < 20; ++step) bench.step(thrown_rad_s < 0 ? 1.1 : -1.1);
      bench.rate_rad_s = thrown_rad_s;
      bench.step(0);
      const double taken = kFriction_n_m * step_s / (kArmature + kLinks);
      EXPECT_NEAR(std::abs(bench.rate_rad_s), std::abs(thrown_rad_s) - taken, 0.2 * taken)
          << thrown_rad_s << " in steps of " << step_s;
    }
  }
}

// load = |external - motor|. The joint holds from (1 - l) m = (1 + l) e to the reverse.
TEST(Gearbox, LoadMakesFrictionThatHelpsToHold) {
  const double l = 0.2;
  const auto moved = [&](double motor_n_m) {
    Bench bench(joint_with({.armature_kg_m2 = 0.01, .l_strib = l, .w_s_rad_s = 1.5, .alpha = 1.3}));
    bench.drive_by(motor_n_m / 3.0);
    for (int step = 0; step < 300; ++step) bench.step(-1.0);
    return bench.angle_rad;
  };
  const double up = (1 + l) / (1 - l);
  EXPECT_LT(std::abs(moved(0.97 * up)), 1e-4);
  EXPECT_GT(moved(1.05 * up), 0.01);
  EXPECT_LT(std::abs(moved(1.03 / up)), 1e-4);
  EXPECT_LT(moved(0.93 / up), -0.01);
}

// M5 and M6: m holds up e while m - e <= l_e e + l_m m + q_e e e, and down while
// e - m <= l_e e + l_m m + q_m m m.
TEST(Gearbox, LoadsOfMotorAndLinkHaveFrictionOfTheirOwn) {
  const double l_m = 0.3, l_e = 0.05, q_m = 0.04, q_e = 0.08;
  const auto moved = [&](double motor_n_m) {
    Bench bench(joint_with({.armature_kg_m2 = 0.01,
                            .l_base = l_m / 2,
                            .l_strib = l_m / 2,
                            .w_s_rad_s = 1.5,
                            .alpha = 1.3,
                            .is_directional = true,
                            .l_external = l_e / 2,
                            .l_external_strib = l_e / 2,
                            .q_motor_per_n_m = q_m,
                            .q_external_per_n_m = q_e}));
    bench.drive_by(motor_n_m / 3.0);
    for (int step = 0; step < 300; ++step) bench.step(-1.0);
    return bench.angle_rad;
  };
  const double up = (1 + l_e + q_e) / (1 - l_m);
  const double down =
      (std::sqrt((1 + l_m) * (1 + l_m) + 4 * q_m * (1 - l_e)) - 1 - l_m) / (2 * q_m);
  EXPECT_LT(std::abs(moved(0.98 * up)), 1e-4);
  EXPECT_GT(moved(1.03 * up), 0.01);
  EXPECT_LT(std::abs(moved(1.02 * down)), 1e-4);
  EXPECT_LT(moved(0.95 * down), -0.01);
}

TEST(Gearbox, InsideThePlayTheRotorHasOnlyItselfToTurn) {
  model::Joint joint = joint_with({.armature_kg_m2 = 0.01});
  joint.servo.backlash_rad = 0.02;
  Bench bench(joint, 0.01);
  bench.drive_by(1.0 / 3);
  // 10 mrad to the flank at 100 rad/s2 take 14 ms; then both halves share the speed.
  for (int step = 0; step < 13; ++step) bench.step(0);
  EXPECT_EQ(bench.rate_rad_s, 0);
  for (int step = 0; step < 3; ++step) bench.step(0);
  EXPECT_NEAR(bench.rate_rad_s, 0.7, 0.1);
}

/// Two bodies, in steps of 10 us.
struct RotorAndLink {
  const model::Servo& servo;
  double link_kg_m2;
  double rotor_rad = 0, rotor_rad_s = 0, link_rad = 0, link_rad_s = 0;

  double flank_n_m() const {
    constexpr double kStiff_n_m = 2e4;
    const double ahead = rotor_rad - link_rad;
    const double within = std::abs(ahead) - servo.backlash_rad / 2;
    if (within <= 0) return 0;
    const double rotor = servo.gearbox.armature_kg_m2;
    const double damping = 2 * std::sqrt(kStiff_n_m * rotor * link_kg_m2 / (rotor + link_kg_m2));
    const double closing =
        std::copysign(rotor_rad_s - link_rad_s, ahead * (rotor_rad_s - link_rad_s));
    return std::copysign(std::max(kStiff_n_m * within + damping * closing, 0.0), ahead);
  }
  void run(double duty, double external_n_m, double time_s) {
    constexpr double kStep = 1e-5;
    const model::Gearbox& gears = servo.gearbox;
    for (double t = 0; t < time_s - kStep / 2; t += kStep) {
      const double flank = flank_n_m();
      const double motor =
          servo.stall_torque_n_m * (duty - rotor_rad_s / servo.no_load_speed_rad_s);
      const double load = std::abs((flank != 0 ? external_n_m : 0) - motor);
      const double budget = gears.f_base_n_m + load * gears.l_base;
      const double stop = gears.armature_kg_m2 / kStep * rotor_rad_s + motor - flank;
      const double friction = -std::copysign(std::min(std::abs(stop), budget), stop);
      rotor_rad_s += (motor - flank + friction) / gears.armature_kg_m2 * kStep;
      link_rad_s += (flank + external_n_m) / link_kg_m2 * kStep;
      rotor_rad += rotor_rad_s * kStep;
      link_rad += link_rad_s * kStep;
    }
  }
};

// Goal to goal with overshoot and gravity. If friction stops the rotor at a flank, the motor moves
// it on.
TEST(Gearbox, WithPlayAJointGoesAsItsRotorAndItsLinkWouldAsTwoBodies) {
  for (const double armature : {0.002, 0.012, 0.045}) {
    for (const double link : {0.005, 0.03}) {
      for (const double gravity_n_m : {-0.4, 0.1}) {
        model::Joint joint =
            joint_with({.armature_kg_m2 = armature, .f_base_n_m = 0.1, .l_base = 0.2});
        joint.servo.backlash_rad = 0.0087;
        Bench bench(joint, link);
        bench.setpoint = {.torque_on = true, .goal_count = 2048, .p_gain = 2200};
        RotorAndLink expected{joint.servo, link};
        for (int ms = 0; ms < 1200; ++ms) {
          constexpr int kGoals[] = {0, 260, 195, -65, 0, -260};
          bench.setpoint.goal_count = 2048 + kGoals[ms / 200];
          const double error =
              bench.setpoint.goal_count - std::round(count_of(joint.servo, expected.link_rad));
          expected.run(std::clamp(2200 / 128.0 * error / 885, -1.0, 1.0),
                       gravity_n_m * std::cos(3 * expected.link_rad), 0.001);
          bench.step(gravity_n_m * std::cos(3 * bench.angle_rad));
          ASSERT_NEAR(bench.angle_rad, expected.link_rad, 0.02)
              << armature << " " << link << " " << gravity_n_m << " at " << ms << " ms";
        }
      }
    }
  }
}

// The published equations in steps of 10 us: driven up, driven back, released.
struct PaperPendulum {
  model::Gearbox gears;
  double stall_n_m, slope_n_m_s;
  double inertia_kg_m2, gravity_n_m;
  double angle_rad = 0, rate_rad_s = 0;

  /// M4; with its two sides apart M5, with squares M6.
  double load_friction(double motor, double external, double s) const {
    if (!gears.is_directional)
      return std::abs(external - motor) * (gears.l_base + s * gears.l_strib);
    double friction = std::abs(external * gears.l_external - motor * gears.l_base);
    friction += s * std::abs(external * gears.l_external_strib - motor * gears.l_strib);
    if (external * motor >= 0) return friction;
    if (std::abs(external) < std::abs(motor))
      friction += s * gears.q_external_per_n_m * external * external;
    else
      friction += s * gears.q_motor_per_n_m * motor * motor;
    return friction;
  }

  void run(double duty, double time_s) {
    constexpr double kStep = 1e-5;
    for (double t = 0; t < time_s - kStep / 2; t += kStep) {
      const double motor = duty == 0 ? 0 : duty * stall_n_m - slope_n_m_s * rate_rad_s;
      const double external = -gravity_n_m * std::sin(angle_rad);
      const double s = std::exp(-std::pow(std::abs(rate_rad_s / gears.w_s_rad_s), gears.alpha));
      const double budget = gears.f_base_n_m + s * gears.f_strib_n_m +
                            load_friction(motor, external, s) +
                            gears.f_visc_n_m_s * std::abs(rate_rad_s);
      const double inertia = inertia_kg_m2 + gears.armature_kg_m2;
      const double stop = inertia / kStep * rate_rad_s + motor + external;
      const double friction = -std::copysign(std::min(std::abs(stop), budget), stop);
      rate_rad_s += (motor + external + friction) / inertia * kStep;
      angle_rad += rate_rad_s * kStep;
    }
  }
};

struct Leg {
  double duty, time_s;
};
constexpr Leg kRun[] = {{0.5, 0.25}, {-0.3, 0.25}, {0, 0.6}, {0.1, 0.4}, {0, 0.4}};

class IdentifiedMotor : public testing::TestWithParam<const char*> {};

TEST_P(IdentifiedMotor, SwingsAPendulumAsThePaperSays) {
  const model::ServoType* type = model::find_servo_type(model::servo_types(), GetParam());
  ASSERT_NE(type, nullptr);
  ASSERT_EQ(type->armature_band, 0);
  model::Joint joint = joint_with({});
  joint.servo = servo_of(*type);
  const double mass_kg =
      0.3 * type->stall_torque_n_m / test::kGravity_m_s2 / 0.1;  // 0.3 of stall when level
  const double inertia = mass_kg * 0.1 * 0.1;
  PaperPendulum paper{type->gearbox, type->stall_torque_n_m,
                      type->stall_torque_n_m / joint.servo.no_load_speed_rad_s, inertia,
                      mass_kg * test::kGravity_m_s2 * 0.1};
  for (const double step_s : {0.00025, 0.001, 0.002}) {
    PaperPendulum expected = paper;
    Bench bench(joint, inertia, step_s);
    double travelled = 0;
    for (const Leg& leg : kRun) {
      bench.drive_by(leg.duty);
      for (int step = 0; step < std::lround(leg.time_s / step_s); ++step) {
        bench.step(-paper.gravity_n_m * std::sin(bench.angle_rad));
        expected.run(std::round(885 * leg.duty) / 885, step_s);
        EXPECT_NEAR(bench.angle_rad, expected.angle_rad, 12 * step_s + 0.004)
            << "duty " << leg.duty << " step " << step << " of " << step_s;
        travelled = std::max(travelled, std::abs(bench.angle_rad));
      }
    }
    EXPECT_GT(travelled, 0.3);
  }
}

// Rhoban/bam, commit 1b5a1ce, bam/params/mx64/m6.json.
TEST(Gearbox, AMotorOfModelM6SwingsAPendulumAsItsAuthorsSay) {
  model::Joint joint = joint_with({.armature_kg_m2 = 0.01227,
                                   .f_base_n_m = 6e-7,
                                   .f_strib_n_m = 0.1227,
                                   .l_base = 0.31147,
                                   .l_strib = 0.18774,
                                   .w_s_rad_s = 2.5753,
                                   .alpha = 0.8409,
                                   .f_visc_n_m_s = 0.02533,
                                   .is_directional = true,
                                   .l_external = 2e-8,
                                   .l_external_strib = 0.01407,
                                   .q_motor_per_n_m = 0.00691,
                                   .q_external_per_n_m = 0.01});
  joint.servo.stall_torque_n_m = 1.6017 * 12 / 2.3164;
  joint.servo.no_load_speed_rad_s = 12 / 1.6017;
  const double gravity_n_m = 0.3 * joint.servo.stall_torque_n_m;
  const double inertia = gravity_n_m * 0.1 / test::kGravity_m_s2;
  PaperPendulum paper{joint.servo.gearbox, joint.servo.stall_torque_n_m,
                      joint.servo.stall_torque_n_m / joint.servo.no_load_speed_rad_s, inertia,
                      gravity_n_m};
  Bench bench(joint, inertia);
  for (const Leg& leg : kRun) {
    bench.drive_by(leg.duty);
    for (int ms = 0; ms < std::lround(leg.time_s * 1000); ++ms) {
      bench.step(-gravity_n_m * std::sin(bench.angle_rad));
      paper.run(std::round(885 * leg.duty) / 885, 0.001);
      EXPECT_NEAR(bench.angle_rad, paper.angle_rad, 0.016) << leg.duty << " at " << ms << " ms";
    }
  }
}

// Gravity comes from the engine's motion.
TEST_P(IdentifiedMotor, SwingsAPendulumAsThePaperSaysInOde) {
  const model::ServoType* type = model::find_servo_type(model::servo_types(), GetParam());
  ASSERT_NE(type, nullptr);
  model::Entity entity = test::arm();
  entity.joints[0].servo = servo_of(*type);
  const double mass_kg = 0.3 * type->stall_torque_n_m / test::kGravity_m_s2 / test::kArmLength;
  entity.nodes[1].mass_kg = mass_kg;
  PaperPendulum paper{type->gearbox, type->stall_torque_n_m,
                      type->stall_torque_n_m / entity.joints[0].servo.no_load_speed_rad_s,
                      test::kArmInertia + 1e-7 + mass_kg * test::kArmLength * test::kArmLength,
                      mass_kg * test::kGravity_m_s2 * test::kArmLength};
  World world;
  TwinOptions options;
  options.imperfections = Imperfections::none();
  options.cradle = Cradle::kAlways;
  options.start_m = Vec3(0, 0, 1);
  options.supply_ohm = 0;
  TwinRobot robot(world, entity, options);
  Bench registers(entity.joints[0]);
  std::uint64_t now_us = 0;
  for (const Leg& leg : kRun) {
    registers.drive_by(leg.duty);
    robot.setpoint(0) = registers.setpoint;
    for (int ms = 0; ms < std::lround(leg.time_s * 1000); ++ms) {
      robot.advance_to(now_us += 1000);
      paper.run(std::round(885 * leg.duty) / 885, 0.001);
      EXPECT_NEAR(robot.truth().joint_rad[0], paper.angle_rad, 0.02)
          << "duty " << leg.duty << " at " << now_us << " us";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Paper, IdentifiedMotor, testing::Values("mx64", "mx106", "xl330"));

// The loop runs at 1 kHz. Finer physics sees a duty for four steps, coarser physics runs two loops
// a step.
TEST(Gearbox, TheLoopRunsAtItsOwnRateWhateverThePhysicsStep) {
  Bench fine(joint_with({}), 0.01, 0.00025);
  fine.setpoint.torque_on = true;
  fine.setpoint.goal_count = 2048 + 100;
  fine.setpoint.p_gain = 500;
  int changes = 0;
  for (int step = 0; step < 80; ++step) {
    const double before = fine.servo.measurement().duty;
    fine.step(0);
    changes += fine.servo.measurement().duty != before ? 1 : 0;
  }
  EXPECT_LE(changes, 20);
  EXPECT_GE(changes, 10);
}

TEST(Gearbox, GoesTheSameWayAtEveryPhysicsStep) {
  for (const double armature : {0.0, 0.01, 0.05}) {
    double reference = 0;
    for (const double step_s : {0.00025, 0.0005, 0.001, 0.002}) {
      Bench bench(joint_with({.armature_kg_m2 = armature,
                              .f_base_n_m = 0.02,
                              .f_strib_n_m = 0.02,
                              .l_strib = 0.2,
                              .f_visc_n_m_s = 0.01}),
                  0.005, step_s);
      bench.setpoint = {.torque_on = true, .goal_count = 2048 + 300, .p_gain = 1500};
      for (int step = 0; step < std::lround(0.08 / step_s); ++step) bench.step(-0.2);
      if (step_s == 0.00025) reference = bench.angle_rad;
      EXPECT_NEAR(bench.angle_rad, reference, 0.02) << armature << " " << step_s;
    }
    EXPECT_GT(reference, 0.1);
  }
}

// Gains to the registers' limits, rotors from a quarter of the lightest to ten times the heaviest
// known. The joint may tremble.
TEST(Gearbox, StaysWithinTheMotorsLineAtAnyGainInertiaAndStep) {
  for (const double armature : {0.0005, 0.01, 0.25}) {
    for (const double step_s : {0.00025, 0.001, 0.002}) {
      for (const std::uint16_t d_gain : {std::uint16_t{0}, std::uint16_t{16383}}) {
        Bench bench(joint_with({.armature_kg_m2 = armature, .f_base_n_m = 0.05, .l_strib = 0.9}),
                    1e-5, step_s);
        bench.setpoint = {
            .torque_on = true, .goal_count = 2048 + 500, .p_gain = 16383, .d_gain = d_gain};
        for (int step = 0; step < 2000; ++step) {
          bench.step(step % 100 < 50 ? 0.5 : -0.5);
          // The current limit acts between steps: 1.4 stall torques may last a step too long.
          const double late = step_s * (1.4 * 3.0 + 0.5) / (armature + 1e-5);
          ASSERT_LT(std::abs(bench.rate_rad_s), 8.0 * (1 + 0.5 / 3) + late)
              << armature << " " << step_s << " " << d_gain << " " << step;
        }
      }
    }
  }
}

}  // namespace
}  // namespace verp::sim
