#include "fem/models/element_stiffness.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>

#include "fem/models/kernel_variants.h"
#include "fem/models/lanes.h"
#include "fem/models/linear.h"
#include "fem/parallel.h"

#pragma GCC diagnostic ignored "-Wpsabi"

namespace argil::fem {
namespace {

constexpr double k_steps = 1099511627776.0;  // 2⁴⁰

void append(std::string& key, std::int64_t value) {
  key.append(reinterpret_cast<const char*>(&value), sizeof value);
}
/// To 40 bits of the mantissa.
void append_rounded(std::string& key, double value) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  append(key, std::llround(mantissa * k_steps));
  append(key, exponent);
}

/// What congruent elements have in common. Rounding may part two of them at the edge of a step, which costs a
/// matrix and no more.
std::string congruence_key(const ElementBlock& block, std::size_t element, const Eigen::Matrix3Xd& rest_nodes) {
  const auto nodes = static_cast<std::size_t>(block.kind->node_count);
  const std::uint32_t* n = block.nodes.data() + element * nodes;
  double size = 0;
  for (std::size_t a = 1; a < nodes; ++a)
    for (int i = 0; i < 3; ++i) size = std::max(size, std::abs(rest_nodes(i, n[a]) - rest_nodes(i, n[0])));
  int exponent = 0;
  std::frexp(size, &exponent);
  const double step = std::ldexp(k_steps, -exponent);
  std::string key;
  append(key, exponent);
  for (std::size_t a = 1; a < nodes; ++a)
    for (int i = 0; i < 3; ++i) append(key, std::llround((rest_nodes(i, n[a]) - rest_nodes(i, n[0])) * step));
  for (int q = 0; q < block.kind->point_count; ++q) {
    append_rounded(key, block.mu[block.point_index(element, q)]);
    append_rounded(key, block.lambda[block.point_index(element, q)]);
  }
  return key;
}

Eigen::Matrix3d rest_jacobian(const ElementBlock& block, std::size_t element, const Eigen::Matrix3Xd& rest_nodes,
                              const Eigen::Matrix3Xd& slopes) {
  const auto nodes = static_cast<std::size_t>(block.kind->node_count);
  const std::uint32_t* n = block.nodes.data() + element * nodes;
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
  for (std::size_t a = 1; a < nodes; ++a) {
    const Eigen::Vector3d x = rest_nodes.col(n[a]) - rest_nodes.col(n[0]);
    for (int axis = 0; axis < 3; ++axis) jacobian.col(axis) += x * slopes(axis, static_cast<Eigen::Index>(a));
  }
  return jacobian;
}

/// stiffness += V (λ g_a g_bᵀ + μ g_b g_aᵀ + μ (g_a·g_b) I) over the columns a, b of g.
void add_elastic(Eigen::MatrixXd& stiffness, const Eigen::Matrix3Xd& g, double mu, double lambda, double volume) {
  for (Eigen::Index b = 0; b < g.cols(); ++b)
    for (Eigen::Index a = 0; a < g.cols(); ++a) {
      const double along = g(0, a) * g(0, b) + g(1, a) * g(1, b) + g(2, a) * g(2, b);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          stiffness(3 * a + i, 3 * b + j) +=
              volume * (lambda * g(i, a) * g(j, b) + mu * g(j, a) * g(i, b) + (i == j ? mu * along : 0.0));
    }
}

}  // namespace

Eigen::Matrix3Xd centre_gradients(const ElementBlock& block, std::size_t element,
                                  const Eigen::Matrix3Xd& rest_nodes) {
  Eigen::VectorXd shapes;
  Eigen::Matrix3Xd slopes;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // of the reference cell, which may be a simplex
  double weights = 0;
  for (std::size_t q = 0; q < block.kind->points.size(); ++q) {
    centre += block.kind->weights[q] * block.kind->points[q];
    weights += block.kind->weights[q];
  }
  block.kind->evaluate(centre / weights, shapes, slopes);
  return rest_jacobian(block, element, rest_nodes, slopes).inverse().transpose() * slopes;
}

