#include "fem/measure/shown_elements.h"

#include "fem/material.h"
#include "fem/measure/strain.h"
#include "fem/measure/stress.h"
#include "subdiv/build.h"
#include "subdiv/neighbourhood.h"
#include "subdiv/radial_edge.h"

namespace argil::fem {

namespace {

using namespace subdiv;

// Material at the points, interpolated from values at the nodes; an apex takes the mean of its base, which is as
// far as pictures need it.
void set_lame(ElementBlock& block, const NodalFields& fields, std::size_t vertex_count) {
  const auto nodes = static_cast<std::size_t>(block.kind->node_count);
  for (std::size_t e = 0; e < block.element_count(); ++e)
    for (int q = 0; q < block.kind->point_count; ++q) {
      double young = 0, poisson = 0, sum = 0;
      for (std::size_t a = 0; a < nodes; ++a) {
        const std::uint32_t node = block.nodes[e * nodes + a];
        if (node >= vertex_count) continue;
        const double weight = block.kind->shapes[static_cast<std::size_t>(q) * nodes + a];
        young += weight * fields.young_modulus[node];
        poisson += weight * fields.poisson_ratio[node];
        sum += weight;
      }
      const Lame point = lame(young / sum, poisson / sum);
      block.mu[block.point_index(e, q)] = point.mu;
      block.lambda[block.point_index(e, q)] = point.lambda;
    }
}

}  // namespace

ShownElements::ShownElements(const Solid& finest, const Eigen::Matrix3Xd& rest_vertices, const NodalFields& fields)
    : vertex_count_(rest_vertices.cols()) {
  ElementBlock hexahedra, pyramids;
  hexahedra.kind = &trilinear_hexahedron();
  pyramids.kind = &pyramid();
  for (const CellId c : finest.cells()) {
    if (cell_kind(finest, c) == CellKind::hexahedron) {
      for (const VertexId v : box_vertices(finest, c)) hexahedra.nodes.push_back(v.value);
      hexahedra.origins.push_back({0, c.value, 0});
      continue;
    }
    const auto apex = static_cast<std::uint32_t>(vertex_count_ + static_cast<Eigen::Index>(apex_cells_.size()));
    apex_cells_.push_back(cell_vertices(finest, c));
    std::uint32_t part = 0;
    for (const FaceUseId use : finest.cell_face_uses(c)) {
      const auto loop = use_vertices(finest, use);
      if (loop.size() != 4) continue;  // only the control level has such faces, and it is not simulated then
      // Counter-clockwise from outside is clockwise from the apex.
      for (const std::size_t corner : {0, 3, 2, 1}) pyramids.nodes.push_back(loop[corner].value);
      pyramids.nodes.push_back(apex);
      pyramids.origins.push_back({0, c.value, part++});
    }
  }
  const Eigen::Matrix3Xd rest = with_apexes(rest_vertices);
  for (ElementBlock* block : {&hexahedra, &pyramids}) {
    if (block->element_count() == 0) continue;
    (void)set_rest_geometry(*block, rest);  // where it is not positive the strain shown is large, as it should be
    set_lame(*block, fields, static_cast<std::size_t>(vertex_count_));
    blocks_.push_back(std::move(*block));
  }
}

Eigen::Matrix3Xd ShownElements::with_apexes(const Eigen::Matrix3Xd& vertices) const {
  Eigen::Matrix3Xd nodes(3, vertex_count_ + static_cast<Eigen::Index>(apex_cells_.size()));
  nodes.leftCols(vertex_count_) = vertices;
  for (std::size_t i = 0; i < apex_cells_.size(); ++i) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const VertexId v : apex_cells_[i]) sum += vertices.col(static_cast<Eigen::Index>(v.index()));
    nodes.col(vertex_count_ + static_cast<Eigen::Index>(i)) = sum / static_cast<double>(apex_cells_[i].size());
  }
  return nodes;
}

Eigen::VectorXd ShownElements::equivalent_strain(const Eigen::Matrix3Xd& vertices) const {
  return fem::equivalent_strain(blocks_, with_apexes(vertices)).head(vertex_count_);
}

Eigen::VectorXd ShownElements::von_mises_stress(const Eigen::Matrix3Xd& vertices) const {
  return fem::von_mises_stress(blocks_, with_apexes(vertices)).head(vertex_count_);
}

}  // namespace argil::fem
