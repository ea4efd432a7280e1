#include "fem/measure/shown_elements.h"

#include <algorithm>

#include "fem/material.h"
#include "fem/measure/recovery.h"
#include "fem/measure/strain.h"
#include "fem/measure/stress.h"
#include "subdiv/build.h"
#include "subdiv/neighbourhood.h"
#include "subdiv/radial_edge.h"

namespace argil::fem {

namespace {

using namespace subdiv;

// The k-th largest of three: by stress they need not be in the order of the stretches.
double ordered(Eigen::Vector3d values, int order) {
  std::sort(values.data(), values.data() + 3);
  return values[2 - order];
}

// Material at the points, interpolated from values at the nodes; an apex takes the mean of its base, which is as
// far as pictures need it.
void set_lame(ElementBlock& block, const NodalFields& fields, std::size_t vertex_count) {
  const auto nodes = static_cast<std::size_t>(block.kind->node_count);
  if (fields.prestress.size() > 0 && !fields.prestress.isZero(0)) block.prestress.resize(block.mu.size());
  for (std::size_t e = 0; e < block.element_count(); ++e)
    for (int q = 0; q < block.kind->point_count; ++q) {
      double young = 0, poisson = 0, prestress = 0, sum = 0;
      for (std::size_t a = 0; a < nodes; ++a) {
        const std::uint32_t node = block.nodes[e * nodes + a];
        if (node >= vertex_count) continue;
        const double weight = block.kind->shapes[static_cast<std::size_t>(q) * nodes + a];
        young += weight * fields.young_modulus[node];
        poisson += weight * fields.poisson_ratio[node];
        if (!block.prestress.empty()) prestress += weight * fields.prestress[node];
        sum += weight;
      }
      const Lame point = lame(young / sum, poisson / sum);
      block.mu[block.point_index(e, q)] = point.mu;
      block.lambda[block.point_index(e, q)] = point.lambda;
      if (!block.prestress.empty()) block.prestress[block.point_index(e, q)] = prestress / sum;
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

bool ShownElements::take_flow(const PlasticFlow& flow) {
  if (!fits(flow, blocks_)) return false;
  flowed_blocks_ = blocks_;
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    for (std::size_t i = 0; i < flow.inverse[b].size(); ++i)
      flowed_blocks_[b].inverse_rest_jacobians[i] = blocks_[b].inverse_rest_jacobians[i] * flow.inverse[b][i];
  plastic_strains_.clear();
  for (const std::vector<double>& strains : fem::plastic_strain(flow))
    plastic_strains_.emplace_back(
        Eigen::Map<const Eigen::VectorXd>(strains.data(), static_cast<Eigen::Index>(strains.size())));
  return true;
}

Eigen::VectorXd ShownElements::plastic_strain() const {
  if (plastic_strains_.empty()) return Eigen::VectorXd::Zero(vertex_count_);
  const std::size_t nodes = static_cast<std::size_t>(vertex_count_) + apex_cells_.size();
  return recover_at_nodes(blocks_, plastic_strains_, nodes).head(vertex_count_);
}

Eigen::VectorXd ShownElements::recovered(const std::vector<ElementBlock>& blocks, const Eigen::Matrix3Xd& vertices,
                                         const OfBlock& point_values) const {
  const Eigen::Matrix3Xd nodes = with_apexes(vertices);
  std::vector<Eigen::VectorXd> values;
  for (const ElementBlock& block : blocks) values.push_back(point_values(block, nodes));
  return recover_at_nodes(blocks, values, static_cast<std::size_t>(nodes.cols())).head(vertex_count_);
}

Eigen::VectorXd ShownElements::equivalent_strain(const Eigen::Matrix3Xd& vertices) const {
  return recovered(blocks_, vertices, [](const ElementBlock& block, const Eigen::Matrix3Xd& nodes) {
    return fem::equivalent_strain(block, nodes);
  });
}

Eigen::VectorXd ShownElements::von_mises_stress(const Eigen::Matrix3Xd& vertices, StressLaw law) const {
  return recovered(stressed_blocks(), vertices, [&](const ElementBlock& block, const Eigen::Matrix3Xd& nodes) {
    return fem::von_mises_stress(block, nodes, law);
  });
}

Eigen::VectorXd ShownElements::principal_strain(const Eigen::Matrix3Xd& vertices, int order) const {
  return recovered(blocks_, vertices, [&](const ElementBlock& block, const Eigen::Matrix3Xd& nodes) {
    const Eigen::Matrix3Xd stretches = principal_stretches(block, nodes);
    Eigen::VectorXd result(stretches.cols());
    for (Eigen::Index i = 0; i < result.size(); ++i) result[i] = stretches(order, i) - 1;
    return result;
  });
}

Eigen::VectorXd ShownElements::principal_stress(const Eigen::Matrix3Xd& vertices, int order, StressLaw law) const {
  return recovered(stressed_blocks(), vertices, [&](const ElementBlock& block, const Eigen::Matrix3Xd& nodes) {
    const Eigen::Matrix3Xd stresses = principal_stresses(block, nodes, law ? law : stress_law("corotational"));
    Eigen::VectorXd result(stresses.cols());
    for (Eigen::Index i = 0; i < result.size(); ++i) result[i] = ordered(stresses.col(i), order);
    return result;
  });
}

Eigen::VectorXd ShownElements::pressure(const Eigen::Matrix3Xd& vertices, StressLaw law) const {
  return recovered(stressed_blocks(), vertices, [&](const ElementBlock& block, const Eigen::Matrix3Xd& nodes) {
    const Eigen::Matrix3Xd stresses = principal_stresses(block, nodes, law ? law : stress_law("corotational"));
    Eigen::VectorXd result(stresses.cols());
    for (Eigen::Index i = 0; i < result.size(); ++i)
      result[i] = -(stresses(0, i) + stresses(1, i) + stresses(2, i)) / 3;
    return result;
  });
}

Eigen::VectorXd ShownElements::distortion(const Eigen::Matrix3Xd& vertices) const {
  return recovered(blocks_, vertices, [](const ElementBlock& block, const Eigen::Matrix3Xd& nodes) {
    const Eigen::Matrix3Xd stretches = principal_stretches(block, nodes);
    Eigen::VectorXd result(stretches.cols());
    for (Eigen::Index i = 0; i < result.size(); ++i)
      result[i] = stretches(0, i) * stretches(1, i) * stretches(2, i) - 1;
    return result;
  });
}

}  // namespace argil::fem