Eigen::MatrixXd element_stiffness(const ElementBlock& block, std::size_t element,
                                  const Eigen::Matrix3Xd& rest_nodes, Formulation formulation) {
  const ElementKind& kind = *block.kind;
  if (&kind != &trilinear_hexahedron()) formulation = Formulation::plain;
  const bool bubbles = formulation == Formulation::incompatible_modes, mean = formulation == Formulation::b_bar;
  const Eigen::Index nodes = kind.node_count, modes = nodes + (bubbles ? 3 : 0);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(3 * modes, 3 * modes);
  Eigen::Matrix3Xd mean_gradients = Eigen::Matrix3Xd::Zero(3, nodes), g(3, modes);
  double mean_bulk = 0, volume = 0;
  Eigen::Matrix3d centre = Eigen::Matrix3d::Zero();  // det J₀ J₀⁻ᵀ
  if (bubbles) {
    Eigen::VectorXd shapes;
    Eigen::Matrix3Xd slopes;
    kind.evaluate(Eigen::Vector3d::Constant(0.5), shapes, slopes);
    const Eigen::Matrix3d jacobian = rest_jacobian(block, element, rest_nodes, slopes);
    centre = jacobian.determinant() * jacobian.inverse().transpose();
  }
  for (int q = 0; q < kind.point_count; ++q) {
    const std::size_t i = block.point_index(element, q);
    const double* slopes = kind.gradients.data() + 3 * q * nodes;
    for (Eigen::Index a = 0; a < nodes; ++a)
      g.col(a) = block.inverse_rest_jacobians[i].transpose() *
                 Eigen::Vector3d(slopes[3 * a], slopes[3 * a + 1], slopes[3 * a + 2]);
    const double v = block.volumes[i];
    if (bubbles) {
      const double determinant = v / kind.weights[static_cast<std::size_t>(q)];
      for (int axis = 0; axis < 3; ++axis)  // of the bubble 4 u (1 − u)
        g.col(nodes + axis) =
            centre.col(axis) * (4 * (1 - 2 * kind.points[static_cast<std::size_t>(q)][axis]) / determinant);
    }
    const double mu = block.mu[i], lambda = block.lambda[i];
    add_elastic(stiffness, g, mu, mean ? -2.0 / 3 * mu : lambda, v);
    mean_gradients += v * g.leftCols(nodes);
    mean_bulk += v * (lambda + 2.0 / 3 * mu);
    volume += v;
  }
  if (mean) add_elastic(stiffness, mean_gradients, 0.0, mean_bulk / volume, 1 / volume);
  if (bubbles) {
    const Eigen::Index n = 3 * nodes;
    const Eigen::LLT<Eigen::MatrixXd> inner(stiffness.bottomRightCorner(9, 9));
    Eigen::MatrixXd condensed = stiffness.topLeftCorner(n, n);
    if (inner.info() == Eigen::Success)  // else there is no material
      condensed -= stiffness.topRightCorner(n, 9) * inner.solve(stiffness.bottomLeftCorner(9, n));
    stiffness = condensed;
  }
  return 0.5 * (stiffness + stiffness.transpose());
}

namespace {

/// These elements as a block of their own, with what stiffness depends on.
ElementBlock some_elements(const ElementBlock& block, const std::vector<std::uint32_t>& elements) {
  const auto nodes = static_cast<std::size_t>(block.kind->node_count);
  const auto points = static_cast<std::size_t>(block.kind->point_count);
  ElementBlock result;
  result.kind = block.kind;
  const auto append = [](auto& to, const auto& from, std::size_t element, std::size_t count) {
    const auto begin = from.begin() + static_cast<std::ptrdiff_t>(element * count);
    to.insert(to.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
  };
  for (const std::uint32_t e : elements) {
    append(result.nodes, block.nodes, e, nodes);
    append(result.origins, block.origins, e, 1);
    append(result.inverse_rest_jacobians, block.inverse_rest_jacobians, e, points);
    append(result.volumes, block.volumes, e, points);
    append(result.mu, block.mu, e, points);
    append(result.lambda, block.lambda, e, points);
  }
  return result;
}

FillMatrices fill_elastic(const Eigen::Matrix3Xd& rest_nodes, Formulation formulation) {
  return [&rest_nodes, formulation](const ElementBlock& distinct, double* matrices) {
    const auto size = 3 * static_cast<std::size_t>(distinct.kind->node_count);
    if (formulation == Formulation::incompatible_modes) {
      parallel_for(distinct.element_count(), 1, [&](std::size_t e) {
        const Eigen::MatrixXd k = element_stiffness(distinct, e, rest_nodes, formulation);
        std::copy(k.data(), k.data() + size * size, matrices + e * size * size);
      });
      return;
    }
    make_linear_as({&distinct, 1}, rest_nodes, formulation)
        ->tangent(rest_nodes, Projection::none)
        ->element_tangents([&](std::span<const std::uint32_t>, const Eigen::MatrixXd& k) {
          matrices = std::copy(k.data(), k.data() + size * size, matrices);
        });
  };
}

}  // namespace

ElementStiffness::ElementStiffness(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes,
                                   Formulation formulation)
    : ElementStiffness(blocks, rest_nodes, fill_elastic(rest_nodes, formulation)) {}

ElementStiffness::ElementStiffness(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes,
                                   const FillMatrices& fill)
    : blocks_(blocks), shared_(blocks.size()) {
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const ElementBlock& block = blocks[b];
    Shared& shared = shared_[b];
    shared.size = 3 * static_cast<std::size_t>(block.kind->node_count);
    shared.mu = block.mu;
    shared.lambda = block.lambda;
    std::vector<std::string> keys(block.element_count());
    parallel_for(keys.size(), 64, [&](std::size_t e) { keys[e] = congruence_key(block, e, rest_nodes); });
    std::unordered_map<std::string, std::uint32_t> numbers;
    for (std::size_t e = 0; e < keys.size(); ++e) {
      const auto [found, is_new] =
          numbers.try_emplace(std::move(keys[e]), static_cast<std::uint32_t>(shared.representatives.size()));
      if (is_new) shared.representatives.push_back(static_cast<std::uint32_t>(e));
      shared.index.push_back(found->second);
    }
    shared.matrices.resize(shared.representatives.size() * shared.size * shared.size);
    fill(some_elements(block, shared.representatives), shared.matrices.data());
  }
}

