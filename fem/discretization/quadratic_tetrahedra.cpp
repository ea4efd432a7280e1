#include "fem/discretization/quadratic_tetrahedra.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <unordered_map>

#include "fem/elements/gauss.h"
#include "fem/elements/quadratic_tetrahedron.h"
#include "fem/material.h"
#include "fem/solvers/block_accumulator.h"
#include "subdiv/error.h"
#include "subdiv/radial_edge.h"

namespace argil::fem {
namespace {

using subdiv::CellId;
using subdiv::FaceId;
using subdiv::FaceUseId;
using subdiv::Solid;
using subdiv::VertexId;

/// Nodes as means of vertices: the vertices, then what is added.
struct Points {
  subdiv::Stencils from_vertices;
  std::uint32_t add(std::vector<std::uint32_t> vertices) {
    std::sort(vertices.begin(), vertices.end());
    const double weight = 1.0 / static_cast<double>(vertices.size());
    from_vertices.append(vertices, std::vector<double>(vertices.size(), weight));
    return static_cast<std::uint32_t>(from_vertices.row_count() - 1);
  }
};

std::vector<std::uint32_t> values_of(std::span<const VertexId> vertices) {
  std::vector<std::uint32_t> result;
  for (const VertexId v : vertices) result.push_back(v.value);
  return result;
}

/// Corners of the tetrahedra; the points they name are in `points`.
std::vector<std::uint32_t> split(const Solid& solid, Points& points, std::vector<ElementOrigin>& origins) {
  std::vector<std::uint32_t> corners, face_centres(solid.face_capacity(), 0);
  for (const FaceId f : solid.faces()) face_centres[f.index()] = points.add(values_of(solid.face_vertices(f)));
  for (const CellId c : solid.cells()) {
    const std::uint32_t centre = points.add(values_of(subdiv::cell_vertices(solid, c)));
    std::uint32_t part = 0;
    for (const FaceUseId use : solid.cell_face_uses(c)) {
      const auto loop = subdiv::use_vertices(solid, use);  // counter-clockwise from outside
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::uint32_t next = loop[(i + 1) % loop.size()].value;
        corners.insert(corners.end(), {face_centres[subdiv::face_of(use).index()], next, loop[i].value, centre});
        origins.push_back({0, c.value, part++});
      }
    }
  }
  return corners;
}

/// Adds the middles of edges as nodes: all nodes of the block from its corners.
std::vector<std::uint32_t> with_middles(const std::vector<std::uint32_t>& corners, std::uint32_t first,
                                        std::vector<std::array<std::uint32_t, 2>>& edges) {
  constexpr int k_edges[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
  std::unordered_map<std::uint64_t, std::uint32_t> numbers;
  std::vector<std::uint32_t> nodes;
  for (std::size_t t = 0; t < corners.size(); t += 4) {
    nodes.insert(nodes.end(), corners.begin() + static_cast<std::ptrdiff_t>(t),
                 corners.begin() + static_cast<std::ptrdiff_t>(t) + 4);
    for (const auto& edge : k_edges) {
      const auto [a, b] = std::minmax(corners[t + static_cast<std::size_t>(edge[0])],
                                      corners[t + static_cast<std::size_t>(edge[1])]);
      const auto [found, is_new] = numbers.try_emplace(static_cast<std::uint64_t>(a) << 32 | b,
                                                       first + static_cast<std::uint32_t>(edges.size()));
      if (is_new) edges.push_back({a, b});
      nodes.push_back(found->second);
    }
  }
  return nodes;
}

double at_point(const Eigen::VectorXd& values, const std::uint32_t* corners, const Eigen::Vector3d& uvw) {
  if (values.size() == 0) return 0;
  return (1 - uvw[0] - uvw[1] - uvw[2]) * values[corners[0]] + uvw[0] * values[corners[1]] +
         uvw[1] * values[corners[2]] + uvw[2] * values[corners[3]];
}

void set_materials(ElementBlock& block, const NodalFields& at_nodes) {
  if (at_nodes.stiffness_damping.size() > 0) block.stiffness_damping.resize(block.mu.size());
  if (at_nodes.prestress.size() > 0) block.prestress.resize(block.mu.size());
  for (std::size_t e = 0; e < block.element_count(); ++e) {
    const std::uint32_t* corners = block.nodes.data() + 10 * e;
    for (int q = 0; q < block.kind->point_count; ++q) {
      const std::size_t i = block.point_index(e, q);
      const Eigen::Vector3d& uvw = block.kind->points[static_cast<std::size_t>(q)];
      const Lame constants =
          lame(at_point(at_nodes.young_modulus, corners, uvw), at_point(at_nodes.poisson_ratio, corners, uvw));
      block.mu[i] = constants.mu;
      block.lambda[i] = constants.lambda;
      block.density[i] = at_point(at_nodes.density, corners, uvw);
      block.damping[i] = at_point(at_nodes.damping, corners, uvw);
      if (!block.stiffness_damping.empty())
        block.stiffness_damping[i] = at_point(at_nodes.stiffness_damping, corners, uvw);
      if (!block.prestress.empty()) block.prestress[i] = at_point(at_nodes.prestress, corners, uvw);
    }
  }
}

/// Gauss points of the cube collapsed to the simplex: exact to degree 5, which density times two shapes has.
struct MassRule {
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;  // summing to 1/6
  std::vector<Eigen::VectorXd> shapes;
};
MassRule mass_rule() {
  const GaussRule rule = gauss_rule(4);
  MassRule result;
  Eigen::Matrix3Xd gradients;
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = 0; b < 4; ++b)
      for (std::size_t c = 0; c < 4; ++c) {
        const double u = rule.points[a], left = 1 - u, v = left * rule.points[b], rest = left - v;
        result.points.emplace_back(u, v, rest * rule.points[c]);
        result.weights.push_back(rule.weights[a] * rule.weights[b] * rule.weights[c] * left * rest);
        quadratic_tetrahedron().evaluate(result.points.back(), result.shapes.emplace_back(), gradients);
      }
  return result;
}

void set_mass(Discretization& to, const NodalFields& at_nodes) {
  const ElementBlock& block = to.blocks.front();
  const MassRule rule = mass_rule();
  BlockAccumulator mass(1), damping(1);
  for (std::size_t e = 0; e < block.element_count(); ++e) {
    const std::uint32_t* nodes = block.nodes.data() + 10 * e;
    const double determinant = block.volumes[block.point_index(e, 0)] / block.kind->weights[0];  // straight edges
    Eigen::Matrix<double, 10, 10> element_mass, element_damping;
    element_mass.setZero();
    element_damping.setZero();
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const double m = rule.weights[q] * determinant * at_point(at_nodes.density, nodes, rule.points[q]);
      const Eigen::VectorXd& n = rule.shapes[q];
      element_mass += m * n * n.transpose();
      element_damping += m * at_point(at_nodes.damping, nodes, rule.points[q]) * n * n.transpose();
      to.total_mass += m;
    }
    for (int q = 0; q < block.kind->point_count; ++q) to.rest_volume += block.volumes[block.point_index(e, q)];
    for (int b = 0; b < 10; ++b)
      for (int a = 0; a < 10; ++a) {
        *mass.block(nodes[a], nodes[b]) += element_mass(a, b);
        *damping.block(nodes[a], nodes[b]) += element_damping(a, b);
      }
  }
  to.mass = mass.matrix(to.nodes.node_count());
  to.damping = damping.matrix(to.nodes.node_count());
}

}  // namespace

