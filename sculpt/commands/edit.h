#pragma once
// What the shape and material commands share.

#include <functional>
#include <span>
#include <string>

#include "sculpt/command.h"
#include "sculpt/document.h"

namespace argil::sculpt {

[[nodiscard]] ElementType element_type(const std::string& word);

/// @throws Error (bad_input) if there is no solid yet.
void require_solid(const Session& session);

/// The selection that a command acts on: `where` if it has one, else what is selected, which must be of one of the
/// types.
/// @throws Error (bad_input) if it is of another type or empty.
[[nodiscard]] Selection acted_on(const Session& session, const Arguments& arguments,
                                 std::span<const ElementType> types);

/// Runs a topology edit: `edit` changes the solid through the transaction and the positions in `next` (rest and
/// present positions grow with the vertices). Then fields, pins, loads and sets follow, and everything must still
/// refine; if anything throws, the solid is as it was.
void edit_topology(Session& session,
                   const std::function<void(subdiv::Transaction&, Eigen::Matrix3Xd& rest, Eigen::Matrix3Xd& present,
                                            Selection& selection)>& edit);

/// Makes sure that the solid can be simulated as it now stands, after the state was assigned.
/// @throws Error (bad_geometry) naming the cell.
void check_discretization(const Session& session);

}  // namespace argil::sculpt
