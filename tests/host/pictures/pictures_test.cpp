#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "host/os/files/places.hpp"
#include "host/os/files/temporary_directory.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/show/render/files.hpp"
#include "host/show/render/offscreen_context.hpp"
#include "host/show/render/renderer.hpp"
#include "host/show/scene/build.hpp"
#include "tests/host/tool/program.hpp"

namespace verp::render {
namespace {

using scene::Vec3;

struct Bench {
  OffscreenContext context;
  Renderer renderer;
  scene::Scene scene = scene::studio();
  scene::Snapshot now;
  scene::Camera camera;
  Size size{160, 120};

  Bench() {
    scene::Item ball;
    ball.name = "ball";
    ball.node = scene::kWorld;
    ball.shape = scene::Shape::kSphere;
    ball.size_m = {0.1, 0, 0};
    ball.pose.translation() = Vec3(1, 0, 0.3);
    ball.material.colour = {0.8F, 0.1F, 0.1F, 1};
    scene::Item wall = ball;
    wall.name = "wall";
    wall.shape = scene::Shape::kBox;
    wall.size_m = {0.1, 4, 4};
    wall.pose.translation() = Vec3(3.05, 0, 0.3);
    wall.material.colour = {0.5F, 0.5F, 0.5F, 1};
    scene.items = {ball, wall};
    camera.eye_m = Vec3(0, 0, 0.3);
    camera.target_m = Vec3(1, 0, 0.3);
    renderer.set_scene(scene);
  }
  Image image(const Effects& effects = {}) { return renderer.image(now, camera, size, effects); }
  std::size_t middle() const {
    return static_cast<std::size_t>(size.height / 2 * size.width + size.width / 2);
  }
};

/// In steps of 255.
double apart(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += std::abs(a.rgb[i] - b.rgb[i]);
  return sum / static_cast<double>(a.rgb.size());
}

TEST(Renderer, DepthAndLabelsAreThoseOfTheSceneToTheMillimetre) {
  Bench bench;
  const Measured seen = bench.renderer.measure(bench.now, bench.camera, bench.size);
  const std::size_t corner = static_cast<std::size_t>(10 * bench.size.width + 10);
  EXPECT_NEAR(seen.depth_m[bench.middle()], 0.9, 1e-3);
  EXPECT_NEAR(seen.depth_m[corner], 3.0, 1e-3);
  EXPECT_EQ(scene::label_name(bench.scene, seen.label[bench.middle()]), "ball");
  EXPECT_EQ(scene::label_name(bench.scene, seen.label[corner]), "wall");
  const Renderer::Hit hit = bench.renderer.pick(bench.now, bench.camera, bench.size, 80, 60);
  EXPECT_EQ(hit.item, 0);
  EXPECT_NEAR(hit.point_world_m.x(), 0.9, 2e-3);
}

TEST(Renderer, TwoPicturesOfOneInstantAreTheSameBytes) {
  Bench bench;
  EXPECT_EQ(bench.image().rgb, bench.image().rgb);
}

TEST(Renderer, EachEffectChangesThePictureAsMeant) {
  Bench bench;
  const Image all = bench.image();
  const auto without = [&](auto change) {
    Effects effects;
    change(effects);
    return apart(all, bench.image(effects));
  };
  EXPECT_GT(without([](Effects& e) { e.shadows = false; }), 0.05);
  EXPECT_GT(without([](Effects& e) { e.antialias = false; }), 0.01);
  EXPECT_GT(without([](Effects& e) { e.ground = false; }), 1.0);
  EXPECT_GT(without([](Effects& e) { e.ground_grid = false; }), 0.02);
  EXPECT_GT(without([](Effects& e) { e.visuals = false; }), 5.0);
  bench.scene.fog = {true, {1, 1, 1, 1}, 0.5, 3};
  bench.renderer.set_looks(bench.scene);
  const Image fog = bench.image();
  EXPECT_GT(apart(all, fog), 3.0);
  Effects clear;
  clear.fog = false;
  EXPECT_EQ(apart(all, bench.image(clear)), 0);
  bench.scene.items[1].material.glow = {0, 0, 0, 1};
  const auto at_wall = [&](double begin_m, double end_m, double density_1_m, bool squared) {
    bench.scene.fog = {true, {1, 1, 1, 1}, begin_m, end_m, density_1_m, squared};
    bench.renderer.set_looks(bench.scene);
    return bench.image().rgb[3 * (10 * std::size_t(bench.size.width) + 20)];
  };
  // 3.4 m to the corner: density 0.2 leaves e^-0.68, squared e^-0.46.
  const int thin = at_wall(0, 1e6, 0, false), thick = at_wall(0, 0.01, 0, false);
  EXPECT_EQ(thick, 255);
  EXPECT_GT(at_wall(4, 30, 0.2, false), thin + 20);
  EXPECT_GT(at_wall(4, 30, 0.2, false), at_wall(4, 30, 0.2, true) + 3);
  EXPECT_GT(at_wall(4, 30, 3, true), 253);
  EXPECT_NEAR(at_wall(4, 30, 0.2, false), at_wall(0, 3.4 / (1 - std::exp(-0.68)), 0, false), 6);
  bench.scene.fog.on = false;
  bench.scene.items[1].material.glow = {0, 0.8F, 0, 1};
  bench.renderer.set_looks(bench.scene);
  const Image opaque = bench.image();
  bench.scene.items[0].material.colour.a = 0.4F;
  bench.renderer.set_looks(bench.scene);
  const std::size_t green = 3 * bench.middle() + 1;
  EXPECT_GT(bench.image().rgb[green], opaque.rgb[green] + 20);  // the wall behind it
  Effects solid;
  solid.transparency = false;
  EXPECT_LT(apart(opaque, bench.image(solid)), 0.5);  // the ball casts no shadow
}

TEST(Renderer, NumbersThatAreNotFiniteAndFilesThatAreNoMeshesAreLeftOut) {
  Bench bench;
  scene::Item bad = bench.scene.items[0];
  bad.shape = scene::Shape::kMesh;
  bad.size_m = {1, 1, 1};
  bad.mesh_file = VERP_PROGRAM;
  bench.scene.items.push_back(bad);
  bad.mesh_file = "/nowhere/a.stl";
  bench.scene.items.push_back(bad);
  bench.scene.items[0].pose.translation().x() = std::nan("");
  bench.renderer.set_scene(bench.scene);
  ASSERT_EQ(bench.renderer.notes().size(), 2u);
  EXPECT_NE(bench.renderer.notes()[0].find("not a mesh"), std::string::npos)
      << bench.renderer.notes()[0];
  EXPECT_NE(bench.renderer.notes()[1].find("no such file"), std::string::npos);
  EXPECT_NEAR(bench.renderer.measure(bench.now, bench.camera, bench.size).depth_m[bench.middle()],
              3.0, 1e-3);
  EXPECT_THROW(bench.renderer.image(bench.now, bench.camera, {100000, 10}), RenderError);
}

std::string stl_of(const std::vector<Eigen::Vector3f>& corners) {
  std::string bytes(84, '\0');
  const auto count = static_cast<std::uint32_t>(corners.size() / 3);
  std::memcpy(bytes.data() + 80, &count, sizeof count);
  for (std::size_t t = 0; t < count; ++t) {
    bytes.append(12, '\0');
    bytes.append(reinterpret_cast<const char*>(&corners[3 * t]), 36);
    bytes.append(2, '\0');
  }
  return bytes;
}

void keep(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

TEST(Meshes, WithACornerThatIsNoNumberAreRefused) {
  const files::TemporaryDirectory folder;
  const std::filesystem::path file = folder.path() / "a.stl";
  keep(file, stl_of({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(read_mesh(file.string()).indices.size(), 3u);
  for (const float bad : {std::nanf(""), 1e20F, -INFINITY}) {
    keep(file, stl_of({{bad, 0, 0}, {0, 1, 0}, {1, 0, 0}}));
    EXPECT_THROW(read_mesh(file.string()), RenderError) << bad;
  }
}

}  // namespace
}  // namespace verp::render

namespace verp::tool::test {
namespace {

class Pictures : public Program {
 protected:
  /// Mean difference from a picture seen by a person.
  double from_golden(const std::string& name) const {
    const render::Image now = render::read_png((folder_ / name).string());
    const render::Image then = render::read_png(std::string(VERP_GOLDEN) + "/" + name);
    EXPECT_EQ(now.rgb.size(), then.rgb.size());
    return now.rgb.size() == then.rgb.size() ? render::apart(now, then) : 255;
  }
};

// Drivers differ at edges; a missing leg is 3 and more.
constexpr double kDriver = 1.5;

TEST_F(Pictures, AStandingRobotAndItsEyeAreAsSomebodyLookedAtThem) {
  ASSERT_EQ(verp("shot generic21 -o stands.png --size 320x240").status, 0);
  EXPECT_LT(from_golden("stands.png"), kDriver);
  ASSERT_EQ(verp("shot generic21 -o back.png --camera back --size 320x240").status, 0);
  EXPECT_GT(render::apart(render::read_png((folder_ / "back.png").string()),
                          render::read_png((folder_ / "stands.png").string())),
            2.0);
  ASSERT_EQ(verp("shot generic21 -o depth.png --depth --size 160x120").status, 0);
  const Outcome parts = verp("shot generic21 -o parts.png --segmentation --size 320x240 --json");
  ASSERT_EQ(parts.status, 0) << parts.err;
  const auto labels = nlohmann::json::parse(parts.out).at("labels");
  EXPECT_GT(labels.size(), 15u);
  EXPECT_TRUE(std::any_of(labels.begin(), labels.end(), [](const auto& label) {
    return label.at("name") == "generic21/trunk" && label.at("pixels") > 1000;
  })) << labels;
}

TEST_F(Pictures, TheEyeDistancesAndAFilmstripAreAsSomebodyLookedAtThem) {
  ASSERT_EQ(verp("shot --world demo --camera head -o eye.png --size 320x240").status, 0);
  EXPECT_LT(from_golden("eye.png"), kDriver);
  ASSERT_EQ(verp("shot --world demo --camera head --depth -o depth.png --size 160x120").status, 0);
  EXPECT_LT(from_golden("depth.png"), kDriver);
  ASSERT_EQ(verp("shot generic21 --for 6 --states -o states.png --size 640x240").status, 0);
  EXPECT_LT(from_golden("states.png"), kDriver);
}

TEST_F(Pictures, OfAWalkAndOfItsTraceShowTheSameInstantAndTheWalkKeepsItsBits) {
  const Outcome walk = as_typed("walk generic21 --for 3 --record a.mcap --json");
  ASSERT_EQ(walk.status, 0) << walk.err;
  ASSERT_EQ(verp("shot a.mcap --at 4 -o trace.png --size 320x240").status, 0);
  ASSERT_EQ(verp("shot generic21 --for 3 --at 4 -o twin.png --size 320x240").status, 0);
  EXPECT_LT(render::apart(render::read_png((folder_ / "trace.png").string()),
                          render::read_png((folder_ / "twin.png").string())),
            1.0);
  for (const char* marks : {"", " --marks"})
    expect_refused(std::string("shot a.mcap --at 30 -o late.png") + marks,
                   "--at 30: the run is over");
  ASSERT_EQ(verp("video a.mcap -o a.gif --from 3 --to 3.4 --fps 10 --size 64x64").status, 0);
  EXPECT_EQ(slurp(folder_ / "a.gif").substr(0, 6), "GIF89a");
}

TEST_F(Pictures, AnImportedRobotsPageShowsIt) {
  const auto odd = files::source_dir() / "tests/host/model/odd_robot/odd.urdf";
  const Outcome made = verp("import " + odd.string() + " -o odd");
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(slurp(folder_ / "odd" / "import.md").find("(import.png)"), std::string::npos);
  EXPECT_EQ(render::read_png((folder_ / "odd" / "import.png").string()).size.width, 640);
}

TEST_F(Pictures, WrongWordsAndMissingThingsCostOneLineEach) {
  expect_refused("shot generic21 -o a.png --camera moon", "three-quarter, front");
  expect_refused("shot generic21 -o a.png --size 5x", "--size 5x");
  expect_refused("shot generic21 -o a.jpg", ".png");
  expect_refused("shot generic21 -o none/a.png", "no folder");
  expect_refused("shot nobody -o a.png", "nobody");
  expect_refused("shot generic21 -o /proc/a.png", "/proc/a.png: cannot be written");
  expect_refused("shot none.mcap -o a.png", "no such file");
  expect_refused("shot generic21", "-o");
  expect_refused("shot none.mcap -o a.png --world demo", "--world is of a walk");
  expect_refused("video none.mcap -o a.mp4 --seed 3", "--seed is of a walk");
  expect_refused("video generic21 -o a.mp4 --from 2 --to 1", "--to 1");
  expect_refused("video generic21 -o a.avi", ".mp4");
  const Outcome no_driver = shell(
      "EGL_PLATFORM=none LIBGL_DRIVERS_PATH=/nowhere __EGL_VENDOR_LIBRARY_FILENAMES=/dev/null " +
      std::string(VERP_PROGRAM) + " shot generic21 -o a.png");
  EXPECT_EQ(no_driver.status, 3) << no_driver.err;
  EXPECT_EQ(std::count(no_driver.err.begin(), no_driver.err.end(), '\n'), 1) << no_driver.err;
  EXPECT_NE(no_driver.err.find("GL driver"), std::string::npos) << no_driver.err;
  const Outcome no_swrast = shell("LIBGL_DRIVERS_PATH=/nowhere " + std::string(VERP_PROGRAM) +
                                  " shot generic21 -o a.png");  // Mesa prints more
  EXPECT_EQ(no_swrast.status, 3) << no_swrast.err;
  EXPECT_EQ(std::count(no_swrast.err.begin(), no_swrast.err.end(), '\n'), 1) << no_swrast.err;
  const Outcome no_ffmpeg =
      shell("PATH=/nowhere " + std::string(VERP_PROGRAM) + " video generic21 -o a.mp4");
  EXPECT_EQ(no_ffmpeg.status, 3);
  EXPECT_NE(no_ffmpeg.err.find("apt-get install ffmpeg"), std::string::npos) << no_ffmpeg.err;
  EXPECT_EQ(shell("ls *.part").out, "");
}

TEST_F(Pictures, AWorldsFileSwitchesEffectsOff) {
  ASSERT_EQ(verp("shot generic21 -o paint.png --size 64x64").status, 0);
  const auto world = [this](const std::string& in_scene) {
    const auto box = [](const std::string& name, const std::string& pose, const std::string& look) {
      return "<model name='" + name + "'><static>true</static><pose>" + pose +
             " 0 0 0</pose><link name='l'><visual name='v'><geometry><box><size>0.1 0.4 0.4</size>"
             "</box></geometry>" +
             look + "</visual></link></model>";
    };
    std::ofstream(folder_ / "w.sdf")
        << "<sdf version='1.9' xmlns:verp='verp'><world name='w'><scene>" << in_scene
        << "</scene><model name='floor'><static>true</static><link name='l'><collision name='c'>"
           "<geometry><plane><normal>0 0 1</normal></plane></geometry></collision></link></model>"
        << box("painted", "1 0.3 0.3",
               "<material><diffuse>1 1 1 "
               "1</diffuse><pbr><metal><albedo_map>paint.png</albedo_map></metal></pbr></material>")
        << box("glass", "1 -0.3 0.3", "<transparency>0.6</transparency>") << "</world></sdf>";
  };
  const auto picture = [&](const std::string& words) {
    const Outcome shot = verp("shot --world w.sdf --camera head -o a.png --size 160x120" + words);
    EXPECT_EQ(shot.status, 0) << shot.err;
    return render::read_png((folder_ / "a.png").string());
  };
  world("");
  const render::Image all = picture("");
  for (const std::string effect : {"antialias", "textures", "transparency"}) {
    world("");
    const render::Image asked = picture(" --no-" + effect);
    EXPECT_GT(render::apart(all, asked), 0.01) << effect;
    world("<verp:effects " + effect + "='false'/>");
    EXPECT_EQ(picture("").rgb, asked.rgb) << effect;
    world("<verp:effects " + effect + "='true'/>");
    EXPECT_EQ(picture("").rgb, all.rgb) << effect;
  }
  world("<sky/>");
  EXPECT_GT(render::apart(all, picture("")), 0.01);
  world("<verp:effects textures='maybe'/>");
  expect_refused("shot --world w.sdf -o a.png", "textures=\"maybe\"");
}

TEST_F(Pictures, AMeshThatIsNotThereIsSaidInALineAndAWorldShowsThoseOfAnyFormat) {
  const std::string robot = slurp(model::find_model("generic21"));
  const std::size_t from = robot.find("<geometry>", robot.find("<visual")),
                    to = robot.find("</geometry>", from);
  std::ofstream(folder_ / "r.sdf")
      << robot.substr(0, from) << "<geometry><mesh><uri>gone.stl</uri></mesh>" << robot.substr(to);
  const Outcome gone = verp("shot r.sdf -o a.png --size 160x120");
  EXPECT_EQ(gone.status, 0) << gone.err;
  EXPECT_NE(gone.err.find("no mesh 'gone.stl' of link 'trunk'"), std::string::npos) << gone.err;
  EXPECT_EQ(std::count(gone.err.begin(), gone.err.end(), '\n'), 1) << gone.err;

  std::ofstream(folder_ / "wall.obj")
      << "v 0 -1 0\nv 0 1 0\nv 0 1 2\nv 0 -1 2\nf 1 2 3 4\nf 4 3 2 1\n";
  const auto world = [this](const std::string& mesh) {
    std::ofstream(folder_ / "w.sdf")
        << "<sdf version='1.9'><world name='w'><model name='floor'><static>true</static><link "
           "name='l'><collision name='c'><geometry><plane><normal>0 0 1</normal></plane></geometry>"
           "</collision></link></model><model name='wall'><static>true</static><pose>1 0 0 0 0 0"
           "</pose><link name='l'><visual name='v'><geometry><mesh><uri>"
        << mesh << "</uri></mesh></geometry></visual></link></model></world></sdf>";
  };
  world("wall.obj");
  const Outcome seen = verp("shot --world w.sdf -o parts.png --segmentation --camera head --json");
  ASSERT_EQ(seen.status, 0) << seen.err;
  EXPECT_NE(seen.out.find("\"wall\""), std::string::npos) << seen.out;
  std::ofstream(folder_ / "junk.dae") << "no mesh";
  world("junk.dae");
  const Outcome junk = verp("shot --world w.sdf -o a.png --size 160x120");
  EXPECT_EQ(junk.status, 0);
  EXPECT_NE(junk.err.find("junk.dae: not a mesh"), std::string::npos) << junk.err;
  EXPECT_EQ(std::count(junk.err.begin(), junk.err.end(), '\n'), 1) << junk.err;
}

}  // namespace
}  // namespace verp::tool::test
