#include "fem/models/local_frame.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>

#include "fem/models/local_frame_operator.h"
#include "fem/models/local_frame_store.h"
#include "fem/parallel.h"
#include "subdiv/error.h"

namespace argil::fem {
namespace {

/// One block: which nodes, what R compares with, K_e, and the gradients in the middle of the cell.
struct Part {
  const ElementKind* kind = nullptr;
  const LocalTopology* topology = nullptr;
  std::vector<std::uint32_t> nodes;
  std::vector<double> rest_measures;        // [element * measure_count]
  std::vector<Eigen::Matrix3Xd> gradients;  // [element], ∂N/∂X in the middle
  ElementMatrices matrices;
  std::size_t slot_begin = 0, element_begin = 0;

  std::size_t node_count() const { return static_cast<std::size_t>(kind->node_count); }
  std::size_t element_count() const { return nodes.size() / node_count(); }
  std::size_t measure_count() const { return topology->edges.size() + topology->corners.size(); }
};

/// A block as papers/004 integrates it: ∂x/∂u for the strain, over the unit cube.
ElementBlock in_cell_coordinates(const ElementBlock& block) {
  ElementBlock result = block;
  for (std::size_t e = 0; e < block.element_count(); ++e)
    for (int q = 0; q < block.kind->point_count; ++q) {
      const std::size_t i = block.point_index(e, q);
      result.inverse_rest_jacobians[i].setIdentity();
      result.volumes[i] = block.kind->weights[static_cast<std::size_t>(q)];
    }
  return result;
}

/// Equation 15: block (a, b) is diag over x of 2 Σ_s K(3a + s, 3b + x).
Eigen::MatrixXd printed_stiffness(const Eigen::MatrixXd& stiffness) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(stiffness.rows(), stiffness.cols());
  for (Eigen::Index a = 0; a < stiffness.rows(); a += 3)
    for (Eigen::Index column = 0; column < stiffness.cols(); ++column) {
      const Eigen::Index axis = column % 3;
      result(a + axis, column) = 2 * (stiffness(a, column) + stiffness(a + 1, column) + stiffness(a + 2, column));
    }
  return result;
}

/// Elements of all blocks and the sums over them, node by node in a fixed order.
class LocalFrames {
 public:
  LocalFrames(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes, bool literal)
      : node_count_(static_cast<std::size_t>(rest_nodes.cols())) {
    for (const ElementBlock& block : blocks) {
      Part part{block.kind, &local_topology(*block.kind),           block.nodes, {},
                {},         ElementMatrices(block.kind->node_count)};
      part.slot_begin = slot_count_;
      part.element_begin = element_count_;
      slot_count_ += block.nodes.size();
      element_count_ += block.element_count();
      measure(part, block, rest_nodes);
      fill_matrices(part, block, rest_nodes, literal);
      parts_.push_back(std::move(part));
    }
    list_slots();
  }

  std::span<const Part> parts() const { return parts_; }
  std::size_t slot_count() const { return slot_count_; }
  std::size_t element_count() const { return element_count_; }

  /// Calls body(part, element) for all elements, in parallel.
  template <class Body>
  void for_elements(const Body& body) const {
    for (const Part& part : parts_)
      parallel_for(part.element_count(), part.node_count() > 8 ? 1 : 32, [&](std::size_t e) { body(part, e); });
  }

