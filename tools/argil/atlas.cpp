#include "tools/atlas/atlas.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "io/file_bytes.h"
#include "subdiv/error.h"
#include "tools/argil/program.h"
#include "tools/atlas/map.h"
#include "tools/atlas/page.h"

namespace argil::tools {

namespace {

using namespace argil::atlas;

bool chosen(const std::vector<std::string>& names, std::string_view name) {
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

/// @throws Error naming what is not there.
void check_names(const std::vector<std::string>& asked, const std::vector<std::string>& there, const char* what) {
  for (const std::string& name : asked)
    if (std::find(there.begin(), there.end(), name) == there.end())
      throw Error(ErrorCode::not_found,
                  fmt::format("'{}' is not {}; there are {}", name, what, fmt::join(there, ", ")));
}

std::vector<Sweep> chosen_sweeps(const AtlasArguments& arguments) {
  std::vector<Sweep> sweeps;
  std::vector<std::string> names;
  for (Sweep& sweep : sweep_table()) {
    names.push_back(sweep.name);
    if (chosen(arguments.sweeps, sweep.name) && (arguments.session.empty() || !arguments.sweeps.empty()))
      sweeps.push_back(std::move(sweep));
  }
  check_names(arguments.sweeps, names, "a sweep");
  if (!arguments.session.empty()) {
    sweeps.push_back(session_sweep(arguments.session));
    const Body as_it_is(sweeps.back().scene, {});  // says what is wrong with it before anything runs
  }
  return sweeps;
}

/// Every model with every integrator; in a quick atlas, every model with the first integrator, every integrator
/// with the first model, and the published model with the published one.
std::vector<AtlasMethod> chosen_methods(const AtlasArguments& arguments) {
  std::vector<std::string> models, names;
  for (const fem::ModelKind& kind : fem::model_table()) models.emplace_back(kind.name);
  const std::vector<Integration> all = integrations();
  for (const Integration& integration : all) names.push_back(integration.name);
  check_names(arguments.models, models, "a force model");
  check_names(arguments.integrators, names, "an integrator");
  std::vector<AtlasMethod> methods;
  for (const std::string& model : models)
    for (const Integration& integration : all) {
      if (!chosen(arguments.models, model) || !chosen(arguments.integrators, integration.name)) continue;
      const bool on_cross = model == models.front() || integration.name == names.front() ||
                            (fem::model_by_name(model).of_published_method && integration.of_published_method);
      if (arguments.quick && !on_cross && arguments.models.empty() && arguments.integrators.empty()) continue;
      methods.push_back({{.name = model}, integration});
    }
  return methods;
}

void list() {
  fmt::print("Sweeps:\n");
  for (const Sweep& sweep : sweep_table())
    fmt::print("  {:<14} {} and {}: {}\n", sweep.name, parameter(sweep.swept.value).title,
               parameter(sweep.searched.value).title, sweep.scene_words);
  fmt::print("Models:\n");
  for (const fem::ModelKind& kind : fem::model_table()) fmt::print("  {}\n", kind.name);
  fmt::print("Integrators:\n");
  for (const Integration& integration : integrations())
    fmt::print("  {}{}\n", integration.name, integration.is_implicit ? "" : " (explicit)");
}

}  // namespace

int stability_atlas(const AtlasArguments& arguments) {
  if (arguments.list) {
    list();
    return k_well;
  }
  const std::vector<Sweep> sweeps = chosen_sweeps(arguments);
  const std::vector<AtlasMethod> methods = chosen_methods(arguments);
  std::error_code failure;
  std::filesystem::create_directories(arguments.out, failure);
  if (failure)
    throw Error(ErrorCode::bad_input, fmt::format("the folder '{}' cannot be made ({}); choose another with --out",
                                                  arguments.out.string(), failure.message()));
  AtlasOptions options;
  options.threads = arguments.threads > 0 ? arguments.threads
                                          : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(options.threads));
  if (arguments.quick) {
    options.grid = {.coarse = 6, .depth = 3};
    options.lines = 4;
    options.line_depth = 0;
    options.criteria.most_steps = 600;
    options.criteria.reference_steps = 150;
  }
  ProbeStore store(arguments.out / "probes.csv");
  if (store.taken_over() > 0 && !arguments.quiet)
    std::fprintf(stderr, "argil: %zu probes are there already and are not run again\n", store.taken_over());
  std::vector<SweepResult> results;
  for (const Sweep& sweep : sweeps) {
    double told = -1;
    options.progress = [&](double fraction, const std::string& what) {
      if (arguments.quiet || (fraction - told < 0.1 && fraction < 1)) return;
      told = fraction;
      std::fprintf(stderr, "%3.0f %%  sweep %zu of %zu, %s: %s\n",
                   100 * (static_cast<double>(results.size()) + fraction) / static_cast<double>(sweeps.size()),
                   results.size() + 1, sweeps.size(), sweep.name.c_str(), what.c_str());
    };
    results.push_back({sweep, run_sweep(sweep, methods, options, store)});
    io::write_file(arguments.out / (sweep.name + ".svg"), map_svg(sweep, options, results.back().panels));
    io::write_file(arguments.out / "index.html", page_html(results, options));
  }
  store.sort_file();
  for (const SweepResult& result : results) {
    fmt::print("{}\n", result.sweep.title);
    for (const Panel& panel : result.panels)
      fmt::print("  {}, {}: {}\n", panel.model, panel.integrator, statement(result.sweep, options.grid, panel));
  }
  fmt::print("{} probes, {} of them new; maps in {}\n", store.taken_over() + store.made(), store.made(),
             (arguments.out / "index.html").string());
  return k_well;
}

}  // namespace argil::tools
