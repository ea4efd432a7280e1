#pragma once
// The pencil (K̃, M̃) of small vibrations in the control points, K̃ v = ω² M̃ v, pins taken out: K̃ = Aᵀ K A is the
// tangent at the positions given, with the springs, M̃ the consistent mass. From it come the frequencies of a body
// and the largest step of the explicit methods (METHODS §5).

#include <Eigen/SparseCore>
#include <memory>
#include <span>
#include <vector>

#include "fem/system.h"

namespace argil::fem {

/// Both matrices hold their lower triangles; row 3 i + axis is that axis of control_points[i].
struct Pencil {
  std::vector<std::uint32_t> control_points;  // not fixed and named by an element, ascending
  Eigen::SparseMatrix<double> stiffness;      // [N/m]
  Eigen::SparseMatrix<double> mass;           // [kg]
};

/// Assembles the pencil, linearised at `positions` (3 x control points). @throws Error (bad_input) if nothing can
/// move, (limit_exceeded) if the stiffness might take more than `max_memory` bytes, asked before it is assembled.
/// Cost as rest_operator(), bytes as pencil_bytes().
[[nodiscard]] Pencil pencil(const System& system, std::span<const AnchorSpring> springs,
                            const Eigen::Matrix3Xd& positions, double max_memory = 12e9);

/// An upper bound of the bytes that assembling K̃ takes: each element couples every two of its control points.
[[nodiscard]] double pencil_bytes(const System& system);

/// M̃ among the free control points as a sparse Cholesky factor.
class InverseMass {
 public:
  /// @throws Error (bad_geometry) if a motion of the free control points carries no mass.
  InverseMass(const Eigen::SparseMatrix<double>& mass, std::vector<std::uint32_t> control_points);
  ~InverseMass();
  InverseMass(const InverseMass&) = delete;
  InverseMass& operator=(const InverseMass&) = delete;
  /// result = M̃⁻¹ forces, 3 x all control points; zero where they are not free.
  void solve(const Eigen::Matrix3Xd& forces, Eigen::Matrix3Xd& result) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

/// Control points that are not fixed and that an element names, ascending.
[[nodiscard]] std::vector<std::uint32_t> moving_control_points(const System& system);

}  // namespace argil::fem
