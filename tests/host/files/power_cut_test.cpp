#include "tests/host/files/power_cut.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "host/author/edit/document.hpp"
#include "host/os/files/temporary_directory.hpp"
#include "host/os/files/whole.hpp"
#include "host/robot/model/export.hpp"
#include "host/trace/record/mcap_writer.hpp"

namespace verp::files::test {
namespace {

namespace fs = std::filesystem;

/// The file has its old or its new content in every cut, and the new one when `work` is done.
void expect_whole(const fs::path& file, const std::function<void()>& work) {
  const std::string old = read(file).value_or(kMissing);
  std::set<std::string> seen;
  std::string last;
  const int cuts = each_power_cut(file, work, [&](const std::string& content) {
    seen.insert(content);
    last = content;
  });
  const std::string now = read(file).value_or(kMissing);
  EXPECT_NE(now, old);
  EXPECT_EQ(seen, (std::set<std::string>{old, now})) << "of " << cuts << " cuts";
  EXPECT_EQ(last, now) << "it was lost after it was promised";
  EXPECT_GE(cuts, 6);
}

TEST(PowerCut, LeavesTheOldOrTheNewFileWhole) {
  const TemporaryDirectory folder;
  const fs::path file = folder.path() / "a.bin";
  expect_whole(file, [&] { EXPECT_FALSE(replace(file, "first").any()); });
  expect_whole(file, [&] { EXPECT_FALSE(replace(file, std::string(100'000, 'x')).any()); });
  expect_whole(file, [&] { EXPECT_FALSE(replace(file, "").any()); });
}

TEST(PowerCut, LeavesTheOldOrTheNewTraceWhole) {
  const TemporaryDirectory folder;
  const fs::path file = folder.path() / "a.mcap";
  for (const char* name : {"first", "second"}) {
    expect_whole(file, [&] {
      record::mcap::Writer writer(file, "", name);
      writer.add_attachment("blob", "", std::string(50'000, 'x'));
      writer.close();
    });
  }
}

TEST(PowerCut, LeavesTheOldOrTheNewRobotWhole) {
  const TemporaryDirectory folder;
  const fs::path file = folder.path() / "robot.sdf";
  ASSERT_FALSE(create(file, "<sdf version='1.9'><model name='a'/></sdf>").any());
  expect_whole(file, [&] {
    edit::Document document = edit::Document::open(file);
    document.apply({"name", {{document.text().find("'a'") + 1, "a", "b"}}});
    document.save();
  });
}

TEST(PowerCut, LeavesTheOldOrTheNewParamsWhole) {
  const TemporaryDirectory folder;
  const fs::path file = folder.path() / "params.bin";
  ASSERT_FALSE(create(file, "an image of yesterday").any());
  expect_whole(file, [&] { model::export_command("generic21", "", folder.path().string()); });
}

TEST(PowerCut, OfACarelessWriterIsSeen) {
  const TemporaryDirectory folder;
  const fs::path file = folder.path() / "a.bin", part = folder.path() / "a.part";
  ASSERT_FALSE(create(file, "old").any());
  ASSERT_FALSE(create(part, "new").any());
  const auto contents_after = [&](const std::function<void()>& work) {
    std::set<std::string> seen;
    each_power_cut(file, work, [&](const std::string& content) { seen.insert(content); });
    return seen;
  };
  EXPECT_EQ(contents_after([&] { ::rename(part.c_str(), file.c_str()); }),
            (std::set<std::string>{"old", kTorn}));
  EXPECT_EQ(contents_after([&] { std::ofstream(file) << "in place"; }),
            (std::set<std::string>{kTorn}));
}

}  // namespace
}  // namespace verp::files::test
