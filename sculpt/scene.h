#pragma once
// Makes what a renderer draws (renderer.h) of solids: the boundary or, with a clip plane, whole cells of the
// inside; the control cage; field values.

#include <Eigen/Core>
#include <span>

#include "sculpt/renderer.h"
#include "subdiv/refinement.h"

namespace argil::sculpt {

/// The normal points at the side that is taken away.
struct ClipPlane {
  Eigen::Vector3d point{0, 0, 0}, normal{1, 0, 0};
};

/// 1 for the cells that the plane keeps or meets: those with a vertex on the kept side, farther from the plane than
/// 1e-9 of the solid's extent. A cell that only touches the plane from the other side is not met.
/// `positions`: 3 x vertex_capacity [m]. @throws Error (bad_input) for a normal that is zero or not finite.
[[nodiscard]] subdiv::CellData<std::uint8_t> cells_met_or_kept(const subdiv::Solid& solid,
                                                               const Eigen::Matrix3Xd& positions,
                                                               const ClipPlane& plane);

/// How many layers each cell lies below the boundary: 0 with a boundary face, else one more than the least of the
/// cells that share a face with it. Cost O(cells).
[[nodiscard]] subdiv::CellData<std::uint32_t> cell_depths(const subdiv::Solid& solid);

/// The faces between a kept cell and none, or one that is not kept, ascending, seen from outside the kept cell;
/// faces inside the solid are marked as cut. Normals split at edges of sharpness ≥ 1, of cut faces, where other
/// than two faces meet, and where the surface bends by more than 50 degrees (coarse levels look as they are). Every
/// edge of these faces is wire. `kept` has cell_capacity entries; empty: all cells.
/// @throws Error (bad_geometry) naming a vertex with a coordinate that is not finite. Cost O(solid).
[[nodiscard]] SceneSurface cells_surface(const subdiv::Solid& solid, const Eigen::Matrix3Xd& positions,
                                         const subdiv::CellData<std::uint8_t>& kept = {});

/// As above for the cells that the plane meets or keeps.
[[nodiscard]] SceneSurface clipped_surface(const subdiv::Solid& solid, const Eigen::Matrix3Xd& positions,
                                           const ClipPlane& plane);

/// The control cell that each cell of the finest level came from.
[[nodiscard]] subdiv::CellData<subdiv::CellId> control_cells(const subdiv::Refinement& refinement);

/// Keeps of the wire only what runs between different groups of cells (with `control_cells`: the control cells'
/// outlines on the refined surface), and what is sharp.
void keep_wire_between(SceneSurface& surface, const subdiv::CellData<subdiv::CellId>& group_from_cell);

/// Legends and their ranges are cut into at most so many round parts.
inline constexpr int k_legend_parts = 8;

/// The legend of these values, its range rounded outwards to round numbers (from 0 where all are positive and it
/// lies near); with the balanced map as far below 0 as above. @throws Error (bad_geometry) for a value that is not
/// finite, with its number.
[[nodiscard]] SceneLegend field_legend(std::span<const double> values, const std::string& title,
                                       const std::string& unit, ColourMap map = ColourMap::viridis);

/// Colours the surface by a field with one value a vertex of the solid, and gives the scene the legend of what is
/// shown.
void show_field(Scene& scene, std::span<const double> value_from_vertex, const std::string& title,
                const std::string& unit, ColourMap map = ColourMap::viridis);

/// Adds the edges and vertices of a control mesh as its cage: those of the boundary, or with `interior` all.
void add_cage(Scene& scene, const subdiv::Solid& solid, const Eigen::Matrix3Xd& positions, bool interior = false);

/// The box between two corners [m], as a frame of pictures.
[[nodiscard]] PictureFrame box_frame(const Eigen::Vector3d& low, const Eigen::Vector3d& high);

/// A step of 1, 2 or 5 times a power of ten that cuts a positive span into at most `most` parts, or the next
/// larger.
[[nodiscard]] double round_step(double span, int most);

}  // namespace argil::sculpt
