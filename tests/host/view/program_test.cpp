#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <string>

namespace {

struct Ended {
  int status = -1;
  std::string said;
};

Ended run(const std::string& before, const std::string& words) {
  Ended ended;
  FILE* pipe = ::popen((before + " " VERP_VIEW_PROGRAM " view " + words + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return ended;
  char some[256];
  while (std::fgets(some, sizeof some, pipe) != nullptr) ended.said += some;
  ended.status = WEXITSTATUS(::pclose(pipe));
  return ended;
}

void expect_one_line(const Ended& ended, int status, const std::string& words) {
  EXPECT_EQ(ended.status, status) << ended.said;
  EXPECT_EQ(ended.said.find('\n'), ended.said.size() - 1) << ended.said;
  EXPECT_NE(ended.said.find(words), std::string::npos) << ended.said;
}

TEST(VerpView, WithoutADisplayIsOneLineAndExit3) {
  expect_one_line(run("env -u DISPLAY -u WAYLAND_DISPLAY", "generic21"), 3, "no display");
  expect_one_line(run("env DISPLAY=:987", "generic21"), 3, ":987 cannot be opened");
}

/// With no driver a window crashes, with an old one it neither shows nor ends.
TEST(VerpView, WithoutAGlDriverIsOneLineAndExit3) {
  const std::string limit = "timeout -k 1 30 env ";
  expect_one_line(run(limit + "LIBGL_DRIVERS_PATH=/nowhere", "generic21"), 3, "no window without");
  expect_one_line(run(limit + "MESA_GL_VERSION_OVERRIDE=2.1", "generic21"), 3, "OpenGL 3.3");
  expect_one_line(run(limit + "QT_QPA_PLATFORM=offscreen", "generic21"), 3, "has no windows");
}

TEST(VerpView, AWrongWordIsToldBeforeAnyWindow) {
  expect_one_line(run("env -u DISPLAY", "nobody"), 2, "nobody");
  expect_one_line(run("env -u DISPLAY", "--set gait.lift=1"), 2, "gait.lift_m");
  expect_one_line(run("", "/nowhere.mcap"), 2, "/nowhere.mcap");
}

TEST(VerpView, ADisplayThatClosesInTheMiddleIsOneLineAndExit3AndTheRecordIsWhole) {
  const Ended ended =
      run("f=$(mktemp -d)/a.mcap; (Xvfb :986 >/dev/null 2>&1 & p=$!; sleep 1; "
          "DISPLAY=:986",
          "--record $f & v=$!; until ls $f.* >/dev/null 2>&1; do sleep 1; done; sleep 4; kill $p; "
          "wait $v; s=$?; test -s $f || echo no trace; "
          "rm -r $(dirname $f); exit $s)");
  expect_one_line(ended, 3, "the display is gone");
}

}  // namespace
