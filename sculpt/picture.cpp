#include "sculpt/picture.h"

#include "sculpt/obstacle_picture.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "sculpt/cell_picture.h"
#include "sculpt/document_loads.h"
#include "sculpt/export.h"
#include "sculpt/field_transfer.h"
#include "sculpt/force_tools/curve.h"
#include "sculpt/force_tools/touched.h"
#include "sculpt/measures.h"
#include "sculpt/region.h"
#include "sculpt/shown_unit.h"
#include "subdiv/error.h"
#include "subdiv/neighbourhood.h"
#include "subdiv/radial_edge.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

constexpr double k_cell_size = 0.9;  // of cells that are drawn by themselves

Eigen::Vector3f single(const Eigen::Vector3d& v) {
  return v.cast<float>();
}

/// The body as it is drawn: as it is simulated, or its control points refined further and what is known at its
/// nodes carried along.
struct Shown {
  const Document& document;
  std::optional<Refinement> finer = std::nullopt;

  Shown(const Document& of, int smooth) : document(of) {
    if (smooth > 0) finer = refine_to_level(of.solid(), of.state().level + smooth, of.state().rules);
  }
  const Refinement& refinement() const { return finer ? *finer : document.refinement(); }
  const Solid& solid() const { return refinement().solid(); }
  Eigen::Matrix3Xd nodes(const Eigen::Matrix3Xd& control_points) const {
    if (finer) return apply(finer->stencils.back(), control_points);
    return document.state().level == 0 ? control_points : document.surface_nodes(control_points);
  }
  Eigen::VectorXd values(Eigen::VectorXd of_nodes) const {
    if (finer)
      for (auto level = static_cast<std::size_t>(document.state().level) + 1; level < finer->levels.size(); ++level)
        of_nodes = apply(finer->step_stencils[level], of_nodes);
    return of_nodes;
  }
  /// Where a node of the simulation is drawn.
  std::vector<std::uint32_t> new_from_old() const { return nodes_at_level(document.refinement(), refinement()); }
};

double extent(const Eigen::Matrix3Xd& positions) {
  if (positions.cols() == 0) return 1;
  return (positions.rowwise().maxCoeff() - positions.rowwise().minCoeff()).norm();
}

void add_lines(Scene& scene, const Solid& solid, const Eigen::Matrix3Xd& positions, bool boundary_only) {
  for (const EdgeId e : solid.edges()) {
    if (boundary_only && !solid.is_boundary(e)) continue;
    const auto& ends = solid.edge_vertices(e);
    scene.cage_lines.push_back({single(positions.col(static_cast<Eigen::Index>(ends[0].index()))),
                                single(positions.col(static_cast<Eigen::Index>(ends[1].index())))});
  }
}

// The outward normal of the surface near a point; zero if it is farther than `reach`.
Eigen::Vector3d outward_at(const SceneSurface& surface, const Eigen::Vector3d& at, double reach) {
  std::size_t nearest = surface.positions.size();
  double distance = reach;
  for (std::size_t v = 0; v < surface.positions.size(); ++v) {
    const double d = (surface.positions[v].cast<double>() - at).norm();
    if (d < distance) {
      distance = d;
      nearest = v;
    }
  }
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t f = 0; f + 1 < surface.offsets.size(); ++f) {
    const auto begin = surface.corners.begin() + static_cast<std::ptrdiff_t>(surface.offsets[f]);
    const auto end = surface.corners.begin() + static_cast<std::ptrdiff_t>(surface.offsets[f + 1]);
    if (std::find(begin, end, nearest) == end) continue;
    for (auto corner = begin; corner != end; ++corner) {
      const auto next = corner + 1 == end ? begin : corner + 1;
      normal +=
          (surface.positions[*corner].cast<double>() - at).cross(surface.positions[*next].cast<double>() - at);
    }
  }
  return normal;
}

// Where an applied force is drawn: its point, or the middle of its faces or cells.
Eigen::Vector3d point_of(const Document& document, const AppliedForce& force) {
  if (force.at_point()) return fem::position(material_point(document, force.point).stencil, document.positions());
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  const auto add = [&](const auto& vertices) {
    for (const VertexId v : vertices) {
      sum += document.positions().col(static_cast<Eigen::Index>(v.index()));
      ++count;
    }
  };
  for (const std::uint32_t f : force.faces) add(document.solid().face_vertices(FaceId{f}));
  for (const std::uint32_t c : force.cells) add(cell_vertices(document.solid(), CellId{c}));
  return sum / static_cast<double>(count);
}

