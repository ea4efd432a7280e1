#include "tools/studio/search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace argil::studio {
namespace {

TEST(Search, EveryCommandComesFirstByItsName) {
  for (const sculpt::Command& command : sculpt::command_table()) {
    const auto found = search(command.name);
    ASSERT_FALSE(found.empty()) << command.name;
    EXPECT_TRUE(std::any_of(found.begin(),
                            found.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(found.size(), 3)),
                            [&](const Found& one) { return one.command == &command; }))
        << command.name;
  }
}

TEST(Search, EveryActionIsFoundByItsLabel) {
  for (const ActionInfo& action : action_table()) {
    const auto found = search(action.label);
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const Found& one) { return one.action == &action; }))
        << action.label;
  }
}

TEST(Search, EveryCommandAndActionIsInAMenu) {
  std::set<std::string> groups, names;
  for (const Menu& menu : menus()) {
    names.insert(menu.name);
    for (const char* group : menu.groups) EXPECT_TRUE(groups.insert(group).second) << group;
  }
  for (const sculpt::Command& command : sculpt::command_table())
    EXPECT_TRUE(groups.contains(command.group)) << command.name << " of " << command.group;
  for (const ActionInfo& action : action_table()) EXPECT_TRUE(names.contains(action.menu)) << action.word;
}

TEST(Search, ALineWithArgumentsIsItsCommandAndSaysWhatIsWrong) {
  EXPECT_EQ(search("levels 2").front().command->name, "levels");
  EXPECT_TRUE(can_run("levels 2"));
  EXPECT_FALSE(can_run("levels"));
  EXPECT_NE(fault_of("levels 99").find("between"), std::string::npos);
  EXPECT_TRUE(search("no such xyzzy").empty());
}

}  // namespace
}  // namespace argil::studio
