#include "sculpt/command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sculpt/commands/commands.h"
#include "sculpt/near_names.h"
#include "sculpt/region.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

[[noreturn]] void fail(const io::SessionLine& line, const io::Token& at, const std::string& message) {
  throw Error(ErrorCode::bad_input, message, io::place_of(line, at));
}
[[noreturn]] void fail_at_end(const io::SessionLine& line, const std::string& message) {
  throw Error(ErrorCode::bad_input, message, io::place_of_end(line));
}

const char* noun(ArgumentType type) {
  switch (type) {
    case ArgumentType::number:
      return "a number";
    case ArgumentType::integer:
      return "a whole number";
    case ArgumentType::word:
      return "a word";
    case ArgumentType::text:
      return "a name";
    case ArgumentType::expression:
      return "an expression";
  }
  return "a value";
}

std::string joined(const std::vector<std::string>& words, const char* separator = ", ") {
  return fmt::format("{}", fmt::join(words, separator));
}

bool is_name(const io::Token& token) {
  return token.kind == io::TokenKind::word || token.kind == io::TokenKind::string;
}

void take_value(const Command& command, const Parameter& parameter, const io::SessionLine& line,
                const io::Token& token, Argument& argument) {
  const bool numeric = parameter.type == ArgumentType::number || parameter.type == ArgumentType::integer;
  if (numeric) {
    if (token.kind != io::TokenKind::number)
      fail(line, token,
           fmt::format("{}: {} wants {}{}, found '{}'", command.name, parameter.name, noun(parameter.type),
                       parameter.unit.empty() ? "" : " [" + parameter.unit + "]", token.text));
    if (!std::isfinite(token.number))
      fail(line, token, fmt::format("{}: {} is not finite", command.name, parameter.name));
    if (parameter.type == ArgumentType::integer && token.number != std::floor(token.number))
      fail(line, token,
           fmt::format("{}: {} wants a whole number, found {}", command.name, parameter.name, token.text));
    if (token.number < parameter.low || token.number > parameter.high)
      fail(line, token,
           fmt::format("{}: {} must lie between {:g} and {:g}, found {}", command.name, parameter.name,
                       parameter.low, parameter.high, token.text));
    argument.numbers.push_back(token.number);
    return;
  }
  if (!is_name(token) && !(parameter.type == ArgumentType::text && token.kind == io::TokenKind::number))
    fail(
        line, token,
        fmt::format("{}: {} wants {}, found '{}'", command.name, parameter.name, noun(parameter.type), token.text));
  if (!parameter.choices.empty() &&
      std::find(parameter.choices.begin(), parameter.choices.end(), token.text) == parameter.choices.end())
    fail(line, token,
         fmt::format("{}: {} must be one of {}; found '{}'", command.name, parameter.name,
                     joined(parameter.choices), token.text));
  argument.words.push_back(token.text);
}

std::string signature(const Parameter& parameter) {
  std::string value;
  if (parameter.type == ArgumentType::expression) {
    value = "EXPRESSION";
  } else if (!parameter.shown.empty()) {
    value = parameter.shown;
  } else if (!parameter.choices.empty()) {
    value = joined(parameter.choices, "|");
  } else {
    static const char* const axes[] = {"X", "Y", "Z", "R"};
    std::string upper = parameter.value_optional ? "N" : parameter.name;
    std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char c) { return std::toupper(c); });
    const bool in_space = parameter.count % 3 == 0 || parameter.count == 4;
    for (int i = 0; i < parameter.count; ++i)
      value += (i ? " " : "") + (in_space              ? std::string(axes[parameter.count == 4 ? i : i % 3])
                                 : parameter.count > 1 ? fmt::format("{}{}", upper, i + 1)
                                                       : upper);
  }
  if (parameter.list) value += " …";
  if (parameter.value_optional) value = "[" + value + "]";
  if (parameter.flag)
    value = parameter.name;
  else if (!parameter.positional)
    value = parameter.name + " " + value;
  return parameter.required && parameter.unless.empty() ? value : "[" + value + "]";
}

}  // namespace

long Arguments::integer(const std::string& name, long otherwise) const {
  return has(name) ? static_cast<long>(number(name)) : otherwise;
}

Eigen::Vector3d Arguments::vector(const std::string& name) const {
  const auto& numbers = values_.at(name).numbers;
  return {numbers.at(0), numbers.at(1), numbers.at(2)};
}

Eigen::Vector3d Arguments::vector(const std::string& name, const Eigen::Vector3d& otherwise) const {
  return has(name) ? vector(name) : otherwise;
}

