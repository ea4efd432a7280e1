#include "fem/element_block.h"

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "tests/fem/element_bodies.h"

namespace argil::fem {
namespace {

using test::Body;

double total_volume(const Body& body) {
  double total = 0;
  for (const ElementBlock& block : body.blocks)
    for (const double v : block.volumes) total += v;
  return total;
}

TEST(ElementBlocks, PyramidVolumeIsExact) {
  // Base a skew quadrilateral: V = ∫ (apex − x)·(x_u × x_v)/3 over the bilinear surface, by the divergence
  // theorem (the sides are cones about the apex and give nothing).
  Body body;
  body.rest.resize(3, 5);
  body.rest << 0, 1.1, 1, -0.1, 0.4, 0, 0.1, 1.2, 0.9, 0.6, 0, 0.2, -0.1, 0.3, 1.3;
  body.blocks.resize(1);
  body.blocks[0].kind = &pyramid();
  test::add_element(body.blocks[0], {0, 1, 2, 3, 4});
  ASSERT_EQ(set_rest_geometry(body.blocks[0], body.rest), k_no_point);
  const Eigen::Vector3d a = body.rest.col(0), b = body.rest.col(1), c = body.rest.col(2), d = body.rest.col(3),
                        apex = body.rest.col(4);
  // (x − apex)·(x_u × x_v) has degree two in u and in v: Simpson's rule is exact.
  double exact = 0;
  const double weight[3] = {1.0 / 6, 4.0 / 6, 1.0 / 6};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double u = 0.5 * i, v = 0.5 * j;
      const Eigen::Vector3d x = (1 - u) * (1 - v) * a + u * (1 - v) * b + u * v * c + (1 - u) * v * d;
      const Eigen::Vector3d along_u = (1 - v) * (b - a) + v * (c - d), along_v = (1 - u) * (d - a) + u * (c - b);
      exact += weight[i] * weight[j] * (apex - x).dot(along_u.cross(along_v)) / 3;
    }
  EXPECT_NEAR(total_volume(body), exact, 1e-15);
}

TEST(ElementBlocks, PyramidsFillTheCellThatTheyDivide) {
  // The same random grid as hexahedra and as pyramids: faces are the same bilinear surfaces, so volumes are equal.
  EXPECT_NEAR(total_volume(test::pyramids(3, 0.15)), total_volume(test::hexahedra(3, 0.15)), 1e-14);
}

TEST(ElementBlocks, BsplineVolumeIsThatOfItsAffineNet) {
  // A uniform net of spacing 1/n: n³ elements fill a unit cube, whatever affine map it is put through.
  Body body = test::bspline(2, 0, 0);
  Eigen::Matrix3d map;
  map << 2, 0.3, 0, 0.1, 1, 0.4, 0, 0, 0.5;
  body.rest = map * body.rest;
  test::finish(body);
  EXPECT_NEAR(total_volume(body), map.determinant(), 1e-14);
}

TEST(ElementBlocks, InverseJacobiansGiveTheIdentityForPositionItself) {
  for (const Body& body : test::all_bodies())
    for (const ElementBlock& block : body.blocks)
      for (std::size_t e = 0; e < block.element_count(); ++e)
        for (int p = 0; p < block.kind->point_count; ++p) {
          Eigen::Matrix3d f = Eigen::Matrix3d::Zero();
          for (int n = 0; n < block.kind->node_count; ++n) {
            const double* g = &block.kind->gradients[static_cast<std::size_t>(p * block.kind->node_count + n) * 3];
            f += body.rest.col(block.nodes[e * static_cast<std::size_t>(block.kind->node_count) +
                                           static_cast<std::size_t>(n)]) *
                 Eigen::RowVector3d(g[0], g[1], g[2]) * block.inverse_rest_jacobians[block.point_index(e, p)];
          }
          // Flat pyramids of the distorted grids have condition numbers up to about 100.
          EXPECT_LE((f - Eigen::Matrix3d::Identity()).norm(), 1e-13) << body.name;
        }
}

TEST(ElementBlocks, NamesTheFirstPointThatIsInsideOut) {
  Body body = test::hexahedra(2, 0);
  const std::uint32_t node = body.blocks[0].nodes[3 * 8 + 7];  // far corner of element 3
  body.rest.col(node) -= Eigen::Vector3d(0, 0, 2);
  const std::size_t bad = set_rest_geometry(body.blocks[0], body.rest);
  ASSERT_NE(bad, k_no_point);
  EXPECT_LE(body.blocks[0].volumes[bad], 0);
  for (std::size_t i = 0; i < bad; ++i) EXPECT_GT(body.blocks[0].volumes[i], 0);
}

}  // namespace
}  // namespace argil::fem
