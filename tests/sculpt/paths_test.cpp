#include "sculpt/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sessions.h"

namespace argil::sculpt {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

//   outside/secret.vtu
//   root/inside.vtu, root/deep/, and the links of each test
class Paths : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(root_ / "deep");
    fs::create_directories(outside_);
    std::ofstream(root_ / "inside.vtu") << "x";
    std::ofstream(outside_ / "secret.vtu") << "x";
  }
  void expect_refused(const std::string& name, const std::string& why) const {
    SCOPED_TRACE(name);
    try {
      (void)path_beneath(root_, name, "the root");
      ADD_FAILURE() << "accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::refused);
      EXPECT_THAT(error.what(), HasSubstr(why));
      EXPECT_THAT(error.what(), HasSubstr("beneath the root"));
    }
  }
  fs::path reached(const std::string& name) const { return path_beneath(root_, name, "the root"); }

  TestFolder folder_;
  fs::path root_ = fs::canonical(folder_.path()) / "root", outside_ = fs::canonical(folder_.path()) / "outside";
};

TEST_F(Paths, FilesBeneathTheRootAreReached) {
  EXPECT_EQ(reached("inside.vtu"), root_ / "inside.vtu");
  EXPECT_EQ(reached("./inside.vtu"), root_ / "inside.vtu");
  EXPECT_EQ(reached("deep/new.vtu"), root_ / "deep/new.vtu");
  EXPECT_EQ(reached("not/yet/there.vtu"), root_ / "not/yet/there.vtu");
  EXPECT_EQ(reached("..inside"), root_ / "..inside");
}

TEST_F(Paths, ARootThatIsWrittenInAnotherWayIsTheSame) {
  EXPECT_EQ(path_beneath(root_ / "deep" / "..", "inside.vtu", "it"), root_ / "inside.vtu");
  EXPECT_EQ(path_beneath(root_.string() + "/", "inside.vtu", "it"), root_ / "inside.vtu");
  EXPECT_EQ(path_beneath(root_.string() + "/to_come/", "a.vtu", "it"), root_ / "to_come/a.vtu");
  fs::create_directory_symlink(root_, folder_.path() / "alias");
  EXPECT_EQ(path_beneath(folder_.path() / "alias", "inside.vtu", "it"), root_ / "inside.vtu");
}

TEST_F(Paths, WhatLeavesTheRootIsRefused) {
  expect_refused((outside_ / "secret.vtu").string(), "absolute");
  expect_refused((root_ / "inside.vtu").string(), "absolute");
  expect_refused("../outside/secret.vtu", "'..'");
  expect_refused("deep/../inside.vtu", "'..'");
  expect_refused("..", "'..'");
  expect_refused("", "not a file name");
  expect_refused(std::string("inside.vtu\0.png", 15), "not a file name");
}

TEST_F(Paths, SymbolicLinksThatLeaveAreRefused) {
  fs::create_symlink(outside_ / "secret.vtu", root_ / "file.vtu");
  fs::create_directory_symlink(outside_, root_ / "folder");
  fs::create_directory_symlink("..", root_ / "up");
  fs::create_directory_symlink(root_ / "folder", root_ / "chain");
  expect_refused("file.vtu", "symbolic link");
  expect_refused("folder/secret.vtu", "symbolic link");
  expect_refused("folder/new.vtu", "symbolic link");
  expect_refused("folder", "symbolic link");
  expect_refused("up/outside/secret.vtu", "symbolic link");
  expect_refused("chain/secret.vtu", "symbolic link");
  // A sibling whose name begins like the root's is not beneath it.
  fs::create_directories(folder_.path() / "root_beside");
  fs::create_directory_symlink(folder_.path() / "root_beside", root_ / "beside");
  expect_refused("beside/a.vtu", "symbolic link");
}

TEST_F(Paths, LinksThatStayInsideAreFollowed) {
  fs::create_symlink("inside.vtu", root_ / "again.vtu");
  fs::create_directory_symlink(root_ / "deep", root_ / "deeper");
  EXPECT_EQ(reached("again.vtu"), root_ / "inside.vtu");
  EXPECT_EQ(reached("deeper/a.vtu"), root_ / "deep/a.vtu");
}

TEST_F(Paths, DanglingLinksAndLoopsAreRefused) {
  fs::create_symlink(outside_ / "to_be_made.vtu", root_ / "dangling.vtu");
  fs::create_directory_symlink(outside_ / "to_be_made", root_ / "missing");
  fs::create_symlink("loop_b", root_ / "loop_a");
  fs::create_symlink("loop_a", root_ / "loop_b");
  expect_refused("dangling.vtu", "dangling");
  expect_refused("missing/a.vtu", "dangling");
  expect_refused("loop_a", "");
}

TEST_F(Paths, SessionsReachNothingElse) {
  SessionOptions options;
  TestSession session({"new box", "levels 1"}, options);
  fs::create_symlink(outside_ / "stolen.obj", session.folder().path() / "link.obj");
  fs::create_directory_symlink(outside_, session.folder().path() / "away");
  for (const char* line :
       {"save link.obj", "save away/a.obj", "save ../a.obj", "open away/secret.vtu", "render away/a.png"})
    EXPECT_EQ(session.fault_of(line).code(), ErrorCode::refused) << line;
  EXPECT_FALSE(fs::exists(outside_ / "stolen.obj"));
  EXPECT_EQ(std::distance(fs::directory_iterator(outside_), fs::directory_iterator()), 1);
  session.run({"save new/folder/a.obj"});
  EXPECT_TRUE(fs::exists(session.folder().path() / "new/folder/a.obj"));
}

}  // namespace
}  // namespace argil::sculpt
