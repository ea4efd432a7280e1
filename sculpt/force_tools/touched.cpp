#include "sculpt/force_tools/touched.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fem/discretization/materials.h"
#include "fem/elements/element_kind.h"
#include "fem/surface_points.h"
#include "sculpt/document_loads.h"
#include "subdiv/error.h"
#include "subdiv/query/surface_tree.h"

namespace argil::sculpt {

namespace {

constexpr double k_least_size = 1e-3;  // of a radius, which is never zero

struct Triangles {
  Eigen::Matrix3Xd points;
  std::vector<std::array<std::uint32_t, 3>> corners;
};

// Each quadrilateral as four triangles about its middle.
Triangles triangles_of(const fem::SurfacePatch& patch, const Eigen::Matrix3Xd& nodes) {
  Triangles result;
  result.points.resize(3, nodes.cols() + static_cast<Eigen::Index>(patch.quads.size()));
  result.points.leftCols(nodes.cols()) = nodes;
  for (std::size_t q = 0; q < patch.quads.size(); ++q) {
    const auto& quad = patch.quads[q];
    const auto middle = static_cast<std::uint32_t>(static_cast<std::size_t>(nodes.cols()) + q);
    result.points.col(middle) =
        (nodes.col(quad[0]) + nodes.col(quad[1]) + nodes.col(quad[2]) + nodes.col(quad[3])) / 4;
    for (std::size_t i = 0; i < 4; ++i) result.corners.push_back({quad[i], quad[(i + 1) % 4], middle});
  }
  return result;
}

// By the solid angle under which the boundary is seen (van Oosterom and Strackee 1983): robust where it folds.
bool is_inside(const Triangles& surface, const Eigen::Vector3d& p) {
  double angle = 0;
  for (const auto& t : surface.corners) {
    const Eigen::Vector3d a = surface.points.col(t[0]) - p, b = surface.points.col(t[1]) - p,
                          c = surface.points.col(t[2]) - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle > 2 * std::numbers::pi;
}

// Equal columns together, ascending; their weights summed in the order that they came in.
fem::PointStencil gathered(std::vector<std::pair<std::uint32_t, double>>& entries) {
  std::stable_sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  fem::PointStencil result;
  for (const auto& [column, weight] : entries) {
    if (result.control_points.empty() || result.control_points.back() != column) {
      result.control_points.push_back(column);
      result.weights.push_back(0);
    }
    result.weights.back() += weight;
  }
  return result;
}

// What the mask leaves at quadrature points: 1 everywhere where there is none.
class Unmasked {
 public:
  Unmasked(const Document& document, Masks masks) : d_(document.discretization()) {
    if (masks == Masks::ignored || !has_mask(document)) return;
    const Eigen::VectorXd& mask = (*document.state().fields)[FieldName::mask];
    at_node_.assign(d_.nodes.node_count(), 1.0);
    for (std::size_t v = 0; v < d_.surface_node_from_vertex.size(); ++v)
      at_node_[d_.surface_node_from_vertex[v]] = 1 - mask[static_cast<Eigen::Index>(v)];
    const subdiv::Stencils& rows = d_.field_samples.rows;
    samples_.assign(rows.row_count(), 0.0);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const auto row = rows.row(static_cast<std::uint32_t>(i));
      for (std::size_t e = 0; e < row.columns.size(); ++e)
        samples_[i] += row.weights[e] * (1 - mask[row.columns[e]]);
    }
  }

  double on_surface(const std::array<std::uint32_t, 4>& quad, const std::array<double, 4>& shapes) const {
    if (at_node_.empty()) return 1;
    double left = 0;
    for (std::size_t c = 0; c < 4; ++c) left += shapes[c] * at_node_[quad[c]];
    return std::clamp(left, 0.0, 1.0);
  }

  double inside(std::size_t block, std::size_t element, int point) const {
    if (at_node_.empty()) return 1;
    const fem::ElementKind& kind = *d_.blocks[block].kind;
    const auto count = static_cast<std::size_t>(fem::field_corner_count(kind)), p = static_cast<std::size_t>(point);
    const double* shapes = kind.shapes.data() + p * count;
    Eigen::VectorXd trilinear;
    if (fem::field_corner_count(kind) != kind.node_count) {  // fields are trilinear over a tricubic element
      Eigen::Matrix3Xd gradients;
      fem::trilinear_hexahedron().evaluate(kind.points[p], trilinear, gradients);
      shapes = trilinear.data();
    }
    const std::uint32_t* const corners = d_.field_samples.corners[block].data() + element * count;
    double left = 0;
    for (std::size_t c = 0; c < count; ++c) left += shapes[c] * samples_[corners[c]];
    return std::clamp(left, 0.0, 1.0);
  }

 private:
  const fem::Discretization& d_;
  std::vector<double> at_node_, samples_;  // 1 − mask; empty: nothing is masked
};

class Collector {
 public:
  Collector(const fem::Discretization& discretization, Touched& result)
      : rows_(discretization.nodes.rows), result_(result) {}

