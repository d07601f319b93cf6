#include "host/os/process/child.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <memory>
#include <system_error>

#include "host/os/files/temporary_directory.hpp"

namespace verp::process {
namespace {

namespace fs = std::filesystem;

constexpr int kPatience_ms = 20'000;  // short operations on a loaded machine

std::string slurp(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Reports when every holder of its write end is gone.
class LifeLine {
 public:
  LifeLine() { EXPECT_EQ(::pipe2(ends_, O_CLOEXEC), 0); }
  ~LifeLine() {
    ::close(ends_[0]);
    let_go();
  }
  LifeLine(const LifeLine&) = delete;
  LifeLine& operator=(const LifeLine&) = delete;

  Stream end() const { return {.descriptor = ends_[1]}; }
  void let_go() {
    if (ends_[1] >= 0) ::close(ends_[1]);
    ends_[1] = -1;
  }
  /// "still there" if a holder remains.
  std::string last_words() {
    let_go();
    std::string words;
    for (;;) {
      pollfd one{.fd = ends_[0], .events = POLLIN, .revents = 0};
      if (::poll(&one, 1, kPatience_ms) <= 0) return "still there";
      char piece[256];
      const ssize_t count = ::read(ends_[0], piece, sizeof piece);
      if (count <= 0) return words;
      words.append(piece, static_cast<std::size_t>(count));
    }
  }
  bool speaks() const {
    pollfd one{.fd = ends_[0], .events = POLLIN, .revents = 0};
    return ::poll(&one, 1, kPatience_ms) == 1 && (one.revents & POLLIN) != 0;
  }

 private:
  int ends_[2] = {-1, -1};
};

Command shell(const std::string& words, const Stream& output) {
  return {.words = {"sh", "-c", words}, .input = {}, .output = output};
}

TEST(Child, HasTheStreamsFolderAndWordsItWasGiven) {
  const files::TemporaryDirectory folder;
  const fs::path in = folder.path() / "in", out = folder.path() / "out",
                 err = folder.path() / "err";
  std::ofstream(in) << "typed";
  std::ofstream(out) << "what was there before, longer than what comes";
  Child child({.words = {"sh", "-c", "cat; pwd; echo \"$1\" >&2; exit 7", "name", "two words"},
               .input = {.file = in},
               .output = {.file = out},
               .error = Stream{.file = err},
               .folder = folder.path()});
  EXPECT_EQ(child.wait(), 7);
  EXPECT_EQ(child.status(), 7) << "asked again";
  EXPECT_EQ(slurp(out), "typed" + fs::canonical(folder.path()).string() + "\n");
  EXPECT_EQ(slurp(err), "two words\n");
}

TEST(Child, ErrorsGoWhereTheOutputGoesAndNothingIsToRead) {
  LifeLine line;
  Child child(shell("cat; echo out; echo err >&2", line.end()));
  EXPECT_EQ(line.last_words(), "out\nerr\n");
  EXPECT_EQ(child.wait(), 0);
}

TEST(Child, WhatCannotStartSaysWhy) {
  const auto reason = [](const Command& command) {
    try {
      const Child child(command);
      return 0;
    } catch (const std::system_error& error) {
      return error.code().value();
    }
  };
  EXPECT_EQ(reason({.words = {"no-such-program"}, .input = {}, .output = {}}), ENOENT);
  EXPECT_EQ(reason({.words = {"/dev/null"}, .input = {}, .output = {}}), EACCES);
  EXPECT_EQ(reason(shell("true", {.file = "/nowhere/out"})), ENOENT);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "none is left behind";
}

TEST(Child, EndsWithTheObjectAndWithItWhatItStarted) {
  LifeLine line;
  auto child = std::make_unique<Child>(shell("sleep 600 & echo up; wait", line.end()));
  ASSERT_TRUE(line.speaks());
  EXPECT_FALSE(child->status().has_value());
  child.reset();
  EXPECT_EQ(line.last_words(), "up\n");
}

TEST(Child, ASignalReachesItAndWhatItStarted) {
  LifeLine line;
  Child child(shell("sleep 600 & echo up; wait", line.end()));
  ASSERT_TRUE(line.speaks());
  child.tell(SIGTERM);
  EXPECT_EQ(line.last_words(), "up\n");
  EXPECT_EQ(child.wait(), 128 + SIGTERM);
}

TEST(Child, ACtrlCOfOursDoesNotReachIt) {
  Child child(shell("sleep 600", {}));
  EXPECT_EQ(::getpgid(child.id()), child.id());
  EXPECT_NE(::getpgid(child.id()), ::getpgrp());
}

// SIGKILL runs no destructor or handler.
TEST(Child, DoesNotOutliveAParentThatIsKilled) {
  LifeLine line;
  const pid_t parent = ::fork();
  if (parent == 0) {
    const Child child(shell("echo up; exec sleep 600", line.end()));
    for (;;) ::pause();
  }
  ASSERT_TRUE(line.speaks());
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  EXPECT_EQ(line.last_words(), "up\n");
}

// The error pipe may get a standard stream's number.
TEST(Child, WhatCannotStartSaysWhyWhereOurStreamsAreClosed) {
  const pid_t parent = ::fork();
  if (parent == 0) {
    for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::close(stream);
    try {
      const Child child({.words = {"no-such-program"}, .input = {}, .output = {}});
      ::_exit(0);
    } catch (const std::system_error& error) {
      ::_exit(error.code().value());
    }
  }
  int status = 0;
  ::waitpid(parent, &status, 0);
  EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, ENOENT);
}

// The program gets descriptors 0 to 2 for its files.
TEST(Child, ClosedStreamsOfOursAreNotMixedUpWithItsOwn) {
  const files::TemporaryDirectory folder;
  const fs::path out = folder.path() / "out", err = folder.path() / "err";
  const pid_t parent = ::fork();
  if (parent == 0) {
    for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::close(stream);
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0 || ends[1] > STDERR_FILENO) ::_exit(100);
    Child child({.words = {"sh", "-c", "cat; echo out; echo err >&2; exit 5"},
                 .input = {.descriptor = ends[0]},
                 .output = {.file = out},
                 .error = Stream{.file = err}});
    if (::write(ends[1], "typed\n", 6) != 6) ::_exit(101);
    ::close(ends[1]);
    ::_exit(child.wait());
  }
  int status = 0;
  ::waitpid(parent, &status, 0);
  EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 5);
  EXPECT_EQ(slurp(out), "typed\nout\n");
  EXPECT_EQ(slurp(err), "err\n");
}

}  // namespace
}  // namespace verp::process
