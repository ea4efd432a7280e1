#include "tools/studio/keys.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "subdiv/error.h"

namespace argil::studio {
namespace {

TEST(Keys, NoTwoActionsHaveOneKey) {
  const Bindings bindings;
  const auto twice = bindings.collision();
  EXPECT_FALSE(twice.has_value()) << (twice ? std::string(info((*twice)[0]).word) + ' ' + info((*twice)[1]).word
                                            : "");
}

TEST(Keys, TheTableIsInTheOrderOfActionsAndSaysWhatEachDoes) {
  std::set<std::string> words;
  for (std::size_t i = 0; i < k_action_count; ++i) {
    const ActionInfo& action = action_table()[i];
    EXPECT_EQ(static_cast<std::size_t>(action.action), i) << action.word;
    EXPECT_TRUE(words.insert(action.word).second) << action.word;
    EXPECT_GT(std::string(action.help).size(), 5U) << action.word;
  }
}

TEST(Keys, ChordsReadBackAsTheyAreWritten) {
  for (const ActionInfo& action : action_table()) {
    const Chord chord = Bindings().key_of(action.action);
    if (chord.key != 0) {
      EXPECT_EQ(parse_chord(word(chord)), chord) << action.word;
    }
  }
  EXPECT_EQ(parse_chord("ctrl-shift-z"), (Chord{'Z', true, true, false}));
  EXPECT_EQ(word(parse_chord("Alt--")), "Alt--");
  for (const char* wrong : {"", "Ctrl-", "F13", "Hyper-A", "Numpad 12"})
    EXPECT_THROW((void)parse_chord(wrong), Error) << wrong;
}

TEST(Keys, PresetsHaveNoTwoActionsWithOneKey) {
  for (const KeyPreset& preset : key_presets()) {
    Bindings bindings;
    bindings.read(preset.lines, preset.name);
    EXPECT_FALSE(bindings.collision()) << preset.name;
    Bindings again;
    again.read(bindings.changes(), "changes");
    for (const ActionInfo& action : action_table())
      EXPECT_EQ(again.key_of(action.action), bindings.key_of(action.action)) << action.word;
  }
}

TEST(Keys, OnesOwnKeysStandInAndMayNotCollide) {
  Bindings bindings;
  bindings.read("# mine\nundo = Ctrl-U\nplay =\n", "keys");
  EXPECT_EQ(bindings.word_of(Action::undo), "Ctrl-U");
  EXPECT_EQ(bindings.action_of({'U', true, false, false}), Action::undo);
  EXPECT_EQ(bindings.key_of(Action::play).key, 0);
  EXPECT_THROW(bindings.read("redo = Ctrl-U\n", "keys"), Error);
  EXPECT_EQ(bindings.word_of(Action::redo), "Ctrl-Shift-Z");  // nothing was changed
  try {
    bindings.read("\nfly = F\n", "keys");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "keys:2");
  }
}

}  // namespace
}  // namespace argil::studio
