// `argil atlas`, run as a user runs it; what it finds is tested in tests/atlas.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pugixml.hpp>

#include "fem/dynamics/method.h"
#include "fem/models/model_table.h"
#include "tests/tools/process.h"

namespace argil::tests {
namespace {

using testing::HasSubstr;

class AtlasCommand : public testing::Test {
 protected:
  Finished argil(const std::vector<std::string>& arguments) { return run_argil(arguments, folder_.path()); }
  TemporaryFolder folder_;
};

TEST_F(AtlasCommand, ListsEveryMethodOfTheTables) {
  const Finished list = argil({"atlas", "--list"});
  EXPECT_EQ(list.status, 0);
  for (const fem::ModelKind& kind : fem::model_table()) EXPECT_THAT(list.out, HasSubstr(std::string(kind.name)));
  for (const fem::MethodKind& kind : fem::method_table()) EXPECT_THAT(list.out, HasSubstr(std::string(kind.name)));
  for (const char* sweep :
       {"time_step", "young_modulus", "poisson_ratio", "contrast", "aspect", "rotation", "inversion", "pull"})
    EXPECT_THAT(list.out, HasSubstr("  " + std::string(sweep) + " "));
  EXPECT_TRUE(folder_.files().empty());
}

TEST_F(AtlasCommand, MapsASessionAndRunsNothingTwice) {
  folder_.write(
      "cube.argil",
      "argil 1\nnew box 2 1 1 size 0.2 0.1 0.1\nselect edges angle 30\nsharpen 10\nlevels 1\npin where x < "
      "1e-6\ngravity 0 0 -1\n");
  const std::vector<std::string> line = {"atlas",        "cube.argil", "--quick", "--model", "linear",
                                         "--integrator", "bdf2",       "--out",   "maps"};
  const Finished first = argil(line);
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_EQ(folder_.files(),
            (std::vector<std::string>{"cube.argil", "maps/index.html", "maps/probes.csv", "maps/session.svg"}));
  EXPECT_THAT(first.out, HasSubstr("linear, bdf2: Nowhere diverged."));
  pugi::xml_document svg;
  ASSERT_TRUE(svg.load_file((folder_ / "maps/session.svg").c_str()));
  EXPECT_GT(svg.select_nodes("//polygon").size(), 6U);
  const std::string rows = read_bytes(folder_ / "maps/probes.csv");
  const Finished again = argil(line);
  EXPECT_THAT(again.out, HasSubstr(" 0 of them new"));
  EXPECT_EQ(read_bytes(folder_ / "maps/probes.csv"), rows);
}

TEST_F(AtlasCommand, SaysWhatIsWrong) {
  folder_.write("empty.argil", "argil 1\n");
  folder_.write("wrong.argil", "argil 1\nnew bocks\n");
  const auto message = [&](const std::vector<std::string>& arguments) {
    const Finished finished = argil(arguments);
    EXPECT_EQ(finished.status, 2) << finished.out;
    return finished.err;
  };
  EXPECT_THAT(message({"atlas", "--sweep", "colour"}), HasSubstr("there are time_step"));
  EXPECT_THAT(message({"atlas", "--model", "jelly"}), HasSubstr("corotational"));
  EXPECT_THAT(message({"atlas", "--integrator", "guess"}), HasSubstr("bdf2"));
  EXPECT_THAT(message({"atlas", "none.argil"}), HasSubstr("none.argil"));
  EXPECT_THAT(message({"atlas", "wrong.argil"}), HasSubstr("wrong.argil:2"));
  EXPECT_THAT(message({"atlas", "empty.argil"}), HasSubstr("without a solid"));
  folder_.write("floor.argil", "argil 1\nnew box 1 1 1\nlevels 1\nobstacle floor plane at 0 0 -1\n");
  EXPECT_THAT(message({"atlas", "floor.argil"}),
              testing::AllOf(HasSubstr("floor.argil"), HasSubstr("obstacle floor"), HasSubstr("remove")));
}

}  // namespace
}  // namespace argil::tests
