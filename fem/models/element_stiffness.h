#pragma once
// Dense stiffness matrices of linear elasticity, one for each element, shared by congruent ones: elements of a
// block whose rest nodes differ by a translation only and whose materials are equal (both to 2⁻⁴⁰, relative to the
// size of the element and to the modulus). Formulations of trilinear hexahedra (METHODS §3): plain, B-bar (mean
// dilatation, Hughes 1980), and incompatible modes (Taylor, Beresford, Wilson 1976: three bubbles, gradients with
// the Jacobian of the centre, condensed out).

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "fem/element_block.h"
#include "fem/models/formulation.h"
#include "fem/models/lanes.h"

namespace argil::fem {

/// Fills the 3n x 3n matrices of all elements of a block, column by column, one after the other.
using FillMatrices = std::function<void(const ElementBlock& distinct, double* matrices)>;

/// Does not change once it is built: who keeps one builds another when is_current() says no.
class ElementStiffness {
 public:
  /// The blocks must outlive this. Cost O(elements) and, for each distinct matrix, O(points · nodes²).
  ElementStiffness(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes,
                   Formulation formulation);
  /// Other matrices that depend on shape and material only: `fill` is given the elements, one of each kind of
  /// congruent ones.
  ElementStiffness(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes,
                   const FillMatrices& fill);

  /// Whether the blocks still have the materials that this was built with. Cost O(points).
  [[nodiscard]] bool is_current() const;

  std::size_t block_count() const { return blocks_.size(); }
  const ElementBlock& block(std::size_t b) const { return blocks_[b]; }
  /// K_e of an element, 3n x 3n column by column, node-major (3 a + axis).
  const double* matrix(std::size_t b, std::size_t element) const {
    const Shared& shared = shared_[b];
    return shared.matrices.data() + shared.index[element] * shared.size * shared.size;
  }
  /// Which of the block's distinct matrices an element has.
  std::uint32_t index(std::size_t b, std::size_t element) const { return shared_[b].index[element]; }
  std::size_t distinct_count(std::size_t b) const { return shared_[b].representatives.size(); }

 private:
  struct Shared {
    std::size_t size = 0;                        // 3n
    std::vector<std::uint32_t> index;            // [element], of its matrix
    std::vector<std::uint32_t> representatives;  // [matrix], the element it was computed from
    std::vector<double> matrices;
    std::vector<double> mu, lambda;  // that they were computed with
  };

  std::span<const ElementBlock> blocks_;
  std::vector<Shared> shared_;
};

/// result = K v for a matrix of `size` rows, column by column: the same bits with and without AVX. Distinct large
/// matrices stream at the speed of memory.
void multiply_stiffness(const double* matrix, std::size_t size, const double* v, double* result);

/// The same for one matrix and four vectors side by side, v and result at [row]: the bits of multiply_stiffness().
void multiply_stiffness_of_four(const double* matrix, std::size_t size, const FourDoubles* v, FourDoubles* result);

/// K_e of one element, symmetric, from its rest positions (3 x nodes of the table) and materials, 3n x 3n.
[[nodiscard]] Eigen::MatrixXd element_stiffness(const ElementBlock& block, std::size_t element,
                                                const Eigen::Matrix3Xd& rest_nodes, Formulation formulation);

/// The gradient ∂x/∂X at the centre of an element's reference cell as 3 x 3 = Σ_a x_a g_aᵀ: columns g_a [1/m] of
/// its nodes.
[[nodiscard]] Eigen::Matrix3Xd centre_gradients(const ElementBlock& block, std::size_t element,
                                                const Eigen::Matrix3Xd& rest_nodes);

}  // namespace argil::fem
