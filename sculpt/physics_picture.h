#pragma once
// What pictures show of the mechanics beside colours: the inside as a volume, local frames of cells (papers/004,
// Figs. 4 and 5), a sheared corner (Fig. 3), and another mesh as wires over the body.

#include <cstdint>

#include "sculpt/document.h"
#include "sculpt/reference_shape.h"
#include "sculpt/renderer.h"

namespace argil::sculpt {

/// The inside of the cells with kept != 0 (empty: all), cut into tetrahedra (cell_tetrahedra.h), with a field.
/// `positions` 3 x vertices, one value a vertex.
[[nodiscard]] SceneVolume scene_volume(const subdiv::Solid& solid, const Eigen::Matrix3Xd& positions,
                                       const subdiv::CellData<std::uint8_t>& kept, const Eigen::VectorXd& values);

enum class FrameKind {
  tangent,  // ∂x/∂u, ∂x/∂v, ∂x/∂w in the middle of each hexahedron: they stretch, shear and turn with it
  rotated   // R of the polar decomposition of F in the middle, det R = +1: they only turn
};
/// Axes u, v, w of every hexahedron of the finest level (of the kept ones), from its middle; u runs from the cell's
/// vertex of lowest id to that vertex' neighbour of lowest id. Tangents are 0.35 of ∂x/∂u long, rotated axes 0.35
/// of the cell's edge at rest.
void add_frames(Scene& scene, const Document& document, FrameKind kind,
                const subdiv::CellData<std::uint8_t>& kept = {});

/// What the published local frame sees at a vertex of the finest level (METHODS §4; Fig. 3): of the corners of
/// quadrilaterals there, the one whose angle has changed most; its sides s₁ and s₂ to a and b, and where a′ and b′
/// would be without shear: turned about s₁ × s₂ by −δ and +δ, δ half the loss of angle.
struct ShearedCorner {
  std::uint32_t vertex = 0, a = 0, b = 0, face = 0;  // of the finest level
  Eigen::Vector3d at, a_now, b_now, a_unsheared, b_unsheared;
  double rest_angle = 0, angle = 0;  // [radians]
};
/// @throws Error (bad_input) for a vertex that is not there or whose corners are all degenerate.
[[nodiscard]] ShearedCorner sheared_corner(const Document& document, std::uint32_t vertex);
/// The cells about the corner as wires, its sides, the sides without shear, and labels.
[[nodiscard]] Scene corner_scene(const Document& document, std::uint32_t vertex);

/// Adds the edges of a surface as an overlay.
void add_overlay(Scene& scene, const io::SurfaceMesh& surface);

}  // namespace argil::sculpt
