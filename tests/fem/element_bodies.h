#pragma once
// Small distorted bodies of each element kind, in blocks over one node table, for the tests of force models.

#include <Eigen/Dense>
#include <array>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "fem/element_block.h"
#include "fem/elements/quadratic_tetrahedron.h"
#include "fem/material.h"

namespace argil::fem::test {

struct Body {
  std::string name;
  std::vector<ElementBlock> blocks;
  Eigen::Matrix3Xd rest;
  std::vector<std::uint32_t> interior;  // nodes whose elements surround them
};

inline Eigen::Matrix3Xd random_vectors(Eigen::Index count, double size, unsigned seed) {
  std::mt19937 generator(seed);  // its sequence is fixed by the standard, unlike that of distributions
  Eigen::Matrix3Xd result(3, count);
  for (Eigen::Index i = 0; i < result.size(); ++i)
    result.data()[i] = size * (2.0 * static_cast<double>(generator()) / 4294967295.0 - 1);
  return result;
}

inline Eigen::Matrix3d rotation(double angle, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

inline void add_element(ElementBlock& block, const std::vector<std::uint32_t>& nodes) {
  block.nodes.insert(block.nodes.end(), nodes.begin(), nodes.end());
  block.origins.push_back({});
}

/// Geometry and a material that differs from point to point (or not).
inline void finish(Body& body, double poisson_ratio = 0.3, bool uniform = false) {
  for (ElementBlock& block : body.blocks) {
    if (set_rest_geometry(block, body.rest) != k_no_point) throw std::logic_error("inverted test body");
    for (std::size_t i = 0; i < block.mu.size(); ++i) {
      const Lame material = lame(uniform ? 1000.0 : 1000.0 + 10.0 * static_cast<double>(i % 7), poisson_ratio);
      block.mu[i] = material.mu;
      block.lambda[i] = material.lambda;
      block.density[i] = 1;
      block.damping[i] = 0;
    }
  }
}

/// A unit cube of n³ cells (h = 1/n) whose nodes are moved by up to `distortion` h; cells where pyramids(cell) are
/// split into six about their centres.
template <class Pyramids>
Body grid_body(const std::string& name, int n, double distortion, const Pyramids& pyramids) {
  Body body{name, {}, {}, {}};
  ElementBlock hexahedra, pyramid_block;
  hexahedra.kind = &trilinear_hexahedron();
  pyramid_block.kind = &pyramid();
  const int m = n + 1;
  std::vector<Eigen::Vector3d> nodes;
  const Eigen::Matrix3Xd moves = random_vectors(m * m * m, distortion / n, 3);
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j)
      for (int k = 0; k < m; ++k) {
        const auto index = static_cast<std::uint32_t>(nodes.size());
        nodes.push_back(Eigen::Vector3d(i, j, k) / n + moves.col(index));
        if (i && j && k && i < n && j < n && k < n) body.interior.push_back(index);
      }
  int cell = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k, ++cell) {
        std::vector<std::uint32_t> corners;
        for (int c = 0; c < 8; ++c)
          corners.push_back(
              static_cast<std::uint32_t>((i + (c >> 2)) * m * m + (j + (c >> 1 & 1)) * m + k + (c & 1)));
        if (!pyramids(cell)) {
          add_element(hexahedra, corners);
          continue;
        }
        Eigen::Vector3d centre = Eigen::Vector3d::Zero();
        for (const auto c : corners) centre += nodes[c] / 8;
        const auto apex = static_cast<std::uint32_t>(nodes.size());
        nodes.push_back(centre);
        body.interior.push_back(apex);
        // Faces counter-clockwise seen from inside.
        constexpr int k_faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
        for (const auto& face : k_faces)
          add_element(
              pyramid_block,
              {corners[static_cast<std::size_t>(face[0])], corners[static_cast<std::size_t>(face[1])],
               corners[static_cast<std::size_t>(face[2])], corners[static_cast<std::size_t>(face[3])], apex});
      }
  body.rest.resize(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) body.rest.col(static_cast<Eigen::Index>(i)) = nodes[i];
  for (ElementBlock* block : {&hexahedra, &pyramid_block})
    if (block->element_count()) body.blocks.push_back(*block);
  finish(body);
  return body;
}

inline Body hexahedra(int n, double distortion) {
  return grid_body("hexahedra", n, distortion, [](int) { return false; });
}
inline Body pyramids(int n, double distortion) {
  return grid_body("pyramids", n, distortion, [](int) { return true; });
}
inline Body mixed(int n, double distortion) {
  return grid_body("mixed", n, distortion, [](int cell) { return cell % 3 == 1; });
}

