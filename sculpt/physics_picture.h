#pragma once
// What pictures show of the mechanics beside colours: the inside as a volume, local frames of cells (papers/004,
// Figs. 4 and 5), a sheared corner (Fig. 3), springs (papers/001, Figs. 1 and 4), material lines, and another mesh
// as wires over the body or as the surface under its wires (papers/001, Figs. 5 and 6).

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

/// The springs of a model that is made of springs, as they stand now, in a colour for each kind (in the key of the
/// picture), with a point for each node; of the kept cells. Volume energies, corrections and hourglass springs are
/// not between two nodes and have no line.
/// @throws Error (unsupported) for a model without springs, or elements that have none.
void add_springs(Scene& scene, const Document& document, const subdiv::CellData<std::uint8_t>& kept = {});

/// A straight line of the body at rest, in `parts` equal parts, where its points are now.
/// @throws Error (bad_input) for a point that is not in the body.
void add_material_line(Scene& scene, const Document& document, const std::array<Eigen::Vector3d, 2>& ends,
                       int parts = 64);

/// Adds the edges of a surface as an overlay; with a name they are in the key of the picture.
void add_overlay(Scene& scene, const io::SurfaceMesh& surface, const std::string& name = "");

/// Puts another mesh in the place of the scene's surface, whose wires stay as an overlay. `field` is displacement,
/// displacement_x, _y or _z, out of the mesh's own displacements, or empty for clay; `wires` with the mesh's own.
/// @throws Error (bad_input) for another field, a mesh that is a surface alone, or one without displacements.
void lay_under(Scene& scene, const ComparedMesh& mesh, const std::string& field, bool wires);

}  // namespace argil::sculpt
