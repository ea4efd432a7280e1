// The command line of Argil: parses, calls a subcommand, and turns errors into messages and exit statuses.

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>

#include "io/volume_formats.h"
#include "sculpt/near_names.h"
#include "sculpt/step_trace.h"
#include "subdiv/error.h"
#include "tools/argil/program.h"

namespace {

using namespace argil::tools;

// What CLI11 says, with the place where help is; it does not name a subcommand that there is not.
std::string usage_message(const CLI::App& app, const CLI::Error& error, const std::string& first_word) {
  std::vector<std::string> names;
  for (const CLI::App* subcommand : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(subcommand->get_name());
  const auto chosen = app.get_subcommands();
  if (chosen.empty() && !first_word.empty() && first_word[0] != '-')
    return fmt::format("argil: '{}' is not a subcommand{}; `argil --help` lists them\n", first_word,
                       argil::sculpt::near_names_hint(first_word, names));
  const std::string name = chosen.empty() ? "argil" : "argil " + chosen.front()->get_name();
  return fmt::format("{}: {}; `{} --help` explains\n", name, error.what(), name);
}

// A failed assertion ends with the exit status of our own bugs. Only what is safe in a signal handler is called.
void report_abort(int) {
  static const char message[] =
      "argil: this is a bug of ours; a replay's journal.argil, in its --out folder, holds all commands before this "
      "one\n";
  (void)!write(STDERR_FILENO, message, sizeof message - 1);
  _exit(k_own_bug);
}

void add_body_options(CLI::App* app, BodyArguments& body, const std::string& mesh_endings) {
  app->add_option("body", body.input, "a session (.argil), run to its end, or a volume mesh: " + mesh_endings)
      ->required();
  app->add_option("--levels", body.levels, "refinements (default: the session's; 1 for a mesh)")
      ->check(CLI::Range(0, 8));
  app->add_option("--space", body.space, "default or cubic")->check(CLI::IsMember({"default", "cubic"}));
  app->add_option("--model", body.model, "the force model; `argil help model` lists them");
  app->add_option("--pin", body.pins, "hold control vertices, as in --pin \"x < 0.01\"; may be repeated");
  app->add_option("--with", body.lines,
                  "a further line of session commands, as in --with \"set young_modulus 1e6\"; may be repeated");
  app->add_option("--max-cells", body.limits.cells, "refuse to make more cells")->capture_default_str();
  app->add_option("--max-memory", body.limits.memory, "bytes, estimated before allocating")->capture_default_str();
}

int run(int argc, char** argv) {
  CLI::App app{
      "Argil sculpts solids by force: coarse solids, refined by subdivision, deformed as finite elements."};
  app.name("argil");
  app.set_version_flag("--version", "argil " ARGIL_VERSION);
  app.require_subcommand(0, 1);
  app.footer(
      "`argil help` lists the commands of a session, `argil help COMMAND` explains one.\n"
      "Exit status: 0 all well, 1 an `expect` failed, 2 bad input, 3 a bug of ours.");
  int status = k_well;
  const std::string mesh_endings = argil::io::volume_endings();

  ReplayArguments replaying;
  CLI::App* replay_app =
      app.add_subcommand("replay", "Runs a session file and writes its results and summary.json");
  replay_app->add_option("session", replaying.session, "the session file")->required();
  replay_app->add_option("--out", replaying.out, "folder for results (default: out/<session name>)");
  replay_app->add_option("--files", replaying.files,
                         "folder beneath which names in the session are read (default: the session's own)");
  replay_app->add_option("--threads", replaying.threads, "threads; the results are the same bits for any number")
      ->check(CLI::Range(1, 1024));
  replay_app->add_option("--until", replaying.until, "stop after this many simulation steps")
      ->check(CLI::PositiveNumber);
  replay_app->add_option("--hash-trace", replaying.hash_trace, "write one state hash a step, for `argil diff`");
  replay_app->add_option("--trace", replaying.trace,
                         "write a CSV row a step: energies by kind, momenta, volume, reactions, iterations, time");
  replay_app->add_option("--set", replaying.overrides,
                         "stand in for a command of the session: --set space=cubic, --set levels=1");
  replay_app->add_option("--max-cells", replaying.limits.cells, "refuse to make more cells")->capture_default_str();
  replay_app->add_option("--max-steps", replaying.limits.steps, "refuse to take more steps")->capture_default_str();
  replay_app->add_option("--max-memory", replaying.limits.memory, "bytes, estimated before allocating")
      ->capture_default_str();
  replay_app->add_flag("--json", replaying.json, "print the summary to standard output");
  replay_app->add_flag("--quiet", replaying.quiet, "no progress, no messages");
  replay_app->add_flag("!--no-pictures", replaying.pictures, "skip `render`");
  replay_app->footer(
      "Columns of --trace: " + argil::sculpt::step_trace_header() +
      ".\n"
      "summary.json: version, session, state_hash, steps, space, cells {regular, regular_published, "
      "extraordinary, irregular}, elements {cubic, linear, pyramid}, unknowns, ms_per_step {median, p99, "
      "forces, tangent, solve, line_search, other}, solver_iterations, newton_iterations, energy, volume, mass, "
      "guard {on, frozen, found, steps}, linear_solver {rule, steps}, threads, measures, expectations.");
  replay_app->callback([&] { status = replay(replaying); });

  MovieArguments filming;
  CLI::App* movie_app = app.add_subcommand(
      "movie", "Replays a session as a film of its simulation, or turns about its last shape: .mp4, .gif, .png");
  movie_app->add_option("session", filming.session, "the session file")->required();
  movie_app->add_option("--out", filming.out, "folder for results (default: out/<session name>)");
  movie_app->add_option(
      "--file", filming.file,
      "the film beneath it: .mp4 or .gif, made by ffmpeg, or .png for numbered pictures (default: the "
      "session's name, .mp4 where there is ffmpeg, else .png)");
  movie_app->add_option("--fps", filming.rate, "pictures a second of simulated time; of a turn, of the film")
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
  movie_app->add_flag("--turntable", filming.turntable, "once about the last shape, which stands still");
  movie_app->add_option("--seconds", filming.seconds, "of a turn")
      ->check(CLI::Range(0.01, 600.0))
      ->capture_default_str();
  movie_app->add_option("--with", filming.options,
                        "arguments of the session command `render`, as in --with \"field strain size 800 600\"");
  movie_app->add_option("--max-cells", filming.limits.cells, "refuse to make more cells")->capture_default_str();
  movie_app->add_option("--max-steps", filming.limits.steps, "refuse to take more steps")->capture_default_str();
  movie_app->add_flag("--quiet", filming.quiet, "no progress, no messages");
  movie_app->footer("The session runs twice: first to see where the body goes, so that the eye stands still.");
  movie_app->callback([&] {
    if (movie_app->count("--seconds") > 0 && !filming.turntable)
      throw argil::Error(argil::ErrorCode::bad_input, "--seconds is that of a turn; add --turntable");
    status = movie(filming);
  });

  ReplayArguments restoring;
  restoring.journal = true;
  CLI::App* restore_app = app.add_subcommand(
      "restore", "Replays the journal of a program that was killed: every command that it had finished");
  restore_app->add_option("journal", restoring.session, "journal.argil in the folder of its results")->required();
  restore_app->add_option("--files", restoring.files, "the folder of the session that was running");
  restore_app->add_option("--out", restoring.out, "folder for results (default: out/journal)");
  restore_app->add_flag("--json", restoring.json, "print the summary to standard output");
  restore_app->add_flag("--quiet", restoring.quiet, "no progress, no messages");
  restore_app->add_flag("!--no-pictures", restoring.pictures, "skip `render`");
  restore_app->callback([&] { status = replay(restoring); });

  std::filesystem::path first, second;
  bool json = false, limit = false;
  int levels = 0, split = 1;
  std::string space = "default", command;
  std::size_t max_cells = argil::sculpt::Limits{}.cells;

  CLI::App* diff_app =
      app.add_subcommand("diff", "Names the first command and step at which two hash traces differ");
  diff_app->add_option("trace_a", first)->required();
  diff_app->add_option("trace_b", second)->required();
  diff_app->add_flag("--json", json, "print the answer as JSON");
  diff_app->callback([&] { status = diff(first, second, json); });

  CLI::App* info_app = app.add_subcommand("info", "Counts, measures and quality of a volume mesh");
  info_app->add_option("mesh", first, mesh_endings)->required();
  info_app->add_flag("--json", json, "print as JSON");
  info_app->callback([&] { status = info(first, json); });

  CLI::App* refine_app = app.add_subcommand("refine", "Refines a volume mesh by MacCracken–Joy subdivision");
  refine_app->add_option("mesh", first, mesh_endings)->required();
  refine_app->add_option("out", second, "a volume mesh, or its boundary as .obj .ply .stl .off .glb .gltf")
      ->required();
  refine_app->add_option("--levels", levels, "how often")->required()->check(CLI::Range(0, 8));
  refine_app->add_flag("--limit", limit, "put the vertices where infinitely many refinements would");
  refine_app->add_option("--max-cells", max_cells, "refuse to make more cells")->capture_default_str();
  refine_app->callback([&] { status = refine(first, second, levels, limit, max_cells); });

  CLI::App* elements_app = app.add_subcommand("elements", "Classes of cells and counts of finite elements");
  elements_app->add_option("mesh", first, mesh_endings)->required();
  elements_app->add_option("--levels", levels, "refinements")->required()->check(CLI::Range(0, 8));
  elements_app->add_option("--space", space, "default, cubic or published")
      ->check(CLI::IsMember({"default", "cubic", "published"}));
  elements_app->add_option("--split", split, "cubic: how often the remaining cells are split")
      ->check(CLI::Range(0, 3));
  elements_app->add_flag("--json", json, "print as JSON");
  elements_app->add_option("--max-cells", max_cells, "refuse to make more cells")->capture_default_str();
  elements_app->callback([&] { status = elements(first, levels, space, split, json, max_cells); });

  CLI::App* convert_app = app.add_subcommand("convert", "Writes a volume mesh, or its boundary, in another format");
  ConvertArguments converting;
  convert_app->add_option("in", converting.in, mesh_endings)->required();
  convert_app
      ->add_option("out", converting.out, mesh_endings + ", or .obj .ply .stl .off .glb .gltf for the boundary")
      ->required();
  convert_app->add_option("--encoding", converting.encoding, "ascii, binary (raw), compressed; see `argil formats`")
      ->check(CLI::IsMember({"ascii", "binary", "raw", "compressed"}));
  convert_app->add_option("--version", converting.version, "of .msh: 2.2 or 4.1");
  convert_app->add_flag("--repair", converting.repair, "turn cells round that are inside out");
  convert_app->callback([&] { status = convert(converting); });

  CLI::App* formats_app = app.add_subcommand("formats", "What each volume format holds");
  bool markdown = false;
  formats_app->add_flag("--markdown", markdown, "as the table of docs/formats.md");
  formats_app->callback([&] { status = formats(markdown); });

  RenderArguments rendering;
  CLI::App* render_app = app.add_subcommand("render", "Makes a picture of a volume mesh, without a display");
  render_app->add_option("mesh", rendering.mesh, mesh_endings)->required();
  render_app->add_option("out", rendering.out, "a .png")->required();
  render_app->add_option("--levels", rendering.levels, "refinements")->check(CLI::Range(0, 8));
  render_app->add_option("--with", rendering.options,
                         "arguments of the session command `render`, as in --with \"cage size 800 600\"");
  render_app->add_option("--max-cells", rendering.max_cells, "refuse to make more cells")->capture_default_str();
  render_app->callback([&] { status = render(rendering); });

  CLI::App* bench_app = app.add_subcommand("bench", "Measures speed on this machine");
  bench_app->require_subcommand(1);
  CLI::App* models_app = bench_app->add_subcommand(
      "models", "The models of papers/004, Table 1: every column, ours beside the paper's");
  BenchArguments benching;
  std::string bench_space, bench_model, bench_integrator;
  models_app->add_option("folder", benching.folder, "sessions; those named as in the table get its row")
      ->capture_default_str();
  models_app->add_option("--out", benching.out, "folder for what the sessions write")->capture_default_str();
  models_app->add_option("--space", bench_space, "instead of the session's own; as the command `space`");
  models_app->add_option("--model", bench_model, "as the command `model`");
  models_app->add_option("--integrator", bench_integrator, "as the command `integrator`");
  models_app->add_option("--steps", benching.steps, "steps that are timed")
      ->capture_default_str()
      ->check(CLI::Range(1, 100000));
  models_app->add_option("--threads", benching.threads, "threads")->check(CLI::Range(1, 1024));
  models_app->add_flag("--json", benching.json, "print as JSON");
  models_app->callback([&] {
    if (!bench_space.empty()) benching.overrides["space"] = bench_space;
    if (!bench_model.empty()) benching.overrides["model"] = bench_model;
    if (!bench_integrator.empty()) benching.overrides["integrator"] = bench_integrator;
    status = bench_models(benching);
  });
  StudioBenchArguments studio_benching;
  CLI::App* studio_bench_app = bench_app->add_subcommand(
      "studio", "Frames of the window, off the screen: turning a fine solid, and during a stroke on each model");
  studio_bench_app->add_option("folder", studio_benching.folder, "sessions to stroke")->capture_default_str();
  studio_bench_app->add_option("--out", studio_benching.out, "folder for what they write")->capture_default_str();
  studio_bench_app->add_option("--frames", studio_benching.frames, "frames that are timed")
      ->check(CLI::Range(10, 100000))
      ->capture_default_str();
  studio_bench_app->callback([&] { status = bench_studio(studio_benching); });
  ChartArguments charting;
  CLI::App* chart_app = app.add_subcommand("chart",
                                           "Charts speed against accuracy: methods on problems with known "
                                           "answers, or on a session of yours");
  chart_app->add_option("session", charting.session,
                        "a session file, compared with its own refinement (default: the problems of the chart)");
  chart_app->add_option("--out", charting.out, "folder for chart.csv, chart.html and the pictures")
      ->capture_default_str();
  chart_app->add_flag("--quick", charting.quick, "few problems, coarse bodies: about two minutes on two cores");
  chart_app->add_flag("--all", charting.every, "every integrator with every model in every space: hours");
  chart_app->add_option("--problem", charting.problems, "only these problems");
  chart_app->add_option("--model", charting.models, "only these models");
  chart_app->add_option("--space", charting.spaces, "only these spaces");
  chart_app->add_option("--integrator", charting.integrators, "only these integrators");
  chart_app->add_option("--threads", charting.threads, "threads of each run")->check(CLI::Range(1, 1024));
  chart_app->add_option("--limit", charting.limit, "stop a run after so many seconds (default: 60, quick 5)")
      ->check(CLI::PositiveNumber);
  chart_app->add_flag("--list", charting.list, "print the names of problems, models, spaces and integrators");
  chart_app->add_flag("--quiet", charting.quiet, "no progress");
  chart_app->footer(
      "Rows are appended to chart.csv as they finish; the same command goes on where it was stopped.");
  chart_app->callback([&] { status = chart(charting); });
  ModesArguments vibrating;
  CLI::App* modes_app =
      app.add_subcommand("modes", "Lowest frequencies and mode shapes of a body, and its largest explicit step");
  add_body_options(modes_app, vibrating.body, mesh_endings);
  modes_app->add_option("--count", vibrating.count, "how many modes")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  modes_app->add_option("--at", vibrating.at, "where the stiffness is taken: the present state or the rest shape")
      ->check(CLI::IsMember({"present", "rest"}))
      ->capture_default_str();
  modes_app->add_option("--out", vibrating.out, "folder for modes.vtu, one displacement field a mode");
  modes_app->add_flag("--json", vibrating.json, "print as JSON");
  modes_app->footer(
      "A frequency of 0 is a rigid motion that nothing holds, a negative one in JSON an instability.");
  modes_app->callback([&] { status = modes(vibrating); });

  MatricesArguments exporting;
  CLI::App* matrices_app = app.add_subcommand(
      "export-matrices", "Stencils, mass, stiffness and damping of a body in Matrix Market files");
  add_body_options(matrices_app, exporting.body, mesh_endings);
  matrices_app
      ->add_option("--at", exporting.at, "where the stiffness is taken: the present state or the rest shape")
      ->check(CLI::IsMember({"present", "rest"}))
      ->capture_default_str();
  matrices_app->add_option("--out", exporting.out, "folder for the files")->required();
  matrices_app->add_flag("--json", exporting.json, "print the list of files as JSON");
  matrices_app->callback([&] { status = export_matrices(exporting); });

  AtlasArguments mapping;
  CLI::App* atlas_app = app.add_subcommand(
      "atlas", "Maps where each force model with each integrator is stable, inaccurate, or diverges");
  atlas_app->add_option("session", mapping.session, "a session whose end is mapped instead of the built-in scenes");
  atlas_app
      ->add_option("--out", mapping.out, "folder for probes.csv, the maps and index.html; what is there is kept")
      ->capture_default_str();
  atlas_app->add_option("--sweep", mapping.sweeps, "one of --list; may be repeated (default: all)");
  atlas_app->add_option("--model", mapping.models, "a force model; may be repeated (default: all)");
  atlas_app->add_option("--integrator", mapping.integrators, "an integrator; may be repeated (default: all)");
  atlas_app->add_option("--threads", mapping.threads, "threads; the results are the same for any number")
      ->check(CLI::Range(1, 1024));
  atlas_app->add_flag("--quick", mapping.quick,
                      "coarse maps; every model with bdf2 and every integrator with corotational");
  atlas_app->add_flag("--list", mapping.list, "list sweeps, models and integrators, and run nothing");
  atlas_app->add_flag("--quiet", mapping.quiet, "no progress");
  atlas_app->footer("A run that was stopped goes on where it was: probes.csv keeps every finished probe.");
  atlas_app->callback([&] { status = stability_atlas(mapping); });

  DevicesArguments handling;
  CLI::App* devices_app = app.add_subcommand("devices", "Lists the devices to sculpt with, and what they can");
  devices_app->add_flag("--bench", handling.bench, "how well this machine keeps a tick of 1 ms");
  devices_app->add_option("--serve", handling.serve, "makes hand, gamepad or space_mouse a device by UDP");
  devices_app->add_option("--address", handling.address, "IPv4 address to serve at")->capture_default_str();
  devices_app->add_option("--port", handling.port, "UDP port to serve at; 0: any")->capture_default_str();
  devices_app->add_option("--seconds", handling.seconds, "of serving or measuring")->check(CLI::Range(0.0, 1e6));
  devices_app->add_flag("--json", handling.json);
  devices_app->callback([&] { status = devices_command(handling); });

  StudioArguments sculpting;
  CLI::App* studio_app =
      app.add_subcommand("studio", "Opens the window to sculpt in (also without any subcommand)");
  studio_app->add_option("file", sculpting.file, "a session (.argil) or a volume mesh; default: a new block");
  studio_app->add_option("--script", sculpting.script,
                         "drive the window off the screen by this text (docs/studio.md)");
  studio_app->add_option("--out", sculpting.out, "folder for the journal, results, and pictures of a script")
      ->capture_default_str();
  studio_app
      ->add_option("--device", sculpting.device,
                   "to sculpt with: gamepad, space_mouse, hand, or \"network ADDRESS:PORT\"")
      ->capture_default_str();
  studio_app->add_option("--max-cells", sculpting.limits.cells, "refuse to make more cells")->capture_default_str();
  studio_app->add_option("--max-memory", sculpting.limits.memory, "bytes, estimated before allocating")
      ->capture_default_str();
  studio_app->callback([&] { status = studio(sculpting); });

  CLI::App* help_app = app.add_subcommand("help", "The commands of a session, or one of them");
  help_app->add_option("command", command, "a command of a session");
  bool document = false;
  help_app->add_flag("--document", document, "docs/commands.md, written from the table of commands");
  help_app->callback([&] { status = document ? help_document() : help(command); });

  const std::string first_word = argc > 1 ? argv[1] : "";
  app.failure_message(
      [&](const CLI::App*, const CLI::Error& error) { return usage_message(app, error, first_word); });
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? k_well : k_bad_input;
  }
  if (app.get_subcommands().empty()) return studio(sculpting);
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGABRT, report_abort);
  try {
    return run(argc, argv);
  } catch (const argil::Error& error) {
    std::fprintf(stderr, "argil: %s%s%s\n", error.where().c_str(), error.where().empty() ? "" : ": ", error.what());
    return k_bad_input;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr,
                 "argil: out of memory; lower the level, or choose limits with --max-cells and --max-memory\n");
    return k_bad_input;
  } catch (const std::filesystem::filesystem_error& error) {
    std::fprintf(stderr, "argil: %s; choose files and folders that exist and are yours\n", error.what());
    return k_bad_input;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "argil: this is a bug of ours: %s\n", error.what());
    return k_own_bug;
  }
}
