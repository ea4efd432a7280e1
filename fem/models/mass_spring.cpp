#include "fem/models/mass_spring.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "fem/models/element_packets.h"
#include "fem/models/mass_spring_kernels.h"
#include "fem/models/packet_memory.h"
#include "fem/parallel.h"
#include "subdiv/error.h"

namespace argil::fem {
namespace {

/// What is the same at every state: which nodes, rest lengths and sizes, in packets.
struct SpringCubes {
  SpringCubes(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes,
              const MassSpringOptions& chosen)
      : options(chosen), packets(blocks, static_cast<std::size_t>(rest_nodes.cols())), kernels(spring_kernels()) {
    packet_begin.push_back(0);
    for (std::size_t b = 0; b < blocks.size(); ++b)
      packet_begin.push_back(packet_begin.back() + packets.packet_count(b));
    rest_lengths.resize(packet_begin.back() * k_springs);
    sizes.resize(packet_begin.back());
    for (std::size_t b = 0; b < blocks.size(); ++b) measure(b, rest_nodes);
  }

  void measure(std::size_t b, const Eigen::Matrix3Xd& rest_nodes) {
    const ElementBlock& block = packets.block(b);
    const std::size_t count = block.element_count();
    parallel_for(packets.packet_count(b), 64, [&](std::size_t packet) {
      for (std::size_t lane = 0; lane < k_lanes; ++lane) {
        const std::size_t element = std::min(packet * k_lanes + lane, count - 1);
        double volume = 0;
        for (int q = 0; q < block.kind->point_count; ++q) volume += block.volumes[block.point_index(element, q)];
        const std::size_t at = packet_begin[b] + packet;
        sizes[at].values[lane] = std::cbrt(volume);
        const std::uint32_t* nodes = block.nodes.data() + element * 8;
        for (std::size_t s = 0; s < k_springs; ++s) {
          const SpringEnds& ends = spring_ends(s);
          const Eigen::Vector3d d = rest_nodes.col(nodes[ends.to]) - rest_nodes.col(nodes[ends.from]);
          rest_lengths[at * k_springs + s].values[lane] = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        }
      }
    });
  }

  SpringArguments arguments(std::size_t b, const double* x, FourDoubles* slots, FourDoubles* tangent,
                            FourDoubles* energies) const {
    SpringArguments a;
    a.packets = packets.arguments(b, slots, nullptr, energies);
    a.packets.x = x;
    a.options = &options;
    a.rest_lengths = rest_lengths.data() + packet_begin[b] * k_springs;
    a.sizes = sizes.data() + packet_begin[b];
    if (tangent) a.tangent = tangent + packet_begin[b] * k_spring_tangent_entries;
    return a;
  }

