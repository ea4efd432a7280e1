#pragma once
// A preconditioner M of the system without contact, corrected for what touches now: contact adds C = E K Eᵀ in the
// control points c that what touches depends on, and (Woodbury)
//   (M + E K Eᵀ)⁻¹ = M⁻¹ − M⁻¹E (1 + K G)⁻¹ K Eᵀ M⁻¹,   G = Eᵀ M⁻¹ E.
// Without it, conjugate gradients take some twenty to forty iterations for the stiff springs of contact. The
// columns M⁻¹E are solved for once for each control point that ever touches, while M stays; what touches may then
// change with every iteration at the cost of a small dense system.

#include <Eigen/LU>
#include <cstdint>
#include <map>
#include <memory>

#include "fem/contact/contact.h"
#include "fem/solvers/preconditioner.h"

namespace argil::fem {

/// 1 + K G of what touched last, which stays the same while a body rests.
struct ContactSystem {
  std::vector<std::uint32_t> control_points;
  Eigen::MatrixXd stiffness;  // K
  Eigen::PartialPivLU<Eigen::MatrixXd> factor;
};

/// Columns of M⁻¹, three a control point, each solved for on its own, so that they do not depend on when they were
/// asked for.
class PreconditionerColumns {
 public:
  void forget() {
    columns_.clear();
    last.reset();
  }
  /// 3 N x 3: the answer to a unit force along each axis.
  const Eigen::MatrixXd& of(const Preconditioner& preconditioner, std::uint32_t control_point,
                            Eigen::Index control_point_count);

  std::shared_ptr<const ContactSystem> last;

 private:
  std::map<std::uint32_t, Eigen::MatrixXd> columns_;
};

/// Null where nothing touches, or where it would take more than 400 control points or 256 MB of columns. What it is
/// made of must outlive it.
[[nodiscard]] std::unique_ptr<Preconditioner> with_contact(const Preconditioner& preconditioner,
                                                           PreconditionerColumns& columns,
                                                           const ContactStep& contact,
                                                           Eigen::Index control_point_count);

}  // namespace argil::fem
