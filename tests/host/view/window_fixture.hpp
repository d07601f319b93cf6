#pragma once
#include <gtest/gtest.h>

#include <QApplication>
#include <QLabel>
#include <QPushButton>
#include <QSettings>
#include <QTemporaryDir>
#include <QtTest/QTest>
#include <cstdlib>

#include "host/apps/view/main_window.hpp"
#include "host/apps/view/run_of.hpp"

namespace verp::view {

/// Saves pictures in VERP_UI_PICTURES, if set.
class Window : public testing::Test {
 protected:
  Window()
      : settings_(folder_.filePath("view.ini"), QSettings::IniFormat),
        window_(settings_, [](const std::string& model) {
          tool::WalkOptions options;
          options.model = model;
          return run_of(options);
        }) {
    window_.show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(&window_));
    QApplication::setActiveWindow(&window_);  // there is no window manager
    if (std::getenv("VERP_UI_PICTURES") == nullptr) {
      window_.scene().effects().shadows = window_.scene().effects().antialias = false;
    }
  }
  ~Window() override {
    const char* folder = std::getenv("VERP_UI_PICTURES");
    if (folder != nullptr) {
      const auto* test = testing::UnitTest::GetInstance()->current_test_info();
      window_.grab().save(QString("%1/%2.png").arg(folder, test->name()));
    }
    window_.close();
    window_.finish();
  }

  template <class Met>
  bool wait_for(Met met, int seconds = 60) {
    return QTest::qWaitFor(met, seconds * 1000);
  }
  LiveRun& live() { return *window_.player()->live(); }
  void watch_robot(int ticks = 60) {
    window_.open("generic21");
    ASSERT_NE(window_.player(), nullptr);
    live().set_speed(0);
    ASSERT_TRUE(wait_for([&] { return live().status().ticks >= std::uint64_t(ticks); }));
  }
  template <class Widget>
  Widget* find(const char* name) {
    auto* found = window_.findChild<Widget*>(name);
    EXPECT_NE(found, nullptr) << name;
    return found;
  }
  void key(Qt::Key key) { QTest::keyClick(&window_, key); }
  QPoint middle() { return {window_.scene().width() / 2, window_.scene().height() / 2}; }
  int mode() {
    const Picture now = live().film()->last();
    return now ? now->robots.front().mode : -1;
  }
  double shown_s() { return window_.player()->shown_s(); }

  QTemporaryDir folder_;
  QSettings settings_;
  MainWindow window_;
};

}  // namespace verp::view
