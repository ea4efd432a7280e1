#include "sculpt/physics_picture.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "fem/elements/element_kind.h"
#include "fem/measure/cell_tetrahedra.h"
#include "fem/models/spring_lattice.h"
#include "sculpt/document_loads.h"
#include "sculpt/scene.h"
#include "sculpt/shown_fields.h"
#include "subdiv/build.h"
#include "subdiv/error.h"
#include "subdiv/neighbourhood.h"
#include "subdiv/radial_edge.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

constexpr double k_axis_length = 0.35;

Eigen::Vector3d column(const Eigen::Matrix3Xd& positions, VertexId v) {
  return positions.col(static_cast<Eigen::Index>(v.index()));
}

// ∂x/∂(u, v, w) in the middle of a hexahedron.
Eigen::Matrix3d slopes(const std::array<VertexId, 8>& box, const Eigen::Matrix3Xd& positions) {
  Eigen::VectorXd shapes;
  Eigen::Matrix3Xd gradients;
  fem::trilinear_hexahedron().evaluate(Eigen::Vector3d::Constant(0.5), shapes, gradients);
  Eigen::Matrix3d result = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < box.size(); ++i)
    result += column(positions, box[i]) * gradients.col(static_cast<Eigen::Index>(i)).transpose();
  return result;
}

// R of the polar decomposition with det R = +1.
Eigen::Matrix3d rotation_of(const Eigen::Matrix3d& f) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) *= -1;
  return u * svd.matrixV().transpose();
}

Eigen::Matrix3Xd shown(const Document& document, const Eigen::Matrix3Xd& control_points) {
  return document.state().level == 0 ? control_points : document.surface_nodes(control_points);
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

SceneVolume scene_volume(const Solid& solid, const Eigen::Matrix3Xd& positions, const CellData<std::uint8_t>& kept,
                         const Eigen::VectorXd& values) {
  fem::CellTetrahedra cut = fem::cell_tetrahedra(solid, kept);
  const Eigen::Matrix3Xd points = apply(cut.points, positions);
  const Eigen::VectorXd at_points = apply(cut.points, values);
  // Only what the kept cells use, so that ids of dead vertices and far cells do not reach the picture.
  std::vector<std::uint32_t> new_from_old(static_cast<std::size_t>(points.cols()), 0xffffffffU);
  SceneVolume volume;
  for (std::array<std::uint32_t, 4>& corners : cut.corners)
    for (std::uint32_t& corner : corners) {
      std::uint32_t& number = new_from_old[corner];
      if (number == 0xffffffffU) {
        number = static_cast<std::uint32_t>(volume.positions.size());
        volume.positions.push_back(points.col(corner).cast<float>());
        volume.values.push_back(static_cast<float>(at_points[corner]));
      }
      corner = number;
    }
  volume.tetrahedra = std::move(cut.corners);
  return volume;
}

void add_frames(Scene& scene, const Document& document, FrameKind kind, const CellData<std::uint8_t>& kept) {
  const Solid& solid = document.refinement().solid();
  const Eigen::Matrix3Xd now = shown(document, document.positions()), rest = shown(document, document.rest());
  std::array<SceneLines, 3> axes;
  axes[0].look = LineLook::axis_u;
  axes[1].look = LineLook::axis_v;
  axes[2].look = LineLook::axis_w;
  for (const CellId c : solid.cells()) {
    if (cell_kind(solid, c) != CellKind::hexahedron || (kept.size() > 0 && kept[c] == 0)) continue;
    const std::array<VertexId, 8> box = box_vertices(solid, c);
    const Eigen::Matrix3d tangents = slopes(box, now), rest_tangents = slopes(box, rest);
    Eigen::Matrix3d frame = tangents;
    if (kind == FrameKind::rotated) {
      // The rest tangents, made orthonormal the same way, then turned.
      const Eigen::Matrix3d rotation = rotation_of(tangents * rest_tangents.inverse());
      frame = rotation * rotation_of(rest_tangents) * std::cbrt(std::abs(rest_tangents.determinant()));
    }
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const VertexId v : box) middle += column(now, v) / 8;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d end = middle + k_axis_length * frame.col(static_cast<Eigen::Index>(axis));
      axes[axis].lines.push_back({middle.cast<float>(), end.cast<float>()});
    }
  }
  for (SceneLines& lines : axes) scene.lines.push_back(std::move(lines));
}

