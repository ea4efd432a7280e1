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

  const std::uint32_t* nodes(std::size_t b, std::size_t element) const {
    return blocks[b].nodes.data() + element * static_cast<std::size_t>(blocks[b].kind->node_count);
  }

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

ARGIL_LANES_INLINE void write(const Eigen::Vector3d& value, const Eigen::Matrix3d* rotation, double sign,
                              double* slot) {
  const Eigen::Vector3d turned = rotation ? Eigen::Vector3d(*rotation * value) : value;
  for (int i = 0; i < 3; ++i) slot[i] = sign * turned[i];
}

/// Slots of all elements = sign · R K Rᵀ v, where local(block, element, node) is Rᵀ v. Four neighbours that are
/// congruent are multiplied side by side, which gives the same bits.
template <class Local>
void multiply_elements(const Elements& elements, const ElementStiffness& stiffness, const Rotations& rotations,
                       double sign, const Local& local, double* slots) {
  for (std::size_t b = 0; b < elements.blocks.size(); ++b) {
    const ElementBlock& block = elements.blocks[b];
    const auto nodes = static_cast<std::size_t>(block.kind->node_count);
    const std::size_t count = block.element_count();
    const auto rotation = [&](std::size_t e) { return rotations.empty() ? nullptr : &rotations[b][e]; };
    parallel_for((count + k_lanes - 1) / k_lanes, 16, [&](std::size_t packet) {
      const std::size_t first = packet * k_lanes, last = std::min(first + k_lanes, count);
      bool congruent = last - first == k_lanes;
      for (std::size_t e = first + 1; e < last; ++e)
        congruent = congruent && stiffness.index(b, e) == stiffness.index(b, first);
      FourDoubles v[k_most_entries], product[k_most_entries];
      if (congruent) {
        for (std::size_t a = 0; a < nodes; ++a)
          for (std::size_t lane = 0; lane < k_lanes; ++lane) {
            const Eigen::Vector3d value = local(b, first + lane, a);
            for (std::size_t i = 0; i < 3; ++i) v[3 * a + i].values[lane] = value[static_cast<int>(i)];
          }
        multiply_stiffness_of_four(stiffness.matrix(b, first), 3 * nodes, v, product);
        for (std::size_t lane = 0; lane < k_lanes; ++lane)
          for (std::size_t a = 0; a < nodes; ++a)
            write({product[3 * a].values[lane], product[3 * a + 1].values[lane], product[3 * a + 2].values[lane]},
                  rotation(first + lane), sign, slots + 3 * (elements.sums.slot(b, first + lane) + a));
        return;
      }
      double *one = v[0].values, *result = product[0].values;
      for (std::size_t e = first; e < last; ++e) {
        for (std::size_t a = 0; a < nodes; ++a) Eigen::Map<Eigen::Vector3d>(one + 3 * a) = local(b, e, a);
        multiply_stiffness(stiffness.matrix(b, e), 3 * nodes, one, result);
        for (std::size_t a = 0; a < nodes; ++a)
          write({result[3 * a], result[3 * a + 1], result[3 * a + 2]}, rotation(e), sign,
                slots + 3 * (elements.sums.slot(b, e) + a));
      }
    });
  }
}

class WarpedTangent final : public Tangent {
 public:
  WarpedTangent(std::shared_ptr<const Elements> elements, std::shared_ptr<const ElementStiffness> stiffness,
                Rotations rotations)
      : elements_(std::move(elements)), stiffness_(std::move(stiffness)), rotations_(std::move(rotations)) {}

  void stiffness_product(const Eigen::Matrix3Xd& dx, Eigen::Matrix3Xd& result) const override {
    slots_.resize(3 * elements_->sums.slot_count());
    multiply_elements(
        *elements_, *stiffness_, rotations_, 1.0,
        [&](std::size_t b, std::size_t e, std::size_t a) {
          const std::uint32_t* nodes = elements_->nodes(b, e);
          const Eigen::Vector3d d = dx.col(nodes[a]) - dx.col(nodes[0]);
          return rotations_.empty() ? d : Eigen::Vector3d(rotations_[b][e].transpose() * d);
        },
        slots_.data());
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
    multiply_elements(
        *elements_, *stiffness, turns, -1.0,
        [&](std::size_t b, std::size_t e, std::size_t a) {
          const std::uint32_t* nodes = elements_->nodes(b, e);
          Eigen::Vector3d now = x.col(nodes[a]) - x.col(nodes[0]);
          if (warped_) now = turns[b][e].transpose() * now;
          return Eigen::Vector3d(now - (rest.col(nodes[a]) - rest.col(nodes[0])));
        },
        slots_.data());
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
