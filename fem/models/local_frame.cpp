#include "fem/models/local_frame.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>

#include "fem/models/element_stiffness.h"
#include "fem/models/local_frame_operator.h"
#include "fem/models/node_sums.h"
#include "fem/parallel.h"
#include "subdiv/error.h"

namespace argil::fem {
namespace {

/// One block: what R compares with, and the gradients in the middle of the cell.
struct Part {
  const ElementBlock* block = nullptr;
  std::size_t index = 0;  // of the block
  const LocalTopology* topology = nullptr;
  std::vector<double> rest_measures;        // [element * measure_count]
  std::vector<Eigen::Matrix3Xd> gradients;  // [element], ∂N/∂X in the middle

  std::size_t node_count() const { return static_cast<std::size_t>(block->kind->node_count); }
  std::size_t element_count() const { return block->element_count(); }
  std::size_t measure_count() const { return topology->measure_count(); }
  const std::uint32_t* nodes(std::size_t element) const { return block->nodes.data() + element * node_count(); }
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

FillMatrices fill_printed(const Eigen::Matrix3Xd& rest_nodes) {
  return [&rest_nodes](const ElementBlock& distinct, double* matrices) {
    const ElementBlock printed = in_cell_coordinates(distinct);
    make_linear({&printed, 1}, rest_nodes)
        ->tangent(rest_nodes, Projection::none)
        ->element_tangents([&](std::span<const std::uint32_t>, const Eigen::MatrixXd& stiffness) {
          const Eigen::MatrixXd k = printed_stiffness(stiffness);
          matrices = std::copy(k.data(), k.data() + k.size(), matrices);
        });
  };
}

/// Elements of all blocks, without their material.
class LocalFrames {
 public:
  LocalFrames(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes)
      : sums(blocks, static_cast<std::size_t>(rest_nodes.cols())) {
    for (const ElementBlock& block : blocks) {
      Part part{&block, parts_.size(), &local_topology(*block.kind), {}, {}};
      measure(part, rest_nodes);
      parts_.push_back(std::move(part));
    }
  }

  std::span<const Part> parts() const { return parts_; }
  std::size_t slot(const Part& part, std::size_t element) const { return 3 * sums.slot(part.index, element); }

  /// Calls body(part, element) for all elements, in parallel.
  template <class Body>
  void for_elements(const Body& body) const {
    for (const Part& part : parts_)
      parallel_for(part.element_count(), part.node_count() > 8 ? 1 : 32, [&](std::size_t e) { body(part, e); });
  }

  NodeSums sums;

 private:
  static void measure(Part& part, const Eigen::Matrix3Xd& rest_nodes) {
    const ElementBlock& block = *part.block;
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

  std::vector<Part> parts_;
};

/// The nodes of one element, at most 64.
struct Local {
  double values[192];
};
void take(const Part& part, std::size_t element, const Eigen::Matrix3Xd& x, Local& to) {
  const std::size_t n = part.node_count();
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t axis = 0; axis < 3; ++axis)
      to.values[3 * a + axis] = x(static_cast<Eigen::Index>(axis), part.nodes(element)[a]);
}
void displacements(const Part& part, std::size_t element, const Eigen::Matrix3Xd& x, Local& result) {
  Local at;
  take(part, element, x, at);
  local_displacements(*part.topology, part.block->kind->node_count,
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
    f += x.col(part.nodes(element)[a]) * part.gradients[element].col(static_cast<Eigen::Index>(a)).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) = -u.col(2);
  return u * svd.matrixV().transpose();
}

/// The elements, and their matrices with the material that the blocks have now: made anew where it was painted.
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
    frames_ = std::make_shared<LocalFrames>(blocks, rest_nodes);
    (void)stiffness();
  }

  const std::shared_ptr<const LocalFrames>& frames() const { return frames_; }
  const std::shared_ptr<const ElementStiffness>& stiffness() {
    if (stiffness_ && stiffness_->is_current()) return stiffness_;
    stiffness_ = literal_ ? std::make_shared<ElementStiffness>(blocks_, rest_nodes_, fill_printed(rest_nodes_))
                          : std::make_shared<ElementStiffness>(blocks_, rest_nodes_, Formulation::plain);
    return stiffness_;
  }

 private:
  std::span<const ElementBlock> blocks_;
  Eigen::Matrix3Xd rest_nodes_;
  bool literal_;
  std::shared_ptr<const LocalFrames> frames_;
  std::shared_ptr<const ElementStiffness> stiffness_;
};

void multiply(const ElementStiffness& stiffness, const Part& part, std::size_t element, const Local& d,
              Local& force) {
  multiply_stiffness(stiffness.matrix(part.index, element), 3 * part.node_count(), d.values, force.values);
}

/// Q K Qᵀ in every element.
class FrameTangent final : public Tangent {
 public:
  FrameTangent(std::shared_ptr<const LocalFrames> frames, std::shared_ptr<const ElementStiffness> stiffness,
               const Eigen::Matrix3Xd& x)
      : frames_(std::move(frames)), stiffness_(std::move(stiffness)), slots_(3 * frames_->sums.slot_count()) {
    for (const Part& part : frames_->parts()) turns_.emplace_back(part.element_count());
    frames_->for_elements([&](const Part& part, std::size_t e) { turns_[part.index][e] = frame(part, e, x); });
  }

