#include "fem/models/warped_stiffness.h"

#include <algorithm>
#include <vector>

#include "fem/models/element_stiffness.h"
#include "fem/models/lane_polar.h"
#include "fem/models/node_sums.h"
#include "fem/parallel.h"

#pragma GCC diagnostic ignored "-Wpsabi"

namespace argil::fem {
namespace {

constexpr std::size_t k_most_entries = 192;

using Rotations = std::vector<std::vector<Eigen::Matrix3d>>;  // [block][element]; empty: none turn

/// What does not change with state or material.
struct Elements {
  Elements(std::span<const ElementBlock> b, const Eigen::Matrix3Xd& rest)
      : blocks(b), rest_nodes(rest), sums(b, static_cast<std::size_t>(rest.cols())) {}

  std::span<const ElementBlock> blocks;
  Eigen::Matrix3Xd rest_nodes;
  NodeSums sums;
  std::vector<std::vector<double>> gradients;  // [block][(element * nodes + node) * 3 + axis], at the centre
};

/// Calls body(block, element) for all elements in parallel.
template <class Body>
void for_elements(std::span<const ElementBlock> blocks, const Body& body) {
  for (std::size_t b = 0; b < blocks.size(); ++b)
    parallel_for(blocks[b].element_count(), 64, [&](std::size_t e) { body(b, e); });
}

/// slots = sign · R K Rᵀ v of each element, where local(node) is Rᵀ v there; returns through `slots`.
template <class Local>
void multiply_element(const ElementStiffness& stiffness, std::size_t b, std::size_t e,
                      const Eigen::Matrix3d* rotation, double sign, const Local& local, double* slots) {
  const auto nodes = static_cast<std::size_t>(stiffness.block(b).kind->node_count);
  double v[k_most_entries], product[k_most_entries];
  for (std::size_t a = 0; a < nodes; ++a) {
    const Eigen::Vector3d value = local(a);
    for (std::size_t i = 0; i < 3; ++i) v[3 * a + i] = value[static_cast<int>(i)];
  }
  multiply_stiffness(stiffness.matrix(b, e), 3 * nodes, v, product);
  for (std::size_t a = 0; a < nodes; ++a) {
    Eigen::Vector3d value(product[3 * a], product[3 * a + 1], product[3 * a + 2]);
    if (rotation) value = *rotation * value;
    for (std::size_t i = 0; i < 3; ++i) slots[3 * a + i] = sign * value[static_cast<int>(i)];
  }
}

class WarpedTangent final : public Tangent {
 public:
  WarpedTangent(std::shared_ptr<const Elements> elements, std::shared_ptr<const ElementStiffness> stiffness,
                Rotations rotations)
      : elements_(std::move(elements)), stiffness_(std::move(stiffness)), rotations_(std::move(rotations)) {}

  void stiffness_product(const Eigen::Matrix3Xd& dx, Eigen::Matrix3Xd& result) const override {
    slots_.resize(3 * elements_->sums.slot_count());
    for_elements(elements_->blocks, [&](std::size_t b, std::size_t e) {
      const ElementBlock& block = elements_->blocks[b];
      const std::uint32_t* nodes = block.nodes.data() + e * static_cast<std::size_t>(block.kind->node_count);
      const Eigen::Matrix3d* rotation = rotations_.empty() ? nullptr : &rotations_[b][e];
      const Eigen::Vector3d first = dx.col(nodes[0]);
      multiply_element(
          *stiffness_, b, e, rotation, 1.0,
          [&](std::size_t a) {
            const Eigen::Vector3d d = dx.col(nodes[a]) - first;
            return rotation ? Eigen::Vector3d(rotation->transpose() * d) : d;
          },
          slots_.data() + 3 * elements_->sums.slot(b, e));
    });
    elements_->sums.gather(slots_, result);
  }

  void element_tangents(const Visit& visit) const override {
    for (std::size_t b = 0; b < elements_->blocks.size(); ++b) {
      const ElementBlock& block = elements_->blocks[b];
      const auto nodes = static_cast<std::size_t>(block.kind->node_count);
      const auto size = static_cast<Eigen::Index>(3 * nodes);
      Eigen::MatrixXd turned(size, size);
      for (std::size_t e = 0; e < block.element_count(); ++e) {
        turned = Eigen::Map<const Eigen::MatrixXd>(stiffness_->matrix(b, e), size, size);
        if (!rotations_.empty()) {
          const Eigen::Matrix3d& r = rotations_[b][e];
          for (Eigen::Index i = 0; i < size; i += 3)
            for (Eigen::Index j = 0; j < size; j += 3) {
              const Eigen::Matrix3d k = turned.block<3, 3>(i, j);
              turned.block<3, 3>(i, j) = r * k * r.transpose();
            }
        }
        visit({block.nodes.data() + e * nodes, nodes}, turned);
      }
    }
  }

 private:
  std::shared_ptr<const Elements> elements_;
  std::shared_ptr<const ElementStiffness> stiffness_;
  Rotations rotations_;
  mutable std::vector<double> slots_;  // working memory: one call at a time
};

class WarpedStiffness final : public ForceModel {
 public:
  WarpedStiffness(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes, Formulation formulation,
                  bool warped)
      : formulation_(formulation), warped_(warped) {
    auto elements = std::make_shared<Elements>(blocks, rest_nodes);
    if (warped) {
      for (const ElementBlock& block : blocks) elements->gradients.emplace_back(3 * block.nodes.size());
      for_elements(blocks, [&](std::size_t b, std::size_t e) {
        const Eigen::Matrix3Xd g = centre_gradients(blocks[b], e, rest_nodes);
        std::copy(g.data(), g.data() + g.size(),
                  elements->gradients[b].data() + e * static_cast<std::size_t>(g.size()));
      });
    }
    elements_ = std::move(elements);
  }

