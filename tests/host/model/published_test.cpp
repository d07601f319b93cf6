#include "tests/host/model/test_files.hpp"

/// Our own robot with published URDF files' habits: placeholder limits, inertias in g m2, mesh
/// collisions, frames with a shape and no mass, no sole frames.
namespace verp::model {
namespace {

const std::string kPublished = VERP_SOURCE_DIR "/tests/host/model/published_robot/";

LoadError refusal_without(const std::string& correction) {
  const TemporaryFile urdf("published.urdf", read_text(kPublished + "published.urdf"));
  const std::string name = std::filesystem::path(urdf.path()).filename().string();
  std::string text = without_element(read_text(kPublished + "robot.sdf"), correction);
  text.replace(text.find("published.urdf"), std::string("published.urdf").size(), name);
  const TemporaryFile wrapper("robot.sdf", text);
  return refusal_of(wrapper.path());
}

TEST(Published, CorrectedByItsWrapperItIsTheOddRobot) {
  expect_same_robot(load_robot(kPublished + "robot.sdf"),
                    load_robot(VERP_SOURCE_DIR "/tests/host/model/odd_robot/robot.sdf"));
}

TEST(Published, InertiasAreRefusedUnlessCorrected) {
  const LoadError error = refusal_without("<verp:inertia link=\"*\"");
  EXPECT_NE(error.message.find("radius of gyration"), std::string::npos) << error.what();
  EXPECT_NE(error.fix.find("<verp:inertia"), std::string::npos) << error.fix;
}

TEST(Published, MeshCollisionIsRefusedUnlessDropped) {
  const LoadError error = refusal_without("<verp:drop what=\"collision\"");
  EXPECT_NE(error.message.find("mesh"), std::string::npos) << error.what();
}

TEST(Published, AFrameWithAShapeAndNoMassIsRefusedUnlessDropped) {
  const LoadError error = refusal_without("<verp:drop what=\"massless_link\"");
  EXPECT_NE(error.message.find("'camera_mount' has a shape and no mass"), std::string::npos)
      << error.what();
}

}  // namespace
}  // namespace verp::model
