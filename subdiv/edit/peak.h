#pragma once
// Pyramids raised over boundary faces.

#include <Eigen/Core>
#include <span>

#include "subdiv/edit/edit.h"

namespace argil::subdiv {

/// Over each face a cell whose apex stands at `height` [m] above the middle of the face along its normal.
/// `next_vertices` are the apexes.
/// @throws Error before anything is changed: as `extrude`; (bad_geometry) for a face without a normal. Cost
/// O(corners).
[[nodiscard]] Edit raise_peaks(Transaction& transaction, const Eigen::Matrix3Xd& rest,
                               std::span<const FaceId> faces, double height);

}  // namespace argil::subdiv
