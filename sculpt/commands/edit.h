#pragma once
// What the shape and material commands share.

#include <functional>
#include <span>
#include <string>

#include "sculpt/command.h"
#include "sculpt/document.h"
#include "subdiv/build.h"
#include "subdiv/edit/edit.h"

namespace argil::sculpt {

[[nodiscard]] ElementType element_type(const std::string& word);

/// @throws Error (bad_input) if there is no solid yet.
void require_solid(const Session& session);

/// The selection that a command acts on: `where` if it has one, else what is selected, which must be of one of the
/// types.
/// @throws Error (bad_input) if it is of another type or empty.
[[nodiscard]] Selection acted_on(const Session& session, const Arguments& arguments,
                                 std::span<const ElementType> types);

/// The same, but all elements of the first type where there is no `where` and nothing of the types is selected.
[[nodiscard]] Selection acted_on_or_all(const Session& session, const Arguments& arguments,
                                        std::span<const ElementType> types);

/// Runs an edit of subdiv/edit: `edit` gets the rest positions, changes the solid, and says where what it made
/// comes from; positions (rest and present), fields, pins, loads and named sets follow, and what it names to go on
/// with is selected. If anything throws, the solid is as it was.
void edit_solid(Session& session,
                const std::function<subdiv::Edit(subdiv::Transaction&, const Eigen::Matrix3Xd& rest)>& edit);

/// A new solid begins a new document: level 0, initial fields, nothing pinned.
[[nodiscard]] State state_of(subdiv::Built built);

/// @throws Error (limit_exceeded) if so many cells are more than the session may have.
void check_cells(const Session& session, double cells);

/// The area-weighted mean of the outward normals of some boundary faces. @throws Error (bad_geometry) if there is
/// none.
[[nodiscard]] Eigen::Vector3d mean_normal(const subdiv::Solid& solid, const Eigen::Matrix3Xd& positions,
                                          const std::vector<std::uint32_t>& faces);

/// Makes sure that the solid can be simulated as it now stands, after the state was assigned.
/// @throws Error (bad_geometry) naming the cell.
void check_discretization(const Session& session);

}  // namespace argil::sculpt
