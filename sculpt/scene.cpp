#include "sculpt/scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "subdiv/error.h"

namespace argil::sculpt {

using subdiv::CellData;
using subdiv::CellId;
using subdiv::EdgeId;
using subdiv::FaceId;
using subdiv::FaceUseId;
using subdiv::Solid;
using subdiv::VertexId;

namespace {

constexpr std::uint32_t k_none = 0xffffffffU;
const double k_cosine_of_split = std::cos(50.0 * M_PI / 180.0);

/// Newell's normal of a loop, normalised; zero for a degenerate face.
Eigen::Vector3d unit_normal(const Solid& solid, const Eigen::Matrix3Xd& positions, FaceUseId use) {
  const auto loop = solid.face_vertices(subdiv::face_of(use));
  const Eigen::Vector3d base = positions.col(static_cast<Eigen::Index>(loop[0].index()));
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const Eigen::Vector3d a = positions.col(static_cast<Eigen::Index>(loop[i].index())) - base;
    const Eigen::Vector3d b = positions.col(static_cast<Eigen::Index>(loop[i + 1].index())) - base;
    normal += a.cross(b);
  }
  const double length = normal.norm();
  if (!(length > 0)) return Eigen::Vector3d::Zero();
  return (subdiv::is_back(use) ? -1.0 : 1.0) / length * normal;
}

/// The side of a face that shows: owned by a kept cell, with none behind it.
FaceUseId shown_use(const Solid& solid, FaceId face, const CellData<std::uint8_t>& kept) {
  const auto is_kept = [&](FaceUseId use) {
    const CellId cell = solid.owner(use);
    return cell.valid() && (kept.size() == 0 || kept[cell] != 0);
  };
  const FaceUseId front = subdiv::face_use(face, false), back = subdiv::face_use(face, true);
  if (is_kept(front) == is_kept(back)) return {};
  return is_kept(front) ? front : back;
}

void add_edges(const Solid& solid, const Eigen::Matrix3Xd& positions, const std::vector<FaceUseId>& shown,
               const std::vector<std::uint32_t>& surface_from_vertex, SceneSurface& surface) {
  struct EdgeFaces {
    std::uint32_t count = 0;
    std::array<FaceUseId, 2> uses;
    bool cut = false;
  };
  std::vector<EdgeFaces> at_edge(solid.edge_capacity());
  for (const FaceUseId use : shown) {
    const FaceId face = subdiv::face_of(use);
    for (const EdgeId edge : solid.face_edges(face)) {
      EdgeFaces& faces = at_edge[edge.index()];
      if (faces.count < 2) faces.uses[faces.count] = use;
      ++faces.count;
      faces.cut = faces.cut || !solid.is_boundary(face);
    }
  }
  for (std::size_t e = 0; e < at_edge.size(); ++e) {
    const EdgeFaces& faces = at_edge[e];
    if (faces.count == 0) continue;
    const auto& ends = solid.edge_vertices(EdgeId{e});
    const std::array<std::uint32_t, 2> line{surface_from_vertex[ends[0].index()],
                                            surface_from_vertex[ends[1].index()]};
    surface.wire.push_back(line);
    const bool splits =
        faces.cut || faces.count != 2 || solid.edge_sharpness(EdgeId{e}) >= 1.0 ||
        unit_normal(solid, positions, faces.uses[0]).dot(unit_normal(solid, positions, faces.uses[1])) <
            k_cosine_of_split;
    if (splits) surface.sharp_edges.push_back(line);
  }
}

}  // namespace