  std::string_view name() const override { return warped_ ? "warped_stiffness" : "linear"; }
  Promises promises() const override {
    Promises promises;
    promises.conserves_momentum = false;  // linear: moments vanish at rest only
    if (warped_) {
      promises.has_energy = false;
      promises.exact_tangent = false;
    } else {
      promises.rotation_invariant = false;
      promises.largest_rotation = 0.05;
    }
    return promises;
  }

  double energy(const Eigen::Matrix3Xd& x) const override {
    Eigen::Matrix3Xd f;
    forces(x, f);
    const Eigen::Matrix3Xd& rest = elements_->rest_nodes;
    return -0.5 * parallel_sum(static_cast<std::size_t>(x.cols()), 1024, [&](std::size_t i) {
      const auto c = static_cast<Eigen::Index>(i);
      return (x(0, c) - rest(0, c)) * f(0, c) + (x(1, c) - rest(1, c)) * f(1, c) + (x(2, c) - rest(2, c)) * f(2, c);
    });
  }

  void forces(const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& forces) const override {
    const auto stiffness = current_stiffness();
    const Rotations turns = rotations(x);
    const Eigen::Matrix3Xd& rest = elements_->rest_nodes;
    slots_.resize(3 * elements_->sums.slot_count());
    for_elements(elements_->blocks, [&](std::size_t b, std::size_t e) {
      const ElementBlock& block = elements_->blocks[b];
      const std::uint32_t* nodes = block.nodes.data() + e * static_cast<std::size_t>(block.kind->node_count);
      const Eigen::Matrix3d* rotation = warped_ ? &turns[b][e] : nullptr;
      const Eigen::Vector3d first = x.col(nodes[0]), rest_first = rest.col(nodes[0]);
      multiply_element(
          *stiffness, b, e, rotation, -1.0,
          [&](std::size_t a) {
            Eigen::Vector3d now = x.col(nodes[a]) - first;
            if (rotation) now = rotation->transpose() * now;
            return Eigen::Vector3d(now - (rest.col(nodes[a]) - rest_first));
          },
          slots_.data() + 3 * elements_->sums.slot(b, e));
    });
    elements_->sums.gather(slots_, forces);
  }

  std::unique_ptr<Tangent> tangent(const Eigen::Matrix3Xd& x, Projection) const override {
    return std::make_unique<WarpedTangent>(elements_, current_stiffness(), rotations(x));
  }

 private:
  std::shared_ptr<const ElementStiffness> current_stiffness() const {
    if (!stiffness_ || !stiffness_->is_current())
      stiffness_ = std::make_shared<ElementStiffness>(elements_->blocks, elements_->rest_nodes, formulation_);
    return stiffness_;
  }

  /// Four elements at a time.
  Rotations rotations(const Eigen::Matrix3Xd& x) const {
    Rotations result;
    if (!warped_) return result;
    for (std::size_t b = 0; b < elements_->blocks.size(); ++b) {
      const ElementBlock& block = elements_->blocks[b];
      const std::size_t count = block.element_count();
      std::vector<Eigen::Matrix3d>& turns = result.emplace_back(count);
      parallel_for((count + k_lanes - 1) / k_lanes, 16, [&](std::size_t packet) {
        LaneMatrix f, rotation;
        for (std::size_t lane = 0; lane < k_lanes; ++lane) {
          const Eigen::Matrix3d gradient = centre_gradient(b, std::min(packet * k_lanes + lane, count - 1), x);
          for (int i = 0; i < 9; ++i) f.m[i][lane] = gradient(i / 3, i % 3);
        }
        nearest_rotation(f, rotation, [](const LaneMatrix& m, LaneSvd& svd) { signed_svd(m, svd); });
        for (std::size_t e = packet * k_lanes; e < std::min((packet + 1) * k_lanes, count); ++e)
          for (int i = 0; i < 9; ++i) turns[e](i / 3, i % 3) = rotation.m[i][e % k_lanes];
      });
    }
    return result;
  }

  Eigen::Matrix3d centre_gradient(std::size_t b, std::size_t element, const Eigen::Matrix3Xd& x) const {
    const ElementBlock& block = elements_->blocks[b];
    const auto nodes = static_cast<std::size_t>(block.kind->node_count);
    const std::uint32_t* n = block.nodes.data() + element * nodes;
    const double* g = elements_->gradients[b].data() + 3 * element * nodes;
    Eigen::Matrix3d f = Eigen::Matrix3d::Zero();
    for (std::size_t a = 1; a < nodes; ++a) {
      const Eigen::Vector3d d = x.col(n[a]) - x.col(n[0]);
      for (std::size_t j = 0; j < 3; ++j) f.col(static_cast<Eigen::Index>(j)) += d * g[3 * a + j];
    }
    return f;
  }

  Formulation formulation_;
  bool warped_;
  std::shared_ptr<const Elements> elements_;
  // Working memory: one call at a time.
  mutable std::shared_ptr<const ElementStiffness> stiffness_;
  mutable std::vector<double> slots_;
};

}  // namespace

std::unique_ptr<ForceModel> make_warped_stiffness(std::span<const ElementBlock> blocks,
                                                  const Eigen::Matrix3Xd& rest_nodes, Formulation formulation) {
  return std::make_unique<WarpedStiffness>(blocks, rest_nodes, formulation, true);
}
std::unique_ptr<ForceModel> make_linear_by_matrices(std::span<const ElementBlock> blocks,
                                                    const Eigen::Matrix3Xd& rest_nodes, Formulation formulation) {
  return std::make_unique<WarpedStiffness>(blocks, rest_nodes, formulation, false);
}

}  // namespace argil::fem