/// A cell of eight quadrilaterals, as a vertex with four edges leaves it, in pyramids; four hexahedra on top of it.
/// Vertices: 0 the old vertex, 1–4 edge points, 5–8 face points, 9 the cell point, 10 the apex, 11–19 the upper
/// side.
inline Body irregular_cell(double distortion) {
  Body body{"irregular_cell", {}, {}, {0, 10}};
  body.rest.resize(3, 20);
  body.rest.col(0) << 0, 0, 1;
  for (int i = 0; i < 4; ++i) {
    const double angle = 0.5 * M_PI * i;
    body.rest.col(1 + i) << std::cos(angle), std::sin(angle), 0.6;
    body.rest.col(5 + i) << 1.1 * std::cos(angle + M_PI / 4), 1.1 * std::sin(angle + M_PI / 4), 0.1;
  }
  body.rest.col(9) << 0, 0, -0.8;
  body.rest.col(10) << 0, 0, 0.1;
  for (int i = 0; i < 9; ++i) body.rest.col(11 + i) = body.rest.col(i) * 1.3 + Eigen::Vector3d(0, 0, 0.9);
  body.rest += random_vectors(20, distortion, 5);
  body.blocks.resize(2);
  body.blocks[0].kind = &pyramid();
  body.blocks[1].kind = &trilinear_hexahedron();
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t next = (i + 1) % 4, e = 1 + i, f = 5 + i, e_next = 1 + next, f_before = 5 + (i + 3) % 4;
    add_element(body.blocks[0], {0, e_next, f, e, 10});
    add_element(body.blocks[0], {9, f_before, e, f, 10});
    // Corner (u, v, w) at 4u + 2v + w, w upwards.
    add_element(body.blocks[1], {0, 11, e_next, 11 + e_next, e, 11 + e, f, 11 + f});
  }
  finish(body);
  return body;
}

/// n³ tricubic elements on a net of (n + 3)³ points; `stretch` makes the layers unequal, `distortion` moves them.
inline Body bspline(int n, double distortion, double stretch = 0.2) {
  Body body{"bspline", {}, {}, {}};
  body.blocks.resize(1);
  body.blocks[0].kind = &bspline_hexahedron();
  const int m = n + 3;
  body.rest = random_vectors(m * m * m, distortion / n, 4);
  const auto at = [&](int i) { return (i + stretch * std::sin(1.7 * i)) / n; };
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j)
      for (int k = 0; k < m; ++k) {
        body.rest.col((i * m + j) * m + k) += Eigen::Vector3d(at(i), at(j), at(k));
        const auto inside = [&](int a) { return a > 2 && a < m - 3; };
        if (inside(i) && inside(j) && inside(k))
          body.interior.push_back(static_cast<std::uint32_t>((i * m + j) * m + k));
      }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        std::vector<std::uint32_t> net;
        for (int a = 0; a < 64; ++a)
          net.push_back(static_cast<std::uint32_t>(((i + a / 16) * m + j + a / 4 % 4) * m + k + a % 4));
        add_element(body.blocks[0], net);
      }
  finish(body);
  return body;
}

/// The grid of hexahedra(n, distortion), each cell in the six ten-node tetrahedra about its diagonal.
inline Body tetrahedra(int n, double distortion) {
  const Body grid = hexahedra(n, distortion);
  Body body{"tetrahedra", std::vector<ElementBlock>(1), {}, grid.interior};
  body.blocks[0].kind = &quadratic_tetrahedron();
  std::vector<Eigen::Vector3d> nodes;
  for (Eigen::Index i = 0; i < grid.rest.cols(); ++i) nodes.push_back(grid.rest.col(i));
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  // Paths along the axes x y z (4, 2, 1 in the numbers of corners) from one end of the diagonal to the other; those
  // of the second half turn the other way.
  constexpr std::size_t k_paths[6][3] = {{4, 2, 1}, {2, 1, 4}, {1, 4, 2}, {2, 4, 1}, {4, 1, 2}, {1, 2, 4}};
  for (std::size_t cell = 0; cell < grid.blocks[0].element_count(); ++cell)
    for (std::size_t path = 0; path < 6; ++path) {
      const std::uint32_t* corners = grid.blocks[0].nodes.data() + 8 * cell;
      const std::size_t first = k_paths[path][0], second = first + k_paths[path][1];
      std::vector<std::uint32_t> element{corners[0], corners[first], corners[second], corners[7]};
      if (path >= 3) std::swap(element[1], element[2]);
      for (const auto& edge : {std::array<std::size_t, 2>{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}) {
        const std::pair<std::uint32_t, std::uint32_t> ends = std::minmax(element[edge[0]], element[edge[1]]);
        const auto [found, is_new] = middles.try_emplace(ends, static_cast<std::uint32_t>(nodes.size()));
        if (is_new) nodes.push_back(0.5 * (nodes[ends.first] + nodes[ends.second]));
        element.push_back(found->second);
      }
      add_element(body.blocks[0], element);
    }
  body.rest.resize(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) body.rest.col(static_cast<Eigen::Index>(i)) = nodes[i];
  finish(body);
  return body;
}

inline std::vector<Body> all_bodies() {
  return {hexahedra(2, 0.2),    pyramids(1, 0.15), mixed(3, 0.15),
          irregular_cell(0.05), bspline(1, 0.1),   bspline(2, 0.05)};
}

}  // namespace argil::fem::test
