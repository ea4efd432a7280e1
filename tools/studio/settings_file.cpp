#include "tools/studio/settings_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "subdiv/error.h"

namespace argil::studio {

void read_settings(Settings& settings, std::string_view text, const std::string& file_name) {
  std::istringstream lines{std::string(text)};
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::istringstream rest(line.substr(0, line.find('#')));
    std::string name, equals, value, more;
    rest >> name >> equals >> value >> more;
    if (name.empty()) continue;
    const auto word = std::find(k_pen_words.begin(), k_pen_words.end(), value);
    if (name != "pen" || equals != "=" || word == k_pen_words.end() || !more.empty())
      throw Error(ErrorCode::bad_input,
                  fmt::format("expected `pen = strength`, `radius` or `off`, found '{}'; put it right or take the "
                              "line away",
                              line),
                  fmt::format("{}:{}", file_name, number));
    settings.pen = static_cast<PenScales>(word - k_pen_words.begin());
  }
}

std::string settings_lines(const Settings& settings) {
  return fmt::format("pen = {}\n", k_pen_words[static_cast<std::size_t>(settings.pen)]);
}

}  // namespace argil::studio