  void gather(const std::vector<double>& slots, Eigen::Matrix3Xd& result) const {
    result.resize(3, static_cast<Eigen::Index>(node_count_));
    parallel_for(node_count_, 512, [&](std::size_t node) {
      double sum[3] = {0, 0, 0};
      for (std::size_t i = slots_begin_[node]; i < slots_begin_[node + 1]; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += slots[3 * slots_[i] + axis];
      for (int axis = 0; axis < 3; ++axis) result(axis, static_cast<Eigen::Index>(node)) = sum[axis];
    });
  }

 private:
  static void measure(Part& part, const ElementBlock& block, const Eigen::Matrix3Xd& rest_nodes) {
    const std::size_t n = part.node_count(), count = block.element_count();
    part.rest_measures.resize(count * part.measure_count());
    part.gradients.resize(count);
    Eigen::VectorXd shapes;
    Eigen::Matrix3Xd in_cell;
    block.kind->evaluate({0.5, 0.5, 0.5}, shapes, in_cell);
    parallel_for(count, 32, [&](std::size_t e) {
      std::vector<double> x(3 * n);
      Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
      for (std::size_t a = 0; a < n; ++a) {
        const Eigen::Vector3d at = rest_nodes.col(block.nodes[e * n + a]);
        for (int axis = 0; axis < 3; ++axis) {
          x[3 * a + static_cast<std::size_t>(axis)] = at[axis];
          jacobian.col(axis) += in_cell(axis, static_cast<Eigen::Index>(a)) * at;
        }
      }
      local_rest_measures(*part.topology, x.data(), part.rest_measures.data() + e * part.measure_count());
      part.gradients[e] = jacobian.inverse().transpose() * in_cell;
    });
  }

  static void fill_matrices(Part& part, const ElementBlock& block, const Eigen::Matrix3Xd& rest_nodes,
                            bool literal) {
    const ElementBlock printed = literal ? in_cell_coordinates(block) : ElementBlock{};
    const ElementBlock& integrated = literal ? printed : block;
    std::size_t element = 0;
    make_linear({&integrated, 1}, rest_nodes)
        ->tangent(rest_nodes, Projection::none)
        ->element_tangents([&](std::span<const std::uint32_t>, const Eigen::MatrixXd& stiffness) {
          part.matrices.append(ElementMatrices::congruence_key(block, element, rest_nodes),
                               literal ? printed_stiffness(stiffness) : stiffness);
          ++element;
        });
  }

  void list_slots() {
    slots_begin_.assign(node_count_ + 1, 0);
    for (const Part& part : parts_)
      for (const std::uint32_t node : part.nodes) ++slots_begin_[node + 1];
    for (std::size_t n = 0; n < node_count_; ++n) slots_begin_[n + 1] += slots_begin_[n];
    slots_.resize(slots_begin_.back());
    std::vector<std::size_t> next(slots_begin_.begin(), slots_begin_.end() - 1);
    for (const Part& part : parts_)
      for (std::size_t i = 0; i < part.nodes.size(); ++i) slots_[next[part.nodes[i]]++] = part.slot_begin + i;
  }

  std::vector<Part> parts_;
  std::size_t node_count_, slot_count_ = 0, element_count_ = 0;
  std::vector<std::size_t> slots_begin_, slots_;
};

/// The nodes of one element, at most 64.
struct Local {
  double values[192];
};
void take(const Part& part, std::size_t element, const Eigen::Matrix3Xd& x, Local& to) {
  const std::size_t n = part.node_count();
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t axis = 0; axis < 3; ++axis)
      to.values[3 * a + axis] = x(static_cast<Eigen::Index>(axis), part.nodes[element * n + a]);
}
void displacements(const Part& part, std::size_t element, const Eigen::Matrix3Xd& x, Local& result) {
  Local at;
  take(part, element, x, at);
  local_displacements(*part.topology, part.kind->node_count,
                      part.rest_measures.data() + element * part.measure_count(), at.values, result.values);
}
void turn(const Eigen::Matrix3d& by, std::size_t nodes, Local& values) {
  for (std::size_t a = 0; a < nodes; ++a) {
    const Eigen::Vector3d v =
        by * Eigen::Vector3d(values.values[3 * a], values.values[3 * a + 1], values.values[3 * a + 2]);
    for (int axis = 0; axis < 3; ++axis) values.values[3 * a + static_cast<std::size_t>(axis)] = v[axis];
  }
}

/// Rotation of F in the middle of the cell, det = +1.
Eigen::Matrix3d frame(const Part& part, std::size_t element, const Eigen::Matrix3Xd& x) {
  Eigen::Matrix3d f = Eigen::Matrix3d::Zero();
  const std::size_t n = part.node_count();
  for (std::size_t a = 0; a < n; ++a)
    f += x.col(part.nodes[element * n + a]) * part.gradients[element].col(static_cast<Eigen::Index>(a)).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) = -u.col(2);
  return u * svd.matrixV().transpose();
}

