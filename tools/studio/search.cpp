#include "tools/studio/search.h"

#include <algorithm>
#include <cctype>

#include "io/session_text.h"
#include "subdiv/error.h"

namespace argil::studio {

namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = c == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  std::string word;
  for (const char c : text + " ") {
    if (c != ' ') {
      word += c;
    } else if (!word.empty()) {
      words.push_back(std::exchange(word, {}));
    }
  }
  return words;
}

bool begins_a_word(const std::string& text, const std::string& word) {
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1))
    if (at == 0 || std::isalnum(static_cast<unsigned char>(text[at - 1])) == 0) return true;
  return false;
}

/// −1: a word is nowhere.
int rank_of(const std::vector<std::string>& words, const std::string& name, const std::string& help) {
  int rank = 0;
  for (const std::string& word : words) {
    if (name == word)
      rank += 0;
    else if (name.starts_with(word))
      rank += 1;
    else if (name.find(word) != name.npos)
      rank += 3;
    else if (begins_a_word(help, word))
      rank += 6;
    else
      return -1;
  }
  return rank;
}

}  // namespace

std::vector<Found> search(std::string_view text) {
  const std::string typed = lower(text);
  const std::vector<std::string> words = words_of(typed);
  std::vector<Found> found;
  for (const sculpt::Command& command : sculpt::command_table()) {
    const std::string name = lower(command.name);
    int rank = rank_of(words, name, lower(command.summary + ' ' + command.group));
    // "levels 2" is a line of `levels`.
    if (words.size() > 1 && words.front() == words_of(name).front() && typed.starts_with(name + ' ')) rank = 0;
    if (rank >= 0) found.push_back({nullptr, &command, rank});
  }
  for (const ActionInfo& action : action_table()) {
    const int rank = rank_of(words, lower(action.label), lower(std::string(action.help) + ' ' + action.word));
    if (rank >= 0) found.push_back({&action, nullptr, rank});
  }
  std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.rank < b.rank; });
  return found;
}

std::string fault_of(const std::string& line) {
  try {
    const io::SessionLine parsed = io::parse_session_line(line, "", 1);
    if (parsed.tokens.empty()) return "a command is missing";
    (void)sculpt::bind(sculpt::find_command(parsed), parsed);
    return {};
  } catch (const Error& error) {
    return error.what();
  }
}

bool can_run(const std::string& line) {
  return fault_of(line).empty();
}

bool runs_alone(const sculpt::Command& command) {
  return std::none_of(command.parameters.begin(), command.parameters.end(),
                      [](const sculpt::Parameter& parameter) { return parameter.required; });
}

const std::vector<Menu>& menus() {
  static const std::vector<Menu> all{
      {"File", "Sessions, meshes and pictures", {"Measuring, saving, pictures"}},
      {"Edit", "Undo, redo", {"History"}},
      {"Select", "What commands act on", {"Choosing"}},
      {"Solid",
       "The control solid",
       {"Beginning", "Growing and removing", "Joining", "Splitting", "Shaping", "Refining"}},
      {"Tool", "What the pointer does on clay", {"Force tools"}},
      {"Physics", "Material, loads and time", {"Material", "Physics"}},
      {"View", "What is shown", {}},
      {"Help", "Keys and commands", {}},
  };
  return all;
}

std::vector<std::string> choices_of(std::string_view command, std::string_view parameter) {
  for (const sculpt::Command& c : sculpt::command_table())
    if (c.name == command)
      for (const sculpt::Parameter& p : c.parameters)
        if (p.name == parameter) return p.choices;
  return {};
}

}  // namespace argil::studio
