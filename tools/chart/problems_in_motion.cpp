// docs/references.md §6, a bar that spins freely, and a bar that is pulled out and let go.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "fem/measure/energy.h"
#include "tools/chart/frequencies.h"
#include "tools/chart/problem.h"

namespace argil::chart {

std::vector<Problem> dynamic_problems();

namespace {

using Eigen::Vector3d;

constexpr double k_touching = 1e-9;  // [m]

std::function<bool(const Vector3d&)> clamped() {
  return [](const Vector3d& x) { return x.x() < k_touching; };
}

void add_vibrations(std::vector<Problem>& to) {
  struct Case {
    const char *name, *title, *source;
    bool free;
    std::vector<double> frequencies;
  };
  for (const Case& c : {Case{"modes_cantilever",
                             "Frequencies of a clamped bar",
                             "docs/references.md §6, cantilever, 0.40872 … 6.6817 Hz",
                             false,
                             {0.40872, 0.60863, 2.4886, 3.5863, 4.196, 6.6817}},
                        Case{"modes_free",
                             "Frequencies of a free bar",
                             "docs/references.md §6, free, 2.5437 … 12.597 Hz",
                             true,
                             {2.5437, 3.7170, 6.7516, 8.339, 9.4899, 12.597}}}) {
    Problem p;
    p.name = c.name;
    p.title = c.title;
    p.quantity = "first six frequencies over those of the reference (RMS)";
    p.source = c.source;
    p.analysis = Analysis::vibration;
    p.material = {1e6, 0.3, 1000};
    p.solid = [](int r) { return sharp_grid({8 * r, r, r}, {1, 0.08, 0.12}); };
    p.resolutions = {1, 2, 4};
    if (!c.free) p.held = clamped();
    p.measure = [c](const Body& body, const fem::Loads&) {
      const int rigid = c.free ? 6 : 0;
      const double first = 2 * std::numbers::pi * c.frequencies[0];
      const auto found = lowest_frequencies(body.system, rigid + 6, c.free ? first * first : 0);
      std::vector<double> ratios;
      for (std::size_t i = 0; i < 6; ++i)
        ratios.push_back(found[static_cast<std::size_t>(rigid) + i] / c.frequencies[i]);
      return ratios;
    };
    p.reference = [](double) { return std::vector<double>(6, 1.0); };
    p.uncertainty = 2e-5;  // the printed digits
    p.in_quick = !c.free;
    to.push_back(p);
  }
}

Problem spin() {
  Problem p;
  p.name = "spin";
  p.title = "Bar that spins freely at 10 rad/s, after half a second";
  p.quantity = "angular momentum over that of the start, and growth of the moment of inertia beyond a tenth";
  p.source = "conservation: 1 and 0 exactly (centrifugal forces stretch the bar by less)";
  p.analysis = Analysis::motion;
  p.material = {1e5, 0.3, 1000};
  p.solid = [](int r) { return sharp_grid({4 * r, r, r}, {0.4, 0.1, 0.1}); };
  p.resolutions = {1, 2};
  p.start = [](Body& body) {
    const Vector3d centre(0.2, 0.05, 0.05), rate(0, 0, 10);
    for (Eigen::Index i = 0; i < body.rest.cols(); ++i)
      body.state.velocities.col(i) = rate.cross(Vector3d(body.rest.col(i)) - centre);
  };
  p.duration = 0.5;
  p.time_steps = {1.0 / 60, 1.0 / 120, 1.0 / 240, 1.0 / 480, 1.0 / 960, 1.0 / 1920};
  p.measure = [](const Body& body, const fem::Loads&) {
    // Of a box about its own axis: m (a² + b²) / 12.
    constexpr double inertia = 1000 * 0.4 * 0.1 * 0.1 * (0.16 + 0.01) / 12, start = 10 * inertia;
    const Vector3d found = fem::momentum(body.system, body.state).angular;
    // A model that takes rotation for strain lets the points fly on straight on: their momentum is kept, the bar is
    // not. Its moment of inertia is the momentum of a rate of one about its middle.
    fem::BodyState turning = body.state;
    for (Eigen::Index i = 0; i < body.rest.cols(); ++i) {
      turning.positions.col(i) -= Vector3d(0.2, 0.05, 0.05);
      turning.velocities.col(i) = Vector3d::UnitZ().cross(Vector3d(turning.positions.col(i)));
    }
    const double grown = fem::momentum(body.system, turning).angular.z() / inertia - 1;
    return std::vector<double>{found.x() / start, found.y() / start, found.z() / start, std::max(0.0, grown - 0.1)};
  };
  p.reference = [](double) { return std::vector<double>{0, 0, 1, 0}; };
  p.uncertainty = 1e-9;
  p.in_quick = true;
  return p;
}

// The first longitudinal mode of a clamped bar with ν = 0: x + a sin(πx/2L) cos(ωt), ω = π/(2L) sqrt(E/ρ).
Problem released_bar() {
  constexpr double length = 1, amplitude = 1e-5, young_modulus = 1e5, density = 1000;
  const double rate = std::numbers::pi / (2 * length) * std::sqrt(young_modulus / density);
  Problem p;
  p.name = "released_bar";
  p.title = "Bar pulled out and let go, two periods";
  p.quantity = "displacement of the end over time (RMS over that of the reference)";
  p.source = "closed form, first longitudinal mode, 2.5 Hz";
  p.analysis = Analysis::motion;
  p.material = {young_modulus, 0, density};
  p.solid = [=](int r) { return sharp_grid({8 * r, r, r}, {length, 0.1, 0.1}); };
  p.resolutions = {1, 2};
  p.held = clamped();
  p.start = [=](Body& body) {
    for (Eigen::Index i = 0; i < body.rest.cols(); ++i)
      body.state.positions(0, i) += amplitude * std::sin(std::numbers::pi * body.rest(0, i) / (2 * length));
  };
  p.duration = 0.8;
  p.time_steps = {1.0 / 60, 1.0 / 120, 1.0 / 240, 1.0 / 480, 1.0 / 960, 1.0 / 1920};
  p.along_the_way = true;
  p.measure = [=](const Body& body, const fem::Loads&) {
    return std::vector<double>{displacement(body, {length, 0.05, 0.05}).x() / amplitude};
  };
  p.reference = [rate](double time) { return std::vector<double>{std::cos(rate * time)}; };
  p.uncertainty = 1e-5;  // of the second order in the strain, for models that are not linear in it
  p.in_quick = true;
  return p;
}

}  // namespace

std::vector<Problem> dynamic_problems() {
  std::vector<Problem> table;
  add_vibrations(table);
  table.push_back(spin());
  table.push_back(released_bar());
  return table;
}

}  // namespace argil::chart
