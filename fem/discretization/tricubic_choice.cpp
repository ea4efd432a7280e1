#include "fem/discretization/tricubic_choice.h"

#include <cassert>
#include <cmath>

#include "fem/discretization/numbering.h"

namespace argil::fem {

namespace {

using subdiv::CellClass;
using subdiv::CellId;
using subdiv::VertexId;
using Box = std::array<VertexId, 8>;

constexpr double k_trilinear_tolerance = 1e-12;

bool is_constant(const Eigen::VectorXd& values) {
  return values.size() == 0 || values.minCoeff() == values.maxCoeff();
}

/// Asks whether the fields at the finest vertices inside a cell are what trilinear interpolation of its corners
/// gives.
class TrilinearTest {
 public:
  TrilinearTest(const subdiv::Refinement& refinement, const NodalFields& fields,
                const std::vector<std::vector<std::uint32_t>>& finest)
      : refinement_(refinement), finest_(finest) {
    for (const Eigen::VectorXd* field :
         {&fields.young_modulus, &fields.poisson_ratio, &fields.density, &fields.damping})
      if (!is_constant(*field)) varying_.push_back(field);
    if (varying_.empty()) return;
    for (int l = 0; l < refinement.finest(); ++l) {
      const auto level = static_cast<std::size_t>(l);
      next_.emplace_back(refinement.levels[level]);
      children_.push_back(children(refinement.parent[level + 1], refinement.levels[level].cell_capacity()));
    }
  }

  bool operator()(std::size_t level, CellId cell) const {
    if (varying_.empty()) return true;
    const Box box = subdiv::box_vertices(refinement_.levels[level], cell);
    for (const Eigen::VectorXd* field : varying_) {
      std::array<double, 8> corners{};
      double largest = 0;
      for (std::size_t c = 0; c < 8; ++c) {
        corners[c] = (*field)[finest_[level][box[c].index()]];
        largest = std::max(largest, std::abs(corners[c]));
      }
      if (!holds(*field, corners, k_trilinear_tolerance * largest, level, cell, box, Eigen::Vector3d::Zero(), 1.0))
        return false;
    }
    return true;
  }

 private:
  static double trilinear(const std::array<double, 8>& corners, const Eigen::Vector3d& uvw) {
    double sum = 0;
    for (std::size_t c = 0; c < 8; ++c)
      sum += corners[c] * ((c & 4) ? uvw[0] : 1 - uvw[0]) * ((c & 2) ? uvw[1] : 1 - uvw[1]) *
             ((c & 1) ? uvw[2] : 1 - uvw[2]);
    return sum;
  }

  bool holds(const Eigen::VectorXd& field, const std::array<double, 8>& corners, double tolerance,
             std::size_t level, CellId cell, const Box& box, const Eigen::Vector3d& origin, double size) const {
    const auto lattice = next_[level].lattice(cell, box);
    if (level + 1 == next_.size()) {
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          for (int k = 0; k < 3; ++k) {
            const double value = field[lattice[static_cast<std::size_t>(9 * i + 3 * j + k)]];
            const double expected = trilinear(corners, origin + 0.5 * size * Eigen::Vector3d(i, j, k));
            if (std::abs(value - expected) > tolerance) return false;
          }
      return true;
    }
    for (std::size_t octant = 0; octant < 8; ++octant) {
      const std::size_t i = octant >> 2 & 1, j = octant >> 1 & 1, k = octant & 1;
      Box child_box;
      for (std::size_t c = 0; c < 8; ++c)
        child_box[c] = VertexId{lattice[9 * (i + (c >> 2 & 1)) + 3 * (j + (c >> 1 & 1)) + k + (c & 1)]};
      const Eigen::Vector3d child_origin =
          origin +
          0.5 * size * Eigen::Vector3d(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
      if (!holds(field, corners, tolerance, level + 1, child_at(level, cell, box[octant]), child_box, child_origin,
                 0.5 * size))
        return false;
    }
    return true;
  }

  CellId child_at(std::size_t level, CellId cell, VertexId corner) const {
    const Children& of = children_[level];
    for (std::size_t n = of.begin[cell.index()]; n < of.begin[cell.index() + 1]; ++n)
      if (refinement_.parent_corner[level + 1][of.cells[n]] == corner) return of.cells[n];
    assert(false);
    return CellId{};
  }

  const subdiv::Refinement& refinement_;
  const std::vector<std::vector<std::uint32_t>>& finest_;
  std::vector<const Eigen::VectorXd*> varying_;
  std::vector<NextLevel> next_;
  std::vector<Children> children_;
};

}  // namespace

std::vector<std::vector<std::uint32_t>> finest_vertices(const subdiv::Refinement& refinement) {
  std::vector<std::vector<std::uint32_t>> result(refinement.levels.size());
  std::vector<std::uint32_t>& finest = result.back();
  finest.resize(refinement.solid().vertex_capacity());
  for (std::size_t v = 0; v < finest.size(); ++v) finest[v] = static_cast<std::uint32_t>(v);
  for (std::size_t level = refinement.levels.size() - 1; level-- > 0;) {
    const subdiv::Solid& solid = refinement.levels[level];
    result[level].assign(solid.vertex_capacity(), VertexId::k_invalid);
    std::size_t rank = 0;
    for (const VertexId v : solid.vertices()) result[level][v.index()] = result[level + 1][rank++];
  }
  return result;
}

TricubicChoice choose_tricubic(const subdiv::Refinement& refinement, const NodalFields& fields) {
  const auto finest = finest_vertices(refinement);
  const TrilinearTest is_trilinear(refinement, fields, finest);
  TricubicChoice result;
  result.cells.resize(refinement.levels.size());
  std::vector<std::uint8_t> open(refinement.levels[0].cell_capacity(), 0);
  for (const CellId c : refinement.levels[0].cells()) open[c.index()] = 1;
  for (std::size_t level = 0;; ++level) {
    const subdiv::Solid& solid = refinement.levels[level];
    const bool last = level + 1 == refinement.levels.size();
    const auto classes = subdiv::classify_cells(solid);
    for (const CellId c : solid.cells()) {
      const CellClass kind = classes[c];
      if (!open[c.index()] || (kind != CellClass::regular_boundary && kind != CellClass::regular_published))
        continue;
      if (!last && !is_trilinear(level, c)) continue;
      result.cells[level].push_back(c);
      open[c.index()] = 0;
    }
    if (last) break;
    const auto& parent = refinement.parent[level + 1];
    std::vector<std::uint8_t> next(parent.size());
    for (std::size_t c = 0; c < next.size(); ++c) next[c] = open[parent.raw()[c].index()];
    open = std::move(next);
  }
  result.left = std::move(open);
  return result;
}

}  // namespace argil::fem
