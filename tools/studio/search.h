#pragma once
// Finding what the program can do by what one types: every action of the window and every command of a session,
// from the two tables that also make menus, keys and session files.

#include <string>
#include <string_view>
#include <vector>

#include "sculpt/command.h"
#include "tools/studio/keys.h"

namespace argil::studio {

struct Found {
  const ActionInfo* action = nullptr;  // one of the two
  const sculpt::Command* command = nullptr;
  int rank = 0;  // lower is better
};

/// Everything where each word of `text` stands in the name, label or help; names that begin with it first. Empty
/// text finds all. Of a line with arguments ("levels 2") the command of its first word comes first.
[[nodiscard]] std::vector<Found> search(std::string_view text);

/// Whether the line is one that can be run as it stands: a command with arguments that fit.
[[nodiscard]] bool can_run(const std::string& line);
/// What is still wrong with it; empty if nothing.
[[nodiscard]] std::string fault_of(const std::string& line);
/// A command that wants no more than its name.
[[nodiscard]] bool runs_alone(const sculpt::Command& command);

/// The words that a parameter of a command may be; empty where it takes others.
[[nodiscard]] std::vector<std::string> choices_of(std::string_view command, std::string_view parameter);

/// The menus of the window from left to right, and the groups of commands that each has below its actions.
struct Menu {
  const char* name;
  const char* help;
  std::vector<const char*> groups;
};
[[nodiscard]] const std::vector<Menu>& menus();

}  // namespace argil::studio
