#include "subdiv/build.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "subdiv/error.h"
#include "subdiv/primitives.h"
#include "subdiv/validate.h"
#include "tests/subdiv/cells.h"

namespace argil::subdiv {
namespace {

using namespace test;
using testing::HasSubstr;

void expect_fault(const CellLists& lists, ErrorCode code, const std::string& where, const std::string& message) {
  try {
    (void)build(lists);
    ADD_FAILURE() << "expected: " << message;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code);
    EXPECT_EQ(error.where(), where);
    EXPECT_THAT(error.what(), HasSubstr(message));
  }
}

TEST(Build, BoxGridHasTheCountsOfAGrid) {
  const Built built = box_grid(3, 4, 5, {3, 4, 5});
  EXPECT_EQ(built.solid.vertex_count(), 4u * 5 * 6);
  EXPECT_EQ(built.solid.edge_count(), 3u * 5 * 6 + 4 * 4 * 6 + 4 * 5 * 5);
  EXPECT_EQ(built.solid.face_count(), 4u * 4 * 5 + 3 * 5 * 5 + 3 * 4 * 6);
  EXPECT_EQ(built.solid.cell_count(), 60u);
  EXPECT_THAT(validate(built.solid), testing::IsEmpty());
}

}  // namespace
}  // namespace argil::subdiv
