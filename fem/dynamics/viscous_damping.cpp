#include "fem/dynamics/viscous_damping.h"

#include "fem/parallel.h"

namespace argil::fem {

namespace {

constexpr std::size_t k_chunk = 32;  // elements

/// Σ x_a ∇_aᵀ of one element at a point, 3x3, with respect to (u, v, w).
Eigen::Matrix3d node_gradient(const ElementKind& kind, int point, const std::uint32_t* nodes,
                              const Eigen::Matrix3Xd& x) {
  Eigen::Matrix3d result = Eigen::Matrix3d::Zero();
  const double* gradient = kind.gradients.data() + static_cast<std::ptrdiff_t>(point) * kind.node_count * 3;
  for (int a = 0; a < kind.node_count; ++a, gradient += 3)
    for (int axis = 0; axis < 3; ++axis) result.col(axis) += gradient[axis] * x.col(nodes[a]);
  return result;
}

}  // namespace

ViscousDamping::ViscousDamping(std::span<const ElementBlock> blocks, std::size_t node_count) {
  std::size_t slot_count = 0, point_count = 0;
  std::vector<std::size_t> count(node_count + 1, 0);
  for (const ElementBlock& block : blocks) {
    if (block.stiffness_damping.empty() || block.element_count() == 0) continue;
    parts_.push_back({&block, slot_count, point_count});
    slot_count += block.nodes.size();
    point_count += block.volumes.size();
    for (const std::uint32_t node : block.nodes) ++count[node + 1];
  }
  if (parts_.empty()) return;
  for (std::size_t n = 0; n < node_count; ++n) count[n + 1] += count[n];
  slots_begin_ = count;
  slots_.resize(slot_count);
  std::size_t slot = 0;
  for (const Part& part : parts_)
    for (const std::uint32_t node : part.block->nodes) slots_[count[node]++] = slot++;
  gradients_.resize(point_count);
  forces_.resize(3, static_cast<Eigen::Index>(slot_count));
}

void ViscousDamping::set_state(const Eigen::Matrix3Xd& x) {
  for (const Part& part : parts_) {
    const ElementKind& kind = *part.block->kind;
    const auto n = static_cast<std::size_t>(kind.node_count);
    parallel_for(part.block->element_count(), k_chunk, [&](std::size_t e) {
      for (int q = 0; q < kind.point_count; ++q) {
        const std::size_t i = part.block->point_index(e, q);
        gradients_[part.point_begin + i] =
            node_gradient(kind, q, part.block->nodes.data() + e * n, x) * part.block->inverse_rest_jacobians[i];
      }
    });
  }
}

void ViscousDamping::product(const Eigen::Matrix3Xd& v, Eigen::Matrix3Xd& result) const {
  for (const Part& part : parts_) {
    const ElementBlock& block = *part.block;
    const ElementKind& kind = *block.kind;
    const auto n = static_cast<std::size_t>(kind.node_count);
    parallel_for(block.element_count(), k_chunk, [&](std::size_t e) {
      double* slots = forces_.data() + 3 * (part.slot_begin + e * n);
      std::fill(slots, slots + 3 * n, 0.0);
      for (int q = 0; q < kind.point_count; ++q) {
        const std::size_t i = block.point_index(e, q);
        const double share = block.stiffness_damping[i] * block.volumes[i];
        if (share == 0) continue;
        const Eigen::Matrix3d& f = gradients_[part.point_begin + i];
        const Eigen::Matrix3d& jacobian = block.inverse_rest_jacobians[i];
        const Eigen::Matrix3d rate =
            f.transpose() * (node_gradient(kind, q, block.nodes.data() + e * n, v) * jacobian);
        Eigen::Matrix3d stress = share * block.mu[i] * (rate + rate.transpose());
        stress.diagonal().array() += share * block.lambda[i] * (rate(0, 0) + rate(1, 1) + rate(2, 2));
        const Eigen::Matrix3d force = f * stress * jacobian.transpose();
        const double* gradient = kind.gradients.data() + static_cast<std::size_t>(q) * n * 3;
        for (std::size_t a = 0; a < n; ++a, gradient += 3)
          for (Eigen::Index r = 0; r < 3; ++r)
            slots[3 * a + static_cast<std::size_t>(r)] +=
                force(r, 0) * gradient[0] + force(r, 1) * gradient[1] + force(r, 2) * gradient[2];
      }
    });
  }
  result.resize(3, v.cols());
  parallel_for(static_cast<std::size_t>(v.cols()), 256, [&](std::size_t node) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t s = slots_begin_[node]; s < slots_begin_[node + 1]; ++s)
      sum += forces_.col(static_cast<Eigen::Index>(slots_[s]));
    result.col(static_cast<Eigen::Index>(node)) = sum;
  });
}

void ViscousDamping::element_matrices(const Tangent::Visit& visit) const {
  Eigen::MatrixXd matrix;
  for (const Part& part : parts_) {
    const ElementBlock& block = *part.block;
    const ElementKind& kind = *block.kind;
    const Eigen::Index n = kind.node_count;
    for (std::size_t e = 0; e < block.element_count(); ++e) {
      matrix.setZero(3 * n, 3 * n);
      for (int q = 0; q < kind.point_count; ++q) {
        const std::size_t i = block.point_index(e, q);
        const double share = block.stiffness_damping[i] * block.volumes[i];
        const Eigen::Map<const Eigen::Matrix3Xd> shapes(
            kind.gradients.data() + static_cast<std::ptrdiff_t>(q) * n * 3, 3, n);
        const Eigen::Matrix3Xd g = block.inverse_rest_jacobians[i].transpose() * shapes;
        for (Eigen::Index b = 0; b < n; ++b)
          for (Eigen::Index a = 0; a < n; ++a) {
            Eigen::Matrix3d entry = share * block.mu[i] * (g.col(b) * g.col(a).transpose());
            entry += share * block.lambda[i] * (g.col(a) * g.col(b).transpose());
            entry.diagonal().array() +=
                share * block.mu[i] * (g(0, a) * g(0, b) + g(1, a) * g(1, b) + g(2, a) * g(2, b));
            matrix.block<3, 3>(3 * a, 3 * b) += entry;
          }
      }
      const auto count = static_cast<std::size_t>(n);
      visit({block.nodes.data() + e * count, count}, matrix);
    }
  }
}

}  // namespace argil::fem
