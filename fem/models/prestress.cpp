#include "fem/models/prestress.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "fem/models/node_sums.h"
#include "fem/parallel.h"

namespace argil::fem {
namespace {

struct Prestress {
  Prestress(std::span<const ElementBlock> b, std::size_t node_count, InitialStresses s,
            std::shared_ptr<const double> acting)
      : blocks(b), sums(b, node_count), given(std::move(s)), share(std::move(acting)) {
    given.resize(b.size());
  }

  /// Volume times stress at a point.
  Eigen::Matrix3d at(std::size_t b, std::size_t point) const {
    const ElementBlock& block = blocks[b];
    const double volume = share ? *share * block.volumes[point] : block.volumes[point];
    if (!given[b].empty()) return volume * given[b][point];
    if (block.prestress.empty()) return Eigen::Matrix3d::Zero();
    return volume * block.prestress[point] * Eigen::Matrix3d::Identity();
  }

  std::span<const ElementBlock> blocks;
  NodeSums sums;
  InitialStresses given;
  std::shared_ptr<const double> share;  // null: 1
};

/// ∂/∂X of the nodes' shape functions at a point.
Eigen::Matrix3Xd gradients(const ElementBlock& block, std::size_t element, int q) {
  const Eigen::Index n = block.kind->node_count;
  Eigen::Matrix3Xd result(3, n);
  const Eigen::Matrix3d transposed = block.inverse_rest_jacobians[block.point_index(element, q)].transpose();
  const double* slopes = block.kind->gradients.data() + 3 * q * n;
  for (Eigen::Index a = 0; a < n; ++a)
    result.col(a) = transposed * Eigen::Vector3d(slopes[3 * a], slopes[3 * a + 1], slopes[3 * a + 2]);
  return result;
}

Eigen::Matrix3d gradient(const ElementBlock& block, std::size_t element, const Eigen::Matrix3Xd& g,
                         const Eigen::Matrix3Xd& x) {
  const std::uint32_t* nodes = block.nodes.data() + element * static_cast<std::size_t>(g.cols());
  Eigen::Matrix3d f = Eigen::Matrix3d::Zero();
  for (Eigen::Index a = 1; a < g.cols(); ++a) {
    const Eigen::Vector3d d = x.col(nodes[a]) - x.col(nodes[0]);
    for (int j = 0; j < 3; ++j) f.col(j) += d * g(j, a);
  }
  return f;
}

/// Adds sign Σ_q F S_q ∇N_a over the points, S times the volume, to `result`.
template <class StressAt>
void add_product(const Prestress& prestress, const Eigen::Matrix3Xd& x, double sign, const StressAt& stress_at,
                 std::vector<double>& slots, Eigen::Matrix3Xd& result) {
  slots.assign(3 * prestress.sums.slot_count(), 0.0);
  for (std::size_t b = 0; b < prestress.blocks.size(); ++b) {
    const ElementBlock& block = prestress.blocks[b];
    parallel_for(block.element_count(), 32, [&](std::size_t e) {
      double* to = slots.data() + 3 * prestress.sums.slot(b, e);
      for (int q = 0; q < block.kind->point_count; ++q) {
        const Eigen::Matrix3Xd g = gradients(block, e, q);
        const Eigen::Matrix3d stress = gradient(block, e, g, x) * stress_at(b, block.point_index(e, q));
        for (Eigen::Index a = 0; a < g.cols(); ++a)
          for (int i = 0; i < 3; ++i)
            to[3 * a + i] += sign * (stress(i, 0) * g(0, a) + stress(i, 1) * g(1, a) + stress(i, 2) * g(2, a));
      }
    });
  }
  Eigen::Matrix3Xd sum;
  prestress.sums.gather(slots, sum);
  result += sum;
}

class PrestressedTangent final : public Tangent {
 public:
  PrestressedTangent(std::unique_ptr<Tangent> elastic, std::shared_ptr<const Prestress> prestress,
                     Projection projection)
      : elastic_(std::move(elastic)), prestress_(std::move(prestress)) {
    for (std::size_t b = 0; b < prestress_->blocks.size(); ++b) {
      auto& stresses = stresses_.emplace_back(prestress_->blocks[b].volumes.size());
      parallel_for(stresses.size(), 256, [&](std::size_t i) {
        stresses[i] = prestress_->at(b, i);
        if (projection == Projection::none) return;
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(stresses[i]);
        const Eigen::Vector3d tension = solver.eigenvalues().cwiseMax(0.0);
        stresses[i] = solver.eigenvectors() * tension.asDiagonal() * solver.eigenvectors().transpose();
      });
    }
  }

  void stiffness_product(const Eigen::Matrix3Xd& dx, Eigen::Matrix3Xd& result) const override {
    elastic_->stiffness_product(dx, result);
    add_product(
        *prestress_, dx, 1.0,
        [&](std::size_t b, std::size_t i) -> const Eigen::Matrix3d& { return stresses_[b][i]; }, slots_, result);
  }

