#pragma once
// What a tool touches: quadrature points of the boundary, or inside the solid, within a radius of the device,
// weighted by falloff and by the area or volume that belongs to them. Sums over them are the integrals of virtual
// work.

#include <functional>
#include <span>
#include <vector>

#include "fem/loads.h"
#include "sculpt/document.h"
#include "sculpt/stroke_pose.h"

namespace argil::sculpt {

/// Where a point lies: quadrilateral and one of its four points; inside, block, element and point of the element.
struct TouchedPlace {
  std::array<std::uint32_t, 4> quad{};
  int which = 0;
  std::size_t block = 0, element = 0;
};

struct Touched {
  bool inside = false;
  std::vector<fem::PointStencil> points;  // in control points, each an affine combination
  std::vector<TouchedPlace> places;
  Eigen::VectorXd falloffs;    // 0 … 1, times what the mask leaves
  Eigen::VectorXd weights;     // falloff times area (inside: rest volume), divided by `measure`: they sum to 1
  double measure = 0;          // Σ falloff · area [m²], inside · volume [m³]
  double share = 1;            // of it, against what it were without a mask: a tool is so much weaker
  bool masked = false;         // there is something, but the mask leaves nothing of it
  Eigen::Matrix3Xd positions;  // when touched [m]
  Eigen::Vector3d middle;      // their weighted mean [m]
  Eigen::Vector3d normal;      // mean outward normal; inside, towards the nearest surface

  bool empty() const { return points.empty(); }
};

/// What protects is the field `mask`: at a point where it is m only 1 − m is touched.
enum class Masks { protect, ignored };

/// Whether the mask protects anything.
[[nodiscard]] bool has_mask(const Document& document);

/// Around `at` [m] on the body as it stands: its surface if that is within the tool's radius and `inside` is not
/// asked for, else what is in it. A brush finer than the mesh is widened to 1.5 times the distance to the nearest
/// point. Empty if there is nothing. Cost O(boundary quadrilaterals), inside O(elements).
[[nodiscard]] Touched touched(const Document& document, const Tool& tool, const Eigen::Vector3d& at, bool inside,
                              Masks masks = Masks::protect);

/// The same. @throws Error (bad_input), with the distance, if there is nothing, or if all of it is masked.
[[nodiscard]] Touched touch(const Document& document, const Tool& tool, const Eigen::Vector3d& at, bool inside,
                            Masks masks = Masks::protect);
/// @throws Error (bad_input) that says what to do where all is masked.
[[noreturn]] void refuse_masked();

/// The tool as a device of less than full size lays it: with that share of its radius, and about the nearest point
/// of the surface where it is the surface that the whole radius touches. At full size the tool where the device is.
struct LaidTool {
  Tool tool;
  Eigen::Vector3d at;  // [m]
};
[[nodiscard]] LaidTool laid_tool(const Document& document, const Tool& tool, const StrokePose& device, bool inside);

/// Of the surface, what is nearer than the tool's radius by a distance of one's own [m]. Empty if there is nothing.
[[nodiscard]] Touched touched_near(const Document& document, const Tool& tool,
                                   const std::function<double(const Eigen::Vector3d&)>& distance);
/// The nearest points of the surface as it stands.
[[nodiscard]] std::vector<Eigen::Vector3d> nearest_on_surface(const Document& document,
                                                              std::span<const Eigen::Vector3d> points);

/// Their weighted mean, as it moves with the body.
[[nodiscard]] fem::PointStencil middle_of(const Touched& touched);

/// Σ factor · point: a stencil whose weights sum to Σ factor.
[[nodiscard]] fem::PointStencil combination(std::span<const fem::PointStencil> points,
                                            std::span<const double> factors);

}  // namespace argil::sculpt
