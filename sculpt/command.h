#pragma once
// The one table of commands (DESIGN.md): name, arguments with types, ranges and units, help, example, and what it
// does. It drives session files, `argil help`, undo and the journal. io/session_text only splits lines into tokens;
// `bind` gives them their types.

#include <Eigen/Core>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "io/session_text.h"
#include "sculpt/where.h"

namespace argil::sculpt {

class Session;

enum class ArgumentType { number, integer, word, text, expression };

struct Parameter {
  std::string name{};
  ArgumentType type = ArgumentType::number;
  std::string help{};
  std::string unit{};       // "m", "N", …; empty for a pure number
  int count = 1;            // values that follow the name (a vector has 3)
  bool positional = false;  // stands without its name, before the named ones
  bool required = false;
  double low = -1e300, high = 1e300;   // allowed range of numbers
  std::vector<std::string> choices{};  // allowed words; empty: any
  bool flag = false;                   // a name alone
  bool list = false;                   // any number of times `count` values (named numbers only)
  bool value_optional = false;         // a name alone, or with one number
  std::string unless{};                // not required where this other argument is given
  std::string shown{};                 // stands for its values in usage; empty: made from the rest
};

/// One bound argument.
struct Argument {
  std::vector<double> numbers;
  std::vector<std::string> words;
  std::shared_ptr<const Expression> expression;
  io::Token at;  // its first token, for messages
};

class Arguments {
 public:
  bool has(const std::string& name) const { return values_.count(name) != 0; }
  double number(const std::string& name) const { return values_.at(name).numbers.at(0); }
  double number(const std::string& name, double otherwise) const { return has(name) ? number(name) : otherwise; }
  long integer(const std::string& name, long otherwise) const;
  Eigen::Vector3d vector(const std::string& name) const;
  Eigen::Vector3d vector(const std::string& name, const Eigen::Vector3d& otherwise) const;
  const std::string& word(const std::string& name) const { return values_.at(name).words.at(0); }
  std::string word(const std::string& name, const std::string& otherwise) const;
  const Expression* expression(const std::string& name) const;
  const std::vector<double>& numbers(const std::string& name) const { return values_.at(name).numbers; }
  std::vector<Eigen::Vector3d> points(const std::string& name) const;
  const Argument& at(const std::string& name) const { return values_.at(name); }
  void set(const std::string& name, Argument value) { values_[name] = std::move(value); }

 private:
  std::map<std::string, Argument> values_;
};

enum class Effect {
  state,    // changes the document; journalled and undone
  history,  // undo and redo; journalled
  output    // writes, prints or checks; journalled, not undone
};

struct Command {
  std::string name{};
  std::string group{};  // its heading in the document
  std::string summary{};
  std::vector<Parameter> parameters{};
  std::string example{};
  std::vector<std::string> before{};  // lines of a session that the example needs to run
  Effect effect = Effect::state;
  std::function<void(Session&, const Arguments&)> run{};
};

/// All commands, by name ascending.
[[nodiscard]] const std::vector<Command>& command_table();
/// @throws Error (not_found) at the token, with the nearest names.
[[nodiscard]] const Command& find_command(const io::SessionLine& line);

/// Gives the tokens of a line (its first is the name) their types.
/// @throws Error (bad_input) at the token that does not fit, with what was expected.
[[nodiscard]] Arguments bind(const Command& command, const io::SessionLine& line);

/// "extrude DISTANCE [steps N] …", and the full help text.
[[nodiscard]] std::string usage(const Command& command);
[[nodiscard]] std::string help_text(const Command& command);
/// docs/commands.md: every command under the heading of its group, with arguments, and an example that runs.
[[nodiscard]] std::string commands_document();
/// A line for each command.
[[nodiscard]] std::string command_overview();

}  // namespace argil::sculpt
