// docs/references.md §1–§5 and §7. Where a reference is that of linear elasticity, the load is a thousandth and
// what is measured is multiplied by a thousand: every model that is linear at rest has that solution then.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tools/chart/problem.h"

namespace argil::chart {

std::vector<Problem> static_problems();

namespace {

using Eigen::Vector3d;

constexpr double k_touching = 1e-9;  // [m]
constexpr double k_small_load = 1e-3;
const char* const k_stvk = "st_venant_kirchhoff";

auto constant(std::vector<double> values) {
  return [values = std::move(values)](double) { return values; };
}

std::function<bool(const Vector3d&)> below(int axis, double value) {
  return [=](const Vector3d& x) { return x[axis] < value + k_touching; };
}
std::function<bool(const Vector3d&)> above(int axis, double value) {
  return [=](const Vector3d& x) { return x[axis] > value - k_touching; };
}
std::function<bool(const Vector3d&)> outside(int axis, double low, double high) {
  return [=](const Vector3d& x) { return x[axis] < low + k_touching || x[axis] > high - k_touching; };
}

std::function<fem::Loads(const Body&)> gravity(double down) {
  return [down](const Body& body) {
    return fem::Loads{fem::gravity_forces(body.discretization, {0, 0, -down}), {}};
  };
}
std::function<fem::Loads(const Body&)> traction(std::function<bool(const Vector3d&)> where, const Vector3d& force) {
  return [where = std::move(where), force](const Body& body) {
    return fem::Loads{
        fem::spread_force(body.discretization, patch_where(body, where), body.discretization.rest_nodes, force),
        {}};
  };
}

/// Chosen components of the displacement of a point, times `scale`.
auto displacement_of(const Vector3d& point, std::vector<int> axes, double scale) {
  return [=](const Body& body, const fem::Loads&) {
    const Vector3d u = displacement(body, point);
    std::vector<double> values;
    for (const int axis : axes) values.push_back(scale * u[axis]);
    return values;
  };
}
/// Component of the force by which the held points there push on the body, times `scale`.
auto force_of(std::function<bool(const Vector3d&)> where, int axis, double scale) {
  return [=](const Body& body, const fem::Loads& loads) {
    const Eigen::Matrix3Xd reaction = fem::reactions(body.system, loads, body.state.positions);
    double sum = 0;
    for (Eigen::Index i = 0; i < reaction.cols(); ++i)
      if (where(body.rest.col(i))) sum += reaction(axis, i);
    return std::vector<double>{scale * sum};
  };
}

// ---- §1
Problem cantilever() {
  Problem p;
  p.material = {1000, 0.3, 1.25};
  p.solid = [](int r) { return sharp_grid({4 * r, r, r}, {0.4, 0.1, 0.1}); };
  p.resolutions = {1, 2, 4, 8};
  p.held = below(0, 0);
  return p;
}

void add_cantilevers(std::vector<Problem>& to) {
  const Vector3d tip(0.4, 0.05, 0.05);
  Problem small = cantilever();
  small.name = "cantilever";
  small.title = "Cantilever under a thousandth of its weight";
  small.quantity = "tip deflection times 1000 [m]";
  small.source = "docs/references.md §1, linear, limit 0.04910 ± 0.00001 m";
  small.loads = gravity(9.81 * k_small_load);
  small.measure = displacement_of(tip, {2}, 1 / k_small_load);
  small.reference = constant({-0.04910});
  small.uncertainty = 0.00001 / 0.04910;
  small.in_quick = true;
  to.push_back(small);

  Problem large = cantilever();
  large.name = "cantilever_weight";
  large.title = "Cantilever under its weight";
  large.quantity = "tip displacement (u_x, u_z) [m]";
  large.source = "docs/references.md §1, St. Venant–Kirchhoff, limit (−0.003318, −0.04866 ± 0.00002) m";
  large.loads = gravity(9.81);
  large.measure = displacement_of(tip, {0, 2}, 1);
  large.reference = constant({-0.003318, -0.04866});
  large.uncertainty = 0.00002 / 0.04866;
  large.laws = {k_stvk};
  to.push_back(large);
}

// ---- §2
void add_tip_loads(std::vector<Problem>& to) {
  struct Case {
    const char *name, *title;
    double load;
    std::vector<double> tip;
    double uncertainty;
    int steps;
  };
  // The printed digits are the uncertainty.
  for (const Case& c : {Case{"tip_load_5", "Tip load, turned by 5°", 1.45833, {-0.00205, -0.05848}, 1e-4, 1},
                        Case{"tip_load_45", "Tip load, turned by 45°", 16.6667, {-0.16335, -0.49779}, 2e-5, 4},
                        Case{"tip_load_80", "Tip load, turned by 80°", 75, {-0.54338, -0.81234}, 1e-5, 10}}) {
    Problem p;
    p.name = c.name;
    p.title = c.title;
    p.quantity = "tip displacement (u_x, u_z) [m]";
    p.source = "docs/references.md §2, ν = 0, St. Venant–Kirchhoff";
    p.material = {1e6, 0, 1000};
    p.solid = [](int r) { return sharp_grid({10 * r, r, r}, {1, 0.1, 0.1}); };
    p.resolutions = {1, 2, 4};
    p.held = below(0, 0);
    p.loads = traction(above(0, 1), {0, 0, -c.load});
    p.load_steps = c.steps;
    p.measure = displacement_of({1, 0.05, 0.05}, {0, 2}, 1);
    p.reference = constant(c.tip);
    p.uncertainty = c.uncertainty;
    p.laws = {k_stvk};
    p.in_quick = std::string(c.name) == "tip_load_45";
    to.push_back(p);
  }
}

// ---- §3
void add_twists(std::vector<Problem>& to) {
  struct Case {
    const char *name, *title;
    double degrees, torque, uncertainty;
    int steps;
  };
  for (const Case& c : {Case{"twist_15", "Bar twisted by 15°", 15, 0.357, 0.0005 / 0.357, 1},
                        Case{"twist_90", "Bar twisted by 90°", 90, 2.164, 0.002 / 2.164, 4},
                        Case{"twist_180", "Bar twisted by 180°", 180, 4.404, 0.003 / 4.404, 8}}) {
    Problem p;
    p.name = c.name;
    p.title = c.title;
    p.quantity = "torque [N m]";
    p.source = fmt::format("docs/references.md §3, St. Venant–Kirchhoff, {} N m", c.torque);
    p.material = {1e5, 0.3, 1000};
    p.solid = [](int r) { return sharp_grid({4 * r, r, r}, {0.4, 0.1, 0.1}); };
    p.resolutions = {1, 2, 4, 8};
    p.held = outside(0, 0, 0.4);
    p.placed = [angle = c.degrees * std::numbers::pi / 180](const Vector3d& x, double share) {
      const double a = angle * share * x.x() / 0.4, y = x.y() - 0.05, z = x.z() - 0.05;
      return Vector3d(x.x(), 0.05 + std::cos(a) * y - std::sin(a) * z, 0.05 + std::sin(a) * y + std::cos(a) * z);
    };
    p.load_steps = c.steps;
    p.measure = [](const Body& body, const fem::Loads& loads) {
      const Eigen::Matrix3Xd reaction = fem::reactions(body.system, loads, body.state.positions);
      double torque = 0;
      for (Eigen::Index i = 0; i < reaction.cols(); ++i) {
        if (body.rest(0, i) < 0.4 - k_touching) continue;
        const Vector3d arm = Vector3d(body.state.positions.col(i)) - Vector3d(0.4, 0.05, 0.05);
        torque += arm.y() * reaction(2, i) - arm.z() * reaction(1, i);
      }
      return std::vector<double>{torque};
    };
    p.reference = constant({c.torque});
    p.uncertainty = c.uncertainty;
    p.laws = {k_stvk};
    p.in_quick = std::string(c.name) == "twist_90";
    to.push_back(p);
  }
}

// ---- §4
void add_l_shapes(std::vector<Problem>& to) {
  struct Case {
    const char *name, *title;
    Vector3d force;
    int axis;
    double displacement, uncertainty;
    bool linear;
  };
  for (const Case& c :
       {Case{"l_side", "L-shape pushed sideways, a thousandth of 1 N", {0, 1, 0}, 1, 0.03765, 2e-4, true},
        Case{"l_down", "L-shape pushed down, a thousandth of 1 N", {0, 0, -1}, 2, -0.02313, 3e-4, true},
        Case{"l_side_large", "L-shape pushed sideways, 4 N", {0, 4, 0}, 1, 0.1320, 0.0002 / 0.1320, false},
        Case{"l_down_large", "L-shape pushed down, 4 N", {0, 0, -4}, 2, -0.0999, 0.0003 / 0.0999, false}}) {
    Problem p;
    p.name = c.name;
    p.title = c.title;
    p.quantity =
        fmt::format("{} of the arm's end{} [m]", c.axis == 1 ? "u_y" : "u_z", c.linear ? " times 1000" : "");
    p.source = fmt::format("docs/references.md §4, {}", c.linear ? "linear" : "St. Venant–Kirchhoff");
    p.material = {1e5, 0.3, 1000};
    p.solid = [](int r) {
      return sharp_grid({3 * r, r, 3 * r}, {0.3, 0.1, 0.3}, [r](int i, int, int k) { return i < r || k >= 2 * r; });
    };
    p.resolutions = {1, 2, 4};
    p.held = below(2, 0);
    p.loads = traction(above(0, 0.3), c.force * (c.linear ? k_small_load : 1));
    p.load_steps = c.linear ? 1 : 4;
    p.measure = displacement_of({0.3, 0.05, 0.25}, {c.axis}, c.linear ? 1 / k_small_load : 1);
    p.reference = constant({c.displacement});
    p.uncertainty = c.uncertainty;
    if (!c.linear) p.laws = {k_stvk};
    p.in_quick = std::string(c.name) == "l_down";
    to.push_back(p);
  }
}

// ---- §5
void add_blocks(std::vector<Problem>& to) {
  struct Case {
    const char* name;
    double poisson_ratio, force, uncertainty;
  };
  for (const Case& c : {Case{"block_300", 0.3, 106.39, 5e-5}, Case{"block_490", 0.49, 122.0, 4e-4},
                        Case{"block_499", 0.499, 123.25, 0.05 / 123.25}}) {
    Problem p;
    p.name = c.name;
    p.title = fmt::format("Block between rough plates, ν = {}, a thousandth of 10 %", c.poisson_ratio);
    p.quantity = "force on the plate times 1000 [N]";
    p.source = fmt::format("docs/references.md §5, linear, {} N", c.force);
    p.material = {1e5, c.poisson_ratio, 1000};
    p.solid = [](int r) { return sharp_grid({r, r, r}, {0.1, 0.1, 0.1}); };
    p.resolutions = {2, 4, 8};
    p.held = outside(2, 0, 0.1);
    p.placed = [](const Vector3d& x, double share) {
      return Vector3d(x.x(), x.y(), x.z() * (1 - 0.1 * k_small_load * share));
    };
    p.measure = force_of(above(2, 0.1), 2, -1 / k_small_load);
    p.reference = constant({c.force});
    p.uncertainty = c.uncertainty;
    p.in_quick = std::string(c.name) == "block_499";
    to.push_back(p);
  }
}

// ---- §7
Problem stretch() {
  Problem p;
  p.name = "stretch";
  p.title = "Unit cube stretched by half";
  p.quantity = "force over E";
  p.source = "docs/references.md §7, St. Venant–Kirchhoff, ν = 0: 0.9375 exactly";
  p.material = {1000, 0, 1000};
  p.solid = [](int r) { return sharp_grid({r, r, r}, {1, 1, 1}); };
  p.resolutions = {2, 4};
  p.held = outside(0, 0, 1);
  p.placed = [](const Vector3d& x, double share) { return Vector3d(x.x() * (1 + 0.5 * share), x.y(), x.z()); };
  p.measure = force_of(above(0, 1), 0, 1e-3);
  p.reference = constant({0.9375});
  p.uncertainty = 1e-8;  // the tolerance of equilibrium
  p.laws = {k_stvk};
  return p;
}

}  // namespace

std::vector<Problem> static_problems() {
  std::vector<Problem> table;
  add_cantilevers(table);
  add_tip_loads(table);
  add_twists(table);
  add_l_shapes(table);
  add_blocks(table);
  table.push_back(stretch());
  return table;
}

}  // namespace argil::chart
