#include "fem/models/hyperelastic.h"

#include <algorithm>

#include "fem/models/element_packets.h"
#include "fem/models/packet_memory.h"
#include "fem/parallel.h"

namespace argil::fem {
namespace {

/// Packets with the kernels of a law, and where each block's tangent entries begin.
struct LawPackets {
  LawPackets(Law law, std::span<const ElementBlock> blocks, std::size_t node_count, bool mean_dilatation)
      : packets(blocks, node_count) {
    for (std::size_t b = 0; b < packets.block_count(); ++b) {
      const ElementKind& kind = *packets.block(b).kind;
      kernels.push_back(hyperelastic_kernels(law, kind, mean_dilatation && &kind == &trilinear_hexahedron()));
      entries_begin.push_back(entry_count);
      entry_count += packets.packet_count(b) * static_cast<std::size_t>(kind.point_count) * kernels.back().entries;
    }
  }
  PacketArguments arguments(std::size_t b, FourDoubles* slots, FourDoubles* tangent, FourDoubles* energies) const {
    PacketArguments result = packets.arguments(b, slots, nullptr, energies);
    if (tangent) result.tangent = tangent + entries_begin[b];
    return result;
  }

  ElementPackets packets;
  std::vector<HyperelasticKernels> kernels;
  std::vector<std::size_t> entries_begin;
  std::size_t entry_count = 0;
};

class SpectralTangent final : public Tangent {
 public:
  SpectralTangent(std::shared_ptr<const LawPackets> law, std::shared_ptr<PacketMemory> memory)
      : law_(std::move(law)),
        memory_(std::move(memory)),
        entries_(memory_->take(law_->entry_count)),
        slots_(memory_->take(law_->packets.slot_count())) {}
  ~SpectralTangent() override {
    memory_->give_back(std::move(entries_));
    memory_->give_back(std::move(slots_));
  }
  FourDoubles* entries() { return entries_.data(); }

  void stiffness_product(const Eigen::Matrix3Xd& dx, Eigen::Matrix3Xd& result) const override {
    law_->packets.for_packets([&](std::size_t block, std::size_t begin, std::size_t end) {
      PacketArguments arguments = law_->arguments(block, slots_.data(), entries_.data(), nullptr);
      arguments.x = dx.data();
      law_->kernels[block].product(arguments, begin, end);
    });
    law_->packets.gather(slots_.data(), result);
  }

  void element_tangents(const Visit& visit) const override {
    for (std::size_t block = 0; block < law_->packets.block_count(); ++block) {
      const PacketArguments arguments = law_->arguments(block, nullptr, entries_.data(), nullptr);
      visit_packets(law_->packets, block, visit, [&](std::size_t packet, FourDoubles* stiffness) {
        spectral_stiffness(arguments, law_->kernels[block].entries, packet, stiffness);
      });
    }
  }

 private:
  std::shared_ptr<const LawPackets> law_;
  std::shared_ptr<PacketMemory> memory_;
  mutable std::vector<FourDoubles> entries_, slots_;
};

class Hyperelastic final : public ForceModel {
 public:
  Hyperelastic(Law law, std::span<const ElementBlock> blocks, std::size_t node_count, bool mean_dilatation)
      : kind_(law), law_(std::make_shared<LawPackets>(law, blocks, node_count, mean_dilatation)) {}

  std::string_view name() const override {
    switch (kind_) {
      case Law::corotational:
        return "corotational";
      case Law::stable_neo_hookean:
        return "stable_neo_hookean";
      case Law::st_venant_kirchhoff:
        return "st_venant_kirchhoff";
      case Law::neo_hookean:
        return "neo_hookean";
    }
    return "";
  }
  Promises promises() const override {
    Promises promises;
    promises.inversion_is_error = kind_ == Law::st_venant_kirchhoff;  // the mirror image has no Green strain
    return promises;
  }

  double energy(const Eigen::Matrix3Xd& x) const override {
    energies_.resize(law_->packets.all_packet_count());
    law_->packets.for_packets([&](std::size_t block, std::size_t begin, std::size_t end) {
      PacketArguments arguments = law_->arguments(block, nullptr, nullptr, energies_.data());
      arguments.x = x.data();
      law_->kernels[block].energy(arguments, begin, end);
    });
    return law_->packets.sum(energies_.data());
  }

  void forces(const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& forces) const override {
    slots_.resize(law_->packets.slot_count());
    law_->packets.for_packets([&](std::size_t block, std::size_t begin, std::size_t end) {
      PacketArguments arguments = law_->arguments(block, slots_.data(), nullptr, nullptr);
      arguments.x = x.data();
      law_->kernels[block].forces(arguments, begin, end);
    });
    law_->packets.gather(slots_.data(), forces);
  }

  std::unique_ptr<Tangent> tangent(const Eigen::Matrix3Xd& x, Projection projection) const override {
    auto result = std::make_unique<SpectralTangent>(law_, memory_);
    law_->packets.for_packets([&](std::size_t block, std::size_t begin, std::size_t end) {
      PacketArguments arguments = law_->arguments(block, nullptr, result->entries(), nullptr);
      arguments.x = x.data();
      arguments.clamp_twist = projection == Projection::positive_semidefinite;
      law_->kernels[block].tangent(arguments, begin, end);
    });
    return result;
  }

 private:
  Law kind_;
  std::shared_ptr<const LawPackets> law_;
  std::shared_ptr<PacketMemory> memory_ = std::make_shared<PacketMemory>();
  mutable std::vector<FourDoubles> slots_, energies_;  // working memory: one call at a time
};

}  // namespace

std::unique_ptr<ForceModel> make_hyperelastic(Law law, std::span<const ElementBlock> blocks,
                                              const Eigen::Matrix3Xd& rest_nodes, bool mean_dilatation) {
  return std::make_unique<Hyperelastic>(law, blocks, static_cast<std::size_t>(rest_nodes.cols()), mean_dilatation);
}

}  // namespace argil::fem