  void stiffness_product(const Eigen::Matrix3Xd& dx, Eigen::Matrix3Xd& result) const override {
    frames_->for_elements([&](const Part& part, std::size_t e) {
      Local d, force;
      take(part, e, dx, d);
      const Eigen::Matrix3d& q = turns_[part.index][e];
      turn(q.transpose(), part.node_count(), d);
      multiply(*stiffness_, part, e, d, force);
      turn(q, part.node_count(), force);
      std::copy_n(force.values, 3 * part.node_count(), slots_.data() + frames_->slot(part, e));
    });
    frames_->sums.gather(slots_, result);
  }

  void element_tangents(const Visit& visit) const override {
    Eigen::MatrixXd turned;
    for (const Part& part : frames_->parts()) {
      const auto size = static_cast<Eigen::Index>(3 * part.node_count());
      for (std::size_t e = 0; e < part.element_count(); ++e) {
        const Eigen::Matrix3d& q = turns_[part.index][e];
        turned = Eigen::Map<const Eigen::MatrixXd>(stiffness_->matrix(part.index, e), size, size);
        for (Eigen::Index a = 0; a < size; a += 3)
          for (Eigen::Index b = 0; b < size; b += 3) {
            const Eigen::Matrix3d block = q * turned.block<3, 3>(a, b) * q.transpose();
            turned.block<3, 3>(a, b) = block;
          }
        visit({part.nodes(e), part.node_count()}, turned);
      }
    }
  }

 private:
  std::shared_ptr<const LocalFrames> frames_;
  std::shared_ptr<const ElementStiffness> stiffness_;
  std::vector<std::vector<Eigen::Matrix3d>> turns_;  // [block][element]
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
    const ElementStiffness& stiffness = *current_.stiffness();
    for (const Part& part : current_.frames()->parts())
      total += parallel_sum(part.element_count(), 16, [&](std::size_t e) {
        Local d, force;
        strain_and_force(stiffness, part, e, x, d, force);
        double sum = 0;
        for (std::size_t i = 0; i < 3 * part.node_count(); ++i) sum += 0.5 * d.values[i] * force.values[i];
        return sum;
      });
    return total;
  }

  void forces(const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& forces) const override {
    const LocalFrames& frames = *current_.frames();
    const ElementStiffness& stiffness = *current_.stiffness();
    slots_.resize(3 * frames.sums.slot_count());
    frames.for_elements([&](const Part& part, std::size_t e) {
      Local d, force;
      turn(-strain_and_force(stiffness, part, e, x, d, force), part.node_count(), force);
      std::copy_n(force.values, 3 * part.node_count(), slots_.data() + frames.slot(part, e));
    });
    frames.sums.gather(slots_, forces);
  }

  std::unique_ptr<Tangent> tangent(const Eigen::Matrix3Xd& x, Projection) const override {
    return std::make_unique<FrameTangent>(current_.frames(), current_.stiffness(), x);
  }

 private:
  /// d = Qᵀ ½R and K d; returns Q.
  static Eigen::Matrix3d strain_and_force(const ElementStiffness& stiffness, const Part& part, std::size_t e,
                                          const Eigen::Matrix3Xd& x, Local& d, Local& force) {
    displacements(part, e, x, d);
    const Eigen::Matrix3d q = frame(part, e, x);
    turn(0.5 * q.transpose(), part.node_count(), d);
    multiply(stiffness, part, e, d, force);
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
    const LocalFrames& frames = *current_.frames();
    const ElementStiffness& stiffness = *current_.stiffness();
    slots_.resize(3 * frames.sums.slot_count());
    frames.for_elements([&](const Part& part, std::size_t e) {
      Local d;
      displacements(part, e, x, d);
      std::copy_n(d.values, 3 * part.node_count(), slots_.data() + frames.slot(part, e));
    });
    frames.sums.gather(slots_, summed_);
    frames.for_elements([&](const Part& part, std::size_t e) {
      Local d, force;
      take(part, e, summed_, d);
      multiply(stiffness, part, e, d, force);
      double* to = slots_.data() + frames.slot(part, e);
      for (std::size_t i = 0; i < 3 * part.node_count(); ++i) to[i] = -force.values[i];
    });
    frames.sums.gather(slots_, forces);
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
