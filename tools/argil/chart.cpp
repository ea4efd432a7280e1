#include "tools/chart/chart.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

#include "io/file_bytes.h"
#include "subdiv/error.h"
#include "tools/argil/program.h"
#include "tools/chart/session_chart.h"

namespace argil::tools {

namespace {

std::atomic<bool> stop_asked = false;

// The second time, the program ends at once; the table is whole even then.
void ask_to_stop(int) {
  stop_asked = true;
  std::signal(SIGINT, SIG_DFL);
}

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void print_lists(const chart::Lists& lists) {
  fmt::print("Problems (* in --quick):\n");
  for (const chart::Problem& problem : lists.problems)
    fmt::print("  {:<18}{} {} [{}]\n", problem.name, problem.in_quick ? '*' : ' ', problem.title, problem.source);
  fmt::print("Models, with their formulations:\n");
  for (const chart::ModelRow& model : lists.models) fmt::print("  {:<32} {}\n", model.name(), model.summary);
  fmt::print("Spaces:\n");
  for (const chart::SpaceRow& space : lists.spaces) fmt::print("  {:<18}  {}\n", space.name, space.summary);
  fmt::print("Integrators:\n");
  for (const fem::MethodKind& method : lists.integrators) fmt::print("  {:<18}  {}\n", method.name, method.summary);
}

class Progress {
 public:
  Progress(std::size_t total, bool quiet) : total_(total), quiet_(quiet), terminal_(isatty(fileno(stderr)) != 0) {}
  void operator()(std::size_t number, const std::string& label, const chart::Row* row) const {
    if (quiet_) return;
    const std::string head = fmt::format("{:>5}/{}  {}", number + 1, total_, label);
    if (!row) {
      if (terminal_) fmt::print(stderr, "\r\x1b[2K{:.110}", head);
      return;
    }
    const std::string result =
        row->status == chart::Status::ok
            ? fmt::format("error {}, {}", chart::percent_text(row->error), chart::time_text(row->ms))
            : std::string(chart::word(row->status));
    fmt::print(stderr, "{}{:<78} {}\n", terminal_ ? "\r\x1b[2K" : "", head, result);
  }

 private:
  std::size_t total_;
  bool quiet_, terminal_;
};

void make_folder(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure)
    throw Error(ErrorCode::bad_input, fmt::format("the folder '{}' cannot be made ({}); choose another with --out",
                                                  folder.string(), failure.message()));
}

int chart_of_session(const ChartArguments& arguments, const chart::Choice& choice, const chart::Setting& setting) {
  if (!arguments.problems.empty() || arguments.quick || arguments.every)
    throw Error(ErrorCode::bad_input,
                "a session is charted as it is; leave out --problem, --quick and --all, or leave out the session");
  static_cast<void>(chart::chosen(chart::all_lists(), choice));  // refuses names that are not there
  const auto folder = arguments.out / arguments.session.stem();
  make_folder(folder);
  const chart::SessionFile session{arguments.session, io::read_file(arguments.session)};
  chart::Table table(folder / "chart.csv");
  std::size_t number = 0;
  try {
    const chart::Panel panel = chart::chart_session(
        session, choice, setting, table, folder, [&](const std::string& label, const chart::Row* row) {
          if (arguments.quiet) return;
          if (!row) return fmt::print(stderr, "{:>5}  {}\n", ++number, label);
          fmt::print(stderr, "       {}\n",
                     row->status == chart::Status::ok
                         ? fmt::format("error {}, {}", chart::percent_text(row->error), chart::time_text(row->ms))
                         : fmt::format("{}: {}", chart::word(row->status), row->message));
        });
    chart::write_results(folder, {panel});
  } catch (const chart::Stopped&) {
    fmt::print("Stopped; the same command goes on.\n");
    return k_well;
  }
  if (!arguments.quiet) fmt::print("open {}\n", (folder / "chart.html").string());
  return k_well;
}

}  // namespace

int chart(const ChartArguments& arguments) {
  const chart::Choice choice{arguments.problems, arguments.models, arguments.spaces, arguments.integrators};
  chart::Setting setting;
  setting.clock = seconds;
  setting.threads =
      arguments.threads > 0 ? arguments.threads : static_cast<int>(std::thread::hardware_concurrency());
  setting.seconds_a_run = arguments.limit > 0 ? arguments.limit : (arguments.quick ? 5 : 60);
  setting.stopped = [] { return stop_asked.load(); };
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(setting.threads));
  std::signal(SIGINT, ask_to_stop);
  if (!arguments.session.empty()) return chart_of_session(arguments, choice, setting);
  chart::Lists lists = chart::chosen(chart::all_lists(), choice);
  if (arguments.list) {
    print_lists(lists);
    return k_well;
  }
  if (arguments.quick && arguments.problems.empty()) lists = chart::quick_problems(std::move(lists));
  const auto runs = chart::plan(lists, arguments.quick   ? chart::Breadth::quick
                                       : arguments.every ? chart::Breadth::all
                                                         : chart::Breadth::usual);
  make_folder(arguments.out);
  chart::Table table(arguments.out / "chart.csv");
  const double begin = seconds();
  bool stopped = false;
  const Progress progress(runs.size(), arguments.quiet);
  try {
    chart::execute(runs, setting, table, [&](std::size_t number, const chart::Run& run, const chart::Row* row) {
      progress(number, run.label(), row);
    });
  } catch (const chart::Stopped&) {
    stopped = true;
  }
  const auto panels = chart::panels(runs, setting, table);
  chart::write_results(arguments.out, panels);
  std::size_t done = 0;
  for (const chart::Panel& panel : panels) done += panel.rows.size();
  if (!arguments.quiet)
    fmt::print("{}{} of {} runs in {} problems, {:.0f} s; open {}\n",
               stopped ? "Stopped; the same command goes on. " : "", done, runs.size(), panels.size(),
               seconds() - begin, (arguments.out / "chart.html").string());
  return k_well;
}

}  // namespace argil::tools
