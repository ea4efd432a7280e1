// `argil bench models`: every session of a folder, beside the paper's row where the name is one of its models.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/tools/process.h"

namespace argil::tests {
namespace {

using nlohmann::json;

TEST(BenchModels, MeasuresEverySessionOfAFolderInThePapersOrder) {
  const TemporaryFolder folder;
  folder.write("a_post.argil", "argil 1\nnew box 1 1 2\nlevels 1\n");
  folder.write("block_3.argil", "argil 1\nnew box 3 3 3\nlevels 1\n");
  const Finished finished =
      run_argil({"bench", "models", ".", "--steps", "2", "--json", "--space", "cubic"}, folder.path());
  ASSERT_EQ(finished.status, 0) << finished.err;
  const json rows = json::parse(finished.out);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0]["model"], "block_3");
  EXPECT_EQ(rows[0]["control_cells"], 27);
  EXPECT_EQ(rows[0]["unknowns"], 192);
  EXPECT_EQ(rows[0]["published"]["elements"], 1728);
  EXPECT_GT(rows[0]["cubic_share"], 0) << "the space asked for is the one that is measured";
  EXPECT_GT(rows[0]["ms_per_step"], 0);
  EXPECT_EQ(rows[1]["model"], "a_post");
  EXPECT_FALSE(rows[1].contains("published"));
}

TEST(BenchModels, NamesAFolderThatIsNotThere) {
  const TemporaryFolder folder;
  const Finished finished = run_argil({"bench", "models", "nowhere"}, folder.path());
  EXPECT_EQ(finished.status, 2);
  EXPECT_THAT(finished.err, testing::HasSubstr("nowhere"));
}

}  // namespace
}  // namespace argil::tests
