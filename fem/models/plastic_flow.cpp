#include "fem/models/plastic_flow.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "fem/models/prestress.h"
#include "fem/parallel.h"
#include "subdiv/error.h"

namespace argil::fem {

namespace {

/// ∂x/∂(u, v, w) of the nodes at a point.
Eigen::Matrix3d node_gradient(const ElementBlock& block, std::size_t element, int q, const Eigen::Matrix3Xd& x) {
  const auto n = static_cast<std::size_t>(block.kind->node_count);
  const std::uint32_t* nodes = block.nodes.data() + element * n;
  const double* slopes = block.kind->gradients.data() + 3 * static_cast<std::size_t>(q) * n;
  Eigen::Matrix3d result = Eigen::Matrix3d::Zero();
  for (std::size_t a = 0; a < n; ++a)
    for (int axis = 0; axis < 3; ++axis)
      result.col(axis) += slopes[3 * a + static_cast<std::size_t>(axis)] * x.col(nodes[a]);
  return result;
}

struct Logarithm {
  Eigen::Vector3d deviator;  // of the principal logarithmic strains
  Eigen::Matrix3d axes;
};

/// Of a symmetric positive definite matrix's root: half the logarithm, its trace taken off.
Logarithm deviator_of(const Eigen::Matrix3d& square) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.compute(square);  // the iterative solver: the closed formula is not exact near equal values
  Logarithm result;
  result.axes = solver.eigenvectors();
  double mean = 0;
  for (int i = 0; i < 3; ++i) {
    result.deviator[i] = 0.5 * std::log(solver.eigenvalues()[i]);
    mean += result.deviator[i] / 3;
  }
  for (int i = 0; i < 3; ++i) result.deviator[i] -= mean;
  return result;
}

double size_of(const Eigen::Vector3d& v) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

struct PointFlow {
  double strain = 0, dissipated = 0;  // dissipated per volume
};

/// `share` of the excess over the yield stress stays.
PointFlow flow_at(const Eigen::Matrix3d& gradient, double mu, double yield, double share,
                  Eigen::Matrix3d& inverse) {
  const Eigen::Matrix3d elastic = gradient * inverse;
  if (!(mu > 0) || !(elastic.determinant() > 0)) return {};
  const Logarithm strain = deviator_of(elastic.transpose() * elastic);
  const double length = size_of(strain.deviator);
  const double stress = std::sqrt(1.5) * 2 * mu * length;
  if (!std::isfinite(stress) || stress <= yield) return {};
  const double kept = (yield + share * (stress - yield)) / stress;
  // F_e and with it F_p⁻¹ are stretched by exp(−(1 − kept) dev ε) from the right.
  Eigen::Matrix3d stretch = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 3; ++i)
    stretch += std::exp((kept - 1) * strain.deviator[i]) * strain.axes.col(i) * strain.axes.col(i).transpose();
  inverse = inverse * stretch;
  // Rounding must not add up to a change of volume.
  inverse /= std::cbrt(inverse.determinant());
  return {std::sqrt(2.0 / 3) * (1 - kept) * length, mu * length * length * (1 - kept * kept)};
}

/// The inner model and the blocks that it was made of, their rest Jacobians those of the body that flowed.
class Flowed final : public ForceModel {
 public:
  Flowed(const ModelKind& kind, Formulation formulation, std::span<const ElementBlock> blocks,
         const Eigen::Matrix3Xd& rest_nodes, const PlasticFlow& state)
      : blocks_(blocks.begin(), blocks.end()) {
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      blocks_[b].prestress.clear();
      auto& jacobians = blocks_[b].inverse_rest_jacobians;
      parallel_for(jacobians.size(), 1024,
                   [&](std::size_t i) { jacobians[i] = jacobians[i] * state.inverse[b][i]; });
    }
    model_ = kind.make(blocks_, rest_nodes, formulation);
  }

  std::string_view name() const override { return model_->name(); }
  Promises promises() const override {
    Promises promises = model_->promises();
    promises.rest_tangent_is_linear = false;
    return promises;
  }
  double energy(const Eigen::Matrix3Xd& x) const override { return model_->energy(x); }
  void forces(const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& forces) const override { model_->forces(x, forces); }
  std::unique_ptr<Tangent> tangent(const Eigen::Matrix3Xd& x, Projection projection) const override {
    return model_->tangent(x, projection);
  }
  void velocity_forces(const Eigen::Matrix3Xd& x, const Eigen::Matrix3Xd& v,
                       Eigen::Matrix3Xd& forces) const override {
    model_->velocity_forces(x, v, forces);
  }

 private:
  std::vector<ElementBlock> blocks_;
  std::unique_ptr<ForceModel> model_;
};

}  // namespace