ShearedCorner sheared_corner(const Document& document, std::uint32_t vertex) {
  const Solid& solid = document.refinement().solid();
  const VertexId i{vertex};
  if (vertex >= solid.vertex_capacity() || !solid.is_live(i))
    throw Error(ErrorCode::bad_input, fmt::format("there is no vertex {} at level {}; it has {}", vertex,
                                                  document.state().level, solid.vertex_count()));
  const Eigen::Matrix3Xd now = shown(document, document.positions()), rest = shown(document, document.rest());
  ShearedCorner most;
  double largest = -1;
  for (const FaceId f : vertex_faces(solid, i)) {
    const auto loop = solid.face_vertices(f);
    const auto here = static_cast<std::size_t>(std::find(loop.begin(), loop.end(), i) - loop.begin());
    const VertexId a = loop[(here + 1) % loop.size()], b = loop[(here + loop.size() - 1) % loop.size()];
    const Eigen::Vector3d at = column(now, i), s1 = column(now, a) - at, s2 = column(now, b) - at;
    const Eigen::Vector3d normal = s1.cross(s2);
    if (!(normal.norm() > 0)) continue;
    const double rest_angle = angle_between(column(rest, a) - column(rest, i), column(rest, b) - column(rest, i));
    const double angle = angle_between(s1, s2);
    if (!(std::abs(rest_angle - angle) > largest)) continue;
    largest = std::abs(rest_angle - angle);
    const double delta = 0.5 * (rest_angle - angle);
    const Eigen::Vector3d axis = normal.normalized();
    most = {.vertex = vertex,
            .a = a.value,
            .b = b.value,
            .face = f.value,
            .at = at,
            .a_now = at + s1,
            .b_now = at + s2,
            .a_unsheared = at + Eigen::AngleAxisd(-delta, axis) * s1,
            .b_unsheared = at + Eigen::AngleAxisd(delta, axis) * s2,
            .rest_angle = rest_angle,
            .angle = angle};
  }
  if (largest < 0)
    throw Error(ErrorCode::bad_input,
                fmt::format("no corner at vertex {} has an angle, its sides are parallel; choose another", vertex));
  return most;
}

Scene corner_scene(const Document& document, std::uint32_t vertex) {
  const ShearedCorner corner = sheared_corner(document, vertex);
  const Solid& solid = document.refinement().solid();
  const Eigen::Matrix3Xd now = shown(document, document.positions());
  CellData<std::uint8_t> kept(solid.cell_capacity(), 0);
  // One of the face's cells is enough to see where the corner is.
  for (const bool back : {true, false}) {
    const CellId owner = solid.owner(face_use(FaceId{corner.face}, back));
    if (!owner.valid()) continue;
    kept = CellData<std::uint8_t>(solid.cell_capacity(), 0);
    kept[owner] = 1;
  }
  Scene scene;
  scene.surface = cells_surface(solid, now, kept);
  scene.draw_surface = false;
  const auto single = [](const Eigen::Vector3d& v) -> Eigen::Vector3f { return v.cast<float>(); };
  const Eigen::Vector3f at = single(corner.at), a = single(corner.a_now), b = single(corner.b_now),
                        a_turned = single(corner.a_unsheared), b_turned = single(corner.b_unsheared);
  scene.lines.push_back({LineLook::side, {{at, a}, {at, b}}});
  scene.lines.push_back({LineLook::rest_side, {{at, a_turned}, {at, b_turned}}});
  scene.lines.push_back({LineLook::overlay, {{a, a_turned}, {b, b_turned}}});
  const auto degrees = [](double radians) { return radians * 180 / M_PI; };
  // The angle stands between the sides, where it is.
  const Eigen::Vector3d between =
      corner.at + 0.3 * (corner.a_unsheared - corner.at) + 0.3 * (corner.b_unsheared - corner.at);
  scene.labels = {{single(between),
                   fmt::format("θ = {:.1f}°, at rest {:.1f}°", degrees(corner.angle), degrees(corner.rest_angle))},
                  {a, "a"},
                  {b, "b"},
                  {a_turned, "a′"},
                  {b_turned, "b′"}};
  return scene;
}

