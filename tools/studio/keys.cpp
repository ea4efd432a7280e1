#include "tools/studio/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "subdiv/error.h"

namespace argil::studio {

namespace {

struct KeyName {
  int key;
  const char* name;
};
constexpr std::array k_names{KeyName{key::space, "Space"},
                             KeyName{key::escape, "Esc"},
                             KeyName{key::enter, "Enter"},
                             KeyName{key::tab, "Tab"},
                             KeyName{key::backspace, "Backspace"},
                             KeyName{key::insert, "Insert"},
                             KeyName{key::del, "Del"},
                             KeyName{key::right, "Right"},
                             KeyName{key::left, "Left"},
                             KeyName{key::down, "Down"},
                             KeyName{key::up, "Up"},
                             KeyName{key::page_up, "PageUp"},
                             KeyName{key::page_down, "PageDown"},
                             KeyName{key::home, "Home"},
                             KeyName{key::end, "End"},
                             KeyName{key::pad_enter, "Numpad Enter"}};

bool same(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

bool take_word(std::string_view& text, std::string_view word) {
  if (text.size() <= word.size() || !same(text.substr(0, word.size()), word)) return false;
  text.remove_prefix(word.size());
  return true;
}

}  // namespace

Chord parse_chord(std::string_view text) {
  const std::string_view all = text = trimmed(text);
  Chord chord;
  for (;;) {
    if (take_word(text, "Ctrl-"))
      chord.control = true;
    else if (take_word(text, "Shift-"))
      chord.shift = true;
    else if (take_word(text, "Alt-"))
      chord.alt = true;
    else
      break;
  }
  for (const KeyName& name : k_names)
    if (same(text, name.name)) chord.key = name.key;
  if (text.size() == 1 && std::isgraph(static_cast<unsigned char>(text[0])) != 0)
    chord.key = std::toupper(static_cast<unsigned char>(text[0]));
  if (text.size() >= 2 && text.size() <= 3 && (text[0] == 'F' || text[0] == 'f') &&
      std::all_of(text.begin() + 1, text.end(), [](unsigned char c) { return std::isdigit(c) != 0; })) {
    const int number = std::stoi(std::string(text.substr(1)));
    if (number >= 1 && number <= 12) chord.key = key::f1 + number - 1;
  }
  if (std::string_view rest = text;
      take_word(rest, "Numpad ") && rest.size() == 1 && rest[0] >= '0' && rest[0] <= '9')
    chord.key = key::pad_0 + rest[0] - '0';
  if (chord.key == 0)
    throw Error(ErrorCode::bad_input,
                fmt::format("expected a key such as Ctrl-Shift-Z, F3, Home or Numpad 1, found '{}'", all));
  return chord;
}

std::string word(const Chord& chord) {
  if (chord.key == 0) return "";
  std::string text;
  if (chord.control) text += "Ctrl-";
  if (chord.shift) text += "Shift-";
  if (chord.alt) text += "Alt-";
  const auto named =
      std::find_if(k_names.begin(), k_names.end(), [&](const KeyName& n) { return n.key == chord.key; });
  if (named != k_names.end()) return text + named->name;
  if (chord.key >= key::f1 && chord.key < key::f1 + 12) return text + fmt::format("F{}", chord.key - key::f1 + 1);
  if (chord.key >= key::pad_0 && chord.key < key::pad_0 + 10)
    return text + fmt::format("Numpad {}", chord.key - key::pad_0);
  return text + static_cast<char>(chord.key);
}

Bindings::Bindings() {
  for (const ActionInfo& action : action_table())
    chords_[static_cast<std::size_t>(action.action)] = *action.keys == '\0' ? Chord{} : parse_chord(action.keys);
}

void Bindings::read(std::string_view text, const std::string& file_name) {
  const auto before = chords_;
  int number = 0;
  try {
    while (!text.empty()) {
      ++number;
      const std::size_t end = std::min(text.find('\n'), text.size());
      std::string_view line = text.substr(0, end);
      text.remove_prefix(std::min(text.size(), end + 1));
      line = trimmed(line.substr(0, line.starts_with('#') ? 0 : line.find(" #")));
      if (line.empty()) continue;
      const std::size_t equals = line.find('=');
      const std::string_view name = trimmed(line.substr(0, equals));
      const auto found = std::find_if(action_table().begin(), action_table().end(),
                                      [&](const ActionInfo& action) { return name == action.word; });
      if (equals == line.npos || found == action_table().end())
        throw Error(
            ErrorCode::bad_input,
            fmt::format("expected `action = key`, found '{}'; F1 shows the actions, undo = Ctrl-Z is one", line));
      const std::string_view keys = trimmed(line.substr(equals + 1));
      chords_[static_cast<std::size_t>(found->action)] = keys.empty() ? Chord{} : parse_chord(keys);
    }
    if (const auto twice = collision())
      throw Error(ErrorCode::bad_input,
                  fmt::format("{} and {} both have the key {}; give one of them another", info((*twice)[0]).word,
                              info((*twice)[1]).word, word_of((*twice)[0])));
  } catch (const Error& error) {
    chords_ = before;
    throw Error(error.code(), error.what(), fmt::format("{}:{}", file_name, number));
  }
}

std::optional<Action> Bindings::bind(Action action, const Chord& chord) {
  const std::optional<Action> had = action_of(chord);
  if (had && *had != action) chords_[static_cast<std::size_t>(*had)] = Chord{};
  chords_[static_cast<std::size_t>(action)] = chord;
  return had == action ? std::nullopt : had;
}

std::string Bindings::changes() const {
  const Bindings usual;
  std::string lines;
  for (const ActionInfo& action : action_table())
    if (key_of(action.action) != usual.key_of(action.action))
      lines += fmt::format("{} = {}\n", action.word, word_of(action.action));
  return lines;
}

std::optional<Action> Bindings::action_of(const Chord& chord) const {
  if (chord.key == 0) return std::nullopt;
  const auto found = std::find(chords_.begin(), chords_.end(), chord);
  if (found == chords_.end()) return std::nullopt;
  return static_cast<Action>(found - chords_.begin());
}

std::optional<std::array<Action, 2>> Bindings::collision() const {
  for (std::size_t i = 0; i < chords_.size(); ++i)
    for (std::size_t k = i + 1; k < chords_.size(); ++k)
      if (chords_[i].key != 0 && chords_[i] == chords_[k])
        return std::array{static_cast<Action>(i), static_cast<Action>(k)};
  return std::nullopt;
}

}  // namespace argil::studio