  MassSpringOptions options;
  ElementPackets packets;
  SpringKernels kernels;
  std::vector<std::size_t> packet_begin;  // [block], one more ends the last
  std::vector<FourDoubles> rest_lengths, sizes;
};

/// Ψ in elongations has the Hessian D; K = Nᵀ D N + the transverse parts, N the directions of the springs.
void element_stiffness(const FourDoubles* entries, std::size_t lane, const MassSpringOptions& options,
                       Eigen::MatrixXd& stiffness) {
  const auto entry = [&](std::size_t i) { return entries[i].values[lane]; };
  const FourDoubles* constants = entries + 4 * k_springs;
  const auto constant = [&](std::size_t i) { return constants[i].values[lane]; };
  const double edge = constant(0), face = constant(1), inner = constant(2), own = constant(3), shared = constant(4),
               hourglass = constant(5);
  stiffness.setZero(24, 24);
  const auto add = [&](std::size_t spring, const Eigen::Matrix3d& block) {
    const int a = 3 * spring_ends(spring).from, b = 3 * spring_ends(spring).to;
    stiffness.block<3, 3>(a, a) += block;
    stiffness.block<3, 3>(b, b) += block;
    stiffness.block<3, 3>(a, b) -= block;
    stiffness.block<3, 3>(b, a) -= block;
  };
  const auto direction = [&](std::size_t s) {
    return Eigen::Vector3d(entry(4 * s), entry(4 * s + 1), entry(4 * s + 2));
  };
  const auto add_rank_one = [&](const Eigen::Matrix<double, 24, 1>& row, double factor) {
    stiffness.noalias() += row * (factor * row.transpose());
  };
  using Row = Eigen::Matrix<double, 24, 1>;
  const auto add_to_row = [&](Row& row, std::size_t s, double weight) {
    row.segment<3>(3 * spring_ends(s).to) += weight * direction(s);
    row.segment<3>(3 * spring_ends(s).from) -= weight * direction(s);
  };
  for (std::size_t s = 0; s < k_springs; ++s) {
    const double k = s < k_edge_springs ? edge : s < k_edge_springs + k_face_springs ? face : inner;
    const bool used =
        s < k_edge_springs || (s < k_edge_springs + k_face_springs
                                   ? options.diagonals != DiagonalSprings::inner || options.hourglass_springs
                                   : options.diagonals != DiagonalSprings::faces);
    if (!used) continue;
    const Eigen::Vector3d n = direction(s);
    const double transverse = entry(4 * s + 3);
    add(s, (k - transverse) * n * n.transpose() + transverse * Eigen::Matrix3d::Identity());
  }
  Row sum = Row::Zero();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Row mean = Row::Zero();
    for (std::size_t e = 4 * axis; e < 4 * axis + 4; ++e) add_to_row(mean, e, 0.25);
    if (own != 0) add_rank_one(mean, own);
    sum += mean;
    if (hourglass == 0) continue;
    Row q = Row::Zero();
    const std::size_t s = k_edge_springs + 4 * axis;
    add_to_row(q, s, -1);
    add_to_row(q, s + 1, 1);
    add_to_row(q, s + 2, 1);
    add_to_row(q, s + 3, -1);
    add_rank_one(q, hourglass);
  }
  if (shared != 0) add_rank_one(sum, shared);
}

class SpringTangent final : public Tangent {
 public:
  SpringTangent(std::shared_ptr<const SpringCubes> cubes, std::shared_ptr<PacketMemory> memory,
                const Eigen::Matrix3Xd& x, Projection projection)
      : cubes_(std::move(cubes)),
        memory_(std::move(memory)),
        entries_(memory_->take(cubes_->packet_begin.back() * k_spring_tangent_entries)),
        slots_(memory_->take(cubes_->packets.slot_count())) {
    const bool project = projection == Projection::positive_semidefinite;
    cubes_->packets.for_packets([&](std::size_t b, std::size_t begin, std::size_t end) {
      SpringArguments a = cubes_->arguments(b, x.data(), nullptr, entries_.data(), nullptr);
      a.drop_negative = project;
      cubes_->kernels.tangent(a, begin, end);
      if (project) make_semidefinite(a, begin, end);
    });
  }
  ~SpringTangent() override {
    memory_->give_back(std::move(entries_));
    memory_->give_back(std::move(slots_));
  }

  void stiffness_product(const Eigen::Matrix3Xd& dx, Eigen::Matrix3Xd& result) const override {
    cubes_->packets.for_packets([&](std::size_t b, std::size_t begin, std::size_t end) {
      cubes_->kernels.product(cubes_->arguments(b, dx.data(), slots_.data(), entries_.data(), nullptr), begin, end);
    });
    cubes_->packets.gather(slots_.data(), result);
  }

  void element_tangents(const Visit& visit) const override {
    Eigen::MatrixXd stiffness;
    for (std::size_t b = 0; b < cubes_->packets.block_count(); ++b) {
      const ElementBlock& block = cubes_->packets.block(b);
      const FourDoubles* entries = entries_.data() + cubes_->packet_begin[b] * k_spring_tangent_entries;
      for (std::size_t e = 0; e < block.element_count(); ++e) {
        element_stiffness(entries + e / k_lanes * k_spring_tangent_entries, e % k_lanes, cubes_->options,
                          stiffness);
        visit({block.nodes.data() + e * 8, 8}, stiffness);
      }
    }
  }

