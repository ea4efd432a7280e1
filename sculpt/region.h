#pragma once
// Which elements a `where` means (SESSION.md, "Grammar"): vertices, edges, faces and cells of the control solid,
// asked at their centroid or at their vertices, and nodes, the vertices of the finest level.

#include <cstdint>
#include <string>
#include <vector>

#include "sculpt/document.h"
#include "sculpt/where.h"

namespace argil::sculpt {

/// x y z (rest), px py pz (present), boundary, valence, and the fields.
[[nodiscard]] const VariableTable& variable_table();

enum class Asked { centroid, any_vertex, all_vertices };

/// Ids of the elements that fit, ascending; without an expression all of them. Faces are boundary faces unless
/// `interior`. Cost O(elements · expression).
[[nodiscard]] std::vector<std::uint32_t> matching(const Document& document, ElementType type,
                                                  const Expression* where, bool interior = false,
                                                  Asked asked = Asked::centroid);

/// A formula's value at each of `nodes`. @throws Error (bad_input) at the first node where it is not finite.
[[nodiscard]] Eigen::VectorXd values_at_nodes(const Document& document, const Expression& formula,
                                              const std::vector<std::uint32_t>& nodes);

/// The finest-level node that a control vertex becomes.
[[nodiscard]] std::vector<std::uint32_t> node_from_control_vertex(const Document& document);

/// Control vertices of a set of elements, ascending.
[[nodiscard]] std::vector<std::uint32_t> vertices_of(const Document& document, const Selection& selection);

/// "3 faces", "1 face".
[[nodiscard]] std::string count_of(std::size_t count, ElementType type);

}  // namespace argil::sculpt
