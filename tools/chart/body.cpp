#include "tools/chart/body.h"

#include <Eigen/Geometry>
#include <cmath>

#include "fem/discretization/quadratic_tetrahedra.h"
#include "subdiv/primitives.h"
#include "subdiv/transaction.h"

namespace argil::chart {

namespace {

SpaceRow row_of(std::string name, std::string summary, int level, fem::Space space) {
  return {std::move(name), std::move(summary), level,
          [space](const subdiv::Refinement& refinement, const Eigen::Matrix3Xd& control_points,
                  const fem::NodalFields& fields) {
            return Discretized{fem::discretize(refinement, control_points, fields, {.space = space, .split = 1}),
                               control_points};
          }};
}

void sharpen_where_faces_turn(subdiv::Built& built) {
  constexpr double k_cosine = 0.8660254037844386;  // of 30 degrees
  subdiv::Transaction edit(built.solid);
  for (const subdiv::EdgeId e : built.solid.edges()) {
    std::vector<Eigen::Vector3d> normals;
    built.solid.for_each_face(e, [&](subdiv::FaceId f) {
      if (!built.solid.is_boundary(f)) return;
      const auto corners = built.solid.face_vertices(f);
      const auto at = [&](std::size_t i) -> Eigen::Vector3d {
        return built.positions.col(static_cast<Eigen::Index>(corners[i].index()));
      };
      normals.push_back((at(2) - at(0)).cross(at(3) - at(1)).normalized());
    });
    if (normals.size() == 2 && std::abs(normals[0].dot(normals[1])) < k_cosine)
      edit.set_sharpness(e, subdiv::k_infinitely_sharp);
  }
  static_cast<void>(edit.commit());
}

}  // namespace

std::vector<SpaceRow> spaces() {
  std::vector<SpaceRow> rows{
      row_of("default", "trilinear elements of one refinement, in control points", 1, fem::Space::standard),
      row_of("cubic", "tricubic elements on the control grid itself", 0, fem::Space::cubic),
      row_of("nodes", "plain elements, the nodes their own unknowns", 0, fem::Space::standard),
      row_of("published", "cubic and linear elements mixed as published, not continuous", 1,
             fem::Space::published)};
  rows.back().of_published_method = true;
  rows.push_back({"tetrahedra", "ten-node tetrahedra, the nodes their own unknowns: a reference from outside", 0,
                  [](const subdiv::Refinement& refinement, const Eigen::Matrix3Xd& control_points,
                     const fem::NodalFields& fields) {
                    fem::Discretization made =
                        fem::quadratic_tetrahedra(refinement.solid(), control_points, fields);
                    Eigen::Matrix3Xd rest = made.rest_nodes;
                    return Discretized{std::move(made), std::move(rest)};
                  },
                  false});
  return rows;
}

std::string ModelRow::name() const {
  return choice.formulation == fem::Formulation::plain
             ? choice.name
             : choice.name + " " + std::string(fem::word(choice.formulation));
}

std::vector<ModelRow> models() {
  std::vector<ModelRow> rows;
  for (const fem::ModelKind& kind : fem::model_table())
    for (const fem::Formulation formulation : fem::k_formulations) {
      const bool has = formulation == fem::Formulation::plain ||
                       (formulation == fem::Formulation::b_bar && kind.has_b_bar) ||
                       (formulation == fem::Formulation::incompatible_modes && kind.has_incompatible_modes);
      if (!has) continue;
      const fem::ModelChoice choice{std::string(kind.name), formulation};
      rows.push_back({choice, std::string(kind.summary),
                      [choice](std::span<const fem::ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes) {
                        return fem::make_model(choice, blocks, rest_nodes);
                      },
                      kind.of_published_method});
    }
  return rows;
}

std::size_t Body::element_count() const {
  std::size_t count = 0;
  for (const fem::ElementBlock& block : discretization.blocks) count += block.element_count();
  return count;
}

std::size_t Body::unknowns() const {
  std::size_t free = 0;
  for (const std::uint8_t fixed : system.fixed) free += fixed ? 0 : 1;
  return 3 * free;
}

std::unique_ptr<Body> make_body(const subdiv::Built& solid, const SpaceRow& space, const ModelRow& model,
                                const Material& material, const std::function<bool(const Eigen::Vector3d&)>& held) {
  auto body = std::make_unique<Body>();
  body->refinement = subdiv::refine_to_level(solid.solid, space.level);
  const auto n = static_cast<Eigen::Index>(body->refinement.solid().vertex_capacity());
  fem::NodalFields fields;
  fields.young_modulus.setConstant(n, material.young_modulus);
  fields.poisson_ratio.setConstant(n, material.poisson_ratio);
  fields.density.setConstant(n, material.density);
  fields.damping.setZero(n);
  Discretized discretized = space.discretize(body->refinement, solid.positions, fields);
  body->discretization = std::move(discretized.discretization);
  body->rest = std::move(discretized.rest);
  body->model = model.make(body->discretization.blocks, body->discretization.rest_nodes);

  fem::System& system = body->system;
  system.rows = &body->discretization.nodes.rows;
  system.rows_transposed = &body->discretization.rows_transposed;
  system.model = body->model.get();
  system.rest_nodes = &body->discretization.rest_nodes;
  system.mass = &body->discretization.mass;
  system.damping = &body->discretization.damping;
  system.fixed.assign(system.rows->column_count, 0);
  for (std::size_t i = 0; i < system.fixed.size(); ++i)
    system.fixed[i] = held && held(body->rest.col(static_cast<Eigen::Index>(i))) ? 1 : 0;
  body->state.positions = body->rest;
  body->state.velocities.setZero(3, body->rest.cols());
  return body;
}

fem::SurfacePatch patch_where(const Body& body, const std::function<bool(const Eigen::Vector3d&)>& where) {
  const subdiv::Solid& finest = body.refinement.solid();
  std::vector<subdiv::FaceId> faces;
  for (const subdiv::FaceId f : finest.faces()) {
    if (!finest.is_boundary(f)) continue;
    bool all = true;
    for (const subdiv::VertexId v : finest.face_vertices(f)) {
      const std::uint32_t node = body.discretization.surface_node_from_vertex[v.index()];
      all = all && where(body.discretization.rest_nodes.col(static_cast<Eigen::Index>(node)));
    }
    if (all) faces.push_back(f);
  }
  return fem::surface_patch(body.discretization, finest, faces);
}

Eigen::Vector3d displacement(const Body& body, const Eigen::Vector3d& rest_point) {
  return fem::position(fem::locate(body.discretization, rest_point).stencil, body.state.positions) - rest_point;
}

subdiv::Built sharp_grid(const std::array<int, 3>& cells, const Eigen::Vector3d& size,
                         const std::function<bool(int, int, int)>& keep) {
  const auto [nx, ny, nz] = cells;
  subdiv::CellLists lists;
  lists.positions.resize(3, (nx + 1) * (ny + 1) * (nz + 1));
  const auto number = [&](int i, int j, int k) {
    return static_cast<std::uint32_t>((k * (ny + 1) + j) * (nx + 1) + i);
  };
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i)
        lists.positions.col(number(i, j, k)) << size.x() * i / nx, size.y() * j / ny, size.z() * k / nz;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        if (keep && !keep(i, j, k)) continue;
        lists.kinds.push_back(subdiv::CellKind::hexahedron);
        for (const int up : {0, 1})
          for (const auto& [a, b] : {std::array{0, 0}, {1, 0}, {1, 1}, {0, 1}})
            lists.connectivity.push_back(number(i + a, j + b, k + up));
        lists.offsets.push_back(lists.connectivity.size());
      }
  subdiv::Built built = subdiv::build(lists);
  sharpen_where_faces_turn(built);
  return built;
}

}  // namespace argil::chart
