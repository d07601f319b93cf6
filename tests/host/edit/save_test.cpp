#include <gtest/gtest.h>

#include <filesystem>

#include "host/author/edit/change.hpp"
#include "tests/host/edit/files.hpp"

namespace verp::edit {
namespace {

namespace fs = std::filesystem;

class Save : public testing::Test {
 protected:
  Save() : file_((folder_.path() / "a.sdf").string()), before_(read(robot("generic21"))) {
    write(file_, before_);
    document_.emplace(Document::open(file_));
    document_->apply(set(*document_, "link:trunk/inertial/mass", "1.25"));
  }
  std::string refusal() {
    try {
      document_->save();
    } catch (const model::LoadError& error) {
      return error.what();
    }
    return "";
  }

  files::TemporaryDirectory folder_;
  std::string file_, before_;
  std::optional<Document> document_;
};

TEST_F(Save, WritesAndIsUnchangedThen) {
  document_->save();
  EXPECT_EQ(read(file_), document_->text());
  EXPECT_FALSE(document_->changed());
}

TEST_F(Save, AFileThatAnotherProgramChangedStaysAndNothingIsLost) {
  write(file_, before_ + "\n<!-- somebody else -->\n");
  EXPECT_NE(refusal().find("changed by another program"), std::string::npos);
  EXPECT_EQ(read(file_), before_ + "\n<!-- somebody else -->\n");
  EXPECT_EQ(read(file_ + ".unsaved"), document_->text());
  EXPECT_NE(refusal().find(".unsaved2"), std::string::npos) << "and the first stays";
}

// In a shared folder another user could have put a link there.
TEST_F(Save, WhatIsPutAsideFollowsNoLink) {
  const std::string elsewhere = (folder_.path() / "elsewhere").string();
  fs::create_symlink(elsewhere, file_ + ".unsaved");
  write(file_, before_ + "\n<!-- somebody else -->\n");
  EXPECT_NE(refusal().find(".unsaved2"), std::string::npos);
  EXPECT_FALSE(fs::exists(elsewhere));
  EXPECT_EQ(read(file_ + ".unsaved2"), document_->text());
}

TEST_F(Save, AReadOnlyFileStaysAndNothingIsLost) {
  fs::permissions(file_, fs::perms::owner_read);
  EXPECT_NE(refusal().find("read-only"), std::string::npos);
  EXPECT_EQ(read(file_), before_);
  EXPECT_EQ(read(file_ + ".unsaved"), document_->text());
}

TEST_F(Save, ALinkAndItsPermissionsStay) {
  const fs::path link = folder_.path() / "link.sdf";
  fs::create_symlink(file_, link);
  fs::permissions(file_, fs::perms::owner_all);
  Document document = Document::open(link);
  document.apply(set(document, "link:trunk/inertial/mass", "1.3"));
  document.save();
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(read(file_), document.text());
  EXPECT_EQ(fs::status(file_).permissions(), fs::perms::owner_all);
}

}  // namespace
}  // namespace verp::edit