void add_springs(Scene& scene, const Document& document, const CellData<std::uint8_t>& kept) {
  const std::string& model = document.state().model.name;
  const std::optional<fem::DiagonalSprings> diagonals = fem::model_by_name(model).springs;
  if (!diagonals)
    throw Error(ErrorCode::unsupported,
                fmt::format("the model {} has no springs to draw; choose one that has, as in `model mass_spring`, "
                            "or leave out springs",
                            model));
  const fem::Discretization& discretization = document.discretization();
  const Eigen::Matrix3Xd nodes = apply(discretization.nodes.rows, document.positions());
  const auto at = [&](std::uint32_t node) -> Eigen::Vector3f {
    return nodes.col(static_cast<Eigen::Index>(node)).cast<float>();
  };
  std::array<SceneLines, 3> sets{SceneLines{LineLook::edge_spring, {}, "edges"},
                                 SceneLines{LineLook::face_spring, {}, "face diagonals"},
                                 SceneLines{LineLook::inner_spring, {}, "inner diagonals"}};
  std::vector<std::uint8_t> used(static_cast<std::size_t>(nodes.cols()), 0);
  for (const fem::LatticeSpring& spring : fem::spring_lattice(discretization.blocks, *diagonals, kept.raw())) {
    sets[static_cast<std::size_t>(spring.kind)].lines.push_back({at(spring.from), at(spring.to)});
    used[spring.from] = used[spring.to] = 1;
  }
  for (std::uint32_t node = 0; node < used.size(); ++node)
    if (used[node] != 0) scene.cage_points.push_back(at(node));
  for (SceneLines& lines : sets)
    if (!lines.lines.empty()) scene.lines.push_back(std::move(lines));
}

void add_material_line(Scene& scene, const Document& document, const std::array<Eigen::Vector3d, 2>& ends,
                       int parts) {
  SceneLines lines{LineLook::material_line, {}, "material line"};
  Eigen::Vector3f before = Eigen::Vector3f::Zero();
  for (int i = 0; i <= parts; ++i) {
    const double share = static_cast<double>(i) / parts;
    const fem::MaterialPoint point = material_point(document, (1 - share) * ends[0] + share * ends[1]);
    const Eigen::Vector3f now = fem::position(point.stencil, document.positions()).cast<float>();
    if (i > 0) lines.lines.push_back({before, now});
    before = now;
  }
  scene.lines.push_back(std::move(lines));
}

void add_overlay(Scene& scene, const io::SurfaceMesh& surface, const std::string& name) {
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    const auto face = surface.face(f);
    for (std::size_t i = 0; i < face.size(); ++i) {
      const std::uint32_t a = face[i], b = face[(i + 1) % face.size()];
      edges.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  SceneLines lines{LineLook::overlay, {}, name};
  for (const auto& ends : edges)
    lines.lines.push_back(
        {surface.positions.col(ends[0]).cast<float>(), surface.positions.col(ends[1]).cast<float>()});
  scene.lines.push_back(std::move(lines));
}

void lay_under(Scene& scene, const ComparedMesh& mesh, const std::string& field, bool wires) {
  if (mesh.volume.solid.cell_count() == 0)
    throw Error(
        ErrorCode::bad_input,
        "an underlay is a volume mesh, as `save` writes .vtu, but this file holds a surface alone; show its "
        "edges with `overlay FILE`");
  SceneLines lines{LineLook::overlay, {}, "this solid"};
  for (const auto& ends : scene.surface.wire)
    lines.lines.push_back({scene.surface.positions[ends[0]], scene.surface.positions[ends[1]]});
  if (!lines.lines.empty()) scene.lines.push_back(std::move(lines));
  scene.surface = cells_surface(mesh.volume.solid, mesh.volume.positions);
  if (!wires) scene.surface.wire.clear();
  if (field.empty()) return;
  const auto fields = derived_fields();
  const auto info = std::find_if(fields.begin(), fields.end(), [&](const auto& f) { return field == f.name; });
  if (!field.starts_with("displacement") || info == fields.end())
    throw Error(
        ErrorCode::bad_input,
        fmt::format("an underlay shows its displacements only, not {}; write `field displacement`, or _x, _y "
                    "or _z of it",
                    field));
  if (mesh.displacements.cols() == 0)
    throw Error(ErrorCode::bad_input,
                "the underlay has no point field displacement of three components, as `save` writes to .vtu and "
                ".vtk; leave out field");
  std::vector<double> values;
  for (Eigen::Index v = 0; v < mesh.displacements.cols(); ++v)
    values.push_back(field == "displacement" ? mesh.displacements.col(v).norm()
                                             : mesh.displacements(field.back() - 'x', v));
  show_field(scene, values, std::string(info->title) + " underneath", info->unit,
             info->has_sign ? ColourMap::balanced : ColourMap::viridis);
}

}  // namespace argil::sculpt
