// docs/commands.md is what the table says, and every example in it runs. ARGIL_UPDATE_DOCS=1 writes it anew.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "sessions.h"

namespace argil::sculpt {
namespace {

TEST(CommandsDocument, IsWhatTheTableSays) {
  const std::filesystem::path path = std::filesystem::path(ARGIL_SOURCE_DIR) / "docs" / "commands.md";
  if (std::getenv("ARGIL_UPDATE_DOCS")) std::ofstream(path, std::ios::binary) << commands_document();
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(text, commands_document()) << "write it anew with `argil help --document > docs/commands.md`";
}

class Example : public testing::TestWithParam<std::string> {};

TEST_P(Example, Runs) {
  const auto& table = command_table();
  const auto command =
      std::find_if(table.begin(), table.end(), [&](const Command& c) { return c.name == GetParam(); });
  TestSession test(command->before);
  const std::uint64_t before = test.session().document().state_hash();
  const std::size_t depth = test.session().undo_depth();
  test.run({command->example});
  EXPECT_THAT(test.session().failed(), testing::IsEmpty());
  EXPECT_TRUE(command->example.starts_with(command->name)) << command->example;
  if (command->effect != Effect::state) return;
  EXPECT_EQ(test.session().undo_depth(), depth + 1);
  const std::uint64_t after = test.hash();
  test.run({"undo"});
  EXPECT_EQ(test.hash(), before);
  test.run({"redo"});
  EXPECT_EQ(test.hash(), after);
}

std::vector<std::string> names() {
  std::vector<std::string> result;
  for (const Command& command : command_table()) result.push_back(command.name);
  return result;
}

INSTANTIATE_TEST_SUITE_P(Commands, Example, testing::ValuesIn(names()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace argil::sculpt
