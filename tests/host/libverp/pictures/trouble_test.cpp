#include <dirent.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include "host/robot/model/find.hpp"
#include "host/show/camera/painter.hpp"
#include "tests/host/libverp/expect_error.hpp"
#include "tests/host/libverp/pictures/pictures.hpp"

namespace verp::abi::test {
namespace {

std::vector<pid_t> drawing() {
  std::vector<pid_t> found;
  DIR* const all = ::opendir("/proc");
  while (const dirent* entry = ::readdir(all)) {
    std::ifstream stat("/proc/" + std::string(entry->d_name) + "/stat");
    pid_t id = 0, parent = 0;
    std::string name, state;
    if (stat >> id >> name >> state >> parent && parent == ::getpid() && state != "Z" &&
        name == "(verp_camera)")
      found.push_back(id);
  }
  ::closedir(all);
  return found;
}

TEST(LibverpSightTrouble, ProgramThatIsKilledIsToldOfAndTheNextCallHasAnother) {
  Looking looking;
  looking.add();
  looking.tick(30);
  const auto before = looking.colour();
  ASSERT_EQ(drawing().size(), 1U);
  ASSERT_EQ(::kill(drawing()[0], SIGKILL), 0);
  EXPECT_EQ(looking.colour(), before) << "it has been drawn, and did not change";
  const verp_view view = Looking::view("front");
  std::vector<std::uint8_t> pixels(std::size_t{3} * view.width * view.height);
  expect_error(verp_session_render(looking.session, &view, pixels.data(), pixels.size()),
               VERP_FAILED, "verp_session_render", "killed by signal 9");
  looking.render(view);
  looking.tick(5);
  ASSERT_EQ(::kill(drawing().at(0), SIGKILL), 0);
  std::vector<std::uint8_t> seen(before.size());
  expect_error(
      verp_session_picture(looking.session, 0, 0, VERP_COLOUR, seen.data(), seen.size(), nullptr),
      VERP_FAILED, "verp_session_picture", "killed by signal 9");
  EXPECT_NE(looking.colour(), before);
  ASSERT_EQ(verp_session_close(looking.session), VERP_OK);
  EXPECT_TRUE(drawing().empty()) << "it goes with its session";
}

TEST(LibverpSightTrouble, ThreadThatAskedFirstMayEnd) {
  Looking looking;
  looking.add();
  looking.tick(30);
  std::thread([&] { looking.render(Looking::view("front")); }).join();
  const auto ids = drawing();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  looking.render(Looking::view("side"));
  EXPECT_EQ(drawing(), ids) << "the same one draws";
}

TEST(LibverpSightTrouble, RobotThatJoinsLaterIsSeen) {
  Looking looking;
  looking.add();
  verp_view view = Looking::view("front");
  const auto one = looking.render(view);
  looking.add([](verp_robot& robot) { robot.y_m = 0.4; });
  EXPECT_NE(looking.render(view), one);
  view.robot = 1;
  looking.render(view);
  EXPECT_EQ(drawing().size(), 1U);
}

TEST(LibverpSightTrouble, ViewThatIsNoneIsRefusedAndTheProgramDrawsOn) {
  Looking looking;
  looking.add();
  looking.render(Looking::view("front"));
  const auto ids = drawing();
  const verp_view view = Looking::view("moon");
  std::vector<std::uint8_t> pixels(std::size_t{3} * view.width * view.height);
  expect_error(verp_session_render(looking.session, &view, pixels.data(), pixels.size()),
               VERP_BAD_ARGUMENT, "verp_session_render", "no view 'moon'; there are three-quarter");
  looking.render(Looking::view("front"));
  EXPECT_EQ(drawing(), ids);
}

TEST(LibverpSightTrouble, ControllerAndSecondThreadAreTold) {
  Looking looking;
  looking.add();
  struct Seen {
    const Looking& looking;
    int own = VERP_OK, other = VERP_OK;
    std::string why = {};
    std::vector<std::uint8_t> pixels = std::vector<std::uint8_t>(std::size_t{3} * 320 * 240);
    int ask() {
      return verp_session_picture(looking.session, 0, 0, VERP_COLOUR, pixels.data(), pixels.size(),
                                  nullptr);
    }
  } seen{looking};
  const auto controller = [](const verp_moment* moment, void* user) {
    auto* const told = static_cast<Seen*>(user);
    told->own = told->ask();
    told->why = verp_last_error();
    std::thread([told] { told->other = told->ask(); }).join();
    return verp_decide(moment->token);
  };
  ASSERT_EQ(verp_session_control(looking.session, 0, controller, &seen), VERP_OK);
  looking.tick(1);
  EXPECT_EQ(seen.own, VERP_BUSY);
  EXPECT_EQ(seen.other, VERP_BUSY);
  EXPECT_EQ(seen.why.rfind("verp_session_picture: another thread", 0), 0U) << seen.why;
}

TEST(Painter, WaitsForNobodyForEver) {
  using camera::Painter;
  const camera::Stage stage{.robots = {{model::find_model("generic21"), 1}}, .world_file = ""};
  const auto why = [&](const auto& act) {
    try {
      act();
    } catch (const camera::CameraError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  const auto silent =
      std::filesystem::temp_directory_path() / ("verp-silent-" + std::to_string(::getpid()));
  std::ofstream(silent) << "#!/bin/sh\nexec sleep 600\n";
  std::filesystem::permissions(silent, std::filesystem::perms::owner_all);
  EXPECT_NE(why([&] { Painter(silent, stage, Painter::Seconds(1)); }).find("not answered for 1 s"),
            std::string::npos);
  std::filesystem::remove(silent);
  // A busy PC needs over two seconds to start it.
  std::optional<Painter> painter;
  int patience_s = 1;
  std::string late;
  while (!painter && patience_s < 64) {
    patience_s *= 2;
    const Painter::Seconds patience(patience_s);
    late = why([&] { painter.emplace(camera::find_program(), stage, patience); });
  }
  ASSERT_TRUE(painter) << late;
  ASSERT_EQ(::kill(drawing().at(0), SIGSTOP), 0);
  const std::string answered = why([&] { painter->look(camera::Moment{}); });
  EXPECT_NE(answered.find("not answered for " + std::to_string(patience_s) + " s"),
            std::string::npos)
      << answered;
  EXPECT_FALSE(painter->works());
  EXPECT_TRUE(drawing().empty());
  EXPECT_NE(why([&] { painter->look(camera::Moment{}); }).find("has ended"), std::string::npos);
}

}  // namespace
}  // namespace verp::abi::test