 private:
  /// Where the correction takes more from the edges than they have, the cube as a whole may still be stable; only a
  /// factorisation knows. An unstable one gives up that part of the correction.
  void make_semidefinite(const SpringArguments& a, std::size_t begin, std::size_t end) const {
    Eigen::MatrixXd stiffness;
    for (std::size_t packet = begin; packet < end; ++packet) {
      FourDoubles* entries = a.tangent + packet * k_spring_tangent_entries;
      FourDoubles* constants = entries + 4 * k_springs;
      for (std::size_t lane = 0; lane < k_lanes; ++lane) {
        double &edge = constants[0].values[lane], &own = constants[3].values[lane],
               &shared = constants[4].values[lane];
        if (edge >= 0 && 4 * edge + own >= 0 && 4 * edge + own + 3 * shared >= 0) continue;
        element_stiffness(entries, lane, cubes_->options, stiffness);
        double trace = 0;
        for (int i = 0; i < 24; ++i) trace += stiffness(i, i);
        for (int i = 0; i < 24; ++i) stiffness(i, i) += 1e-12 * trace;
        if (Eigen::LLT<Eigen::MatrixXd>(stiffness).info() == Eigen::Success) continue;
        edge = std::max(edge, 0.0);
        own = std::max(own, -4 * edge);
        shared = std::max(shared, -(4 * edge + own) / 3);
      }
    }
  }

  std::shared_ptr<const SpringCubes> cubes_;
  std::shared_ptr<PacketMemory> memory_;
  mutable std::vector<FourDoubles> entries_, slots_;
};

class MassSpring final : public ForceModel {
 public:
  MassSpring(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes,
             const MassSpringOptions& options)
      : cubes_(std::make_shared<SpringCubes>(blocks, rest_nodes, options)) {}

  std::string_view name() const override {
    if (cubes_->options.correction == SpringCorrection::printed) return "mass_spring_published";
    constexpr std::string_view k_names[] = {"mass_spring", "mass_spring_m2", "mass_spring_m3"};
    return k_names[static_cast<std::size_t>(cubes_->options.diagonals)];
  }
  Promises promises() const override {
    Promises promises;
    promises.has_energy = cubes_->options.correction != SpringCorrection::printed;
    promises.inversion_is_error = true;  // the mirror image has every length at rest
    promises.exact_tangent = cubes_->options.correction != SpringCorrection::printed;
    promises.passes_patch_test = false;  // only where all cells are alike
    promises.rest_tangent_is_linear = false;
    return promises;
  }

  double energy(const Eigen::Matrix3Xd& x) const override {
    energies_.resize(cubes_->packets.all_packet_count());
    cubes_->packets.for_packets([&](std::size_t b, std::size_t begin, std::size_t end) {
      cubes_->kernels.energy(cubes_->arguments(b, x.data(), nullptr, nullptr, energies_.data()), begin, end);
    });
    return cubes_->packets.sum(energies_.data());
  }

  void forces(const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& forces) const override {
    slots_.resize(cubes_->packets.slot_count());
    cubes_->packets.for_packets([&](std::size_t b, std::size_t begin, std::size_t end) {
      cubes_->kernels.forces(cubes_->arguments(b, x.data(), slots_.data(), nullptr, nullptr), begin, end);
    });
    cubes_->packets.gather(slots_.data(), forces);
  }

  std::unique_ptr<Tangent> tangent(const Eigen::Matrix3Xd& x, Projection projection) const override {
    return std::make_unique<SpringTangent>(cubes_, memory_, x, projection);
  }

 private:
  std::shared_ptr<const SpringCubes> cubes_;
  std::shared_ptr<PacketMemory> memory_ = std::make_shared<PacketMemory>();
  mutable std::vector<FourDoubles> slots_, energies_;  // working memory: one call at a time
};

}  // namespace

std::unique_ptr<ForceModel> make_mass_spring(std::span<const ElementBlock> blocks,
                                             const Eigen::Matrix3Xd& rest_nodes, const MassSpringOptions& options) {
  for (const ElementBlock& block : blocks)
    if (block.kind != &trilinear_hexahedron())
      throw Error(
          ErrorCode::unsupported,
          fmt::format("a mass–spring model is made of trilinear hexahedra, but this body has {} elements of "
                      "kind {}; use the default space and cells that are boxes, or another model",
                      block.element_count(), block.kind->name));
  if (options.correction == SpringCorrection::printed && options.diagonals != DiagonalSprings::inner)
    throw Error(
        ErrorCode::unsupported,
        "the printed correction belongs to cubes with inner diagonals; choose those, or the energy correction");
  return std::make_unique<MassSpring>(blocks, rest_nodes, options);
}

}  // namespace argil::fem
