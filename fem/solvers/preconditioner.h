#pragma once
// Preconditioners of the linear systems in the control points, made from the rest operator: a dense Cholesky factor
// of S₀ = K̃₀ + M̃/c² + D̃/c + springs up to k_largest_factor unknowns, block Jacobi (3x3) of the same matrix beyond.
// (K̃₀ of a refined solid couples a control point with some hundred others, so that Eigen's sparse factor fills up:
// at 1815 unknowns it took 970 ms where the dense one takes 150.) They depend on rest state, materials, the time
// coefficient, pins and the springs' stiffnesses only, never on history, so that undo gives the same bits.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

namespace argil::fem {

struct AnchorSpring;
struct RestOperator;

enum class PreconditionerKind { factor, jacobi };

inline constexpr std::size_t k_largest_factor = 3000;

/// The rule above, by the number of unknowns (3 x control points).
[[nodiscard]] PreconditionerKind preconditioner_kind(std::size_t unknowns);

class Preconditioner {
 public:
  virtual ~Preconditioner() = default;
  virtual PreconditionerKind kind() const = 0;
  /// z ≈ S⁻¹ r; 3 x control points, zero in columns that are not free.
  virtual void apply(const Eigen::Matrix3Xd& r, Eigen::Matrix3Xd& z) const = 0;
};

/// `inertia` = M̃/c² + D̃/c per control point, empty in statics; `free` per control point. A factor needs
/// RestOperator::stiffness, and where S₀ has no factor (a body that nothing holds) block Jacobi is returned.
[[nodiscard]] std::unique_ptr<Preconditioner> make_preconditioner(PreconditionerKind kind, const RestOperator& rest,
                                                                  const Eigen::SparseMatrix<double>& inertia,
                                                                  const std::vector<AnchorSpring>& springs,
                                                                  const std::vector<std::uint8_t>& free);

}  // namespace argil::fem
