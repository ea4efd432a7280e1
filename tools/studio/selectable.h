#pragma once
// What of the control solid shows on the surface that is drawn: which control face, edge, vertex or cell lies
// where, so that a hand can point at it, and a highlight be laid on it. Made beside a scene, by the simulation's
// thread.

#include <cstdint>
#include <optional>
#include <vector>

#include "sculpt/document.h"
#include "tools/studio/orbit_camera.h"
#include "tools/studio/picking.h"

namespace argil::studio {

struct Selectable {
  static constexpr std::uint32_t k_none = 0xffffffffU;
  struct Line {
    std::uint32_t edge = 0;
    std::array<std::uint32_t, 2> ends{};  // surface vertices
    auto operator<=>(const Line&) const = default;
  };
  struct Point {
    std::uint32_t vertex = 0, at = 0;  // control vertex, surface vertex
  };
  std::vector<std::uint32_t> face_from_face;  // of surface faces: the boundary control face, or k_none (a cut)
  std::vector<std::uint32_t> cell_from_face;
  std::vector<Line> lines;  // ascending: edges of the control solid in pieces
  std::vector<Point> points;
};
/// Cost O(solid).
[[nodiscard]] Selectable selectable(const sculpt::Document& document, const sculpt::SceneSurface& surface);

/// The element that a hit means: the face or cell met, or the edge or vertex nearest to the place.
[[nodiscard]] std::optional<std::uint32_t> element_at(const Selectable& on, const sculpt::SceneSurface& surface,
                                                      sculpt::ElementType type, const Hit& hit);

/// Corners of a box on the screen [pixels].
struct ScreenBox {
  double left = 0, top = 0, right = 0, bottom = 0;
  [[nodiscard]] bool contains(const Eigen::Vector2d& p) const {
    return p.x() >= left && p.x() <= right && p.y() >= top && p.y() <= bottom;
  }
};
/// Elements with their middle (of what shows) in the box, ascending: those that can be seen, or with `through`
/// those behind others as well. Cost O(elements in the box · faces).
[[nodiscard]] std::vector<std::uint32_t> elements_in(const Selectable& on, const sculpt::SceneSurface& surface,
                                                     sculpt::ElementType type, const OrbitCamera& camera,
                                                     const ScreenBox& box, bool through);

/// Where the surface faces of a selection have their middle, and their mean normal: what a tool is drawn by.
struct Patch {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::UnitZ();
  bool empty = true;
};
[[nodiscard]] Patch patch_of(const Selectable& on, const sculpt::SceneSurface& surface,
                             const sculpt::Selection& selection);

}  // namespace argil::studio
