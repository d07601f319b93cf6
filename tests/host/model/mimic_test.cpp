#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "common/model/coupling.hpp"
#include "common/model/image.hpp"
#include "host/robot/model/check.hpp"
#include "host/robot/model/couplings.hpp"
#include "host/robot/model/export.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/load_error.hpp"
#include "host/robot/model/params.hpp"
#include "tests/host/model/test_files.hpp"

namespace verp::model {
namespace {

constexpr const char* kOdd = VERP_SOURCE_DIR "/tests/host/model/odd_robot/";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

class Odd {
 public:
  Odd(const std::string& urdf, const std::string& wrapper)
      : urdf_("odd.urdf", urdf),
        wrapper_("robot.sdf", replaced(wrapper, "odd.urdf",
                                       std::filesystem::path(urdf_.path()).filename().string())) {}
  Entity load() const { return load_robot(wrapper_.path()); }

 private:
  TemporaryFile urdf_, wrapper_;
};

std::string urdf() {
  return read_text(std::string(kOdd) + "odd.urdf");
}
std::string wrapper() {
  return read_text(std::string(kOdd) + "robot.sdf");
}

const Joint& joint_of(const Entity& entity, const std::string& name) {
  for (const Joint& joint : entity.joints) {
    if (joint.name == name) return joint;
  }
  throw std::runtime_error("no joint " + name);
}

void expect_refused(const std::string& urdf_text, const std::string& wrapper_text,
                    const std::string& said, const std::string& near) {
  try {
    Odd(urdf_text, wrapper_text).load();
    FAIL() << said;
  } catch (const LoadError& error) {
    EXPECT_NE(error.message.find(said), std::string::npos) << error.what();
    const std::string& text = error.file.ends_with(".urdf") ? urdf_text : wrapper_text;
    const auto line =
        1 + std::count(text.begin(), text.begin() + static_cast<long>(text.find(near)), '\n');
    EXPECT_NEAR(static_cast<double>(error.line), static_cast<double>(line), 5) << error.what();
    EXPECT_FALSE(error.fix.empty());
  }
}

constexpr const char* kHips = "<mimic joint=\"l_hip_yaw\" multiplier=\"-1\"/>";

TEST(Mimic, HipsOfOneMotorAreOneServoOnTheBus) {
  const Entity entity = load_robot(std::string(kOdd) + "robot.sdf");
  ASSERT_EQ(entity.joints.size(), 15u);
  const Joint& follower = entity.joints.back();
  EXPECT_EQ(follower.name, "r_hip_yaw");
  EXPECT_EQ(entity.joints[static_cast<std::size_t>(follower.follows)].name, "l_hip_yaw");
  const Params params = make_params(entity);
  EXPECT_TRUE(is_well_formed(params));
  EXPECT_EQ(params.servo_count(), 14);
  EXPECT_EQ(driver_of(params, 14), follower.follows);
  const JointParams& driver = params.joint[follower.follows];
  EXPECT_NEAR(followed(driver, params.joint[14], 0.3F), -0.3F, 1e-6F);
  EXPECT_NE(describe(entity).find("r_hip_yaw follows l_hip_yaw"), std::string::npos);
  EXPECT_NE(describe_json(entity).find("\"multiplier\": -1.0"), std::string::npos);
  const ParamsImage image = make_image(entity);
  EXPECT_EQ(check_image(&image, sizeof image), ImageFault::kNone);
}

// Arms instead of hips, any ratio, either of the two first.
TEST(Mimic, BothLimitsAndSpeedsHoldForBoth) {
  struct Row {
    double multiplier, offset;
  };
  for (const Row row : {Row{-1, 0}, Row{2, 0.1}, Row{0.5, -0.2}}) {
    for (const std::string own : {"l_shoulder", "r_shoulder"}) {
      const std::string driver = own == "l_shoulder" ? "r_shoulder" : "l_shoulder";
      const auto fact = "<verp:mimic joint=\"" + own + "\" follows=\"" + driver +
                        "\" multiplier=\"" + std::to_string(row.multiplier) + "\" offset_rad=\"" +
                        std::to_string(row.offset) + "\"/>";
      const std::string id = own == "l_shoulder" ? "2" : "3";
      const std::string servo =
          "<verp:servo joint=\"" + own + "\" id=\"" + id + "\" type=\"xm430_w210\"/>";
      const Odd odd(urdf(),
                    replaced(replaced(wrapper(), servo, ""), "<verp:imu", fact + "<verp:imu"));
      const Entity entity = odd.load();
      const Joint &f = joint_of(entity, own), &d = joint_of(entity, driver);
      const double at_low = row.multiplier * d.lower_rad + row.offset;
      const double at_high = row.multiplier * d.upper_rad + row.offset;
      EXPECT_NEAR(f.lower_rad, std::min(at_low, at_high), 1e-9);
      EXPECT_NEAR(f.upper_rad, std::max(at_low, at_high), 1e-9);
      EXPECT_LE(f.upper_rad, 2.5 + 1e-9);
      EXPECT_GE(f.lower_rad, -2.5 - 1e-9);
      EXPECT_LE(d.upper_rad, 2.5 + 1e-9);
      EXPECT_TRUE(std::abs(f.upper_rad) > 2.49 || std::abs(d.upper_rad) > 2.49 ||
                  std::abs(f.lower_rad) > 2.49 || std::abs(d.lower_rad) > 2.49)
          << "narrower than either has it";
      EXPECT_NEAR(f.velocity_limit_rad_s, std::abs(row.multiplier) * d.velocity_limit_rad_s, 1e-9);
      EXPECT_NEAR(f.stand_rad, row.offset, 1e-9);
      const Params params = make_params(entity);
      EXPECT_NEAR(followed(params.joint[f.follows], params.joint[&f - entity.joints.data()], 0.25F),
                  row.multiplier * 0.25 + row.offset, 1e-5);
    }
  }
}

TEST(Mimic, CouplingsThatAreNoneAreRefusedWhereTheyStand) {
  const auto hips = [](const std::string& instead) { return replaced(urdf(), kHips, instead); };
  expect_refused(hips("<mimic joint=\"r_hip_yaw\"/>"), wrapper(), "itself",
                 "<joint name=\"r_hip_yaw\"");
  expect_refused(hips("<mimic joint=\"tail\"/>"), wrapper(), "which there is not", "\"tail\"");
  expect_refused(hips("<mimic joint=\"spine\"/>"), wrapper(), "doesn't turn", "\"spine\"/>");
  expect_refused(hips("<mimic joint=\"l_finger_1\"/>"), wrapper(), "doesn't turn",
                 "<mimic joint=\"l_finger_1\"/>");
  expect_refused(hips("<mimic joint=\"l_hip_yaw\" multiplier=\"0\"/>"), wrapper(), "0 times",
                 "multiplier=\"0\"");
  expect_refused(hips("<mimic joint=\"l_hip_yaw\" multiplier=\"-1\" offset=\"2.5\"/>"), wrapper(),
                 "leave it no way", "offset=\"2.5\"");
  expect_refused(hips("<mimic joint=\"l_hip_yaw\"/>"), wrapper(), "opposite ways",
                 "<mimic joint=\"l_hip_yaw\"/>");
  expect_refused(hips("<mimic joint=\"l_hip_roll\" multiplier=\"-1\"/>"), wrapper(), "a motor each",
                 "<mimic joint=\"l_hip_roll\"");
  const std::string chain =
      replaced(urdf(), "<axis xyz=\"0 1 0\"/><limit lower=\"-2.5\"",
               "<mimic joint=\"r_hip_yaw\"/><axis xyz=\"0 1 0\"/><limit lower=\"-2.5\"");
  expect_refused(chain, wrapper(), "which mimics 'l_hip_yaw'", "<mimic joint=\"r_hip_yaw\"");
}

TEST(Mimic, FollowerWithAServoOrAPoseOfItsOwnIsRefusedInTheWrapper) {
  const std::string servo = "<verp:servo joint=\"r_hip_yaw\" id=\"30\" type=\"xm430_w210\"/>";
  expect_refused(urdf(), replaced(wrapper(), "</verp:bus>", servo + "</verp:bus>"),
                 "whose servo turns both", "joint=\"r_hip_yaw\" id=\"30\"");
  const std::string own = "<verp:drop what=\"mimic\" name=\"r_hip_yaw\" reason=\"rebuilt\"/>";
  const std::string two = replaced(wrapper(), "</verp:bus>", servo + "</verp:bus>" + own);
  EXPECT_EQ(make_params(Odd(urdf(), two).load()).followers, 0);
  const std::string arm =
      "<verp:mimic joint=\"r_shoulder\" follows=\"l_shoulder\"/>\n"
      "<verp:pose name=\"stand\"><verp:joint name=\"r_shoulder\" "
      "rad=\"0.5\"/></verp:pose>\n<verp:imu";
  const std::string posed = replaced(
      replaced(wrapper(), "<verp:servo joint=\"r_shoulder\" id=\"3\" type=\"xm430_w210\"/>", ""),
      "<verp:imu", arm);
  expect_refused(urdf(), posed, "takes it to 0", "rad=\"0.5\"");
}

}  // namespace
}  // namespace verp::model