bool fits(const PlasticFlow& state, std::span<const ElementBlock> blocks) {
  if (state.inverse.size() != blocks.size()) return false;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    if (state.inverse[b].size() != blocks[b].volumes.size()) return false;
  return true;
}

FlowReport flow(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& nodes, const FlowLaw& law,
                double time_step, PlasticFlow& state) {
  const double share = law.relaxation > 0 ? std::exp(-time_step / law.relaxation) : 0;
  PlasticFlow next;
  if (fits(state, blocks))
    next = state;
  else
    for (const ElementBlock& block : blocks)
      next.inverse.emplace_back(block.volumes.size(), Eigen::Matrix3d::Identity());
  FlowReport report;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const ElementBlock& block = blocks[b];
    std::vector<PointFlow> flowed(block.volumes.size());
    parallel_for(block.element_count(), 64, [&](std::size_t e) {
      for (int q = 0; q < block.kind->point_count; ++q) {
        const std::size_t i = block.point_index(e, q);
        const Eigen::Matrix3d gradient = node_gradient(block, e, q, nodes) * block.inverse_rest_jacobians[i];
        flowed[i] = flow_at(gradient, block.mu[i], law.yield, share, next.inverse[b][i]);
      }
    });
    for (std::size_t i = 0; i < flowed.size(); ++i) {
      if (flowed[i].strain == 0) continue;
      ++report.points;
      report.largest_strain = std::max(report.largest_strain, flowed[i].strain);
      report.dissipated += block.volumes[i] * flowed[i].dissipated;
    }
  }
  if (report.points > 0) state = std::move(next);
  return report;
}

void check_flow(const ModelChoice& choice) {
  std::string names;
  for (const ModelKind& kind : model_table()) {
    if (!kind.can_flow) continue;
    if (kind.name == choice.name) return;
    names += (names.empty() ? "" : ", ") + std::string(kind.name);
  }
  throw Error(
      ErrorCode::unsupported,
      fmt::format("the model {} has no strain at its points that plastic flow could relax; choose one of {}, "
                  "or turn the flow off with `plasticity off`",
                  choice.name, names));
}

std::unique_ptr<ForceModel> make_flowed_model(const ModelChoice& choice, std::span<const ElementBlock> blocks,
                                              const Eigen::Matrix3Xd& rest_nodes, const PlasticFlow& state,
                                              std::shared_ptr<const double> prestress_share) {
  check_model(choice);
  check_flow(choice);
  assert(state.empty() || fits(state, blocks));
  if (state.empty()) return make_model(choice, blocks, rest_nodes, std::move(prestress_share));
  auto model = std::make_unique<Flowed>(model_by_name(choice.name), choice.formulation, blocks, rest_nodes, state);
  for (const ElementBlock& block : blocks)
    if (!block.prestress.empty())
      return make_prestressed(std::move(model), blocks, rest_nodes, {}, std::move(prestress_share));
  return model;
}

std::vector<std::vector<double>> plastic_strain(const PlasticFlow& state) {
  std::vector<std::vector<double>> result;
  for (const auto& inverse : state.inverse) {
    auto& strains = result.emplace_back(inverse.size());
    parallel_for(inverse.size(), 256, [&](std::size_t i) {
      strains[i] = std::sqrt(2.0 / 3) * size_of(deviator_of(inverse[i].transpose() * inverse[i]).deviator);
    });
  }
  return result;
}

}  // namespace argil::fem
