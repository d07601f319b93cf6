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
  ASSERT_FALSE(replace(file, "old").any());
  ASSERT_FALSE(replace(file, "new").any());
  EXPECT_EQ(read(file), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
  EXPECT_TRUE(replace(folder.path(), "a folder takes no bytes").any());
}

TEST(Replace, ALinkStaysOne) {
  const TemporaryDirectory folder;
  const fs::path file = folder.path() / "a.bin", link = folder.path() / "link";
  ASSERT_FALSE(replace(file, "old").any());
  fs::create_symlink("a.bin", link);
  ASSERT_FALSE(replace(link, "new").any());
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(read(file), "new");
}

TEST(Replace, APipeIsWrittenTo) {
  const TemporaryDirectory folder;
  const fs::path pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int end = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(end, 0);
  ASSERT_FALSE(replace(pipe, "new").any());
  char bytes[4] = {};
  EXPECT_EQ(::read(end, bytes, sizeof bytes), 3);
  ::close(end);
  EXPECT_STREQ(bytes, "new");
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST(Replace, KeepsThePermissionsAndAReadOnlyFile) {
  const TemporaryDirectory folder;
  const fs::path file = folder.path() / "a.bin";
  ASSERT_FALSE(replace(file, "old").any());
  fs::permissions(file, fs::perms::owner_all);
  ASSERT_FALSE(replace(file, "new").any());
  EXPECT_EQ(fs::status(file).permissions(), fs::perms::owner_all);
  if (::geteuid() == 0) return;  // may write all
  fs::permissions(file, fs::perms::owner_read);
  EXPECT_NE(replace(file, "newer").text().find("Permission denied"), std::string::npos);
  EXPECT_EQ(read(file), "new");
}

TEST(Replace, SaysWhatIsWrongWithItsRemedy) {
  const TemporaryDirectory folder;
  EXPECT_EQ(replace(folder.path() / "none" / "a", "").text(),
            "cannot be written: No such file or directory; choose a folder that exists");
  EXPECT_EQ(replace("/dev/full", "bytes").text(),
            "cannot be written: No space left on device; free space, or choose another place");
}

// Another user's link in a shared folder leads to a file of this user's.
class PlantedLink : public ::testing::Test {
 protected:
  PlantedLink() {
    EXPECT_FALSE(create(victim_, "precious").any());
    fs::create_directory(shared_);
    fs::permissions(shared_, fs::perms::all | fs::perms::sticky_bit);
    fs::create_symlink(victim_, link_);
    can_plant_ = ::lchown(link_.c_str(), kStranger, kStranger) == 0;
  }
  static constexpr uid_t kStranger = 65534;
  const TemporaryDirectory folder_;
  const fs::path victim_ = folder_.path() / "victim", shared_ = folder_.path() / "shared",
                 link_ = shared_ / "a.bin";
  bool can_plant_ = false;
};

TEST_F(PlantedLink, IsRefusedByReplaceAndOwnLinksAreFollowed) {
  if (can_plant_) {  // only the superuser gives files away
    EXPECT_NE(replace(link_, "evil").text().find("another user's link"), std::string::npos);
    EXPECT_EQ(read(victim_), "precious");
  }
  fs::permissions(shared_, fs::perms::owner_all);
  EXPECT_FALSE(replace(link_, "in a folder of mine").any());
  EXPECT_EQ(read(victim_), "in a folder of mine");
}

TEST_F(PlantedLink, IsNeverFollowedByCreate) {
  EXPECT_TRUE(create(link_, "evil").any());
  fs::remove(victim_);
  EXPECT_TRUE(create(link_, "evil").any()) << "a link to nothing";
  EXPECT_FALSE(fs::exists(victim_));
}

TEST(Create, LeavesNothingOfWhatItCannotWrite) {
  const TemporaryDirectory folder;
  ASSERT_FALSE(create(folder.path() / "a", "old").any());
  EXPECT_TRUE(create(folder.path() / "a", "new").any());
  EXPECT_EQ(read(folder.path() / "a"), "old");
}

}  // namespace
}  // namespace verp::files
