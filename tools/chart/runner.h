#pragma once
// Runs of the chart: which there are, and one of them from problem to row.

#include <optional>

#include "fem/dynamics/integrator.h"
#include "tools/chart/problem.h"
#include "tools/chart/table.h"

namespace argil::chart {

/// What is to be run; the lists must outlive the runs made from them.
struct Lists {
  std::vector<Problem> problems;
  std::vector<ModelRow> models;
  std::vector<SpaceRow> spaces;
  std::vector<fem::MethodKind> integrators;
};
/// Everything that the program has.
[[nodiscard]] Lists all_lists();

enum class Breadth {
  quick,  // few problems, two resolutions (one in motion), three time steps; one choice differs from the default at
          // a time, or model, space and integrator are all as published
  usual,  // all problems and resolutions, every model in every space; integrators with the default model
  all     // every integrator with every model in every space, too
};

struct Run {
  const Problem* problem = nullptr;
  const ModelRow* model = nullptr;
  const SpaceRow* space = nullptr;
  const fem::MethodKind* integrator = nullptr;  // null where nothing moves
  int resolution = 1;
  double time_step = 0;  // [s]; 0 where nothing moves

  [[nodiscard]] std::string label() const;
};

/// Coarse runs of all problems first, so that a chart that is stopped early shows all of them. The first row of
/// each list is the default.
[[nodiscard]] std::vector<Run> plan(const Lists& lists, Breadth breadth);

struct Setting {
  fem::Clock clock = nullptr;     // [s]; without one, times are 0
  double seconds_a_run = 60;      // then it is stopped
  int repeats = 3;                // of runs shorter than a tenth of a second; the least time counts
  int threads = 1;                // for the row only
  std::function<bool()> stopped;  // by the user
};

/// The user stopped the chart.
struct Stopped {};

[[nodiscard]] std::uint64_t key_of(const Run& run, const Setting& setting);
/// A method's failure is a status of the row. @throws Stopped.
[[nodiscard]] Row execute(const Run& run, const Setting& setting);

/// Does what the table does not have yet. A run is not tried where a coarser one of its series went over time.
/// `tell` hears of every run before and after (row null before).
void execute(const std::vector<Run>& runs, const Setting& setting, Table& table,
             const std::function<void(std::size_t number, const Run& run, const Row* row)>& tell);

}  // namespace argil::chart
