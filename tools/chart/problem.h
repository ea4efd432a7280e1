#pragma once
// The problems of the chart, each with a solution that is known from elsewhere (references.md §1–§7, or in closed
// form): how to build the body at a resolution, what holds and loads it, what is measured and what it should be.

#include "fem/dynamics/method.h"
#include "tools/chart/body.h"

namespace argil::chart {

enum class Analysis {
  equilibrium,  // followed in load steps
  motion,       // from a start, over time steps of one length
  vibration     // lowest frequencies at rest
};

struct Problem {
  std::string name, title;
  std::string quantity;  // what is measured, with its unit
  std::string source;    // of the reference
  Analysis analysis = Analysis::equilibrium;
  Material material;
  std::function<subdiv::Built(int resolution)> solid;
  std::vector<int> resolutions;  // ascending; cells through the thickness, or as the title says
  std::function<bool(const Eigen::Vector3d& rest)> held = {};

  // Equilibrium. `placed` says where a point goes when `share` of the whole is done: held points exactly, the
  // others at the start of each load step.
  std::function<Eigen::Vector3d(const Eigen::Vector3d& rest, double share)> placed = {};
  std::function<fem::Loads(const Body&)> loads = {};  // the whole of them
  int load_steps = 1;

  // Motion.
  std::function<void(Body&)> start = {};
  double duration = 0;             // [s]
  std::vector<double> time_steps;  // [s], descending; each divides the duration
  bool along_the_way = false;      // measured after every step, else at the end only

  /// The quantity, as one or more numbers.
  std::function<std::vector<double>(const Body&, const fem::Loads&)> measure;
  /// What it should be, at a time of the motion.
  std::function<std::vector<double>(double time)> reference;
  double uncertainty = 0;  // of the reference, relative: smaller errors mean nothing
  /// Models whose solution the reference is; empty: it is that of all. Others are drawn, but their error includes
  /// the difference between the models.
  std::vector<std::string> laws;
  bool in_quick = false;

  [[nodiscard]] bool holds_for(const std::string& model) const;
};

[[nodiscard]] const std::vector<Problem>& problem_table();
/// @throws Error (not_found) that lists the names.
[[nodiscard]] const Problem& problem_by_name(const std::string& name);

/// sqrt Σ(found − expected)² / sqrt Σ expected². Both in the order of measurement.
[[nodiscard]] double relative_error(const std::vector<double>& found, const std::vector<double>& expected);
/// Σ(found − expected) expected / Σ expected²: the part of the error that has a sign.
[[nodiscard]] double signed_error(const std::vector<double>& found, const std::vector<double>& expected);

}  // namespace argil::chart