  /// `unmasked`: what the mask leaves, 0 … 1.
  void add(std::span<const std::uint32_t> nodes, const double* shapes, double falloff, double unmasked,
           double measure, const Eigen::Vector3d& position, const TouchedPlace& place) {
    whole_ += falloff * measure;
    falloff *= unmasked;
    if (!(unmasked > 0)) return;
    entries_.clear();
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const auto row = rows_.row(nodes[a]);
      for (std::size_t e = 0; e < row.columns.size(); ++e)
        entries_.emplace_back(row.columns[e], shapes[a] * row.weights[e]);
    }
    result_.points.push_back(gathered(entries_));
    result_.places.push_back(place);
    falloffs_.push_back(falloff);
    weights_.push_back(falloff * measure);
    positions_.push_back(position);
  }

  void finish() {
    const auto count = static_cast<Eigen::Index>(positions_.size());
    result_.falloffs.resize(count);
    result_.weights.resize(count);
    result_.positions.resize(3, count);
    result_.measure = 0;
    for (const double w : weights_) result_.measure += w;
    if (!(result_.measure > 0)) {
      result_.points.clear();
      result_.places.clear();
      result_.masked = whole_ > 0;
      return;
    }
    result_.share = result_.measure / whole_;
    result_.middle.setZero();
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      result_.falloffs[i] = falloffs_[at];
      result_.weights[i] = weights_[at] / result_.measure;
      result_.positions.col(i) = positions_[at];
      result_.middle += result_.weights[i] * positions_[at];
    }
  }

 private:
  const subdiv::Stencils& rows_;
  Touched& result_;
  std::vector<std::pair<std::uint32_t, double>> entries_;
  std::vector<double> falloffs_, weights_;
  std::vector<Eigen::Vector3d> positions_;
  double whole_ = 0;  // Σ falloff · measure, the mask left aside
};

void touch_surface(const fem::Discretization& d, const fem::SurfacePatch& surface, const Eigen::Matrix3Xd& nodes,
                   const Tool& tool, double radius, const std::function<double(const Eigen::Vector3d&)>& distance,
                   const Unmasked& unmasked, Touched& result) {
  const fem::Falloff falloff = falloff_by_word(tool.falloff);
  Collector collector(d, result);
  result.normal.setZero();
  for (const auto& quad : surface.quads)
    for (int which = 0; which < 4; ++which) {
      const fem::SurfacePoint point = fem::surface_point(quad, which, nodes);
      const double s = distance(point.position) / radius;
      if (s >= 1) continue;
      const double weight = falloff_weight(falloff, s), left = unmasked.on_surface(quad, point.shapes);
      result.normal += left * weight * point.area_vector;
      collector.add(quad, point.shapes.data(), weight, left, point.area_vector.norm(), point.position,
                    {quad, which, 0, 0});
    }
  collector.finish();
}

void touch_inside(const fem::Discretization& d, const Eigen::Matrix3Xd& nodes, const Tool& tool,
                  const Eigen::Vector3d& at, bool widen, const Unmasked& unmasked, Touched& result) {
  const auto for_each = [&](const auto& visit) {
    for (std::size_t b = 0; b < d.blocks.size(); ++b) {
      const fem::ElementBlock& block = d.blocks[b];
      const auto n = static_cast<std::size_t>(block.kind->node_count);
      for (std::size_t e = 0; e < block.element_count(); ++e)
        for (int q = 0; q < block.kind->point_count; ++q) {
          const double* shapes = block.kind->shapes.data() + static_cast<std::size_t>(q) * n;
          Eigen::Vector3d position = Eigen::Vector3d::Zero();
          for (std::size_t a = 0; a < n; ++a) position += shapes[a] * nodes.col(block.nodes[e * n + a]);
          visit(block, b, e, q, shapes, position);
        }
    }
  };
  double nearest = 1e300;
  for_each([&](const fem::ElementBlock&, std::size_t, std::size_t, int, const double*, const Eigen::Vector3d& x) {
    nearest = std::min(nearest, (x - at).norm());
  });
  if (nearest >= tool.radius && !widen) return;
  const double radius = nearest < tool.radius ? tool.radius : 1.5 * nearest;
  const fem::Falloff falloff = falloff_by_word(tool.falloff);
  Collector collector(d, result);
  for_each([&](const fem::ElementBlock& block, std::size_t b, std::size_t e, int q, const double* shapes,
               const Eigen::Vector3d& x) {
    const double s = (x - at).norm() / radius;
    if (s >= 1) return;
    const auto n = static_cast<std::size_t>(block.kind->node_count);
    collector.add({block.nodes.data() + e * n, n}, shapes, falloff_weight(falloff, s), unmasked.inside(b, e, q),
                  block.volumes[block.point_index(e, q)], x, {{}, q, b, e});
  });
  collector.finish();
}

void make_unit(Eigen::Vector3d& normal) {
  const double length = normal.norm();
  normal = length > 0 ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::UnitZ();
}