CellData<std::uint8_t> cells_met_or_kept(const Solid& solid, const Eigen::Matrix3Xd& positions,
                                         const ClipPlane& plane) {
  const double length = plane.normal.norm();
  if (!(length > 0) || !std::isfinite(length) || !plane.point.allFinite())
    throw Error(ErrorCode::bad_input,
                "expected a clip plane with a finite point and a normal other than zero, found normal " +
                    std::to_string(plane.normal.x()) + " " + std::to_string(plane.normal.y()) + " " +
                    std::to_string(plane.normal.z()) + "; give it as three numbers such as 1 0 0");
  const Eigen::Vector3d normal = plane.normal / length;
  Eigen::Vector3d low = Eigen::Vector3d::Constant(HUGE_VAL), high = -low;
  for (const VertexId v : solid.vertices()) {
    const Eigen::Vector3d x = positions.col(static_cast<Eigen::Index>(v.index()));
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const double tolerance = solid.vertex_count() == 0 ? 0.0 : 1e-9 * (high - low).norm();
  CellData<std::uint8_t> kept(solid.cell_capacity(), 0);
  for (const CellId cell : solid.cells())
    for (const FaceUseId use : solid.cell_face_uses(cell))
      for (const VertexId v : solid.face_vertices(subdiv::face_of(use)))
        if (normal.dot(positions.col(static_cast<Eigen::Index>(v.index())) - plane.point) < -tolerance)
          kept[cell] = 1;
  return kept;
}

CellData<std::uint32_t> cell_depths(const Solid& solid) {
  CellData<std::uint32_t> depth(solid.cell_capacity(), k_none);
  std::vector<CellId> layer, next;
  const auto reach = [&](CellId cell, std::uint32_t at) {
    if (!cell.valid() || depth[cell] != k_none) return;
    depth[cell] = at;
    next.push_back(cell);
  };
  for (const FaceId f : solid.faces())
    if (solid.is_boundary(f)) reach(solid.owner(solid.boundary_use(f)), 0);
  for (std::uint32_t at = 1; !next.empty(); ++at) {
    layer = std::exchange(next, {});
    for (const CellId cell : layer)
      for (const FaceUseId use : solid.cell_face_uses(cell))
        reach(solid.owner(subdiv::face_use(subdiv::face_of(use), !subdiv::is_back(use))), at);
  }
  return depth;
}

SceneSurface cells_surface(const Solid& solid, const Eigen::Matrix3Xd& positions,
                           const CellData<std::uint8_t>& kept) {
  assert(static_cast<std::size_t>(positions.cols()) >= solid.vertex_capacity());
  assert(kept.size() == 0 || kept.size() >= solid.cell_capacity());
  SceneSurface surface;
  std::vector<FaceUseId> shown;
  std::vector<std::uint32_t> surface_from_vertex(solid.vertex_capacity(), k_none);
  for (const FaceId face : solid.faces()) {
    const FaceUseId use = shown_use(solid, face, kept);
    if (!use.valid()) continue;
    shown.push_back(use);
    for (const VertexId v : solid.face_vertices(face)) surface_from_vertex[v.index()] = 0;
  }
  for (std::size_t v = 0; v < surface_from_vertex.size(); ++v) {
    if (surface_from_vertex[v] == k_none) continue;
    const Eigen::Vector3d x = positions.col(static_cast<Eigen::Index>(v));
    if (!x.allFinite())
      throw Error(ErrorCode::bad_geometry,
                  "expected finite coordinates to draw, found one that is not; undo to the last good state",
                  "vertex " + std::to_string(v));
    surface_from_vertex[v] = static_cast<std::uint32_t>(surface.positions.size());
    surface.positions.push_back(x.cast<float>());
    surface.vertex_from_surface.push_back(static_cast<std::uint32_t>(v));
  }
  for (const FaceUseId use : shown) {
    const auto loop = solid.face_vertices(subdiv::face_of(use));
    for (std::size_t i = 0; i < loop.size(); ++i)
      surface.corners.push_back(surface_from_vertex[loop[subdiv::is_back(use) ? loop.size() - 1 - i : i].index()]);
    surface.offsets.push_back(surface.corners.size());
    surface.cell_from_face.push_back(solid.owner(use).value);
    surface.cut_faces.push_back(solid.is_boundary(subdiv::face_of(use)) ? 0 : 1);
  }
  add_edges(solid, positions, shown, surface_from_vertex, surface);
  return surface;
}

SceneSurface clipped_surface(const Solid& solid, const Eigen::Matrix3Xd& positions, const ClipPlane& plane) {
  return cells_surface(solid, positions, cells_met_or_kept(solid, positions, plane));
}

CellData<CellId> control_cells(const subdiv::Refinement& refinement) {
  CellData<CellId> control(refinement.levels.front().cell_capacity());
  for (std::size_t c = 0; c < control.size(); ++c) control[CellId{c}] = CellId{c};
  for (std::size_t level = 1; level < refinement.levels.size(); ++level) {
    const CellData<CellId>& parent = refinement.parent[level];
    CellData<CellId> next(parent.size());
    for (std::size_t c = 0; c < parent.size(); ++c)
      if (parent[CellId{c}].valid()) next[CellId{c}] = control[parent[CellId{c}]];
    control = std::move(next);
  }
  return control;
}

void keep_wire_between(SceneSurface& surface, const CellData<CellId>& group_from_cell) {
  using Ends = std::array<std::uint32_t, 2>;
  const auto ascending = [](Ends ends) { return ends[0] < ends[1] ? ends : Ends{ends[1], ends[0]}; };
  std::vector<std::pair<Ends, CellId>> groups;  // at each edge of each face
  for (std::size_t face = 0; face + 1 < surface.offsets.size(); ++face)
    for (std::size_t c = surface.offsets[face]; c < surface.offsets[face + 1]; ++c) {
      const std::size_t next = c + 1 < surface.offsets[face + 1] ? c + 1 : surface.offsets[face];
      groups.emplace_back(ascending({surface.corners[c], surface.corners[next]}),
                          group_from_cell[CellId{surface.cell_from_face[face]}]);
    }
  std::sort(groups.begin(), groups.end());
  std::vector<Ends> kept;
  for (const Ends& ends : surface.sharp_edges) kept.push_back(ascending(ends));
  for (std::size_t i = 1; i < groups.size(); ++i)
    if (groups[i].first == groups[i - 1].first && groups[i].second != groups[i - 1].second)
      kept.push_back(groups[i].first);
  std::sort(kept.begin(), kept.end());
  std::erase_if(surface.wire,
                [&](const Ends& ends) { return !std::binary_search(kept.begin(), kept.end(), ascending(ends)); });
}

PictureFrame box_frame(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  PictureFrame frame;
  for (int corner = 0; corner < 8; ++corner) {
    Eigen::Vector3d at = low;
    for (int axis = 0; axis < 3; ++axis)
      if ((corner >> axis & 1) != 0) at[axis] = high[axis];
    frame.places.push_back(at.cast<float>());
  }
  return frame;
}

double round_step(double span, int most) {
  assert(span > 0 && std::isfinite(span) && most > 0);
  const double raw = span / most;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double digit : {1.0, 2.0, 5.0})
    if (digit * power >= raw * (1 - 1e-9)) return digit * power;
  return 10 * power;
}

