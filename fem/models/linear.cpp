#include "fem/models/linear.h"

#include "fem/models/element_packets.h"
#include "fem/models/linear_kernels.h"
#include "fem/models/packet_memory.h"
#include "fem/models/warped_stiffness.h"
#include "fem/parallel.h"

namespace argil::fem {
namespace {

/// What does not change with state or material.
struct LinearElements {
  LinearElements(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest, Formulation formulation)
      : packets(blocks, static_cast<std::size_t>(rest.cols())), rest_nodes(rest) {
    for (std::size_t b = 0; b < packets.block_count(); ++b) {
      const ElementKind& kind = *packets.block(b).kind;
      means.push_back(formulation == Formulation::b_bar && &kind == &trilinear_hexahedron());
      kernels.push_back(linear_kernels(kind, means.back()));
      moduli_begin.push_back(moduli_count);
      moduli_count += packets.packet_count(b) * linear_entries(static_cast<std::size_t>(kind.point_count));
    }
  }
  PacketArguments arguments(std::size_t b, FourDoubles* slots, FourDoubles* moduli, const double* x) const {
    PacketArguments result = packets.arguments(b, slots, nullptr, nullptr);
    result.tangent = moduli + moduli_begin[b];
    result.rest = rest_nodes.data();
    result.x = x;
    return result;
  }

  ElementPackets packets;
  Eigen::Matrix3Xd rest_nodes;
  std::vector<bool> means;  // [block]
  std::vector<LinearKernels> kernels;
  std::vector<std::size_t> moduli_begin;
  std::size_t moduli_count = 0;
};

/// Keeps the moduli that the blocks had. One call at a time.
class LinearTangent final : public Tangent {
 public:
  LinearTangent(std::shared_ptr<const LinearElements> elements, std::shared_ptr<PacketMemory> memory)
      : elements_(std::move(elements)),
        memory_(std::move(memory)),
        moduli_(memory_->take(elements_->moduli_count)),
        slots_(memory_->take(elements_->packets.slot_count())) {
    elements_->packets.for_packets([&](std::size_t block, std::size_t begin, std::size_t end) {
      elements_->kernels[block].moduli(elements_->arguments(block, nullptr, moduli_.data(), nullptr), begin, end);
    });
  }
  ~LinearTangent() override {
    memory_->give_back(std::move(moduli_));
    memory_->give_back(std::move(slots_));
  }

  void stiffness_product(const Eigen::Matrix3Xd& dx, Eigen::Matrix3Xd& result) const override {
    elements_->packets.for_packets([&](std::size_t block, std::size_t begin, std::size_t end) {
      elements_->kernels[block].product(elements_->arguments(block, slots_.data(), moduli_.data(), dx.data()),
                                        begin, end);
    });
    elements_->packets.gather(slots_.data(), result);
  }

  void element_tangents(const Visit& visit) const override {
    for (std::size_t block = 0; block < elements_->packets.block_count(); ++block) {
      const PacketArguments arguments = elements_->arguments(block, nullptr, moduli_.data(), nullptr);
      visit_packets(elements_->packets, block, visit, [&](std::size_t packet, FourDoubles* stiffness) {
        linear_stiffness(arguments, elements_->means[block], packet, stiffness);
      });
    }
  }

 private:
  std::shared_ptr<const LinearElements> elements_;
  std::shared_ptr<PacketMemory> memory_;
  mutable std::vector<FourDoubles> moduli_, slots_;
};

class Linear final : public ForceModel {
 public:
  Linear(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes, Formulation formulation)
      : elements_(std::make_shared<LinearElements>(blocks, rest_nodes, formulation)) {}

  std::string_view name() const override { return "linear"; }
  Promises promises() const override {
    Promises promises;
    promises.conserves_momentum = false;  // moments vanish at rest only
    promises.rotation_invariant = false;
    promises.largest_rotation = 0.05;  // strain of a rigid rotation: 1 − cos ≈ 1e-3
    return promises;
  }

  double energy(const Eigen::Matrix3Xd& x) const override {
    const Eigen::Matrix3Xd displacements = x - elements_->rest_nodes;
    Eigen::Matrix3Xd product;
    tangent(x, Projection::none)->stiffness_product(displacements, product);
    return 0.5 * parallel_sum(static_cast<std::size_t>(x.cols()), 1024, [&](std::size_t i) {
             const auto c = static_cast<Eigen::Index>(i);
             return displacements(0, c) * product(0, c) + displacements(1, c) * product(1, c) +
                    displacements(2, c) * product(2, c);
           });
  }

  void forces(const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& forces) const override {
    tangent(x, Projection::none)->stiffness_product(x - elements_->rest_nodes, forces);
    forces = -forces;
  }

  std::unique_ptr<Tangent> tangent(const Eigen::Matrix3Xd&, Projection) const override {
    return std::make_unique<LinearTangent>(elements_, memory_);
  }

 private:
  std::shared_ptr<const LinearElements> elements_;
  std::shared_ptr<PacketMemory> memory_ = std::make_shared<PacketMemory>();
};

}  // namespace

std::unique_ptr<ForceModel> make_linear(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes) {
  return make_linear_as(blocks, rest_nodes, Formulation::plain);
}

std::unique_ptr<ForceModel> make_linear_as(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes,
                                           Formulation formulation) {
  if (formulation == Formulation::incompatible_modes)
    return make_linear_by_matrices(blocks, rest_nodes, formulation);
  return std::make_unique<Linear>(blocks, rest_nodes, formulation);
}

}  // namespace argil::fem
