#include "sculpt/selection.h"

#include <algorithm>
#include <limits>

#include "subdiv/error.h"
#include "subdiv/radial_edge.h"
#include "subdiv/sort_unique.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;
using Ids = std::vector<std::uint32_t>;

// The elements of one type: nodes are the vertices of the finest level, the others are of the control solid.
class Elements {
 public:
  Elements(const Document& document, ElementType type, bool interior = true)
      : solid_(type == ElementType::nodes ? document.refinement().solid() : document.solid()),
        type_(type == ElementType::nodes ? ElementType::vertices : type),
        interior_(interior) {}

  const Solid& solid() const { return solid_; }

  std::vector<VertexId> vertices(std::uint32_t id) const {
    switch (type_) {
      case ElementType::edges: {
        const auto& ends = solid_.edge_vertices(EdgeId{id});
        return {ends.begin(), ends.end()};
      }
      case ElementType::faces: {
        const auto loop = solid_.face_vertices(FaceId{id});
        return {loop.begin(), loop.end()};
      }
      case ElementType::cells:
        return cell_vertices(solid_, CellId{id});
      default:
        return {VertexId{id}};
    }
  }

  std::vector<CellId> cells(std::uint32_t id) const {
    switch (type_) {
      case ElementType::edges:
        return edge_cells(solid_, EdgeId{id});
      case ElementType::faces: {
        std::vector<CellId> owners;
        for (const bool back : {false, true})
          if (const CellId c = solid_.owner(face_use(FaceId{id}, back)); c.valid()) owners.push_back(c);
        return owners;
      }
      case ElementType::cells:
        return {CellId{id}};
      default:
        return vertex_cells(solid_, VertexId{id});
    }
  }

  // Those with this vertex; of vertices, those that an edge joins to it. Not in order.
  void append_at(VertexId vertex, Ids& ids) const {
    const auto append = [&](const auto& found) {
      for (const auto id : found) ids.push_back(id.value);
    };
    switch (type_) {
      case ElementType::edges:
        return append(vertex_edges(solid_, vertex));
      case ElementType::faces:
        for (const FaceId f : vertex_faces(solid_, vertex))
          if (interior_ || solid_.is_boundary(f)) ids.push_back(f.value);
        return;
      case ElementType::cells:
        return append(vertex_cells(solid_, vertex));
      default:
        solid_.for_each_edge(vertex, [&](EdgeId e) { ids.push_back(solid_.other_vertex(e, vertex).value); });
    }
  }

  Ids at_vertices_of(const Ids& chosen) const {
    Ids around;
    for (const std::uint32_t id : chosen)
      for (const VertexId v : vertices(id)) around.push_back(v.value);
    subdiv::sort_unique(around);
    Ids found;
    for (const std::uint32_t v : around) append_at(VertexId{v}, found);
    subdiv::sort_unique(found);
    return found;
  }

  bool is_boundary(std::uint32_t id) const {
    switch (type_) {
      case ElementType::edges:
        return solid_.is_boundary(EdgeId{id});
      case ElementType::faces:
        return solid_.is_boundary(FaceId{id});
      case ElementType::cells: {
        const auto uses = solid_.cell_face_uses(CellId{id});
        return std::any_of(uses.begin(), uses.end(), [&](FaceUseId u) { return solid_.is_boundary(face_of(u)); });
      }
      default:
        return solid_.is_boundary(VertexId{id});
    }
  }

 private:
  const Solid& solid_;
  ElementType type_;
  bool interior_;
};

Eigen::Matrix3Xd positions_of(const Document& document, ElementType type) {
  if (type != ElementType::nodes) return document.positions();
  return apply(document.refinement().stencils.back(), document.positions());
}

// Woop, Benthin, Wald 2013: in axes sheared so that the ray runs along z, a ray through an edge or a vertex meets
// at least one of the triangles there.
class PickingRay {
 public:
  PickingRay(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) : origin_(origin) {
    direction.cwiseAbs().maxCoeff(&z_);
    x_ = (z_ + 1) % 3;
    y_ = (z_ + 2) % 3;
    scale_ = 1 / direction[z_];
    shear_ = {direction[x_] * scale_, direction[y_] * scale_};
  }

  // In units of the direction; negative if it misses.
  double distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) const {
    const Eigen::Vector3d p = sheared(a), q = sheared(b), r = sheared(c);
    const double u = r[0] * q[1] - r[1] * q[0], v = p[0] * r[1] - p[1] * r[0], w = q[0] * p[1] - q[1] * p[0];
    const double sum = u + v + w;
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return -1;
    return sum == 0 ? -1 : (u * p[2] + v * q[2] + w * r[2]) / sum;
  }

 private:
  Eigen::Vector3d sheared(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d d = point - origin_;
    return {d[x_] - shear_[0] * d[z_], d[y_] - shear_[1] * d[z_], scale_ * d[z_]};
  }

  Eigen::Vector3d origin_;
  Eigen::Index x_ = 0, y_ = 0, z_ = 0;
  double scale_ = 0;
  Eigen::Vector2d shear_;
};