void add_marks(Scene& scene, const Shown& body, const PictureRequest& request, const Eigen::Matrix3Xd& now) {
  const Document& document = body.document;
  const double size = extent(now);
  // A pinned control point is shown where it holds the surface.
  const auto node = node_from_control_vertex(document), drawn = body.new_from_old();
  std::vector<std::uint8_t> shown(static_cast<std::size_t>(now.cols()), 0);
  for (const std::uint32_t v : scene.surface.vertex_from_surface) shown[v] = 1;
  for (const std::uint32_t v : document.state().pins->control_points)
    if (shown[drawn[node[v]]]) scene.pins.push_back(single(now.col(drawn[node[v]])));
  if (!document.state().pins->nodes.empty()) {
    for (const SoftPin& pin : document.state().pins->nodes)
      if (shown[drawn[pin.node]]) scene.pins.push_back(single(now.col(drawn[pin.node])));
  }
  std::vector<std::array<Eigen::Vector3d, 2>> forces;
  for (const AppliedForce& force : document.state().loads->forces)
    forces.push_back({point_of(document, force), force_at(force, document.state().motion->time)});
  if (request.tool_force) forces.push_back(*request.tool_force);
  double largest = 0;
  for (const auto& [at, force] : forces) largest = std::max(largest, force.norm());
  // The largest is a quarter of the solid long. A pull begins where it acts, a push ends there.
  for (const auto& [at, force] : forces) {
    if (!(force.norm() > 1e-9 * largest)) continue;
    const Eigen::Vector3d arrow = 0.25 * size * force / largest;
    const bool push = outward_at(scene.surface, at, 0.05 * size).dot(force) < 0;
    scene.arrows.push_back(push ? SceneArrow{single(at - arrow), single(at)}
                                : SceneArrow{single(at), single(at + arrow)});
  }
}

Scene net_scene(const Document& document, const PictureRequest& request) {
  const Solid& solid = document.refinement().solid();
  const CellId cell{*request.net_cell};
  if (!solid.is_live(cell))
    throw Error(ErrorCode::bad_input, fmt::format("there is no cell {} at level {}; it has {}", cell.value,
                                                  document.state().level, solid.cell_count()));
  const RegularNets nets = regular_nets(solid, classify_cells(solid));
  const auto found = std::lower_bound(nets.cells.begin(), nets.cells.end(), cell);
  if (found == nets.cells.end() || *found != cell)
    throw Error(ErrorCode::bad_input,
                fmt::format("cell {} is not regular, it has no 4×4×4 net; choose another", cell.value));
  const auto& net = nets.nodes[static_cast<std::size_t>(found - nets.cells.begin())];
  const Eigen::Matrix3Xd positions = apply(document.refinement().stencils.back(), document.positions());
  const Eigen::Matrix3Xd phantoms = apply(nets.phantoms, positions);
  const auto at = [&](std::uint32_t node) -> Eigen::Vector3d {
    return node < solid.vertex_capacity() ? positions.col(node)
                                          : phantoms.col(static_cast<Eigen::Index>(node - solid.vertex_capacity()));
  };
  // In Fig. 6 the steps go outwards: a net vertex has as many outer indices as the step that finds it.
  const auto step_of = [](int i, int j, int k) {
    const auto outer = [](int a) { return a == 0 || a == 3 ? 1 : 0; };
    return 1 + outer(i) + outer(j) + outer(k);
  };
  Scene scene;
  CellData<std::uint8_t> kept(solid.cell_capacity(), 0);
  kept[cell] = 1;
  scene.surface = cells_surface(solid, positions, kept);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k) {
        if (step_of(i, j, k) > request.net_steps) continue;
        const auto index = [](int a, int b, int c) { return static_cast<std::size_t>(16 * a + 4 * b + c); };
        const Eigen::Vector3d here = at(net[index(i, j, k)]);
        scene.labels.push_back({single(here), fmt::format("{}", index(i, j, k))});
        const int next[3][3] = {{i + 1, j, k}, {i, j + 1, k}, {i, j, k + 1}};
        for (const auto& n : next) {
          if (n[0] > 3 || n[1] > 3 || n[2] > 3 || step_of(n[0], n[1], n[2]) > request.net_steps) continue;
          scene.cage_lines.push_back({single(here), single(at(net[index(n[0], n[1], n[2])]))});
        }
      }
  return scene;
}

}  // namespace