std::vector<Eigen::Vector3d> Arguments::points(const std::string& name) const {
  std::vector<Eigen::Vector3d> result;
  const auto& numbers = values_.at(name).numbers;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
    result.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  return result;
}

std::string Arguments::word(const std::string& name, const std::string& otherwise) const {
  return has(name) ? word(name) : otherwise;
}

const Expression* Arguments::expression(const std::string& name) const {
  return has(name) ? values_.at(name).expression.get() : nullptr;
}

Arguments bind(const Command& command, const io::SessionLine& line) {
  const std::vector<io::Token>& tokens = line.tokens;
  Arguments arguments;
  std::size_t i = 1;
  const auto named = [&](const io::Token& token) -> const Parameter* {
    if (token.kind != io::TokenKind::word) return nullptr;
    for (const Parameter& p : command.parameters)
      if (!p.positional && p.name == token.text) return &p;
    return nullptr;
  };
  for (const Parameter& parameter : command.parameters) {
    if (!parameter.positional) continue;
    const bool numeric = parameter.type == ArgumentType::number || parameter.type == ArgumentType::integer;
    if (parameter.type == ArgumentType::expression) {
      if (i >= tokens.size())
        fail_at_end(line, fmt::format("{}: {} is missing ({})", command.name, parameter.name, parameter.help));
      Argument argument;
      argument.at = tokens[i];
      argument.expression = std::make_shared<const Expression>(
          Expression::parse(io::expression_tokens(line, i), line, variable_table()));
      while (i < tokens.size() && !(tokens[i].kind == io::TokenKind::word && tokens[i].text == "where")) ++i;
      arguments.set(parameter.name, std::move(argument));
      continue;
    }
    const bool fits = i < tokens.size() && (parameter.required || !named(tokens[i])) &&
                      (parameter.required || numeric == (tokens[i].kind == io::TokenKind::number));
    if (!fits) {
      if (!parameter.required) continue;
      fail_at_end(line, fmt::format("{}: {} is missing ({}). Usage: {}", command.name, parameter.name,
                                    parameter.help, usage(command)));
    }
    Argument argument;
    argument.at = tokens[i];
    for (int k = 0; k < parameter.count; ++k) {
      if (i >= tokens.size())
        fail_at_end(line, fmt::format("{}: {} wants {} values, the line ends after {}", command.name,
                                      parameter.name, parameter.count, k));
      take_value(command, parameter, line, tokens[i++], argument);
    }
    arguments.set(parameter.name, std::move(argument));
  }
  while (i < tokens.size()) {
    const io::Token& name = tokens[i];
    const Parameter* parameter = named(name);
    if (!parameter) {
      std::vector<std::string> names;
      for (const Parameter& p : command.parameters)
        if (!p.positional) names.push_back(p.name);
      fail(line, name,
           fmt::format("{}: '{}' is not one of its arguments{}{}. Usage: {}", command.name, name.text,
                       names.empty() ? "" : ": ", joined(names), usage(command)));
    }
    if (arguments.has(parameter->name))
      fail(line, name, fmt::format("{}: {} is given twice", command.name, parameter->name));
    ++i;
    Argument argument;
    argument.at = name;
    if (parameter->type == ArgumentType::expression) {
      const auto rest = std::span(tokens).subspan(i);
      argument.expression = std::make_shared<const Expression>(Expression::parse(rest, line, variable_table()));
      if (!argument.expression->is_boolean())
        fail(line, rest.front(),
             fmt::format("{}: {} wants a condition, as in `where z < 0.1`, and this is a number", command.name,
                         parameter->name));
      i = tokens.size();
    } else if (parameter->value_optional && (i >= tokens.size() || tokens[i].kind != io::TokenKind::number)) {
      // Its name alone.
    } else if (!parameter->flag) {
      const auto goes_on = [&](int k) {
        return k < parameter->count || k % parameter->count != 0 ||
               (parameter->list && i < tokens.size() && tokens[i].kind == io::TokenKind::number);
      };
      for (int k = 0; goes_on(k); ++k) {
        if (i >= tokens.size())
          fail_at_end(line, fmt::format("{}: {} wants {}, the line ends", command.name, parameter->name,
                                        parameter->count == 1
                                            ? std::string(noun(parameter->type))
                                            : fmt::format("{}{} values", parameter->list ? "groups of " : "",
                                                          parameter->count)));
        if (k == 0) argument.at = tokens[i];
        take_value(command, *parameter, line, tokens[i++], argument);
      }
    }
    arguments.set(parameter->name, std::move(argument));
  }
  for (const Parameter& parameter : command.parameters)
    if (parameter.required && !arguments.has(parameter.name) && !arguments.has(parameter.unless))
      fail_at_end(line, fmt::format("{}: {} is missing ({}). Usage: {}", command.name, parameter.name,
                                    parameter.help, usage(command)));
  return arguments;
}

