#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "subdiv/error.h"
#include "tools/argil/program.h"

namespace argil::tools {

namespace {

struct TraceLine {
  long line = 0, step = 0;
  std::string command, hash;
};

std::vector<TraceLine> read_trace(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file || std::filesystem::is_directory(path))
    throw Error(
        ErrorCode::not_found,
        fmt::format("the trace '{}' cannot be read; `argil replay --hash-trace FILE` makes one", path.string()));
  std::vector<TraceLine> lines;
  std::string text;
  while (std::getline(file, text)) {
    std::istringstream words(text);
    TraceLine line;
    std::string rest;
    if (!(words >> line.line >> line.command >> line.step >> line.hash) || (words >> rest) ||
        line.hash.size() != 16 || line.hash.find_first_not_of("0123456789abcdef") != std::string::npos)
      throw Error(ErrorCode::bad_input,
                  "this is not a line of a hash trace; make it with `argil replay --hash-trace`",
                  fmt::format("{}:{}:1", path.string(), lines.size() + 1));
    lines.push_back(std::move(line));
  }
  if (lines.empty())
    throw Error(ErrorCode::bad_input,
                "expected the lines of a hash trace, found none; make it with `argil replay --hash-trace`",
                path.string());
  return lines;
}

}  // namespace

int diff(const std::filesystem::path& path_a, const std::filesystem::path& path_b, bool json) {
  const auto a = read_trace(path_a), b = read_trace(path_b);
  const std::size_t common = std::min(a.size(), b.size());
  std::size_t i = 0;
  while (i < common && a[i].hash == b[i].hash && a[i].command == b[i].command) ++i;
  const bool same = i == a.size() && i == b.size();
  const auto describe = [&](const std::vector<TraceLine>& trace) {
    return i < trace.size() ? fmt::format("'{}' in line {}, step {}, state {}", trace[i].command, trace[i].line,
                                          trace[i].step, trace[i].hash)
                            : std::string("the trace has ended");
  };
  if (json) {
    nlohmann::ordered_json answer{{"same", same}, {"compared", i}};
    if (!same) {
      answer["first_difference"] = {{"a", describe(a)}, {"b", describe(b)}};
      const TraceLine& at = i < a.size() ? a[i] : b[i];
      answer["line"] = at.line;
      answer["command"] = at.command;
      answer["step"] = at.step;
    }
    fmt::print("{}\n", answer.dump(2));
  } else if (same) {
    fmt::print("the same: {} states\n", a.size());
  } else {
    fmt::print("the first difference is after {} equal states:\n  {}: {}\n  {}: {}\n", i, path_a.string(),
               describe(a), path_b.string(), describe(b));
  }
  return same ? k_well : k_expectation_failed;
}

}  // namespace argil::tools