  /// The model visits in the order of blocks and elements where it has one matrix an element; what it visits
  /// otherwise is followed by the geometric stiffness on its own.
  void element_tangents(const Visit& visit) const override {
    std::size_t b = 0, e = 0;
    const auto skip_empty = [&] {
      while (b < prestress_->blocks.size() && e == prestress_->blocks[b].element_count()) ++b, e = 0;
    };
    Eigen::MatrixXd sum;
    elastic_->element_tangents([&](std::span<const std::uint32_t> nodes, const Eigen::MatrixXd& stiffness) {
      skip_empty();
      if (b < prestress_->blocks.size() && std::ranges::equal(nodes, nodes_of(b, e))) {
        sum = stiffness;
        add_geometric(b, e++, sum);
        visit(nodes, sum);
      } else {
        visit(nodes, stiffness);
      }
    });
    for (skip_empty(); b < prestress_->blocks.size(); skip_empty()) {
      const auto nodes = nodes_of(b, e);
      sum.setZero(static_cast<Eigen::Index>(3 * nodes.size()), static_cast<Eigen::Index>(3 * nodes.size()));
      add_geometric(b, e++, sum);
      visit(nodes, sum);
    }
  }

 private:
  std::span<const std::uint32_t> nodes_of(std::size_t b, std::size_t e) const {
    const ElementBlock& block = prestress_->blocks[b];
    const auto n = static_cast<std::size_t>(block.kind->node_count);
    return {block.nodes.data() + e * n, n};
  }
  void add_geometric(std::size_t b, std::size_t e, Eigen::MatrixXd& stiffness) const {
    const ElementBlock& block = prestress_->blocks[b];
    for (int q = 0; q < block.kind->point_count; ++q) {
      const Eigen::Matrix3Xd g = gradients(block, e, q);
      const Eigen::Matrix3d& s = stresses_[b][block.point_index(e, q)];
      for (Eigen::Index j = 0; j < g.cols(); ++j) {
        const Eigen::Vector3d along = s * g.col(j);
        for (Eigen::Index i = 0; i < g.cols(); ++i) {
          const double k = g(0, i) * along[0] + g(1, i) * along[1] + g(2, i) * along[2];
          for (int axis = 0; axis < 3; ++axis) stiffness(3 * i + axis, 3 * j + axis) += k;
        }
      }
    }
  }

  std::unique_ptr<Tangent> elastic_;
  std::shared_ptr<const Prestress> prestress_;
  InitialStresses stresses_;  // times volume
  mutable std::vector<double> slots_;
};

class Prestressed final : public ForceModel {
 public:
  Prestressed(std::unique_ptr<ForceModel> model, std::span<const ElementBlock> blocks, std::size_t node_count,
              InitialStresses stresses, std::shared_ptr<const double> share)
      : model_(std::move(model)),
        prestress_(std::make_shared<Prestress>(blocks, node_count, std::move(stresses), std::move(share))) {}

  std::string_view name() const override { return model_->name(); }
  Promises promises() const override {
    Promises promises = model_->promises();
    promises.rest_tangent_is_linear = false;
    return promises;
  }

  double energy(const Eigen::Matrix3Xd& x) const override {
    double total = model_->energy(x);
    for (std::size_t b = 0; b < prestress_->blocks.size(); ++b) {
      const ElementBlock& block = prestress_->blocks[b];
      total += parallel_sum(block.element_count(), 32, [&](std::size_t e) {
        double sum = 0;
        for (int q = 0; q < block.kind->point_count; ++q) {
          const Eigen::Matrix3d f = gradient(block, e, gradients(block, e, q), x);
          const Eigen::Matrix3d strain = 0.5 * (f.transpose() * f - Eigen::Matrix3d::Identity());
          const Eigen::Matrix3d stress = prestress_->at(b, block.point_index(e, q));
          for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) sum += stress(i, j) * strain(i, j);
        }
        return sum;
      });
    }
    return total;
  }

  void forces(const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& forces) const override {
    model_->forces(x, forces);
    add_product(
        *prestress_, x, -1.0, [&](std::size_t b, std::size_t i) { return prestress_->at(b, i); }, slots_, forces);
  }

  std::unique_ptr<Tangent> tangent(const Eigen::Matrix3Xd& x, Projection projection) const override {
    return std::make_unique<PrestressedTangent>(model_->tangent(x, projection), prestress_, projection);
  }

  void velocity_forces(const Eigen::Matrix3Xd& x, const Eigen::Matrix3Xd& v,
                       Eigen::Matrix3Xd& forces) const override {
    model_->velocity_forces(x, v, forces);
  }

 private:
  std::unique_ptr<ForceModel> model_;
  std::shared_ptr<const Prestress> prestress_;
  mutable std::vector<double> slots_;  // working memory: one call at a time
};

}  // namespace

std::unique_ptr<ForceModel> make_prestressed(std::unique_ptr<ForceModel> model,
                                             std::span<const ElementBlock> blocks,
                                             const Eigen::Matrix3Xd& rest_nodes, InitialStresses stresses,
                                             std::shared_ptr<const double> share) {
  return std::make_unique<Prestressed>(std::move(model), blocks, static_cast<std::size_t>(rest_nodes.cols()),
                                       std::move(stresses), std::move(share));
}

}  // namespace argil::fem