SceneLegend field_legend(std::span<const double> values, const std::string& title, const std::string& unit,
                         ColourMap map) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i]))
      throw Error(ErrorCode::bad_geometry, "expected finite values of " + title + ", found one that is not",
                  "value " + std::to_string(i));
    low = std::min(low, values[i]);
    high = std::max(high, values[i]);
  }
  if (values.empty()) low = high = 0;
  if (low > 0 && low < 0.5 * high) low = 0;
  // A field that is the same everywhere, but for rounding, gets one colour and not the whole range.
  const double largest = std::max(std::abs(low), std::abs(high));
  // Of a body at rest rounding leaves that much: as stress 1e-15 of the stiffest modulus, as length and strain
  // less.
  const double nothing = unit == "Pa" ? 1e-3 : 1e-12;
  if (largest < nothing) {
    low = 0;
    high = unit == "%" ? 0.01 : 1;
  } else if (high - low < 1e-5 * largest) {
    low = std::min(low, 0.0);
    high = std::max(high, 0.0);
  }
  if (map == ColourMap::balanced) {
    high = std::max(std::abs(low), std::abs(high));
    low = -high;
  }
  if (high - low > 1e-12 * std::max(std::abs(low), std::abs(high))) {
    const double step = round_step(high - low, k_legend_parts);
    low = step * std::floor(low / step + 1e-9);
    high = step * std::ceil(high / step - 1e-9);
  }
  return {title, unit, low, high, map};
}

void show_field(Scene& scene, std::span<const double> value_from_vertex, const std::string& title,
                const std::string& unit, ColourMap map) {
  SceneSurface& surface = scene.surface;
  surface.values.clear();
  std::vector<double> shown;
  for (const std::uint32_t v : surface.vertex_from_surface) {
    assert(v < value_from_vertex.size());
    if (!std::isfinite(value_from_vertex[v]))
      throw Error(ErrorCode::bad_geometry, "expected finite values of " + title + ", found one that is not",
                  "vertex " + std::to_string(v));
    shown.push_back(value_from_vertex[v]);
    surface.values.push_back(static_cast<float>(value_from_vertex[v]));
  }
  scene.legend = field_legend(shown, title, unit, map);
}

void add_cage(Scene& scene, const Solid& solid, const Eigen::Matrix3Xd& positions, bool interior) {
  const auto at = [&](VertexId v) -> Eigen::Vector3f {
    return positions.col(static_cast<Eigen::Index>(v.index())).cast<float>();
  };
  for (const EdgeId edge : solid.edges()) {
    if (!interior && !solid.is_boundary(edge)) continue;
    const auto& ends = solid.edge_vertices(edge);
    scene.cage_lines.push_back({at(ends[0]), at(ends[1])});
  }
  for (const VertexId v : solid.vertices())
    if (interior || solid.is_boundary(v)) scene.cage_points.push_back(at(v));
}

}  // namespace argil::sculpt