/// The elements with the material that the blocks have now: made anew where it was painted.
class CurrentFrames {
 public:
  CurrentFrames(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes, bool literal)
      : blocks_(blocks), rest_nodes_(rest_nodes), literal_(literal) {
    for (const ElementBlock& block : blocks)
      if (block.kind != &trilinear_hexahedron() && block.kind != &bspline_hexahedron() && block.kind != &pyramid())
        throw Error(
            ErrorCode::unsupported,
            fmt::format("the published local frame measures edges and angles of hexahedra and pyramids; a {} "
                        "has no such; choose another model",
                        block.kind->name));
    (void)get();
  }

  const std::shared_ptr<const LocalFrames>& get() {
    bool same = frames_ != nullptr;
    for (std::size_t b = 0; b < blocks_.size() && same; ++b)
      same = mu_[b] == blocks_[b].mu && lambda_[b] == blocks_[b].lambda;
    if (same) return frames_;
    mu_.clear();
    lambda_.clear();
    for (const ElementBlock& block : blocks_) {
      mu_.push_back(block.mu);
      lambda_.push_back(block.lambda);
    }
    frames_ = std::make_shared<LocalFrames>(blocks_, rest_nodes_, literal_);
    return frames_;
  }

 private:
  std::span<const ElementBlock> blocks_;
  Eigen::Matrix3Xd rest_nodes_;
  bool literal_;
  std::vector<std::vector<double>> mu_, lambda_;
  std::shared_ptr<const LocalFrames> frames_;
};

/// Q K Qᵀ in every element.
class FrameTangent final : public Tangent {
 public:
  FrameTangent(std::shared_ptr<const LocalFrames> frames, const Eigen::Matrix3Xd& x)
      : frames_(std::move(frames)), turns_(frames_->element_count()), slots_(3 * frames_->slot_count()) {
    frames_->for_elements(
        [&](const Part& part, std::size_t e) { turns_[part.element_begin + e] = frame(part, e, x); });
  }

  void stiffness_product(const Eigen::Matrix3Xd& dx, Eigen::Matrix3Xd& result) const override {
    frames_->for_elements([&](const Part& part, std::size_t e) {
      Local d, force;
      take(part, e, dx, d);
      const Eigen::Matrix3d& q = turns_[part.element_begin + e];
      turn(q.transpose(), part.node_count(), d);
      part.matrices.product(e, d.values, force.values);
      turn(q, part.node_count(), force);
      std::copy_n(force.values, 3 * part.node_count(),
                  slots_.data() + 3 * (part.slot_begin + e * part.node_count()));
    });
    frames_->gather(slots_, result);
  }

  void element_tangents(const Visit& visit) const override {
    Eigen::MatrixXd turned;
    for (const Part& part : frames_->parts()) {
      const auto size = static_cast<Eigen::Index>(part.matrices.size());
      for (std::size_t e = 0; e < part.element_count(); ++e) {
        const Eigen::Matrix3d& q = turns_[part.element_begin + e];
        turned = Eigen::Map<const Eigen::MatrixXd>(part.matrices.matrix(e), size, size).transpose();
        for (Eigen::Index a = 0; a < size; a += 3)
          for (Eigen::Index b = 0; b < size; b += 3) {
            const Eigen::Matrix3d block = q * turned.block<3, 3>(a, b) * q.transpose();
            turned.block<3, 3>(a, b) = block;
          }
        visit({part.nodes.data() + e * part.node_count(), part.node_count()}, turned);
      }
    }
  }

 private:
  std::shared_ptr<const LocalFrames> frames_;
  std::vector<Eigen::Matrix3d> turns_;  // [element of all parts]
  mutable std::vector<double> slots_;
};

class LocalFrame final : public ForceModel {
 public:
  LocalFrame(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes)
      : current_(blocks, rest_nodes, false) {}

  std::string_view name() const override { return "published"; }
  Promises promises() const override {
    Promises promises;
    promises.has_energy = false;
    promises.conserves_momentum = false;  // forces sum to zero, moments do not
    promises.inversion_is_error = true;   // the mirror image has no force
    promises.exact_tangent = promises.passes_patch_test = promises.rest_tangent_is_linear = false;
    return promises;
  }

  double energy(const Eigen::Matrix3Xd& x) const override {
    double total = 0;
    for (const Part& part : current_.get()->parts())
      total += parallel_sum(part.element_count(), 16, [&](std::size_t e) {
        Local d, force;
        strain_and_force(part, e, x, d, force);
        double sum = 0;
        for (std::size_t i = 0; i < 3 * part.node_count(); ++i) sum += 0.5 * d.values[i] * force.values[i];
        return sum;
      });
    return total;
  }

