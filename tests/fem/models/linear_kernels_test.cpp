// Linear elasticity at quadrature points: the same as the matrices of its elements, whatever computes it.

#include "fem/models/linear_kernels.h"

#include <gtest/gtest.h>

#include "fem/models/element_packets.h"
#include "fem/models/element_stiffness.h"
#include "fem/models/linear.h"
#include "tests/fem/element_bodies.h"
#include "tests/fem/models/kernel_comparisons.h"

namespace argil::fem {
namespace {

using test::Body;
using test::same_bits;

constexpr Formulation k_formulations[] = {Formulation::plain, Formulation::b_bar};

TEST(LinearKernels, WiderInstructionsGiveTheSameBits) {
  for (const Body& body : test::all_bodies())
    for (std::size_t b = 0; b < body.blocks.size(); ++b)
      for (const bool mean : {false, true}) {
        const ElementKind& kind = *body.blocks[b].kind;
        if (mean && &kind != &trilinear_hexahedron()) continue;
        const ElementPackets packets(body.blocks, static_cast<std::size_t>(body.rest.cols()));
        const Eigen::Matrix3Xd dx = test::random_vectors(body.rest.cols(), 1, 43);
        const std::size_t count = packets.packet_count(b);
        std::vector<FourDoubles> moduli[2], slots[2];
        for (const int wide : {0, 1}) {
          const LinearKernels kernels =
              linear_kernels(kind, mean, wide ? Instructions::best : Instructions::baseline);
          moduli[wide].resize(count * linear_entries(static_cast<std::size_t>(kind.point_count)));
          slots[wide].resize(count * static_cast<std::size_t>(kind.node_count) * 3);
          PacketArguments a = packets.arguments(b, nullptr, nullptr, nullptr);
          a.x = dx.data();
          a.rest = body.rest.data();
          a.tangent = moduli[wide].data();
          a.slots = slots[wide].data();
          kernels.moduli(a, 0, count);
          kernels.product(a, 0, count);
        }
        EXPECT_TRUE(same_bits(moduli[0], moduli[1])) << body.name;
        EXPECT_TRUE(same_bits(slots[0], slots[1])) << body.name;
      }
}

/// Σ K_e dx with the matrix of each element from its table of gradients.
Eigen::Matrix3Xd product_by_matrices(const Body& body, Formulation formulation, const Eigen::Matrix3Xd& dx) {
  Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, dx.cols());
  for (const ElementBlock& block : body.blocks)
    for (std::size_t e = 0; e < block.element_count(); ++e) {
      const Eigen::MatrixXd k = element_stiffness(block, e, body.rest, formulation);
      const std::uint32_t* nodes = block.nodes.data() + e * static_cast<std::size_t>(block.kind->node_count);
      for (Eigen::Index a = 0; a < block.kind->node_count; ++a)
        for (Eigen::Index b = 0; b < block.kind->node_count; ++b)
          result.col(nodes[a]) += k.block<3, 3>(3 * a, 3 * b) * dx.col(nodes[b]);
    }
  return result;
}

TEST(LinearKernels, ProductIsThatOfTheElementsMatrices) {
  for (const Body& body : test::all_bodies())
    for (const Formulation formulation : k_formulations) {
      const Eigen::Matrix3Xd dx = test::random_vectors(body.rest.cols(), 1, 47);
      const Eigen::Matrix3Xd expected = product_by_matrices(body, formulation, dx);
      Eigen::Matrix3Xd found;
      make_linear_as(body.blocks, body.rest, formulation)
          ->tangent(body.rest, Projection::none)
          ->stiffness_product(dx, found);
      // Rounding of sums of a few hundred terms, in distorted cells.
      EXPECT_LE((found - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.cwiseAbs().maxCoeff()) << body.name;
    }
}

TEST(LinearKernels, FarFromTheOriginNothingIsLostButWhatThePositionsLose) {
  Body body = test::hexahedra(3, 0.15);
  const Eigen::Matrix3Xd dx = test::random_vectors(body.rest.cols(), 1, 5);
  const Eigen::Matrix3Xd near = product_by_matrices(body, Formulation::plain, dx);
  body.rest.colwise() += Eigen::Vector3d(1e6, -2e6, 3e6);  // leaves 2e-10 of positions, 7e-10 of a cell
  for (ElementBlock& block : body.blocks) {
    const std::vector<double> mu = block.mu, lambda = block.lambda;
    ASSERT_EQ(set_rest_geometry(block, body.rest), k_no_point);
    block.mu = mu;
    block.lambda = lambda;
  }
  Eigen::Matrix3Xd far;
  make_linear(body.blocks, body.rest)->tangent(body.rest, Projection::none)->stiffness_product(dx, far);
  EXPECT_LE((far - near).cwiseAbs().maxCoeff(), 1e-8 * near.cwiseAbs().maxCoeff());
}

TEST(LinearKernels, CornersAndTablesAgree) {
  for (const Body& body : test::all_bodies()) {
    const test::BodyByTables by_tables(body);
    const Body& dense = by_tables.body;
    const Eigen::Matrix3Xd dx = test::random_vectors(body.rest.cols(), 1, 11);
    Eigen::Matrix3Xd a, b;
    make_linear(body.blocks, body.rest)->tangent(body.rest, Projection::none)->stiffness_product(dx, a);
    make_linear(dense.blocks, dense.rest)->tangent(dense.rest, Projection::none)->stiffness_product(dx, b);
    EXPECT_LE((a - b).cwiseAbs().maxCoeff(), 1e-12 * a.cwiseAbs().maxCoeff()) << body.name;
  }
}

TEST(LinearKernels, ElementsWithoutStiffnessOrVolumeGiveNone) {
  Body body = test::hexahedra(2, 0.1);
  const Eigen::Matrix3Xd dx = test::random_vectors(body.rest.cols(), 1, 13);
  for (std::size_t q = 0; q < 8; ++q)
    body.blocks[0].mu[q] = body.blocks[0].lambda[q] = body.blocks[0].volumes[q] = 0;
  for (const Formulation formulation : k_formulations) {
    Eigen::Matrix3Xd found;
    make_linear_as(body.blocks, body.rest, formulation)
        ->tangent(body.rest, Projection::none)
        ->stiffness_product(dx, found);
    EXPECT_TRUE(found.allFinite());
    EXPECT_EQ(found.col(body.blocks[0].nodes[0]), Eigen::Vector3d::Zero());  // no other element has this corner
  }
}

TEST(LinearKernels, ATangentKeepsTheMaterialItWasMadeWith) {
  Body body = test::mixed(3, 0.1);
  const Eigen::Matrix3Xd dx = test::random_vectors(body.rest.cols(), 1, 59);
  auto model = make_linear(body.blocks, body.rest);
  const auto kept = model->tangent(body.rest, Projection::none);
  Eigen::Matrix3Xd before, after, painted;
  kept->stiffness_product(dx, before);
  for (ElementBlock& block : body.blocks)
    for (double& mu : block.mu) mu *= 2;
  model->tangent(body.rest, Projection::none)->stiffness_product(dx, painted);
  model.reset();
  kept->stiffness_product(dx, after);
  EXPECT_EQ(before, after);
  EXPECT_GT((painted - before).norm(), 0.1 * before.norm());
}

TEST(LinearKernels, ThreadsDoNotChangeABit) {
  for (const Body& body : {test::mixed(7, 0.1), test::bspline(3, 0.05)})
    for (const Formulation formulation :
         {Formulation::plain, Formulation::b_bar, Formulation::incompatible_modes}) {
      SCOPED_TRACE(body.name);
      const Eigen::Matrix3Xd x = body.rest + test::random_vectors(body.rest.cols(), 0.05, 53);
      test::expect_the_same_by_any_threads([&] { return make_linear_as(body.blocks, body.rest, formulation); }, x,
                                           x);
    }
}

}  // namespace
}  // namespace argil::fem
