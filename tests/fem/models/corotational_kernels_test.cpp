// One result, whatever the processor, the number of threads or the path through the kernels.

#include "fem/models/corotational_kernels.h"

#include <gtest/gtest.h>

#include "fem/models/element_packets.h"
#include "fem/models/force_model.h"
#include "tests/fem/element_bodies.h"
#include "tests/fem/models/kernel_comparisons.h"

namespace argil::fem {
namespace {

using test::Body;
using test::same_bits;

Eigen::Matrix3Xd crushed(const Body& body) {
  Eigen::Matrix3Xd x = body.rest + test::random_vectors(body.rest.cols(), 0.15, 41);
  x.row(2) *= -0.3;
  return x;
}

struct Results {
  std::vector<FourDoubles> energies, forces, tangent, product;
};

Results run(const Body& body, std::size_t block, const CorotationalKernels& kernels) {
  const ElementPackets packets(body.blocks, static_cast<std::size_t>(body.rest.cols()));
  const Eigen::Matrix3Xd x = crushed(body), dx = test::random_vectors(x.cols(), 1, 43);
  Results r;
  const std::size_t count = packets.packet_count(block);
  const auto nodes = static_cast<std::size_t>(body.blocks[block].kind->node_count);
  const auto points = static_cast<std::size_t>(body.blocks[block].kind->point_count);
  r.energies.resize(count);
  r.forces.resize(count * nodes * 3);
  r.product.resize(count * nodes * 3);
  r.tangent.resize(count * points * k_tangent_entries);
  PacketArguments a = packets.arguments(block, nullptr, nullptr, nullptr);
  a.x = x.data();
  a.energies = r.energies.data();
  a.slots = r.forces.data();
  a.tangent = r.tangent.data();
  a.clamp_twist = true;
  kernels.energy(a, 0, count);
  kernels.forces(a, 0, count);
  kernels.tangent(a, 0, count);
  a.x = dx.data();
  a.slots = r.product.data();
  kernels.product(a, 0, count);
  return r;
}

TEST(CorotationalKernels, WiderInstructionsGiveTheSameBits) {
  for (const Body& body : test::all_bodies())
    for (std::size_t b = 0; b < body.blocks.size(); ++b) {
      const ElementKind& kind = *body.blocks[b].kind;
      const Results best = run(body, b, corotational_kernels(kind, Instructions::best));
      const Results baseline = run(body, b, corotational_kernels(kind, Instructions::baseline));
      EXPECT_TRUE(same_bits(best.energies, baseline.energies)) << body.name;
      EXPECT_TRUE(same_bits(best.forces, baseline.forces)) << body.name;
      EXPECT_TRUE(same_bits(best.tangent, baseline.tangent)) << body.name;
      EXPECT_TRUE(same_bits(best.product, baseline.product)) << body.name;
    }
}

TEST(CorotationalKernels, AxisByAxisAndTheTablesAgree) {
  for (const Body& body : test::all_bodies()) {
    const test::BodyByTables by_tables(body);
    const Body& dense = by_tables.body;
    const auto fast = make_corotational(body.blocks, body.rest);
    const auto plain = make_corotational(dense.blocks, dense.rest);
    const Eigen::Matrix3Xd x = crushed(body), dx = test::random_vectors(x.cols(), 1, 47);
    Eigen::Matrix3Xd a, b;
    fast->forces(x, a);
    plain->forces(x, b);
    EXPECT_LE((a - b).cwiseAbs().maxCoeff(), 1e-12 * a.cwiseAbs().maxCoeff()) << body.name;
    fast->tangent(x, Projection::positive_semidefinite)->stiffness_product(dx, a);
    plain->tangent(x, Projection::positive_semidefinite)->stiffness_product(dx, b);
    EXPECT_LE((a - b).cwiseAbs().maxCoeff(), 1e-11 * a.cwiseAbs().maxCoeff()) << body.name;
    EXPECT_NEAR(fast->energy(x), plain->energy(x), 1e-13 * fast->energy(x));
  }
}

TEST(CorotationalKernels, ThreadsDoNotChangeABit) {
  for (const Body& body : {test::mixed(7, 0.1), test::bspline(3, 0.05)}) {
    const Eigen::Matrix3Xd x = crushed(body), dx = test::random_vectors(x.cols(), 1, 53);
    SCOPED_TRACE(body.name);
    test::expect_the_same_by_any_threads([&] { return make_corotational(body.blocks, body.rest); }, x, dx);
  }
}

TEST(CorotationalKernels, TangentsKeepTheirStateWhileOthersComeAndGo) {
  const Body body = test::mixed(3, 0.1);
  const Eigen::Matrix3Xd x = crushed(body), dx = test::random_vectors(x.cols(), 1, 59);
  auto model = make_corotational(body.blocks, body.rest);
  const auto kept = model->tangent(x, Projection::none);
  Eigen::Matrix3Xd before, after, other;
  kept->stiffness_product(dx, before);
  model->tangent(body.rest, Projection::none)->stiffness_product(dx, other);  // gives its memory back
  const auto recycled = model->tangent(x, Projection::none);
  recycled->stiffness_product(dx, after);
  EXPECT_EQ(before, after);
  model.reset();  // tangents may outlive their model
  kept->stiffness_product(dx, after);
  EXPECT_EQ(before, after);
  EXPECT_NE(before, other);
}

TEST(CorotationalKernels, AnIncompleteLastPacketCountsItsElementsOnce) {
  // One to five equal cubes apart from each other: energy and forces are those of one, times their number.
  for (std::size_t count = 1; count <= 5; ++count) {
    Body body{"apart", {}, {}, {}};
    body.blocks.resize(1);
    body.blocks[0].kind = &trilinear_hexahedron();
    body.rest.resize(3, static_cast<Eigen::Index>(8 * count));
    for (std::size_t e = 0; e < count; ++e) {
      std::vector<std::uint32_t> nodes;
      for (std::uint32_t c = 0; c < 8; ++c) {
        nodes.push_back(static_cast<std::uint32_t>(8 * e) + c);
        body.rest.col(nodes.back()) << (c >> 2), (c >> 1 & 1), (c & 1);
      }
      test::add_element(body.blocks[0], nodes);
    }
    test::finish(body, 0.0, true);
    const Eigen::Matrix3Xd x = Eigen::Vector3d(1.2, 1, 1).asDiagonal() * body.rest;
    const auto model = make_corotational(body.blocks, body.rest);
    EXPECT_NEAR(model->energy(x), 500 * 0.04 * static_cast<double>(count), 1e-12);
    Eigen::Matrix3Xd f;
    model->forces(x, f);
    for (Eigen::Index i = 0; i < f.cols(); ++i) EXPECT_NEAR(std::abs(f(0, i)), 50, 1e-11);
  }
}

}  // namespace
}  // namespace argil::fem
