#pragma once
// From a document to a scene: what `render` shows.

#include <memory>
#include <optional>
#include <string>

#include "sculpt/document.h"
#include "sculpt/physics_picture.h"
#include "sculpt/renderer.h"
#include "sculpt/scene.h"

namespace argil::sculpt {

enum class PictureStyle {
  solid,              // clay or field colours, with the wires of the finest level's cells
  wireframe,          // every edge of the refined solid, inside as well
  boundary_wireframe  // the edges of the boundary only
};

struct PictureRequest {
  std::string field;                                // empty: clay
  std::optional<ColourMap> colours;                 // else by rule
  std::shared_ptr<const ReferenceShape> reference;  // for the field `error`
  bool volume = false;                              // the field inside, in place of the surface
  double opacity = 1;                               // of the volume
  std::optional<std::array<double, 2>> range;
  std::optional<ClipPlane> clip;
  int peel = 0;  // layers of the finest cells that are taken away from the boundary inwards
  PictureStyle style = PictureStyle::solid;
  bool cage = false;
  bool control_wire = false;  // outlines of the control cells only, on the refined surface
  bool marks = true;          // loads as arrows, pins as marks
  std::optional<std::array<Eigen::Vector3d, 2>> tool_force;  // where [m] and what [N]: shown with the loads
  std::optional<std::uint32_t> net_cell;   // instead of the solid: this cell of the finest level in its 4×4×4 net
  std::optional<FrameKind> frames;         // axes of every cell, in a body of wires
  std::optional<std::uint32_t> corner;     // instead of the solid: the sheared corner at this vertex
  std::optional<io::SurfaceMesh> overlay;  // edges of another mesh
  bool overlay_rest = false;               // those of the solid at rest
  std::shared_ptr<const ComparedMesh> underlay;  // in place of the surface, under the solid's wires; with the field
  bool underlay_wires = false;                   // and with its own edges
  bool springs = false;                          // those of the model, in place of surface and wires
  std::optional<std::array<Eigen::Vector3d, 2>> line;  // ends of a material line, at rest
  int smooth = 0;                                      // refined so many times more, for the picture only
  std::optional<double> shrink;                        // every cell by itself, of this size
  bool cell_kinds = false;                             // and coloured by its kind
  std::vector<Eigen::Vector3d> curve_handles;          // of a curve on the surface [m]; fewer than two: none
  std::optional<double> felt;  // [N] at which the ground has full colour; the tool's force fills it
  int net_steps = 4;           // 1: the cell, 2: and its face neighbours, 3: edge, 4: vertex neighbours
};

/// @throws Error (bad_input) for a cell or vertex that is not there, a cell without a net, a volume without a
/// field; and what add_springs, add_material_line and lay_under throw.
[[nodiscard]] Scene make_scene(const Document& document, const PictureRequest& request);

}  // namespace argil::sculpt
