#include <gtest/gtest.h>

#include <QComboBox>
#include <QDockWidget>
#include <QLineEdit>
#include <QTableView>
#include <fstream>
#include <iterator>

#include "common/safety/machine.hpp"
#include "host/apps/view/editor_panel.hpp"
#include "host/apps/view/editor_table.hpp"
#include "host/robot/model/find.hpp"
#include "tests/host/view/window_fixture.hpp"

namespace verp::view {
namespace {

std::string text_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Editor : public Window {
 protected:
  Editor() { find<QDockWidget>("dock_Editor")->raise(); }
  void press(const char* button) { QTest::mouseClick(find<QPushButton>(button), Qt::LeftButton); }
  std::string complaint() { return find<QLabel>("editor_complaint")->text().toStdString(); }

  QLineEdit* type(const std::string& path, const char* text) {
    auto* table = find<QTableView>("editor_numbers");
    const int row = static_cast<EditorTable*>(table->model())->row_of(path);
    EXPECT_GE(row, 0) << path;
    const QModelIndex cell = table->model()->index(row, 1);
    table->setCurrentIndex(cell);
    table->edit(cell);
    auto* line = table->findChild<QLineEdit*>();
    EXPECT_NE(line, nullptr);
    line->selectAll();
    QTest::keyClicks(line, text);
    return line;
  }
  void add(const char* kind, const char* words) {
    find<QComboBox>("editor_kind")->setCurrentText(kind);
    auto* line = find<QLineEdit>("editor_words");
    line->setText(words);
    QTest::keyClick(line, Qt::Key_Return);
    EXPECT_EQ(line->text(), "") << kind << ": " << complaint();
  }
};

TEST_F(Editor, AMassIsEditedUndoneRedoneAndSavedAsOneLine) {
  const std::string file = folder_.filePath("a.sdf").toStdString();
  const std::string before = text_of(model::find_model("generic21"));
  std::ofstream(file, std::ios::binary) << before;
  window_.open(QString::fromStdString(file));
  ASSERT_NE(window_.editor().document(), nullptr);
  window_.editor().select("link:trunk");
  const std::string mass = "link:trunk/inertial/mass";
  QLineEdit* line = type(mass, "-2");
  ASSERT_TRUE(QTest::qWaitFor([&] { return complaint().find("out of range") != std::string::npos; },
                              60000));
  EXPECT_NE(complaint().find("link:trunk/inertial/mass, line 10"), std::string::npos)
      << "while typing: " << complaint();
  EXPECT_FALSE(window_.editor().changed());
  line->selectAll();
  QTest::keyClicks(line, "1.25");
  QTest::keyClick(line, Qt::Key_Return);
  const auto now = [&] { return window_.editor().document()->text(); };
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_.editor().changed(); }, 60000));
  EXPECT_NE(now().find("<mass>1.25</mass>"), std::string::npos);
  EXPECT_EQ(complaint(), "Sound");
  QTest::keyClick(&window_, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(now(), before);
  QTest::keyClick(&window_, Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_NE(now().find("<mass>1.25</mass>"), std::string::npos);
  press("editor_save");
  std::string wanted = before;
  wanted.replace(wanted.find("<mass>1.1</mass>"), 16, "<mass>1.25</mass>");
  EXPECT_EQ(text_of(file), wanted);
  EXPECT_FALSE(window_.editor().changed());
}

TEST_F(Editor, ASmallBipedGrowsFromAnEmptyFileAndStands) {
  const std::string file = folder_.filePath("biped.sdf").toStdString();
  ASSERT_EQ(window_.editor().open(file, true), "");
  add("link", "name=trunk mass=1.1 size=0.08,0.12,0.1 centre=0,0,0.05");
  add("body", "link=trunk");
  add("bus", "protocol=dynamixel2");
  add("joint",
      "name=l_hip_yaw parent=trunk at=0,0.0375,-0.02 axis=z lower=-1 upper=1 mass=0.05 "
      "size=0.03,0.03,0.02");
  add("joint",
      "name=l_hip_roll parent=l_hip_yaw_link axis=x lower=-0.6 upper=0.8 mass=0.12 "
      "size=0.04,0.036,0.03");
  add("joint",
      "name=l_hip_pitch parent=l_hip_roll_link axis=y lower=-1.9 upper=0.7 mass=0.12 "
      "size=0.04,0.04,0.07 centre=0,0,-0.05");
  add("joint",
      "name=l_knee parent=l_hip_pitch_link at=0,0,-0.093 axis=y lower=0 upper=2.3 mass=0.06 "
      "size=0.04,0.04,0.07 centre=0,0,-0.045");
  add("joint",
      "name=l_ankle_pitch parent=l_knee_link at=0,0,-0.093 axis=y lower=-1.3 upper=1 mass=0.12 "
      "size=0.04,0.036,0.03");
  add("joint",
      "name=l_ankle_roll parent=l_ankle_pitch_link axis=x lower=-0.8 upper=0.6 mass=0.08 "
      "size=0.104,0.066,0.01 centre=0,0,-0.0285");
  int id = 0;
  for (const char* joint :
       {"hip_yaw", "hip_roll", "hip_pitch", "knee", "ankle_pitch", "ankle_roll"}) {
    add("servo",
        QString("joint=l_%1 id=%2 type=xm430_w210").arg(joint).arg(++id).toUtf8().constData());
  }
  add("frame", "name=left_sole on=l_ankle_roll_link at=0,0,-0.0335");
  add("limb", "name=left_leg base=trunk tip=left_sole");
  window_.editor().select("joint:l_hip_yaw");
  press("editor_mirror");
  add("imu", "link=trunk id=120 type=icm20648");
  ASSERT_EQ(complaint(), "Sound");
  press("editor_walk");  // in no file yet
  ASSERT_NE(window_.player(), nullptr) << complaint();
  EXPECT_FALSE(QFile::exists(QString::fromStdString(file)));
  LiveRun& live = *window_.player()->live();
  live.set_speed(0);
  EXPECT_TRUE(QTest::qWaitFor(
      [&] {
        const Picture now = live.film()->last();
        return now && now->robots.front().mode == int(safety::Mode::kStanding);
      },
      120000));
  const std::uint64_t ticks = live.status().ticks;
  ASSERT_TRUE(QTest::qWaitFor([&] { return live.status().ticks > ticks + 500; }, 120000));
  const int mode = live.film()->last()->robots.front().mode;
  EXPECT_TRUE(mode == int(safety::Mode::kStanding) || mode == int(safety::Mode::kWalking)) << mode;
  EXPECT_EQ(live.film()->last()->robots.front().faults, 0U) << "and 5 s later it is still up";
  press("editor_save");
  EXPECT_EQ(text_of(file), window_.editor().document()->text());
}

TEST_F(Editor, WhatCannotBeSavedIsToldAndKept) {
  const std::string file = folder_.filePath("a.sdf").toStdString();
  std::ofstream(file, std::ios::binary) << text_of(model::find_model("generic21"));
  window_.open(QString::fromStdString(file));
  window_.editor().select("link:trunk");
  QTest::keyClick(type("link:trunk/inertial/mass", "1.25"), Qt::Key_Return);
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_.editor().changed(); }, 60000));
  std::ofstream(file, std::ios::binary | std::ios::app) << "<!-- somebody else -->\n";
  EXPECT_NE(window_.editor().save().find("changed by another program"), std::string::npos);
  EXPECT_EQ(text_of(file + ".unsaved"), window_.editor().document()->text());
}

}  // namespace
}  // namespace verp::view
