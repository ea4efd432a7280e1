#include "fem/springs_2d.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>

#include "subdiv/error.h"

namespace argil::fem {
namespace {

void check(const SpringRectangle& r) {
  if (!(r.length > 0 && r.height > 0 && r.young_modulus > 0 && std::abs(r.poisson_ratio) < 1))
    throw Error(
        ErrorCode::bad_input,
        fmt::format("a rectangle of springs needs sides and a modulus above 0 and a Poisson's ratio between -1 "
                    "and 1, but has {} x {}, {} and {}",
                    r.length, r.height, r.young_modulus, r.poisson_ratio));
}

struct Ends {
  int from, to;
};
constexpr std::array<Ends, 2> k_along_length{{{0, 1}, {2, 3}}}, k_along_height{{{0, 2}, {1, 3}}},
    k_diagonals{{{0, 3}, {1, 2}}};

double distance(const RectangleNodes& x, const Ends& ends) {
  return std::hypot(x(0, ends.to) - x(0, ends.from), x(1, ends.to) - x(1, ends.from));
}

void pull(const RectangleNodes& x, const Ends& ends, double tension, RectangleNodes& forces) {
  const double length = distance(x, ends);
  if (length == 0) return;
  const Eigen::Vector2d force = tension / length * (x.col(ends.to) - x.col(ends.from));
  forces.col(ends.from) += force;
  forces.col(ends.to) -= force;
}

/// Force along an axis that holds the small displacement gradient `gradient`, per unit of it: that of one side's
/// two nodes, which carry the same, by central differences.
double force_along(const SpringRectangle& r, int axis, const Eigen::Matrix2d& gradient) {
  const double small = 1e-6;
  const RectangleNodes rest = rest_nodes(r);
  const RectangleNodes difference =
      forces(r, rest + small * gradient * rest) - forces(r, rest - small * gradient * rest);
  return (difference(axis, 0) - difference(axis, 3)) / (2 * small);
}

}  // namespace

RectangleSprings rectangle_springs(const SpringRectangle& r) {
  check(r);
  const double l = r.length, h = r.height, nu = r.poisson_ratio;
  const double scale = r.young_modulus / (4 * l * h * (1 + nu));
  return {scale * (h * h * (3 * nu + 2) - l * l), scale * (l * l * (3 * nu + 2) - h * h), scale * (l * l + h * h)};
}

RectangleNodes rest_nodes(const SpringRectangle& r) {
  RectangleNodes x;
  x << 0, r.length, 0, r.length, 0, 0, r.height, r.height;
  return x;
}

RectangleNodes forces(const SpringRectangle& r, const RectangleNodes& x) {
  const RectangleSprings k = rectangle_springs(r);
  const RectangleNodes rest = rest_nodes(r);
  double elongation_l = 0, elongation_h = 0;
  for (const Ends& ends : k_along_length) elongation_l += 0.5 * (distance(x, ends) - r.length);
  for (const Ends& ends : k_along_height) elongation_h += 0.5 * (distance(x, ends) - r.height);
  const double nu = r.poisson_ratio, modulus = r.young_modulus / (1 - nu * nu);
  const double strain_l = elongation_l / r.length, strain_h = elongation_h / r.height;
  const double force_l = r.height * modulus * (strain_l + nu * strain_h);
  const double force_h = r.length * modulus * (strain_h + nu * strain_l);
  // F⊥ works against the thinning: it presses the edge between the two nodes of a side.
  const double tension_l = r.corrections * r.height * force_h * (3 * nu - 1) / (8 * r.length);
  const double tension_h = r.corrections * r.length * force_l * (3 * nu - 1) / (8 * r.height);
  RectangleNodes result = RectangleNodes::Zero();
  for (const Ends& ends : k_along_length)
    pull(x, ends, k.along_length * (distance(x, ends) - r.length) + tension_l, result);
  for (const Ends& ends : k_along_height)
    pull(x, ends, k.along_height * (distance(x, ends) - r.height) + tension_h, result);
  for (const Ends& ends : k_diagonals)
    pull(x, ends, k.diagonal * (distance(x, ends) - distance(rest, ends)), result);
  return result;
}

RectangleConstants measure(const SpringRectangle& r) {
  // Stress = C · strain for the two elongations; a stretched rectangle has no stress across.
  Eigen::Matrix2d stiffness;
  for (int strain = 0; strain < 2; ++strain) {
    Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();
    gradient(strain, strain) = 1;
    stiffness(0, strain) = force_along(r, 0, gradient) / r.height;
    stiffness(1, strain) = force_along(r, 1, gradient) / r.length;
  }
  const Eigen::Matrix2d compliance = stiffness.inverse();
  Eigen::Matrix2d slide = Eigen::Matrix2d::Zero();
  slide(0, 1) = 1;
  return {1 / compliance(0, 0), 1 / compliance(1, 1), -compliance(1, 0) / compliance(0, 0),
          -compliance(0, 1) / compliance(1, 1), force_along(r, 0, slide) / r.length};
}

}  // namespace argil::fem
