#pragma once
// What tests of kernels hold against each other: bits, element kinds known by their tables only, numbers of
// threads.

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cstring>

#include "fem/models/force_model.h"
#include "tests/fem/element_bodies.h"

namespace argil::fem::test {

inline bool same_bits(const std::vector<FourDoubles>& a, const std::vector<FourDoubles>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(FourDoubles)) == 0;
}

/// A body with copies of its element kinds: at other addresses, they are taken as kinds without a shape of their
/// own.
struct BodyByTables {
  explicit BodyByTables(const Body& of) : body(of) {
    kinds.reserve(body.blocks.size());
    for (ElementBlock& block : body.blocks) {
      kinds.push_back(*block.kind);
      block.kind = &kinds.back();
    }
  }
  BodyByTables(const BodyByTables&) = delete;
  BodyByTables& operator=(const BodyByTables&) = delete;

  Body body;
  std::vector<ElementKind> kinds;
};

/// Forces and energy at x, products with dx and element tangents of what make() gives, by one thread and by four.
template <class Make>
void expect_the_same_by_any_threads(const Make& make, const Eigen::Matrix3Xd& x, const Eigen::Matrix3Xd& dx) {
  Eigen::Matrix3Xd forces[2], products[2];
  double energies[2], sums[2] = {0, 0};
  for (const int many : {0, 1}) {
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, many ? 4 : 1);
    const std::unique_ptr<ForceModel> model = make();
    model->forces(x, forces[many]);
    energies[many] = model->energy(x);
    const auto tangent = model->tangent(x, Projection::positive_semidefinite);
    tangent->stiffness_product(dx, products[many]);
    tangent->element_tangents([&](std::span<const std::uint32_t>, const Eigen::MatrixXd& stiffness) {
      sums[many] = 0.9 * sums[many] + stiffness(1, 2);  // feels the order
    });
  }
  EXPECT_EQ(forces[0], forces[1]);
  EXPECT_EQ(products[0], products[1]);
  EXPECT_EQ(energies[0], energies[1]);
  EXPECT_EQ(sums[0], sums[1]);
}

}  // namespace argil::fem::test
