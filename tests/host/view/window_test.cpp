#include <QAction>
#include <QCheckBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QMenuBar>
#include <QSlider>
#include <QStatusBar>
#include <QTreeWidget>
#include <QUndoStack>
#include <algorithm>
#include <filesystem>

#include "common/safety/machine.hpp"
#include "host/apps/view/plot_panel.hpp"
#include "host/apps/view/pose_panel.hpp"
#include "host/robot/model/find.hpp"
#include "host/trace/record/replay.hpp"
#include "host/trace/record/trace.hpp"
#include "tests/host/view/window_fixture.hpp"

namespace verp::view {
namespace {

TEST_F(Window, PlaysPausesAndTicksByKeys) {
  watch_robot();
  EXPECT_TRUE(window_.player()->playing());
  key(Qt::Key_P);
  EXPECT_FALSE(window_.player()->playing());
  QTest::qWait(100);
  const std::uint64_t ticks = live().status().ticks;
  key(Qt::Key_Period);
  ASSERT_TRUE(wait_for([&] { return live().status().ticks > ticks; }));
  QTest::qWait(100);
  EXPECT_EQ(live().status().ticks, ticks + 1);
  key(Qt::Key_Comma);
  const auto film = live().film();
  EXPECT_EQ(shown_s(), film->at(film->end_s() - 1e-6)->t_s) << "the very instant before the last";
  EXPECT_TRUE(wait_for([&] { return window_.scene().drawn() > 3; })) << "and was drawn";
}

TEST_F(Window, TheMouseTurnsMovesAndZoomsThePicture) {
  watch_robot(5);
  key(Qt::Key_P);
  ASSERT_TRUE(wait_for([&] { return window_.scene().drawn() > 0; }));
  SceneView& scene = window_.scene();
  const scene::Orbit before = scene.orbit();
  QTest::mousePress(&scene, Qt::LeftButton, {}, middle());
  QTest::mouseMove(&scene, middle() + QPoint(60, 20));
  QMouseEvent drag(QEvent::MouseMove, middle() + QPoint(60, 20), QPointF(), Qt::NoButton,
                   Qt::LeftButton, {});
  QApplication::sendEvent(&scene, &drag);
  QTest::mouseRelease(&scene, Qt::LeftButton, {}, middle() + QPoint(60, 20));
  EXPECT_LT(scene.orbit().azimuth_rad, before.azimuth_rad - 0.2);
  QWheelEvent wheel(middle(), scene.mapToGlobal(middle()), {}, {0, 240}, {}, {}, Qt::NoScrollPhase,
                    false);
  QApplication::sendEvent(&scene, &wheel);
  EXPECT_LT(scene.orbit().distance_m, 0.85 * before.distance_m);
  key(Qt::Key_3);
  EXPECT_EQ(scene.view(), "side");
}

TEST_F(Window, WalksByKeysAndStopsBySpace) {
  watch_robot(20);
  key(Qt::Key_W);
  key(Qt::Key_W);
  key(Qt::Key_Q);
  ASSERT_TRUE(wait_for([&] { return mode() == int(safety::Mode::kWalking); }));
  const std::string file = folder_.filePath("walked.mcap").toStdString();
  key(Qt::Key_Space);
  ASSERT_TRUE(wait_for([&] { return mode() == int(safety::Mode::kStanding); }));
  ASSERT_EQ(live().save(file), "");
  const record::Trace trace = record::read_trace(file);
  int asked_vx = 0, asked_wz = 0;
  for (const TickRecord& tick : trace.ticks) {
    asked_vx = std::max<int>(asked_vx, tick.inputs.command.vx_tenth_mm_s);
    asked_wz = std::max<int>(asked_wz, tick.inputs.command.wz_mrad_s);
  }
  EXPECT_GT(asked_vx, 1500);
  EXPECT_GT(asked_wz, 100);
  EXPECT_FALSE(record::replay(trace).divergence);
}

TEST_F(Window, TheEmergencyStopTakesTheTorque) {
  watch_robot(300);
  key(Qt::Key_Escape);
  ASSERT_TRUE(wait_for([&] { return mode() == int(safety::Mode::kStopped); }));
  ASSERT_TRUE(
      wait_for([&] { return find<QLabel>("fault_emergency stop")->styleSheet().contains("600"); }));
}

TEST_F(Window, AWalkThatIsPushedByTheMouseStepsOnAndThePushIsRecorded) {
  watch_robot(100);
  SceneView& scene = window_.scene();
  ASSERT_TRUE(wait_for([&] { return scene.drawn() > 0; }));
  key(Qt::Key_W);
  ASSERT_TRUE(wait_for([&] { return mode() == int(safety::Mode::kWalking); }));
  live().set_speed(1);
  const auto carries = [&](int foot) {
    return [&, foot] { return live().film()->last()->robots.front().stance == foot; };
  };
  const auto drag = [&](QPoint to) {
    QMouseEvent event(QEvent::MouseMove, to, scene.mapToGlobal(to), Qt::NoButton, Qt::LeftButton,
                      Qt::ShiftModifier);
    QApplication::sendEvent(&scene, &event);
  };
  QTest::mousePress(&scene, Qt::LeftButton, Qt::ShiftModifier, middle());
  drag(middle() + QPoint(40, 0));
  drag(middle() + QPoint(90, 0));
  QTest::mouseRelease(&scene, Qt::LeftButton, Qt::ShiftModifier, middle() + QPoint(90, 0));
  for (const int foot : {0, 1, 0}) EXPECT_TRUE(wait_for(carries(foot), 10)) << "it steps on";
  live().set_speed(0);
  const std::uint64_t ticks = live().status().ticks;
  ASSERT_TRUE(wait_for([&] { return live().status().ticks > ticks + 300; }));
  EXPECT_EQ(mode(), int(safety::Mode::kWalking));
  EXPECT_EQ(live().status().complaint, "");
  const std::string file = folder_.filePath("pushed.mcap").toStdString();
  ASSERT_EQ(live().save(file), "");
  const record::Trace trace = record::read_trace(file);
  ASSERT_EQ(trace.changes.size(), 1U);
  EXPECT_EQ(trace.changes[0].what.rfind("push ", 0), 0U) << trace.changes[0].what;
  EXPECT_GE(trace.changes[0].tick, 99U);
  EXPECT_FALSE(record::replay(trace).divergence);
}

void push_over(LiveRun& run) {
  session::Intervention push{.kind = session::Intervention::Kind::kPush, .name = "trunk"};
  push.force_world_n = {0, 60, 0};
  push.for_s = 0.15;
  run.intervene(push);
}

TEST_F(Window, ARobotThatWasPushedOverGetsUpByAKeyAndWalksOn) {
  watch_robot(400);
  auto* button = find<QPushButton>("get_up");
  EXPECT_FALSE(button->isEnabled()) << "it stands";
  push_over(live());
  ASSERT_TRUE(wait_for([&] { return mode() == int(safety::Mode::kFallen); }));
  ASSERT_TRUE(wait_for([&] { return button->isEnabled(); }));
  const std::uint64_t ticks = live().status().ticks;
  ASSERT_TRUE(wait_for([&] { return live().status().ticks > ticks + 300; }));
  EXPECT_EQ(mode(), int(safety::Mode::kFallen)) << "nobody asked it";
  key(Qt::Key_G);
  ASSERT_TRUE(wait_for([&] { return mode() == int(safety::Mode::kGettingUp); }));
  ASSERT_TRUE(wait_for([&] { return !button->isEnabled(); }));
  ASSERT_TRUE(wait_for([&] { return mode() == int(safety::Mode::kStanding); }));
  EXPECT_TRUE(wait_for([&] {
    return window_.statusBar()->currentMessage().contains("stands again");
  })) << window_.statusBar()->currentMessage().toStdString();
  key(Qt::Key_W);
  ASSERT_TRUE(wait_for([&] { return mode() == int(safety::Mode::kWalking); }));
  const std::string file = folder_.filePath("up.mcap").toStdString();
  ASSERT_EQ(live().save(file), "");
  EXPECT_FALSE(record::replay(record::read_trace(file)).divergence) << "by its actions, too";
}

TEST_F(Window, ARobotThatMayGetUpByItselfNeedsNoWord) {
  watch_robot(20);
  auto* by_itself = find<QAction>("gets_up_by_itself");
  ASSERT_TRUE(wait_for([&] { return by_itself->isEnabled(); }));
  EXPECT_FALSE(by_itself->isChecked());
  by_itself->trigger();
  key(Qt::Key_W);
  ASSERT_TRUE(wait_for([&] { return mode() == int(safety::Mode::kWalking); }));
  push_over(live());
  ASSERT_TRUE(wait_for([&] { return mode() == int(safety::Mode::kFallen); }));
  ASSERT_TRUE(wait_for([&] { return mode() == int(safety::Mode::kWalking); })) << "as ordered";
  EXPECT_TRUE(by_itself->isChecked());
}

TEST_F(Window, ARobotWithoutActionsToGetUpByIsOfferedNone) {
  const QString file = folder_.filePath("robot.sdf");
  std::filesystem::copy(model::find_model("darwin_op"), file.toStdString());
  window_.open(file);
  ASSERT_NE(window_.player(), nullptr);
  live().set_speed(0);
  ASSERT_TRUE(wait_for([&] { return live().status().ticks >= 20; }));
  ASSERT_TRUE(wait_for([&] { return !find<QPushButton>("get_up")->toolTip().isEmpty(); }));
  EXPECT_FALSE(find<QAction>("gets_up_by_itself")->isEnabled());
}

TEST_F(Window, ASignalIsPlottedAndAClickShowsItsInstant) {
  watch_robot(120);
  auto* tree = find<QTreeWidget>("signals");
  QTreeWidgetItem* height = tree->findItems("z", Qt::MatchExactly | Qt::MatchRecursive).front();
  height->setCheckState(0, Qt::Checked);
  const int number = height->data(0, Qt::UserRole).toInt();
  ASSERT_TRUE(wait_for([&] { return window_.plots().points_of(number) > 100; }));
  key(Qt::Key_P);
  QTest::qWait(300);
  auto* plot = window_.plots().findChild<QWidget*>("plot");
  QTest::mouseClick(plot, Qt::LeftButton, {}, QPoint(plot->width() / 2, plot->height() / 2));
  EXPECT_LT(shown_s(), live().film()->end_s() - 0.05);
  EXPECT_FALSE(window_.player()->follows());
}

TEST_F(Window, ANumberChangesWhileItWalksAndIsUndone) {
  watch_robot(30);
  key(Qt::Key_W);
  ASSERT_TRUE(wait_for([&] { return mode() == int(safety::Mode::kWalking); }));
  auto* lift = find<QDoubleSpinBox>("gait.lift_m");
  const double own = lift->value();
  lift->setValue(0.02);
  const auto in_force = [&] { return double(live().status().tuning->gait.lift_m); };
  ASSERT_TRUE(wait_for([&] { return std::abs(in_force() - 0.02) < 1e-6; }));
  EXPECT_TRUE(lift->font().bold());
  QTest::keyClick(&window_, Qt::Key_Z, Qt::ControlModifier);
  ASSERT_TRUE(wait_for([&] { return std::abs(in_force() - own) < 1e-4; }));
  EXPECT_NEAR(lift->value(), own, 1e-4);
  EXPECT_EQ(mode(), int(safety::Mode::kWalking));
}

TEST_F(Window, ATraceIsScrubbedAndPlayed) {
  watch_robot(200);
  const QString file = folder_.filePath("run.mcap");
  ASSERT_EQ(live().save(file.toStdString()), "");
  window_.open(file);
  ASSERT_EQ(window_.player()->live(), nullptr);
  const double begin_s = window_.player()->film()->begin_s();
  auto* scrub = find<QSlider>("scrub");
  scrub->setValue(scrub->maximum() / 2);
  EXPECT_GT(shown_s(), begin_s + 0.5);
  const double half_s = shown_s();
  key(Qt::Key_P);
  ASSERT_TRUE(wait_for([&] { return shown_s() > half_s + 0.2; }));
  EXPECT_GT(window_.plots().points_of(window_.plots().shown().front()), 100);
}

TEST_F(Window, AJointAndAFootMoveInTheHand) {
  watch_robot(5);
  find<QDockWidget>("dock_Pose")->raise();
  QTest::qWait(50);
  auto* knee = find<QSlider>("joint_l_knee");
  knee->setFocus();
  const int before = knee->value();
  for (int i = 0; i < 3; ++i) QTest::keyClick(knee, Qt::Key_PageUp);
  EXPECT_NE(knee->value(), before);
  EXPECT_TRUE(window_.pose().posing());
  EXPECT_FALSE(window_.player()->playing());
  const auto& joints = live().setup().plan().entity.joints;
  const auto moved = std::find_if(joints.begin(), joints.end(),
                                  [](const model::Joint& j) { return j.name == "l_knee"; });
  EXPECT_NEAR(window_.pose().hand()->joint_rad()[std::size_t(moved - joints.begin())],
              knee->value() / 1000.0, 1e-3);
  const scene::Vec3 from = window_.pose().sole_world_m(0);
  SceneView::Hold hold;
  hold.node = 0;
  while (window_.pose().hand()->foot_of(hold.node) != 0) ++hold.node;
  hold.to_world_m = scene::Vec3(0.02, 0, 0.01);
  window_.scene().held(hold);
  EXPECT_LT((window_.pose().sole_world_m(0) - from - hold.to_world_m).norm(), 2e-3)
      << find<QLabel>("reach")->text().toStdString();
  hold.to_world_m = scene::Vec3(0, 0, -1);
  window_.scene().held(hold);
  EXPECT_TRUE(find<QLabel>("reach")->text().contains("out of reach"));
  window_.scene().let_go(hold);
  const auto elbow = std::find_if(joints.begin(), joints.end(),
                                  [](const model::Joint& j) { return j.name == "l_elbow"; });
  hold.node = int(elbow - joints.begin()) + 1;
  const scene::Vec3 grip(0, 0, -0.05);
  const auto at = [&] {
    return window_.pose().picture()->robots[0].link_world[std::size_t(hold.node)] * grip;
  };
  hold.at_world_m = at();
  hold.to_world_m = hold.at_world_m + scene::Vec3(0.03, 0, 0.02);
  window_.scene().held(hold);
  EXPECT_LT((at() - hold.to_world_m).norm(), 1e-3) << find<QLabel>("reach")->text().toStdString();
  EXPECT_TRUE(find<QLabel>("reach")->text().contains("damped least squares"));
}

TEST_F(Window, AFootFollowsTheMouseThatDragsIt) {
  watch_robot();
  SceneView& scene = window_.scene();
  find<QCheckBox>("posing")->click();
  ASSERT_TRUE(window_.pose().posing());
  find<QSlider>("joint_l_knee")->setValue(600);  // a bent knee reaches all ways
  find<QSlider>("joint_r_knee")->setValue(600);
  scene.grabFramebuffer();
  int side = -1;
  const auto held = scene.held;
  scene.held = [&](const SceneView::Hold& hold) {
    side = window_.pose().hand()->foot_of(hold.node);
    if (side >= 0) held(hold);
  };
  const auto move = [&](QPoint to) {
    QMouseEvent event(QEvent::MouseMove, to, scene.mapToGlobal(to), Qt::NoButton, Qt::LeftButton,
                      Qt::ShiftModifier);
    QApplication::sendEvent(&scene, &event);
  };
  for (int y = scene.height() - 8; side < 0 && y > 0; y -= 12) {
    for (int x = 8; side < 0 && x < scene.width(); x += 12) {
      QTest::mousePress(&scene, Qt::LeftButton, Qt::ShiftModifier, {x, y});
      move({x, y});
      if (side >= 0) {
        const scene::Vec3 from = window_.pose().sole_world_m(side);
        move({x + 8, y - 8});
        const scene::Vec3 by = window_.pose().sole_world_m(side) - from;
        EXPECT_GT(by.z(), 0.002) << "up";
        EXPECT_GT(by.head<2>().norm(), 0.002) << "and aside";
        EXPECT_LT(by.norm(), 0.1);
      }
      QTest::mouseRelease(&scene, Qt::LeftButton, Qt::ShiftModifier, {x, y});
    }
  }
  EXPECT_GE(side, 0) << "no foot in the picture";
}

TEST_F(Window, WhatCannotBeOpenedIsToldAndTheRunGoesOn) {
  watch_robot(5);
  window_.open("/nowhere/robot.sdf");
  EXPECT_TRUE(window_.player()->live() != nullptr);
  window_.open("/nowhere/run.mcap");
  EXPECT_TRUE(window_.player()->live() != nullptr);
  EXPECT_FALSE(settings_.value("recent").toStringList().contains("/nowhere/run.mcap"));
  EXPECT_EQ(settings_.value("recent").toStringList().size(), 1);
}

TEST_F(Window, RemembersItsLayout) {
  find<QDockWidget>("dock_Signals")->hide();
  window_.close();
  MainWindow again(settings_, [](const std::string&) { return RunSetup{}; });
  again.show();
  EXPECT_TRUE(again.findChild<QDockWidget*>("dock_Signals")->isHidden());
  EXPECT_TRUE(again.findChild<QDockWidget*>("dock_Plots")->isVisible());
}

}  // namespace
}  // namespace verp::view