Discretization quadratic_tetrahedra(const Solid& solid, const Eigen::Matrix3Xd& positions,
                                    const NodalFields& fields) {
  Discretization result;
  result.cells = count_cells(solid);
  ElementBlock& block = result.blocks.emplace_back();
  block.kind = &quadratic_tetrahedron();
  Points points{subdiv::Stencils::identity(solid.vertex_capacity())};
  const std::vector<std::uint32_t> corners = split(solid, points, block.origins);
  const auto corner_count = static_cast<std::uint32_t>(points.from_vertices.row_count());
  std::vector<std::array<std::uint32_t, 2>> edges;
  block.nodes = with_middles(corners, corner_count, edges);

  const std::size_t nodes = corner_count + edges.size();
  result.rest_nodes.resize(3, static_cast<Eigen::Index>(nodes));
  result.rest_nodes.leftCols(corner_count) = subdiv::apply(points.from_vertices, positions);
  for (std::size_t e = 0; e < edges.size(); ++e)
    result.rest_nodes.col(static_cast<Eigen::Index>(corner_count + e)) =
        0.5 * (result.rest_nodes.col(edges[e][0]) + result.rest_nodes.col(edges[e][1]));
  result.nodes.rows = subdiv::Stencils::identity(nodes);
  result.nodes.level_begin = {0, solid.vertex_capacity()};
  result.nodes.virtual_centre_begin = solid.vertex_capacity();
  result.nodes.phantom_begin = result.nodes.limit_begin = nodes;
  result.rows_transposed = subdiv::Stencils::identity(nodes);
  for (std::uint32_t v = 0; v < solid.vertex_capacity(); ++v) result.surface_node_from_vertex.push_back(v);

  const std::size_t bad = set_rest_geometry(block, result.rest_nodes);
  if (bad != k_no_point) {
    const std::uint32_t cell = block.origins[bad / static_cast<std::size_t>(block.kind->point_count)].cell;
    throw Error(ErrorCode::bad_geometry,
                fmt::format("Tetrahedra need cells whose centre sees all their faces, but cell {} has one that it "
                            "does not see. Move its vertices apart, or refine the solid first.",
                            cell),
                fmt::format("level 0, cell {}", cell));
  }
  const auto sampled = [&](const Eigen::VectorXd& values) {
    return values.size() > 0 ? subdiv::apply(points.from_vertices, values) : Eigen::VectorXd();
  };
  const NodalFields at_nodes{sampled(fields.young_modulus),     sampled(fields.poisson_ratio),
                             sampled(fields.density),           sampled(fields.damping),
                             sampled(fields.stiffness_damping), sampled(fields.prestress)};
  set_materials(block, at_nodes);
  set_mass(result, at_nodes);
  return result;
}

}  // namespace argil::fem