double distance_squared_to_segment(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
                                   const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double length_squared = along.squaredNorm();
  const double part = length_squared > 0 ? std::clamp((point - a).dot(along) / length_squared, 0.0, 1.0) : 0.0;
  return (a + part * along - point).squaredNorm();
}

}  // namespace

std::vector<std::uint32_t> picked(const Document& document, ElementType type, const Eigen::Vector3d& origin,
                                  const Eigen::Vector3d& direction) {
  if (!(direction.norm() > 0))
    throw Error(ErrorCode::bad_input, "the direction of the ray is zero; `ray 0 0 5 0 0 -1` looks down");
  const Elements elements(document, type);
  const Solid& solid = elements.solid();
  const Eigen::Matrix3Xd positions = positions_of(document, type);
  const auto at = [&](VertexId v) { return positions.col(static_cast<Eigen::Index>(v.index())); };
  const PickingRay ray(origin, direction);
  FaceId hit;
  double nearest = 0;
  for (const FaceId f : solid.faces()) {
    if (!solid.is_boundary(f)) continue;
    const auto loop = solid.face_vertices(f);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      const double distance = ray.distance(at(loop[0]), at(loop[i]), at(loop[i + 1]));
      if (distance < 0 || (hit.valid() && distance >= nearest)) continue;
      hit = f;
      nearest = distance;
    }
  }
  if (!hit.valid()) return {};
  if (type == ElementType::faces) return {hit.value};
  if (type == ElementType::cells) return {solid.owner(solid.boundary_use(hit)).value};
  const Eigen::Vector3d point = origin + nearest * direction;
  std::pair<double, std::uint32_t> best{std::numeric_limits<double>::infinity(), 0};
  if (type == ElementType::edges) {
    for (const EdgeId e : solid.face_edges(hit)) {
      const auto& ends = solid.edge_vertices(e);
      best = std::min(best, {distance_squared_to_segment(point, at(ends[0]), at(ends[1])), e.value});
    }
  } else {
    for (const VertexId v : solid.face_vertices(hit))
      best = std::min(best, {(at(v) - point).squaredNorm(), v.value});
  }
  return {best.second};
}

void keep_within(const Document& document, ElementType type, Asked asked,
                 const std::function<bool(const Eigen::Vector3d&)>& region, std::vector<std::uint32_t>& ids) {
  const Elements elements(document, type);
  const Eigen::Matrix3Xd positions = positions_of(document, type);
  std::erase_if(ids, [&](std::uint32_t id) {
    const std::vector<VertexId> vertices = elements.vertices(id);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    std::size_t within = 0;
    for (const VertexId v : vertices) {
      const Eigen::Vector3d p = positions.col(static_cast<Eigen::Index>(v.index()));
      sum += p;
      within += region(p) ? 1 : 0;
    }
    if (asked == Asked::any_vertex) return within == 0;
    if (asked == Asked::all_vertices) return within < vertices.size();
    return !region(sum / static_cast<double>(vertices.size()));
  });
}

void keep_boundary(const Document& document, ElementType type, bool boundary, std::vector<std::uint32_t>& ids) {
  const Elements elements(document, type);
  std::erase_if(ids, [&](std::uint32_t id) { return elements.is_boundary(id) != boundary; });
}

Selection grown(const Document& document, const Selection& selection, long steps, bool interior) {
  const Elements elements(document, selection.type, interior);
  Selection result = selection;
  for (long step = 0; step < steps; ++step) {
    const Ids around = elements.at_vertices_of(result.ids);
    Ids all;
    std::set_union(result.ids.begin(), result.ids.end(), around.begin(), around.end(), std::back_inserter(all));
    if (all.size() == result.ids.size()) break;
    result.ids = std::move(all);
  }
  return result;
}

Selection shrunk(const Document& document, const Selection& selection, long steps, bool interior) {
  const Elements elements(document, selection.type, interior);
  Selection result = selection;
  for (long step = 0; step < steps && !result.ids.empty(); ++step) {
    const Ids& held = result.ids;
    const Ids around = elements.at_vertices_of(held);
    Ids others, kept;
    std::set_difference(around.begin(), around.end(), held.begin(), held.end(), std::back_inserter(others));
    const Ids beside = elements.at_vertices_of(others);
    std::set_difference(held.begin(), held.end(), beside.begin(), beside.end(), std::back_inserter(kept));
    if (kept.size() == held.size()) break;
    result.ids = std::move(kept);
  }
  return result;
}

Selection whole_components(const Document& document, const Selection& selection, bool interior) {
  const Elements elements(document, selection.type, interior);
  const Components parts = components(elements.solid());
  std::vector<std::uint8_t> chosen(static_cast<std::size_t>(parts.count), 0);
  for (const std::uint32_t id : selection.ids)
    for (const CellId c : elements.cells(id)) chosen[static_cast<std::size_t>(parts.component_from_cell[c])] = 1;
  Selection result{selection.type, matching(document, selection.type, nullptr, interior)};
  std::erase_if(result.ids, [&](std::uint32_t id) {
    const std::vector<CellId> cells = elements.cells(id);
    return std::none_of(cells.begin(), cells.end(), [&](CellId c) {
      return chosen[static_cast<std::size_t>(parts.component_from_cell[c])] != 0;
    });
  });
  return result;
}

}  // namespace argil::sculpt