bool ElementStiffness::is_current() const {
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    if (blocks_[b].mu != shared_[b].mu || blocks_[b].lambda != shared_[b].lambda) return false;
  return true;
}

namespace {

ARGIL_LANES_INLINE Lanes load_four(const double* from) {
  Lanes x;
  std::memcpy(&x, from, sizeof x);
  return x;
}
ARGIL_LANES_INLINE void store_four(double* to, const Lanes& x) {
  std::memcpy(to, &x, sizeof x);
}

/// Nothing is reduced across lanes: each row sums its columns in order. Small matrices go eight rows at a time,
/// with the sums in registers; large ones, which come from memory, column after column, so that they are read from
/// end to end without a jump.
ARGIL_LANES_INLINE void multiply_rows(const double* matrix, std::size_t size, const double* v, double* result) {
  std::size_t row = 0;
  const std::size_t whole = size / 8 * 8;
  if (size <= 32) {
    for (; row < whole; row += 8) {
      Lanes low = broadcast(0), high = broadcast(0);
      for (std::size_t j = 0; j < size; ++j) {
        low += load_four(matrix + j * size + row) * v[j];
        high += load_four(matrix + j * size + row + 4) * v[j];
      }
      store_four(result + row, low);
      store_four(result + row + 4, high);
    }
  } else {
    for (std::size_t i = 0; i < whole; ++i) result[i] = 0;
    for (std::size_t j = 0; j < size; ++j) {
      const double* column = matrix + j * size;
      for (row = 0; row < whole; row += 8) {
        store_four(result + row, load_four(result + row) + load_four(column + row) * v[j]);
        store_four(result + row + 4, load_four(result + row + 4) + load_four(column + row + 4) * v[j]);
      }
    }
  }
  for (row = whole; row < size; ++row) {
    double sum = 0;
    for (std::size_t j = 0; j < size; ++j) sum += matrix[j * size + row] * v[j];
    result[row] = sum;
  }
}

struct Multiply {
  template <class>
  static ARGIL_LANES_INLINE void run(const double* matrix, std::size_t size, const double* v, double* result) {
    multiply_rows(matrix, size, v, result);
  }
};

template <std::size_t Rows>
ARGIL_LANES_INLINE void multiply_some_rows(const double* matrix, std::size_t size, const FourDoubles* v,
                                           FourDoubles* result) {
  Lanes sums[Rows];
#pragma GCC unroll 6
  for (std::size_t i = 0; i < Rows; ++i) sums[i] = broadcast(0);
  for (std::size_t j = 0; j < size; ++j) {
    const Lanes value = load(v + j);
#pragma GCC unroll 6
    for (std::size_t i = 0; i < Rows; ++i) sums[i] += matrix[j * size + i] * value;
  }
#pragma GCC unroll 6
  for (std::size_t i = 0; i < Rows; ++i) store(result + i, sums[i]);
}
/// Six rows at a time, with the sums in registers.
ARGIL_LANES_INLINE void multiply_four(const double* matrix, std::size_t size, const FourDoubles* v,
                                      FourDoubles* result) {
  std::size_t row = 0;
  for (; row + 6 <= size; row += 6) multiply_some_rows<6>(matrix + row, size, v, result + row);
  for (; row < size; ++row) multiply_some_rows<1>(matrix + row, size, v, result + row);
}
struct MultiplyFour {
  template <class>
  static ARGIL_LANES_INLINE void run(const double* matrix, std::size_t size, const FourDoubles* v,
                                     FourDoubles* result) {
    multiply_four(matrix, size, v, result);
  }
};

}  // namespace

void multiply_stiffness(const double* matrix, std::size_t size, const double* v, double* result) {
  static const auto chosen = kernel_variant<Multiply, const double*, std::size_t, const double*, double*>();
  chosen(matrix, size, v, result);
}

void multiply_stiffness_of_four(const double* matrix, std::size_t size, const FourDoubles* v, FourDoubles* result) {
  static const auto chosen =
      kernel_variant<MultiplyFour, const double*, std::size_t, const FourDoubles*, FourDoubles*>();
  chosen(matrix, size, v, result);
}

}  // namespace argil::fem
