#include "tools/atlas/atlas.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <thread>

#include "sculpt/hash.h"

namespace argil::atlas {

namespace {

/// Two lines between which a third one would be seen: they have other outcomes, or a boundary that moves far.
bool differ(const LineGrid& grid, const MapLine& a, const MapLine& b) {
  if (a.stretches.size() != b.stretches.size()) return true;
  for (std::size_t i = 0; i < a.stretches.size(); ++i) {
    if (a.stretches[i].outcome != b.stretches[i].outcome) return true;
    if (std::abs(a.stretches[i].begin - b.stretches[i].begin) > 0.3 * grid.last()) return true;
  }
  return false;
}

class PanelRun {
 public:
  PanelRun(const Sweep& sweep, const AtlasMethod& method, const AtlasOptions& options, Workbench& bench,
           ProbeStore& store)
      : sweep_(sweep), method_(method), options_(options), bench_(bench), store_(store) {}

  MapLine line(double swept) {
    MapLine result;
    result.swept = swept;
    std::map<int, ProbeRow> rows;
    const auto points = search_line(options_.grid, [&](int position) {
      rows[position] = probe(swept, static_cast<double>(position) / options_.grid.last());
      return rows[position].result.outcome;
    });
    result.stretches = stretches(options_.grid, points);
    for (auto& [position, row] : rows) result.probes.push_back(std::move(row));
    return result;
  }

  void refine(std::vector<MapLine>& lines) {
    for (int depth = 0; depth < options_.line_depth; ++depth) {
      std::vector<MapLine> between;
      for (std::size_t i = 0; i + 1 < lines.size(); ++i)
        if (differ(options_.grid, lines[i], lines[i + 1]))
          between.push_back(line(0.5 * (lines[i].swept + lines[i + 1].swept)));
      for (MapLine& each : between) lines.push_back(std::move(each));
      std::sort(lines.begin(), lines.end(), [](const MapLine& a, const MapLine& b) { return a.swept < b.swept; });
    }
  }

 private:
  ProbeRow probe(double swept, double searched) {
    const Scene scene = scene_at(sweep_, swept, searched);
    const std::uint64_t key = probe_key(sweep_, scene, method_, options_.criteria);
    return store_.find_or_run(key, [&] {
      ProbeRow row{.key = key,
                   .sweep = sweep_.name,
                   .model = method_.model.name,
                   .integrator = method_.integration.name,
                   .swept = scene.*sweep_.swept.value,
                   .searched = scene.*sweep_.searched.value,
                   .time_step = scene.time_step,
                   .result = {}};
      row.result = bench_.run(scene, method_.model, method_.integration, sweep_.reference_model);
      return row;
    });
  }

  const Sweep& sweep_;
  const AtlasMethod& method_;
  const AtlasOptions& options_;
  Workbench& bench_;
  ProbeStore& store_;
};

}  // namespace

std::uint64_t probe_key(const Sweep& sweep, const Scene& scene, const AtlasMethod& method,
                        const Criteria& criteria) {
  sculpt::Hash hash;
  hash.add(std::string_view(ARGIL_VERSION)).add(std::string_view(sweep.name)).add(scene_hash(scene));
  hash.add(std::string_view(method.model.name)).add(fem::word(method.model.formulation));
  hash.add(std::string_view(method.integration.name)).add(std::string_view(sweep.reference_model));
  hash.add(criteria.energy_factor).add(criteria.error);
  for (const int count : {criteria.least_steps, criteria.most_steps, criteria.reference_steps})
    hash.add(static_cast<std::uint64_t>(count));
  return hash.value();
}

double searched_value(const Sweep& sweep, const LineGrid& grid, double point) {
  return sweep.searched.at(point / grid.last());
}

std::vector<Panel> run_sweep(const Sweep& sweep, const std::vector<AtlasMethod>& methods,
                             const AtlasOptions& options, ProbeStore& store) {
  std::vector<Panel> panels;
  std::vector<std::vector<std::size_t>> by_model;  // methods that share bodies and references
  for (std::size_t m = 0; m < methods.size(); ++m) {
    panels.push_back({methods[m].model.name, methods[m].integration.name, methods[m].integration.is_implicit, {}});
    const auto same = [&](const std::vector<std::size_t>& group) {
      return methods[group.front()].model == methods[m].model;
    };
    const auto group = std::find_if(by_model.begin(), by_model.end(), same);
    if (group == by_model.end())
      by_model.push_back({m});
    else
      group->push_back(m);
  }
  std::atomic<std::size_t> done = 0;
  const std::size_t all = methods.size() * static_cast<std::size_t>(options.lines);
  std::mutex progress_mutex;
  const auto run_group = [&](std::size_t g) {
    Workbench bench(options.criteria);
    // Line by line, so that one reference serves all integrators.
    for (int i = 0; i < options.lines; ++i) {
      const double swept = options.lines > 1 ? static_cast<double>(i) / (options.lines - 1) : 0.5;
      for (const std::size_t m : by_model[g]) {
        panels[m].lines.push_back(PanelRun(sweep, methods[m], options, bench, store).line(swept));
        ++done;
        const std::lock_guard lock(progress_mutex);
        if (options.progress)
          options.progress(static_cast<double>(done) / static_cast<double>(all),
                           panels[m].model + ", " + panels[m].integrator);
      }
    }
    for (const std::size_t m : by_model[g])
      PanelRun(sweep, methods[m], options, bench, store).refine(panels[m].lines);
  };
  // Threads of our own: within a TBB loop, one that waits for an inner loop might begin another group half way.
  std::atomic<std::size_t> next = 0;
  std::exception_ptr failure;
  const auto work = [&] {
    for (std::size_t g; (g = next++) < by_model.size();) try {
        run_group(g);
      } catch (...) {
        const std::lock_guard lock(progress_mutex);
        if (!failure) failure = std::current_exception();
        next = by_model.size();
      }
  };
  {
    std::vector<std::jthread> threads;
    for (int t = 1; t < options.threads; ++t) threads.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
  return panels;
}

}  // namespace argil::atlas
