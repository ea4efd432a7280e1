#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "io/file_bytes.h"
#include "sculpt/session.h"
#include "sculpt/summary.h"
#include "subdiv/error.h"
#include "tools/argil/program.h"
#include "tools/argil/progress_bar.h"
#include "tools/view/offscreen_renderer.h"

namespace argil::tools {

namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string read_text(const std::filesystem::path& path) {
  std::error_code failure;
  if (std::filesystem::is_directory(path, failure))
    throw Error(ErrorCode::bad_input,
                fmt::format("expected a session file, found the folder '{}'; name a file in it", path.string()));
  if (std::filesystem::is_regular_file(path, failure) &&
      std::filesystem::file_size(path, failure) > io::k_max_session_file)
    throw Error(ErrorCode::limit_exceeded, fmt::format("the session '{}' is not a text of at most {} MiB; split it",
                                                       path.string(), io::k_max_session_file >> 20));
  return io::read_file(path);
}

std::map<std::string, std::string> parsed_overrides(const std::vector<std::string>& texts) {
  std::map<std::string, std::string> overrides;
  for (const std::string& text : texts) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw Error(ErrorCode::bad_input,
                  fmt::format("--set wants COMMAND=ARGUMENTS, as in --set space=cubic; found '{}'", text));
    const std::string name = text.substr(0, equals);
    (void)sculpt::find_command(io::parse_session_line(name, "--set " + name, 1));
    if (!overrides.emplace(name, text.substr(equals + 1)).second)
      throw Error(ErrorCode::bad_input, fmt::format("--set {} is given twice; which one is meant?", name));
  }
  return overrides;
}

// An override that no line waits for would do nothing. (These three come after `new` and `open`, if not before.)
void check_used(const std::map<std::string, std::string>& overrides, const std::vector<io::SessionLine>& lines) {
  for (const auto& [name, unused] : overrides) {
    if (name == "space" || name == "model" || name == "integrator") continue;
    if (std::none_of(lines.begin(), lines.end(),
                     [&](const io::SessionLine& line) { return line.tokens[0].text == name; }))
      throw Error(ErrorCode::bad_input,
                  fmt::format("--set {} stands in for lines of the session, and it has no `{}`; add one to it",
                              name, name));
  }
}

// What a replay writes must not be what it reads.
void check_apart(const std::filesystem::path& session, const std::filesystem::path& written, const char* remedy) {
  std::error_code failure;
  if (std::filesystem::equivalent(session, written, failure))
    throw Error(ErrorCode::refused,
                fmt::format("'{}' is the session itself and would be overwritten; {}", written.string(), remedy));
}

}  // namespace

int replay(const ReplayArguments& arguments) {
  std::string text = read_text(arguments.session);
  if (arguments.journal && !text.empty() && text.back() != '\n') {
    const std::size_t begin = text.rfind('\n') + 1;
    std::fprintf(stderr, "argil: the last line was not written to its end and is left out: %s\n",
                 text.substr(begin).c_str());
    text.resize(begin);
  }
  const auto overrides = parsed_overrides(arguments.overrides);
  check_used(overrides, io::parse_session(text, arguments.session.string()));
  const int threads =
      arguments.threads > 0 ? arguments.threads : static_cast<int>(std::thread::hardware_concurrency());
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
  ProgressBar bar(arguments.quiet);
  std::unique_ptr<sculpt::Renderer> renderer;
  if (arguments.pictures) renderer = view::make_offscreen_renderer();

  sculpt::SessionOptions options;
  options.read_root = arguments.files.empty() ? arguments.session.parent_path() : arguments.files;
  options.out = arguments.out.empty() ? std::filesystem::path("out") / arguments.session.stem() : arguments.out;
  options.hash_trace = arguments.hash_trace;
  options.step_trace = arguments.trace;
  options.overrides = overrides;
  options.until_step = arguments.until;
  options.limits = arguments.limits;
  options.renderer = renderer.get();
  options.clock = seconds;
  options.print = [&](const std::string& message) { bar.message(message); };
  options.progress = [&](double fraction, const std::string& what) { bar.update(fraction, what); };

  check_apart(arguments.session, options.out / "journal.argil", "choose another folder with --out");
  check_apart(arguments.session, options.hash_trace, "choose another file with --hash-trace");
  check_apart(arguments.session, options.step_trace, "choose another file with --trace");
  sculpt::Session session(options);
  try {
    session.run_text(text, arguments.session.string());
  } catch (const Error&) {
    bar.clear();
    throw;
  } catch (const std::exception&) {
    bar.clear();
    std::fprintf(stderr, "argil: the journal up to here is in %s\n", session.journal_path().string().c_str());
    throw;
  }
  bar.clear();
  const std::string summary = sculpt::summary_json(session, arguments.session.stem().string(), threads);
  io::write_file(options.out / "summary.json", summary + '\n');
  if (arguments.json) std::printf("%s\n", summary.c_str());
  for (const sculpt::FailedExpectation& failed : session.failed())
    std::fprintf(stderr, "%s: %s\n", failed.where.c_str(), failed.message.c_str());
  if (!arguments.quiet && !arguments.json)
    std::printf("%zu steps, %d of %d expectations held, state %016llx; results in %s\n", session.steps().size(),
                session.expectations - static_cast<int>(session.failed().size()), session.expectations,
                static_cast<unsigned long long>(session.document().state_hash()), options.out.string().c_str());
  return session.failed().empty() ? k_well : k_expectation_failed;
}

}  // namespace argil::tools