  void forces(const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& forces) const override {
    const LocalFrames& frames = *current_.get();
    slots_.resize(3 * frames.slot_count());
    frames.for_elements([&](const Part& part, std::size_t e) {
      Local d, force;
      turn(-strain_and_force(part, e, x, d, force), part.node_count(), force);
      std::copy_n(force.values, 3 * part.node_count(),
                  slots_.data() + 3 * (part.slot_begin + e * part.node_count()));
    });
    frames.gather(slots_, forces);
  }

  std::unique_ptr<Tangent> tangent(const Eigen::Matrix3Xd& x, Projection) const override {
    return std::make_unique<FrameTangent>(current_.get(), x);
  }

 private:
  /// d = Qᵀ ½R and K d; returns Q.
  static Eigen::Matrix3d strain_and_force(const Part& part, std::size_t e, const Eigen::Matrix3Xd& x, Local& d,
                                          Local& force) {
    displacements(part, e, x, d);
    const Eigen::Matrix3d q = frame(part, e, x);
    turn(0.5 * q.transpose(), part.node_count(), d);
    part.matrices.product(e, d.values, force.values);
    return q;
  }

  mutable CurrentFrames current_;
  mutable std::vector<double> slots_;  // working memory: one call at a time
};

class LocalFrameLiteral final : public ForceModel {
 public:
  LocalFrameLiteral(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes)
      : current_(blocks, rest_nodes, true), linear_(make_linear(blocks, rest_nodes)) {}

  std::string_view name() const override { return "published_literal"; }
  Promises promises() const override {
    Promises promises;
    promises.has_energy = promises.conserves_momentum = promises.rotation_invariant = false;
    promises.inversion_is_error = true;
    promises.exact_tangent = promises.passes_patch_test = promises.rest_tangent_is_linear = false;
    return promises;
  }
  double energy(const Eigen::Matrix3Xd& x) const override {
    Eigen::Matrix3Xd force;
    forces(x, force);
    return -0.5 * parallel_sum(static_cast<std::size_t>(x.cols()), 1024, [&](std::size_t i) {
      const auto c = static_cast<Eigen::Index>(i);
      return force(0, c) * summed_(0, c) + force(1, c) * summed_(1, c) + force(2, c) * summed_(2, c);
    });
  }

  void forces(const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& forces) const override {
    const LocalFrames& frames = *current_.get();
    slots_.resize(3 * frames.slot_count());
    frames.for_elements([&](const Part& part, std::size_t e) {
      Local d;
      displacements(part, e, x, d);
      std::copy_n(d.values, 3 * part.node_count(), slots_.data() + 3 * (part.slot_begin + e * part.node_count()));
    });
    frames.gather(slots_, summed_);
    frames.for_elements([&](const Part& part, std::size_t e) {
      Local d, force;
      take(part, e, summed_, d);
      part.matrices.product(e, d.values, force.values);
      double* to = slots_.data() + 3 * (part.slot_begin + e * part.node_count());
      for (std::size_t i = 0; i < 3 * part.node_count(); ++i) to[i] = -force.values[i];
    });
    frames.gather(slots_, forces);
  }

  /// That of linear elasticity: what an implicit method is given to fail with.
  std::unique_ptr<Tangent> tangent(const Eigen::Matrix3Xd& x, Projection projection) const override {
    return linear_->tangent(x, projection);
  }

 private:
  mutable CurrentFrames current_;
  std::unique_ptr<ForceModel> linear_;
  mutable std::vector<double> slots_;
  mutable Eigen::Matrix3Xd summed_;  // R d, over all elements
};

}  // namespace

std::unique_ptr<ForceModel> make_local_frame(std::span<const ElementBlock> blocks,
                                             const Eigen::Matrix3Xd& rest_nodes) {
  return std::make_unique<LocalFrame>(blocks, rest_nodes);
}

std::unique_ptr<ForceModel> make_local_frame_literal(std::span<const ElementBlock> blocks,
                                                     const Eigen::Matrix3Xd& rest_nodes) {
  return std::make_unique<LocalFrameLiteral>(blocks, rest_nodes);
}

}  // namespace argil::fem
