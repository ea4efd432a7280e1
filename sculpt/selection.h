#pragma once
// Ways of choosing elements by where they stand and what they touch: a picking ray, regions of space, growing,
// shrinking, components. Faces are boundary faces unless `interior`; nodes are the vertices of the finest level.
// Positions are the present ones. Every result is ascending.

#include <functional>

#include "sculpt/document.h"
#include "sculpt/region.h"

namespace argil::sculpt {

/// The element that a ray from `origin` meets first on the boundary faces of the control solid (nodes: of the
/// finest level), fanned into triangles about their first corner: the face; or the vertex or edge of it that is
/// nearest to the point met; or its cell. Empty if the ray meets nothing; of faces at the same distance the lowest.
/// @throws Error (bad_input) for a direction that is zero. Cost O(solid) to find the boundary.
[[nodiscard]] std::vector<std::uint32_t> picked(const Document& document, ElementType type,
                                                const Eigen::Vector3d& origin, const Eigen::Vector3d& direction);

/// Keeps of `ids` what lies in a region: the centroid of its vertices, or any or all of them.
void keep_within(const Document& document, ElementType type, Asked asked,
                 const std::function<bool(const Eigen::Vector3d&)>& region, std::vector<std::uint32_t>& ids);

/// Keeps boundary elements (cells: those with a boundary face), or only the others.
void keep_boundary(const Document& document, ElementType type, bool boundary, std::vector<std::uint32_t>& ids);

/// `steps` times the elements that share a vertex (vertices and nodes: an edge) with it. Cost O(result · steps).
[[nodiscard]] Selection grown(const Document& document, const Selection& selection, long steps, bool interior);
/// `steps` times without the elements that share a vertex (vertices and nodes: an edge) with one not selected.
[[nodiscard]] Selection shrunk(const Document& document, const Selection& selection, long steps, bool interior);
/// All elements of the components (cells connected through faces) that the selection touches. Cost O(solid).
[[nodiscard]] Selection whole_components(const Document& document, const Selection& selection, bool interior);

}  // namespace argil::sculpt
