#include "fem/models/local_frame.h"

#include <Eigen/Dense>
#include <algorithm>

#include "fem/models/local_frame_elements.h"

namespace argil::fem {
namespace {

using namespace local_frame;

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