Touched find(const Document& document, const Tool& tool, const Eigen::Vector3d& at, bool inside, Masks masks,
             double& away) {
  const fem::Discretization& d = document.discretization();
  const Eigen::Matrix3Xd nodes = subdiv::apply(d.nodes.rows, document.positions());
  const fem::SurfacePatch surface = fem::whole_surface(d, document.refinement().solid());
  const Triangles triangles = triangles_of(surface, nodes);
  // A brush finer than the mesh is widened until it holds something, so what it touches is asked of the surface
  // itself.
  const Eigen::Vector3d nearest = subdiv::SurfaceTree(triangles.points, triangles.corners).nearest(at);
  away = (nearest - at).norm();
  const Unmasked unmasked(document, masks);
  Touched result;
  if (away <= tool.radius && !inside) {
    const auto distance = [&](const Eigen::Vector3d& x) { return (x - at).norm(); };
    double closest = 1e300;
    fem::for_each_surface_point(surface, nodes, [&](const auto&, const fem::SurfacePoint& point) {
      closest = std::min(closest, distance(point.position));
    });
    touch_surface(d, surface, nodes, tool, closest < tool.radius ? tool.radius : 1.5 * closest, distance, unmasked,
                  result);
  } else {
    const bool within = is_inside(triangles, at);
    if (!within && away > tool.radius) return result;
    result.inside = true;
    touch_inside(d, nodes, tool, at, within, unmasked, result);
    result.normal = within ? Eigen::Vector3d(nearest - at) : Eigen::Vector3d(at - nearest);
  }
  if (result.empty()) return result;
  make_unit(result.normal);
  return result;
}

}  // namespace

Touched touched_near(const Document& document, const Tool& tool,
                     const std::function<double(const Eigen::Vector3d&)>& distance) {
  const fem::Discretization& d = document.discretization();
  const Eigen::Matrix3Xd nodes = subdiv::apply(d.nodes.rows, document.positions());
  Touched result;
  touch_surface(d, fem::whole_surface(d, document.refinement().solid()), nodes, tool, tool.radius, distance,
                Unmasked(document, Masks::protect), result);
  make_unit(result.normal);
  return result;
}

std::vector<Eigen::Vector3d> nearest_on_surface(const Document& document, std::span<const Eigen::Vector3d> points) {
  const fem::Discretization& d = document.discretization();
  const Triangles triangles = triangles_of(fem::whole_surface(d, document.refinement().solid()),
                                           subdiv::apply(d.nodes.rows, document.positions()));
  const subdiv::SurfaceTree tree(triangles.points, triangles.corners);
  std::vector<Eigen::Vector3d> result;
  for (const Eigen::Vector3d& point : points) result.push_back(tree.nearest(point));
  return result;
}

bool has_mask(const Document& document) {
  const Eigen::VectorXd& mask = (*document.state().fields)[FieldName::mask];
  return std::any_of(mask.begin(), mask.end(), [](double value) { return value > 0; });
}

void refuse_masked() {
  throw Error(ErrorCode::bad_input,
              "all that the tool would touch is masked; take the mask away there, as with `mask clear`, or work "
              "beside it");
}

Touched touched(const Document& document, const Tool& tool, const Eigen::Vector3d& at, bool inside, Masks masks) {
  double away = 0;
  return find(document, tool, at, inside, masks, away);
}

Touched touch(const Document& document, const Tool& tool, const Eigen::Vector3d& at, bool inside, Masks masks) {
  double away = 0;
  Touched result = find(document, tool, at, inside, masks, away);
  if (result.masked) refuse_masked();
  if (result.empty())
    throw Error(
        ErrorCode::bad_input,
        fmt::format(
            "the tool touches nothing at ({:g}, {:g}, {:g}): the surface is {:.3g} m away and its radius is "
            "{:g} m; begin the stroke on the surface or make the radius larger",
            at.x(), at.y(), at.z(), away, tool.radius));
  return result;
}

LaidTool laid_tool(const Document& document, const Tool& tool, const StrokePose& device, bool inside) {
  LaidTool laid{tool, device.position};
  if (device.size >= 1) return laid;
  laid.tool.radius *= std::max(device.size, k_least_size);
  if (inside) return laid;
  const Eigen::Vector3d nearest = nearest_on_surface(document, {&device.position, 1})[0];
  if ((nearest - device.position).norm() <= tool.radius) laid.at = nearest;
  return laid;
}

fem::PointStencil middle_of(const Touched& touched) {
  return combination(touched.points, {touched.weights.data(), static_cast<std::size_t>(touched.weights.size())});
}

fem::PointStencil combination(std::span<const fem::PointStencil> points, std::span<const double> factors) {
  std::uint32_t last = 0;
  for (const fem::PointStencil& point : points) last = std::max(last, point.control_points.back());
  std::vector<double> sums(last + std::size_t{1}, 0.0);
  std::vector<std::uint8_t> named(last + std::size_t{1}, 0);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t e = 0; e < points[i].control_points.size(); ++e) {
      sums[points[i].control_points[e]] += factors[i] * points[i].weights[e];
      named[points[i].control_points[e]] = 1;
    }
  fem::PointStencil result;
  for (std::uint32_t c = 0; c <= last; ++c)
    if (named[c]) {
      result.control_points.push_back(c);
      result.weights.push_back(sums[c]);
    }
  return result;
}

}  // namespace argil::sculpt
