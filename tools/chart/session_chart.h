#pragma once
// A session of the user's against its own refinement: replayed with other models, spaces, integrators, levels and
// time steps, and compared at the end with a replay one level finer and with a quarter of the time step. The error
// is the RMS distance of the limit positions of the boundary vertices that all levels share, over the RMS
// displacement of the reference.

#include <filesystem>
#include <string>

#include "tools/chart/runner.h"
#include "tools/chart/series.h"

namespace argil::chart {

struct Choice;  // chart.h

struct SessionRun {
  std::string model, formulation, space, integrator;
  int level = 0;
  int substeps = 1;  // every `step N dt t` is taken as N · substeps of t / substeps
};

struct SessionFile {
  std::filesystem::path path;  // names in it are read beneath its folder
  std::string text;
};

/// What one replay came to.
struct Replayed {
  SessionRun run;           // as it was at the end
  Eigen::Matrix3Xd points;  // limits of the common boundary vertices, present
  Eigen::Matrix3Xd rest;    // and at rest
  std::uint64_t topology = 0;
  std::uint64_t state_hash = 0;
  std::size_t unknowns = 0, elements = 0, steps = 0;
  double simulated = 0;  // [s]
  double time_step = k_nothing;
  double ms = 0;  // from the first line that simulates
};

/// Replays without pictures, files and expectations. `run` null: as it is written. `common_level` is that of the
/// vertices that are compared. Pictures, saved files and the journal are left out; nothing is written but
/// `scratch`.
/// @throws what the session's commands throw; Stopped; Error (not_converged) if it takes longer than the limit.
[[nodiscard]] Replayed replay(const SessionFile& session, const SessionRun* run, int common_level,
                              const Setting& setting, const std::filesystem::path& scratch);

/// Fills `table` with what it does not have yet and returns the panel of its rows. The session's own choices come
/// first; `choice` keeps models, spaces and integrators by name (the session's own always).
/// @throws Error (bad_input) for a session that simulates nothing.
[[nodiscard]] Panel chart_session(const SessionFile& session, const Choice& choice, const Setting& setting,
                                  Table& table, const std::filesystem::path& scratch,
                                  const std::function<void(const std::string& label, const Row* row)>& tell);

}  // namespace argil::chart
