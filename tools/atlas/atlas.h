#pragma once
// The stability atlas: for each sweep and each method, a force model with an integrator, where it is stable,
// inaccurate, or diverges (METHODS §5). Probes go to probes.csv, each sweep to an SVG map, all to index.html.

#include <functional>

#include "tools/atlas/records.h"
#include "tools/atlas/sweep.h"

namespace argil::atlas {

struct AtlasMethod {
  fem::ModelChoice model;
  Integration integration;
};

/// A line of a map: all its probes, in the order of the searched parameter.
struct MapLine {
  double swept = 0;  // share of the axis
  std::vector<ProbeRow> probes;
  std::vector<Stretch> stretches;  // in points of the grid
};

/// What one method did in one sweep.
struct Panel {
  std::string model, integrator;
  bool is_implicit = true;
  std::vector<MapLine> lines;  // ascending
};

struct AtlasOptions {
  LineGrid grid;       // along the searched parameter
  int lines = 5;       // of constant swept parameter, at first
  int line_depth = 1;  // halvings between lines whose boundaries differ much
  Criteria criteria;
  int threads = 2;
  std::function<void(double fraction, const std::string& what)> progress;
};

/// Runs one sweep for all methods, or takes the rows that are there. In parallel by model; the result does not
/// depend on the number of threads.
[[nodiscard]] std::vector<Panel> run_sweep(const Sweep& sweep, const std::vector<AtlasMethod>& methods,
                                           const AtlasOptions& options, ProbeStore& store);

/// Hash of everything that a probe runs.
[[nodiscard]] std::uint64_t probe_key(const Sweep& sweep, const Scene& scene, const AtlasMethod& method,
                                      const Criteria& criteria);

/// Points of the searched axis of a panel's line as values of its parameter.
[[nodiscard]] double searched_value(const Sweep& sweep, const LineGrid& grid, double point);

}  // namespace argil::atlas