namespace {

struct Group {
  const char* title;
  std::vector<std::vector<Command> (*)()> sources;
};

const std::vector<Group>& groups() {
  static const std::vector<Group> all{
      {"Beginning", {&base_commands, &file_commands}},
      {"Choosing", {&selection_commands}},
      {"Growing and removing", {&topology_commands}},
      {"Joining", {&joining_commands}},
      {"Splitting", {&splitting_commands}},
      {"Shaping", {&transform_commands, &smoothing_commands, &sharpen_commands}},
      {"Refining", {&level_commands}},
      {"Material", {&material_commands, &mask_commands}},
      {"Physics", {&load_commands, &key_commands, &simulation_commands, &obstacle_commands}},
      {"Force tools", {&tool_commands, &stroke_commands}},
      {"History", {&history_commands}},
      {"Measuring, saving, pictures",
       {&output_commands, &recording_commands, &render_commands, &sampling_commands, &panel_commands}},
  };
  return all;
}

}  // namespace

const std::vector<Command>& command_table() {
  static const std::vector<Command> table = [] {
    std::vector<Command> all;
    for (const Group& group : groups())
      for (const auto& source : group.sources)
        for (Command& command : source()) {
          command.group = group.title;
          all.push_back(std::move(command));
        }
    std::sort(all.begin(), all.end(), [](const Command& a, const Command& b) { return a.name < b.name; });
    return all;
  }();
  return table;
}

const Command& find_command(const io::SessionLine& line) {
  const io::Token& name = line.tokens.at(0);
  const auto& table = command_table();
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const Command& c) { return c.name == name.text; });
  if (found != table.end() && name.kind == io::TokenKind::word) return *found;
  std::vector<std::string> names;
  for (const Command& c : table) names.push_back(c.name);
  throw Error(ErrorCode::not_found,
              fmt::format("'{}' is not a command{} (`argil help` lists them all)", name.text,
                          near_names_hint(name.text, names)),
              io::place_of(line, name));
}

std::string usage(const Command& command) {
  std::string line = command.name;
  for (const Parameter& parameter : command.parameters) line += " " + signature(parameter);
  return line;
}

namespace {

std::string note_on(const Parameter& parameter) {
  std::string note = parameter.help;
  if (!parameter.unit.empty()) note += " [" + parameter.unit + "]";
  if (parameter.low > -1e300 && parameter.high < 1e300)
    note += fmt::format(" ({:g} … {:g})", parameter.low, parameter.high);
  else if (parameter.low > -1e300)
    note += fmt::format(" (at least {:g})", parameter.low);
  return note;
}

}  // namespace

std::string help_text(const Command& command) {
  std::string text = fmt::format("{}\n\n  {}\n\n", command.summary, usage(command));
  for (const Parameter& parameter : command.parameters)
    text += fmt::format("  {:<14} {}\n", parameter.name, note_on(parameter));
  text += "\nExample:\n";
  for (const std::string& line : command.before) text += fmt::format("  {}\n", line);
  return text + fmt::format("  {}\n", command.example);
}

std::string commands_document() {
  std::string text =
      "# Commands of a session\n\n"
      "Written by `argil help --document` from the table that runs them; a test runs every example. `argil help "
      "COMMAND` "
      "prints one\nof these. Lengths are in metres, time in seconds, mass in kilograms, angles in degrees.\n";
  for (const Group& group : groups()) {
    text += fmt::format("\n## {}\n", group.title);
    for (const Command& command : command_table()) {
      if (command.group != group.title) continue;
      text += fmt::format("\n### {}\n\n{}\n\n    {}\n", command.name, command.summary, usage(command));
      if (!command.parameters.empty()) text += "\n| argument | meaning |\n|---|---|\n";
      for (const Parameter& parameter : command.parameters) {
        std::string note = note_on(parameter);
        for (std::size_t at = 0; (at = note.find('|', at)) != std::string::npos; at += 2) note.insert(at, "\\");
        text += fmt::format("| `{}` | {} |\n", parameter.name, note);
      }
      text += "\nExample:\n\n";
      for (const std::string& line : command.before) text += fmt::format("    {}\n", line);
      text += fmt::format("    {}\n", command.example);
    }
  }
  return text;
}

std::string command_overview() {
  std::string text;
  for (const Command& command : command_table())
    text += fmt::format("  {:<12} {}\n", command.name, command.summary);
  return text;
}

}  // namespace argil::sculpt
