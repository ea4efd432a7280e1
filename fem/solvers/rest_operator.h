#pragma once
// The stiffness at rest in the control points, K̃₀ = Aᵀ K(rest) A, from which the preconditioners are made. It
// depends on rest positions and materials only.

#include <Eigen/SparseCore>
#include <functional>
#include <vector>

#include "fem/system.h"
#include "subdiv/progress.h"

namespace argil::fem {

struct RestOperator {
  subdiv::Stencils rows, rows_transposed;  // A where an element names the node; other rows are empty
  std::vector<std::uint8_t> touched;       // per control point: some element depends on it
  std::vector<Eigen::Matrix3d> diagonal;   // 3x3 diagonal blocks of K̃₀, per control point
  Eigen::SparseMatrix<double> stiffness;   // K̃₀, 3N x 3N, lower blocks only; empty unless asked for
};

/// Cost O(elements · (nodes · columns + columns²)), columns = control points that an element depends on; the full
/// matrix only if `with_stiffness`.
[[nodiscard]] RestOperator rest_operator(const System& system, bool with_stiffness, const Progress& progress = {});
/// The same of any element matrices, in nodes that `rows` gives.
using ElementSource = std::function<void(const Tangent::Visit& visit)>;
[[nodiscard]] RestOperator reduce_elements(const subdiv::Stencils& rows, const ElementSource& source,
                                           bool with_stiffness);
/// to += factor · other, in diagonal and stiffness.
void add_scaled(RestOperator& to, const RestOperator& other, double factor);

/// Gathers what one element names into its reduced form: the union of columns of its rows (ascending) and their
/// weights, nodes x columns. Used for stiffness and mass alike.
class ElementReduction {
 public:
  explicit ElementReduction(const subdiv::Stencils& rows) : rows_(rows), local_(rows.column_count, 0) {}
  void gather(std::span<const std::uint32_t> nodes);

  std::vector<std::uint32_t> columns;
  Eigen::MatrixXd weights;

 private:
  const subdiv::Stencils& rows_;
  std::vector<std::uint32_t> local_;
};

}  // namespace argil::fem
