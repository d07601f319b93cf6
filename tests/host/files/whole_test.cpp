#include "host/os/files/whole.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "host/os/files/temporary_directory.hpp"

namespace verp::files {
namespace {

namespace fs = std::filesystem;

TEST(Read, ADeviceThatGoesOnForEverIsRefused) {
  EXPECT_EQ(read("/dev/zero"), std::nullopt);
  EXPECT_EQ(errno, EFBIG);
  EXPECT_EQ(read("/dev/null"), "");
}

TEST(Replace, WritesAFileAndLeavesNothingBesideIt) {
  const TemporaryDirectory folder;
  const fs::path file = folder.path() / "a.bin";
  ASSERT_TRUE(replace(file, "old"));
  ASSERT_TRUE(replace(file, "new"));
  EXPECT_EQ(read(file), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
  EXPECT_FALSE(replace(folder.path(), "a folder takes no bytes"));
}

TEST(Replace, ALinkStaysOne) {
  const TemporaryDirectory folder;
  const fs::path file = folder.path() / "a.bin", link = folder.path() / "link";
  ASSERT_TRUE(replace(file, "old"));
  fs::create_symlink("a.bin", link);
  ASSERT_TRUE(replace(link, "new"));
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(read(file), "new");
}

TEST(Replace, APipeIsWrittenTo) {
  const TemporaryDirectory folder;
  const fs::path pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int end = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(end, 0);
  ASSERT_TRUE(replace(pipe, "new"));
  char bytes[4] = {};
  EXPECT_EQ(::read(end, bytes, sizeof bytes), 3);
  ::close(end);
  EXPECT_STREQ(bytes, "new");
  EXPECT_TRUE(fs::is_fifo(pipe));
}

}  // namespace
}  // namespace verp::files
