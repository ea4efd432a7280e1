#pragma once
// The loads of a document as the integrator takes them, and places in its body by their rest position.

#include <string>

#include "fem/loads.h"
#include "sculpt/document.h"

namespace argil::sculpt {

/// Gravity and applied forces as generalised forces, soft pins as springs.
/// @throws Error (not_found) if a force acts at a point that is not in the body.
[[nodiscard]] fem::Loads document_loads(const Document& document);

/// The material point at a rest position. @throws Error (bad_input) if it lies outside, with the remedy.
[[nodiscard]] fem::MaterialPoint material_point(const Document& document, const Eigen::Vector3d& rest_position);

/// Boundary faces of the finest level that came from these control faces, ascending.
[[nodiscard]] std::vector<subdiv::FaceId> finest_faces(const subdiv::Refinement& refinement,
                                                       const std::vector<std::uint32_t>& control_faces);

/// smooth, linear or constant.
[[nodiscard]] fem::Falloff falloff_by_word(const std::string& word);
/// Weight of a brush at distance / radius.
[[nodiscard]] double falloff_weight(fem::Falloff falloff, double distance_ratio);

}  // namespace argil::sculpt
