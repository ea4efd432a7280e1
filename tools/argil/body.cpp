#include "tools/argil/body.h"

#include <fmt/format.h>

#include "io/session_text.h"
#include "subdiv/error.h"

namespace argil::tools {

std::unique_ptr<sculpt::Session> run_body(const BodyArguments& arguments) {
  // Links that the user names are followed; those in a session's folder are not.
  std::error_code failure;
  const std::filesystem::path input = std::filesystem::canonical(arguments.input, failure);
  if (failure)
    throw Error(ErrorCode::not_found, "there is no such file; check the name and the folder",
                arguments.input.string());
  const bool is_session = input.extension() == ".argil";
  sculpt::SessionOptions options;
  options.read_root = (is_session ? arguments.input : input).parent_path();
  options.out = ".";  // where nothing is written
  options.write_journal = false;
  options.limits = arguments.limits;
  options.print = [](const std::string&) {};
  auto session = std::make_unique<sculpt::Session>(options);
  const auto run = [&](const std::string& line, const std::string& option) {
    session->run_line(io::parse_session_line(line, option, 1));
  };
  if (is_session) {
    for (const io::SessionLine& line : io::read_session(arguments.input)) {
      if (sculpt::find_command(line).effect != sculpt::Effect::output) session->run_line(line);
    }
  } else {
    run("open " + io::quote(input.filename().string()), arguments.input.string());
  }
  if (!is_session || arguments.levels >= 0)
    run(fmt::format("levels {}", arguments.levels >= 0 ? arguments.levels : 1), "--levels");
  if (!arguments.space.empty()) run("space " + arguments.space, "--space");
  if (!arguments.model.empty()) run("model " + arguments.model, "--model");
  for (const std::string& condition : arguments.pins) run("pin where " + condition, "--pin");
  for (const std::string& line : arguments.lines) run(line, "--with");
  if (session->document().empty())
    throw Error(ErrorCode::bad_input, "the session ends without a solid; it wants `new` or `open`",
                arguments.input.string());
  return session;
}

}  // namespace argil::tools
