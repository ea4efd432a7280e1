#include "fem/models/lane_polar.h"

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "tests/fem/element_bodies.h"

#pragma GCC diagnostic ignored "-Wpsabi"

namespace argil::fem {
namespace {

using Eigen::Matrix3d;

void put(LaneMatrix& to, int lane, const Matrix3d& f) {
  for (int i = 0; i < 9; ++i) to.m[i][lane] = f(i / 3, i % 3);
}
Matrix3d take(const LaneMatrix& from, int lane) {
  Matrix3d f;
  for (int i = 0; i < 9; ++i) f(i / 3, i % 3) = from.m[i][lane];
  return f;
}
Matrix3d columns(const LaneVector* v, int lane) {
  Matrix3d m;
  for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = v[i % 3].m[i / 3][lane];
  return m;
}

void rotate(const LaneMatrix& f, LaneMatrix& rotation) {
  nearest_rotation(f, rotation, [](const LaneMatrix& m, LaneSvd& svd) { signed_svd(m, svd); });
}

/// From nearly rigid to flat, mirrored, of rank one and nothing.
std::vector<Matrix3d> cases() {
  const Matrix3d r = test::rotation(2.2, {1, -3, 2}), q = test::rotation(0.7, {2, 1, 1});
  std::vector<Matrix3d> result;
  for (const Eigen::Vector3d& s : std::vector<Eigen::Vector3d>{{1, 1, 1},
                                                               {1 + 1e-9, 1, 1 - 1e-9},
                                                               {2, 1, 0.5},
                                                               {1, 1, 1e-9},
                                                               {1, 1, 0},
                                                               {1, 1e-5, 1e-10},
                                                               {3, 0, 0},
                                                               {1, 1, -1},
                                                               {1, 0.5, -0.2},
                                                               {-1, -2, 3},
                                                               {-1, -1, -1},
                                                               {1e-20, 1e-20, 2e-20},
                                                               {1e9, 1e3, 1},
                                                               {1e-70, 0, 0},
                                                               {0, 0, 0}}) {
    result.push_back(s.asDiagonal());
    result.push_back(r * s.asDiagonal() * q.transpose());
  }
  for (unsigned seed = 0; seed < 200; ++seed) result.push_back(test::random_vectors(3, 1, seed));
  return result;
}

TEST(LanePolar, SignedSingularValuesMultiplyToTheMatrix) {
  for (const Matrix3d& f : cases()) {
    LaneMatrix lanes;
    for (int lane = 0; lane < 4; ++lane) put(lanes, lane, f);
    LaneSvd svd;
    signed_svd(lanes, svd);
    const Matrix3d u = columns(svd.u, 2), v = columns(svd.v, 2);
    const Eigen::Vector3d s(svd.sigma.m[0][2], svd.sigma.m[1][2], svd.sigma.m[2][2]);
    // A dozen rotations of three columns, each correct to a few 1e-16.
    EXPECT_LE((u.transpose() * u - Matrix3d::Identity()).norm(), 1e-14) << f;
    EXPECT_LE((v.transpose() * v - Matrix3d::Identity()).norm(), 1e-14) << f;
    EXPECT_NEAR(u.determinant(), 1, 1e-14);
    EXPECT_NEAR(v.determinant(), 1, 1e-14);
    EXPECT_LE((u * s.asDiagonal() * v.transpose() - f).norm(), 1e-14 * f.norm() + 1e-60) << f;
    EXPECT_GE(s[0], s[1]);
    EXPECT_GE(s[1], std::abs(s[2]) - 1e-14 * s[0]);
    EXPECT_EQ(s[2] < -1e-14 * s[0], f.determinant() < -1e-14 * s[0] * s[0] * s[0] && s[0] > 0) << f;
  }
}

TEST(LanePolar, NearestRotationIsNotBeatenByAnyOther) {
  for (const Matrix3d& f : cases()) {
    LaneMatrix lanes, rotation;
    for (int lane = 0; lane < 4; ++lane) put(lanes, lane, f);
    rotate(lanes, rotation);
    const Matrix3d r = take(rotation, 0);
    EXPECT_LE((r.transpose() * r - Matrix3d::Identity()).norm(), 1e-14) << f;
    EXPECT_NEAR(r.determinant(), 1, 1e-14);
    const double best = (r.transpose() * f).trace();
    for (unsigned seed = 0; seed < 30; ++seed) {
      const Eigen::Matrix3Xd axis = test::random_vectors(1, 1, seed);
      for (const double angle : {1e-4, 0.1, 3.0})
        EXPECT_LE(((test::rotation(angle, axis.col(0)) * r).transpose() * f).trace(),
                  best + 1e-14 * f.norm() + 1e-60)
            << f;
    }
  }
}

TEST(LanePolar, NewtonAndSingularValuesAgree) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Matrix3d f =
        test::rotation(seed, {1, 2, 3}) * (Matrix3d::Identity() + 0.5 * Matrix3d(test::random_vectors(3, 1, seed)));
    LaneMatrix lanes, rotation;
    for (int lane = 0; lane < 4; ++lane) put(lanes, lane, f);
    rotate(lanes, rotation);
    LaneSvd svd;
    signed_svd(lanes, svd);
    const double pair = svd.sigma.m[1][0] + svd.sigma.m[2][0];  // R turns by δF/(σ₁ + σ₂)
    EXPECT_LE((take(rotation, 0) - take(outer_sum(svd.u, svd.v), 0)).norm(), 3e-15 * (1 + f.norm() / pair)) << f;
  }
}

TEST(LanePolar, LanesDoNotDependOnEachOther) {
  const std::vector<Matrix3d> all = cases();
  for (std::size_t i = 0; i + 3 < all.size(); ++i) {
    LaneMatrix together, alone, rotations, rotation;
    for (int lane = 0; lane < 4; ++lane) put(together, lane, all[i + static_cast<std::size_t>(lane)]);
    rotate(together, rotations);
    LaneSvd svds, svd;
    signed_svd(together, svds);
    for (int lane = 0; lane < 4; ++lane) {
      for (int other = 0; other < 4; ++other) put(alone, other, all[i + static_cast<std::size_t>(lane)]);
      rotate(alone, rotation);
      signed_svd(alone, svd);
      EXPECT_EQ(take(rotations, lane), take(rotation, 0));
      EXPECT_EQ(columns(svds.u, lane), columns(svd.u, 0));
      EXPECT_EQ(columns(svds.v, lane), columns(svd.v, 0));
    }
  }
}

}  // namespace
}  // namespace argil::fem
