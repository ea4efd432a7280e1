#include "tools/studio/script.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <functional>
#include <sstream>

#include "io/image.h"
#include "sculpt/measures.h"
#include "subdiv/error.h"

namespace argil::studio {

namespace {

struct Line {
  std::string name, rest;
  std::vector<std::string> words;
};

[[noreturn]] void wants(const Line& line, const char* usage) {
  throw Error(ErrorCode::bad_input, fmt::format("expected `{}`, found '{} {}'", usage, line.name, line.rest));
}

double number(const Line& line, std::size_t i, const char* usage) {
  double value = 0;
  if (i >= line.words.size()) wants(line, usage);
  const std::string& word = line.words[i];
  if (std::from_chars(word.data(), word.data() + word.size(), value).ec != std::errc{}) wants(line, usage);
  return value;
}

std::string unquoted(const std::string& text) {
  return text.size() >= 2 && text.front() == '"' && text.back() == '"' ? text.substr(1, text.size() - 2) : text;
}

int button_of(const Line& line, std::size_t i, const char* usage) {
  static constexpr std::array<const char*, 3> k_names{"left", "right", "middle"};
  for (std::size_t b = 0; b < 3; ++b)
    if (i < line.words.size() && line.words[i] == k_names[b]) return static_cast<int>(b);
  wants(line, usage);
}

double value_of(Offscreen& window, const std::string& what) {
  const Snapshot& now = window.now();
  if (what == "level") return now.state.level;
  if (what == "undo") return static_cast<double>(now.undo_depth);
  if (what == "redo") return static_cast<double>(now.redo_depth);
  if (what == "steps") return static_cast<double>(now.steps);
  if (what == "radius") return window.studio().desk().brush.radius;
  if (what == "strength") return window.studio().desk().brush.strength;
  if (what == "unsaved") return static_cast<double>(now.unsaved->size());
  if (what == "saved") return now.saved ? 1 : 0;
  if (what == "lines_in_frames") return static_cast<double>(window.workshop().lines_run_in_frames());
  return sculpt::measure(window.workshop().bench().session().document(), {.name = what});
}

Line parsed(const std::string& text) {
  Line line;
  std::istringstream words(text);
  words >> line.name;
  std::getline(words >> std::ws, line.rest);
  std::istringstream rest(line.rest);
  for (std::string word; rest >> word;) line.words.push_back(word);
  return line;
}

void run_line(const Line& line, Offscreen& window, const std::filesystem::path& out,
              const std::function<void(const std::string&)>& print, ScriptResult& result) {
  const std::string& name = line.name;
  const auto at = [&](std::size_t i, const char* usage) { return number(line, i, usage); };
  if (name == "move") {
    window.move(at(0, "move X Y"), at(1, "move X Y"));
  } else if (name == "press" || name == "release") {
    window.button(button_of(line, 0, "press left|right|middle"), name == "press");
  } else if (name == "click") {
    if (line.rest.starts_with('"'))
      window.click(unquoted(line.rest));
    else
      window.click(at(0, "click X Y"), at(1, "click X Y"));
  } else if (name == "drag") {
    static constexpr const char* k_usage = "drag X0 Y0 X1 Y1 FRAMES [left|right|middle]";
    const int which = line.words.size() > 5 ? button_of(line, 5, k_usage) : 0;
    window.drag(at(0, k_usage), at(1, k_usage), at(2, k_usage), at(3, k_usage), static_cast<int>(at(4, k_usage)),
                which);
  } else if (name == "pen") {
    static constexpr const char* k_usage = "pen PRESSURE [eraser]` with a pressure from 0 to 1, or `pen off";
    const bool off = line.rest == "off", eraser = line.words.size() == 2 && line.words[1] == "eraser";
    const double pressure = off ? 1 : at(0, k_usage);
    if (!(pressure >= 0 && pressure <= 1) || line.words.size() > (eraser ? 2U : 1U)) wants(line, k_usage);
    window.pen(pressure, eraser);
  } else if (name == "wheel") {
    window.wheel(at(0, "wheel NOTCHES"));
  } else if (name == "key") {
    window.press(line.rest);
  } else if (name == "hold" || name == "let") {
    const std::string& word = line.rest;
    const int key = word == "Ctrl"    ? key::left_control
                    : word == "Shift" ? key::left_shift
                    : word == "Alt"   ? key::left_alt
                                      : parse_chord(word).key;
    window.key(key, name == "hold");
  } else if (name == "type") {
    window.type(unquoted(line.rest));
  } else if (name == "wait") {
    window.wait(static_cast<int>(at(0, "wait FRAMES")));
  } else if (name == "size") {
    static constexpr const char* k_usage = "size WIDTH HEIGHT [SCALE]";
    window.resize(static_cast<int>(at(0, k_usage)), static_cast<int>(at(1, k_usage)),
                  line.words.size() > 2 ? static_cast<float>(at(2, k_usage)) : 1.0F);
    window.wait(2);
  } else if (name == "picture") {
    const std::filesystem::path file(unquoted(line.rest));
    if (file.is_absolute() || file.extension() != ".png" || line.rest.find("..") != std::string::npos)
      wants(line, "picture NAME.png");
    const sculpt::Picture picture = window.picture();
    std::filesystem::create_directories((out / file).parent_path());
    io::write_png(out / file, picture.width, picture.height, picture.rgba);
    ++result.pictures;
  } else if (name == "print") {
    if (line.rest == "hash")
      print(fmt::format("hash {:016x}", window.workshop().bench().session().document().state_hash()));
    else
      print(fmt::format("{} {:g}", line.rest, value_of(window, line.rest)));
  } else if (name == "expect") {
    static constexpr const char* k_usage = "expect WHAT VALUE [LARGEST]";
    if (line.words.size() < 2) wants(line, k_usage);
    const double value = value_of(window, line.words[0]), low = at(1, k_usage);
    const double high = line.words.size() > 2 ? at(2, k_usage) : low;
    if (!(value >= low && value <= high)) {
      ++result.failed;
      print(fmt::format("expected {} {:g} to {:g}, found {:g}", line.words[0], low, high, value));
    }
  } else {
    throw Error(
        ErrorCode::bad_input,
        fmt::format(
            "'{}' is not something a hand does; there are move, press, release, click, drag, pen, wheel, key, "
            "hold, let, type, wait, size, picture, print, expect",
            name));
  }
}

}  // namespace

ScriptResult run_script(const std::string& text, const std::string& file_name, Offscreen& window,
                        const std::filesystem::path& out, const std::function<void(const std::string&)>& print) {
  ScriptResult result;
  std::istringstream lines(text);
  int count = 0;
  for (std::string each; std::getline(lines, each);) {
    ++count;
    const Line line = parsed(each);
    if (line.name.empty() || line.name.starts_with('#')) continue;
    const int failed = result.failed;
    try {
      run_line(line, window, out, print, result);
    } catch (const Error& error) {
      throw Error(error.code(), error.what(), fmt::format("{}:{}", file_name, count));
    }
    if (result.failed > failed) print(fmt::format("  at {}:{}", file_name, count));
  }
  return result;
}

}  // namespace argil::studio