namespace {

SceneSurface surface_of(const Solid& solid, const Eigen::Matrix3Xd& positions, const PictureRequest& request,
                        const CellData<std::uint8_t>& kept, const Refinement& refinement) {
  if (request.shrink || request.cell_kinds)
    return separate_cells(solid, positions, request.shrink.value_or(k_cell_size), kept);
  SceneSurface surface = cells_surface(solid, positions, kept);
  if (request.control_wire) keep_wire_between(surface, control_cells(refinement));
  return surface;
}

void add_curve(Scene& scene, const Document& document, const std::vector<Eigen::Vector3d>& handles) {
  constexpr int k_pieces = 24;  // of a span
  const HandleCurve curve(handles);
  const int pieces = k_pieces * static_cast<int>(std::lround(curve.end()));
  std::vector<Eigen::Vector3d> places;
  for (int i = 0; i <= pieces; ++i) places.push_back(curve.point(curve.end() * i / pieces));
  places = nearest_on_surface(document, places);
  SceneLines lines{LineLook::curve, {}, "curve"};
  for (std::size_t i = 1; i < places.size(); ++i) lines.lines.push_back({single(places[i - 1]), single(places[i])});
  scene.lines.push_back(std::move(lines));
  for (const Eigen::Vector3d& handle : handles) scene.handles.push_back(single(handle));
}

SceneFelt felt_force(const PictureRequest& request) {
  const double force = request.tool_force ? (*request.tool_force)[1].norm() : 0;
  const ShownUnit shown = shown_unit("N", std::max(force, 1e-3 * *request.felt));
  return {force / *request.felt, fmt::format("felt {:.3g} {}", force * shown.per_value, shown.unit)};
}

// 1 for what the plane and the peeling leave; empty: all.
CellData<std::uint8_t> shown_cells(const Solid& solid, const Eigen::Matrix3Xd& positions,
                                   const PictureRequest& request) {
  CellData<std::uint8_t> kept;
  if (request.clip) kept = cells_met_or_kept(solid, positions, *request.clip);
  if (request.peel == 0) return kept;
  if (kept.size() == 0) kept = CellData<std::uint8_t>(solid.cell_capacity(), 1);
  const CellData<std::uint32_t> depth = cell_depths(solid);
  std::uint32_t deepest = 0;
  for (const CellId c : solid.cells()) {
    deepest = std::max(deepest, depth[c]);
    if (depth[c] < static_cast<std::uint32_t>(request.peel)) kept[c] = 0;
  }
  if (static_cast<std::uint32_t>(request.peel) > deepest)
    throw Error(ErrorCode::bad_input, fmt::format("peel {} takes everything away: the solid is {} layers of cells "
                                                  "deep at this level; peel less, or refine it",
                                                  request.peel, deepest + 1));
  return kept;
}

void apply_range(Scene& scene, const PictureRequest& request) {
  if (!request.range || !scene.legend) return;
  scene.legend->low = (*request.range)[0];
  scene.legend->high = (*request.range)[1];
}

void add_field(Scene& scene, const Shown& body, const PictureRequest& request, const Eigen::Matrix3Xd& positions,
               const CellData<std::uint8_t>& kept) {
  ShownField field = shown_field(body.document, request.field, request.reference.get());
  field.values = body.values(std::move(field.values));
  const ColourMap map = request.colours.value_or(field.map);
  if (request.volume) {
    scene.volume = scene_volume(body.solid(), positions, kept, field.values);
    scene.volume->opacity = request.opacity;
    scene.draw_surface = false;
    scene.legend = field_legend(std::vector<double>(scene.volume->values.begin(), scene.volume->values.end()),
                                field.title, field.unit, map);
  } else {
    show_field(scene, {field.values.data(), static_cast<std::size_t>(field.values.size())}, field.title, field.unit,
               map);
  }
  apply_range(scene, request);
}

}  // namespace

Scene make_scene(const Document& document, const PictureRequest& request) {
  if (document.empty()) throw Error(ErrorCode::bad_input, "there is no solid to show; begin with `new` or `open`");
  if (request.net_cell) return net_scene(document, request);
  if (request.corner) return corner_scene(document, *request.corner);
  if (request.volume && request.field.empty())
    throw Error(ErrorCode::bad_input, "a volume is of a field; add `field strain`");
  const Shown body(document, request.smooth);
  const Solid& solid = body.solid();
  const Eigen::Matrix3Xd positions = body.nodes(document.positions());
  Scene scene;
  const CellData<std::uint8_t> kept = shown_cells(solid, positions, request);
  if (request.style == PictureStyle::solid) {
    scene.surface = surface_of(solid, positions, request, kept, body.refinement());
  } else {
    scene.surface = cells_surface(solid, positions);
    scene.surface.wire.clear();
    scene.draw_surface = false;
    add_lines(scene, solid, positions, request.style == PictureStyle::boundary_wireframe);
  }
  if (!request.field.empty() && !request.underlay) add_field(scene, body, request, positions, kept);
  if (request.cell_kinds) show_cell_kinds(scene, solid);
  if (request.frames) {
    add_frames(scene, document, *request.frames, kept);
    scene.draw_surface = false;
  }
  if (request.springs) {
    add_springs(scene, document, kept);
    scene.surface.wire.clear();
    scene.draw_surface = false;
  }
  if (request.overlay_rest)
    add_overlay(scene, surface_mesh(solid, body.nodes(document.rest())), request.springs ? "at rest" : "");
  if (request.overlay) add_overlay(scene, *request.overlay);
  if (request.cage) add_cage(scene, document.solid(), document.positions());
  if (request.line) add_material_line(scene, document, *request.line);
  add_obstacles(scene, document);
  if (request.marks) add_marks(scene, body, request, positions);
  if (request.marks && request.curve_handles.size() > 1) add_curve(scene, document, request.curve_handles);
  if (request.felt) scene.felt = felt_force(request);
  if (request.underlay) {
    lay_under(scene, *request.underlay, request.field, request.underlay_wires);
    apply_range(scene, request);
    scene.draw_surface = true;
  }
  return scene;
}

}  // namespace argil::sculpt
