#include <algorithm>

#include "host/author/import/import.hpp"
#include "host/os/files/temporary_directory.hpp"
#include "tests/host/edit/files.hpp"
#include "tests/host/model/test_files.hpp"
#include "tests/host/scene/meshes.hpp"

/// Other makers' untouched files, through our wrappers.
namespace verp {
namespace {

constexpr const char* kOp3 = "model://op3/op3.urdf";
constexpr const char* kDarwin = "model://darwin_op/darwin_op_robot.urdf";

/// A failure says where to put the file.
std::string file_of(const char* uri) {
  const std::string file = model::resolve_model_uri(uri, ".");
  EXPECT_FALSE(file.empty()) << uri << " is not in " << model::model_path_text()
                             << ": set VERP_MODEL_PATH";
  return file;
}

std::string wrapper(const std::string& name) {
  return VERP_SOURCE_DIR "/common/robots/" + name + "/robot.sdf";
}

/// Without one correction.
model::LoadError refusal_without(const std::string& name, const std::string& correction) {
  const model::TemporaryFile file(
      "robot.sdf", model::without_element(model::read_text(wrapper(name)), correction));
  return model::refusal_of(file.path());
}

TEST(ThirdParty, TablesSayWhatTheMakersFilesSay) {
  for (const std::string name : {"op3", "darwin_op"}) {
    SCOPED_TRACE(name);
    model::expect_same_robot(model::load_robot(wrapper(name)),
                             model::load_robot(wrapper(name + "_urdf")));
  }
}

TEST(ThirdParty, InertiasOfDarwinOpAreRefusedUnlessCorrected) {
  ASSERT_FALSE(file_of(kDarwin).empty());
  const model::LoadError error = refusal_without("darwin_op_urdf", "<verp:inertia link=\"*\"");
  EXPECT_NE(error.message.find("radius of gyration"), std::string::npos) << error.what();
  EXPECT_NE(error.fix.find("<verp:inertia"), std::string::npos);
}

TEST(ThirdParty, MeshCollisionOfOp3IsRefusedUnlessDropped) {
  ASSERT_FALSE(file_of(kOp3).empty());
  const model::LoadError error = refusal_without("op3_urdf", "<verp:drop what=\"collision\"");
  EXPECT_NE(error.message.find("mesh"), std::string::npos) << error.what();
}

TEST(ThirdParty, Op3KeepsItsMaterialsAndTheMeshesThatAreThere) {
  const scene::MeshCount count = scene::meshes_of(model::load_robot(wrapper("op3_urdf")));
  EXPECT_GT(count.there, 0u) << "the feet's";
  EXPECT_GT(count.missing, 0u) << "all others";
  EXPECT_EQ(count.coloured, count.there + count.missing);
}

TEST(ThirdParty, OfTheirFilesOnlyTheEditedLineChanges) {
  edit::expect_a_mass_changes_one_line(file_of(kOp3));
  edit::expect_a_mass_changes_one_line(file_of(kDarwin));
}

TEST(ThirdParty, RobotsImportFromTheirUntouchedFiles) {
  struct Known {
    const char *uri, *left_knee, *right_sole;
  };
  for (const Known& each :
       {Known{"model://op3/op3.urdf", "l_knee", "127 by 80 mm under r_ank_roll_link"},
        Known{"model://darwin_op/darwin_op_robot.urdf", "LKnee", "104 by 66 mm under MP_ANKLE2_R"},
        Known{"model://toddlerbot/toddlerbot.urdf", "left_knee", "under ank_roll_link_2"},
        Known{"model://toddlerbot/toddlerbot.xml", "left_knee",
              "120 by 42 mm under ank_roll_link_2"},
        Known{"model://op3_mjcf/op3_mjx_feetonly.xml", "l_knee",
              "127 by 78 mm under r_ank_roll_link"},
        Known{"model://t1_mjcf/t1_mjx_feetonly.xml", "Left_Knee_Pitch", "223 by 100 mm"}}) {
    const std::string file = file_of(each.uri);
    const files::TemporaryDirectory folder;
    import::Wish wish{file, folder.path().string(), "", ""};
    import::make_urdf(wish);
    const import::Imported robot = import::import_robot(wish);
    EXPECT_EQ(robot.refusal, "") << each.uri;
    const auto says = [&](const std::string& what, const std::string& value) {
      return std::any_of(robot.findings.begin(), robot.findings.end(), [&](const auto& finding) {
        return finding.what == what && finding.value.find(value) != std::string::npos;
      });
    };
    EXPECT_TRUE(says("left_leg", each.left_knee)) << each.uri;
    EXPECT_TRUE(says("right sole", each.right_sole)) << each.uri;
    EXPECT_TRUE(says("ahead", "(1, 0, 0)")) << each.uri;
  }
}

}  // namespace
}  // namespace verp
