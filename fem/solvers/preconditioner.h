#pragma once
// Preconditioners of the linear systems in the control points, made from the rest operator: a dense Cholesky factor
// of S₀ = K̃₀ + M̃/c² + D̃/c + springs, a supernodal one (supernodal.h), or block Jacobi (3x3) of the same matrix;
// solver_choice.h says when which. (K̃₀ of a refined solid couples a control point with some hundred others, so that
// Eigen's sparse factor fills up: at 1815 unknowns it took 970 ms where the dense one takes 150.) They depend on
// rest state, materials, the time coefficient, pins and the springs' stiffnesses only, never on history, so that
// undo gives the same bits.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <memory>
#include <string_view>
#include <vector>

namespace argil::fem {

struct AnchorSpring;
struct RestOperator;

enum class PreconditionerKind { factor, jacobi, supernodal, none };  // none: an explicit step

inline constexpr std::array k_preconditioner_kinds{PreconditionerKind::factor, PreconditionerKind::jacobi,
                                                   PreconditionerKind::supernodal, PreconditionerKind::none};
[[nodiscard]] std::string_view word(PreconditionerKind kind);

class Preconditioner {
 public:
  virtual ~Preconditioner() = default;
  virtual PreconditionerKind kind() const = 0;
  /// z ≈ S⁻¹ r; 3 x control points, zero in columns that are not free.
  virtual void apply(const Eigen::Matrix3Xd& r, Eigen::Matrix3Xd& z) const = 0;
};

/// `inertia` = M̃/c² + D̃/c per control point, empty in statics; `free` per control point. A factor needs
/// RestOperator::stiffness, and where S₀ has none (a body that nothing holds) block Jacobi is returned.
[[nodiscard]] std::unique_ptr<Preconditioner> make_preconditioner(PreconditionerKind kind, const RestOperator& rest,
                                                                  const Eigen::SparseMatrix<double>& inertia,
                                                                  const std::vector<AnchorSpring>& springs,
                                                                  const std::vector<std::uint8_t>& free);

}  // namespace argil::fem
