#include <fcntl.h>
#include <linux/joystick.h>
#include <sys/stat.h>
#include <unistd.h>

#include <QAction>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QMenu>
#include <QSlider>
#include <memory>
#include <set>

#include "common/safety/machine.hpp"
#include "host/apps/view/state_panel.hpp"
#include "tests/host/session/plans.hpp"
#include "tests/host/shadow/polled_controller.hpp"
#include "tests/host/view/window_fixture.hpp"

namespace verp::view {
namespace {

TEST_F(Window, EachEffectIsSwitchedByItsMenuAndBack) {
  watch_robot();
  window_.player()->pause();
  ASSERT_TRUE(wait_for([&] { return window_.scene().drawn() > 0; }));
  QTest::qWait(100);
  auto* menu = find<QMenu>("show");
  std::set<QString> seen;
  for (QAction* action : menu->actions()) {
    if (!action->isCheckable()) continue;
    emit menu->aboutToShow();
    const QImage before = window_.scene().grabFramebuffer();
    action->toggle();
    if (window_.scene().grabFramebuffer() != before) seen.insert(action->text());
    action->toggle();
    EXPECT_EQ(window_.scene().grabFramebuffer(), before) << action->text().toStdString();
  }
  // Some worlds have fog, textures or transparency.
  for (const char* effect :
       {"Shadows", "Antialiasing", "Sky", "Floor", "Floor's grid", "Axes of links",
        "Collision shapes", "Centre of mass", "Support polygon"})
    EXPECT_TRUE(seen.contains(effect)) << effect;
}

TEST_F(Window, AControllerAtALinkStandsBesideTheRobotAndIsSaidToBeLost) {
  const std::string path = folder_.filePath("link").toStdString();
  auto controller = std::make_unique<shadow::test::Controller>(
      session::test::plan_of("dxl").params, "unix-listen:" + path, std::chrono::milliseconds(8));
  window_.link_to("unix:" + path);
  watch_robot(20);
  auto* told = find<QLabel>("status_link");
  ASSERT_TRUE(wait_for([&] { return told->text().contains("tick"); }))
      << told->text().toStdString();
  ASSERT_TRUE(wait_for([&] {
    const Picture now = live().film()->last();
    return now && now->robots.size() == 2 && !now->robots[1].link_world.empty();
  }));
  controller.reset();
  ASSERT_TRUE(wait_for([&] { return told->text().startsWith("link lost: "); }))
      << told->text().toStdString();
  const std::uint64_t ticks = live().status().ticks;
  EXPECT_TRUE(wait_for([&] { return live().status().ticks > ticks + 20; })) << "the run goes on";
}

TEST_F(Window, StateAtAScrubbedTickAndAControllerThatGoesOnFromThere) {
  watch_robot(250);
  const QString file = folder_.filePath("run.mcap");
  ASSERT_EQ(live().save(file.toStdString()), "");
  window_.open(file);
  find<QDockWidget>("dock_State")->raise();
  auto* state = find<StatePanel>("state");
  auto* scrub = find<QSlider>("scrub");
  scrub->setValue(scrub->maximum() / 2);
  const auto tick = [&] { return state->value("inputs.tick").toInt(); };
  ASSERT_TRUE(wait_for([&] { return tick() > 50; }));
  const int half = tick();
  scrub->setValue(scrub->maximum() / 4);
  ASSERT_TRUE(wait_for([&] { return tick() < half; }));
  const int quarter = tick();
  auto* how = find<QLabel>("state_how");
  QTest::mouseClick(find<QPushButton>("step_10"), Qt::LeftButton);
  ASSERT_TRUE(wait_for([&] { return tick() == quarter + 10; })) << tick();
  EXPECT_TRUE(how->text().contains("the bits that were recorded")) << how->text().toStdString();
  find<QDoubleSpinBox>("gait.lift_m")->setValue(0.02);
  QTest::mouseClick(find<QPushButton>("step_1"), Qt::LeftButton);
  ASSERT_TRUE(wait_for([&] { return state->different() > 0; }));
  EXPECT_EQ(tick(), quarter + 11);
  EXPECT_EQ(state->value("state.tuning.gait.lift_m"), "0.02");
  QTest::mouseClick(find<QPushButton>("step_back"), Qt::LeftButton);
  ASSERT_TRUE(wait_for([&] { return how->text() == "As recorded"; }));
  EXPECT_EQ(state->different(), 0);
}

TEST_F(Window, AGamepadWalksTheRobotAndUnpluggedItStops) {
  const std::string path = folder_.filePath("js").toStdString();
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const int stick = ::open(path.c_str(), O_RDWR | O_NONBLOCK);
  window_.steer_by(path);
  watch_robot(20);
  js_event push{};
  push.type = JS_EVENT_AXIS;
  push.number = 1;
  push.value = -32767;
  ASSERT_EQ(::write(stick, &push, sizeof push), ssize_t{sizeof push});
  ASSERT_TRUE(wait_for([&] { return mode() == int(safety::Mode::kWalking); }));
  ::close(stick);
  ASSERT_TRUE(wait_for([&] { return mode() == int(safety::Mode::kStanding); }));
}

}  // namespace
}  // namespace verp::view
