#pragma once
// Carries what hangs on the nodes of the finest level to another level of the same solid, or through a topology
// edit.

#include <cstdint>
#include <memory>
#include <vector>

#include "sculpt/document.h"
#include "subdiv/edit/edit.h"

namespace argil::sculpt {

inline constexpr std::uint32_t k_no_node = 0xffffffffU;

/// Rising, a node becomes its vertex point; falling, it stays where the coarser level has it (else k_no_node).
[[nodiscard]] std::vector<std::uint32_t> nodes_at_level(const subdiv::Refinement& from,
                                                        const subdiv::Refinement& to);
/// Fields rising by the stencils (weights ≥ 0 keep them positive), falling by restriction.
[[nodiscard]] std::shared_ptr<const Fields> fields_at_level(const Fields& fields, const subdiv::Refinement& from,
                                                            const subdiv::Refinement& to);

/// New node from old node where the element that it stands for lived on, else k_no_node. Cost O(finest level ·
/// log).
[[nodiscard]] std::vector<std::uint32_t> nodes_after_edit(const subdiv::Refinement& before,
                                                          const subdiv::Refinement& after);
/// The node that each node in a copy of a cell is a copy of, else k_no_node: a cell is a copy if its vertices are
/// placed with one source each, and these are the vertices of another. Cost O(finest level · log).
[[nodiscard]] std::vector<std::uint32_t> copied_nodes(const subdiv::Refinement& after, const subdiv::Edit& edit);
/// What stayed keeps its value, a copied node takes that of its source, what grew else the mean of its known
/// neighbours, layer by layer. `source_from_node` as copied_nodes gives it, or empty.
[[nodiscard]] std::shared_ptr<const Fields> fields_after_edit(
    const Fields& fields, const std::vector<std::uint32_t>& node_map, const subdiv::Refinement& after,
    const std::vector<std::uint32_t>& source_from_node = {});

}  // namespace argil::sculpt
