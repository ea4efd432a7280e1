#include "subdiv/cell_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace argil::subdiv {
namespace {

CellLoops loops_of(const std::vector<std::vector<std::uint32_t>>& faces) {
  CellLoops loops;
  for (const auto& face : faces) {
    loops.corners.insert(loops.corners.end(), face.begin(), face.end());
    loops.end_face();
  }
  return loops;
}

// A prism over an n-gon, with vertex numbers that are far apart.
std::vector<std::vector<std::uint32_t>> prism(std::uint32_t n) {
  std::vector<std::vector<std::uint32_t>> faces(2);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = 1000 * i, b = 1000 * ((i + 1) % n);
    faces[0].insert(faces[0].begin(), a);
    faces[1].push_back(a + 1);
    faces.push_back({a, b, b + 1, a + 1});
  }
  return faces;
}

TEST(SphereFault, PrismsOverAnyPolygonAreSpheresInAnyOrderAndRotationOfFaces) {
  std::mt19937 random(7);
  for (const std::uint32_t n : {3U, 4U, 7U, 1000U}) {
    auto faces = prism(n);
    EXPECT_EQ(sphere_fault(loops_of(faces)), "");
    std::shuffle(faces.begin(), faces.end(), random);
    for (auto& face : faces) std::rotate(face.begin(), face.begin() + random() % face.size(), face.end());
    EXPECT_EQ(sphere_fault(loops_of(faces)), "");
  }
}

TEST(SphereFault, WithoutAnyOneFaceOrWithOneTurnedItIsNone) {
  const auto faces = prism(5);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    auto fewer = faces, turned = faces;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    std::reverse(turned[i].begin(), turned[i].end());
    EXPECT_THAT(sphere_fault(loops_of(fewer)), testing::HasSubstr("open"));
    EXPECT_THAT(sphere_fault(loops_of(turned)), testing::HasSubstr("incoherent orientation"));
  }
}

}  // namespace
}  // namespace argil::subdiv
