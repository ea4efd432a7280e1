#include "sculpt/document_loads.h"

#include <fmt/format.h>

#include <algorithm>

#include "subdiv/error.h"

namespace argil::sculpt {

using namespace subdiv;

std::vector<FaceId> finest_faces(const Refinement& refinement, const std::vector<std::uint32_t>& control_faces) {
  std::vector<std::uint8_t> chosen(refinement.levels[0].face_capacity(), 0);
  for (const std::uint32_t f : control_faces) chosen[f] = 1;
  for (std::size_t level = 1; level < refinement.levels.size(); ++level) {
    // A fine face that came of a coarse one holds the coarse face's point; those points follow the vertices and
    // edges.
    const Solid& coarse = refinement.levels[level - 1];
    const Solid& fine = refinement.levels[level];
    const std::size_t first = coarse.vertex_count() + coarse.edge_count();
    std::vector<std::uint8_t> chosen_point;
    chosen_point.reserve(coarse.face_count());
    for (const FaceId f : coarse.faces()) chosen_point.push_back(chosen[f.index()]);
    std::vector<std::uint8_t> next(fine.face_capacity(), 0);
    for (const FaceId f : fine.faces()) {
      if (!fine.is_boundary(f)) continue;
      for (const VertexId v : fine.face_vertices(f))
        if (v.index() >= first && v.index() < first + chosen_point.size() && chosen_point[v.index() - first])
          next[f.index()] = 1;
    }
    chosen = std::move(next);
  }
  std::vector<FaceId> faces;
  for (std::size_t f = 0; f < chosen.size(); ++f)
    if (chosen[f]) faces.emplace_back(f);
  return faces;
}

fem::MaterialPoint material_point(const Document& document, const Eigen::Vector3d& rest_position) {
  try {
    return fem::locate(document.discretization(), rest_position);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::not_found) throw;
    throw Error(
        ErrorCode::bad_input,
        fmt::format(
            "({:g}, {:g}, {:g}) is not inside the solid; give the rest position of a point in it (refinement "
            "draws smooth boundaries inwards)",
            rest_position.x(), rest_position.y(), rest_position.z()));
  }
}

fem::Loads document_loads(const Document& document) {
  const fem::Discretization& d = document.discretization();
  const AppliedLoads& applied = *document.state().loads;
  fem::Loads loads;
  loads.forces = fem::gravity_forces(d, applied.gravity);
  for (const AppliedForce& force : applied.forces) {
    if (force.faces.empty()) {
      loads.forces += fem::point_forces(material_point(document, force.point).stencil,
                                        static_cast<std::size_t>(loads.forces.cols()), force.force);
    } else {
      const auto faces = finest_faces(document.refinement(), force.faces);
      loads.forces += fem::spread_force(d, fem::surface_patch(d, document.refinement().solid(), faces),
                                        d.rest_nodes, force.force);
    }
  }
  for (const SoftPin& pin : document.state().pins->nodes) {
    const StencilRow row = d.nodes.rows.row(d.surface_node_from_vertex[pin.node]);
    fem::AnchorSpring spring;
    spring.control_points.assign(row.columns.begin(), row.columns.end());
    spring.weights.assign(row.weights.begin(), row.weights.end());
    spring.target = pin.target;
    spring.stiffness = pin.stiffness;
    loads.springs.push_back(std::move(spring));
  }
  return loads;
}

fem::Falloff falloff_by_word(const std::string& word) {
  if (word == "constant") return fem::Falloff::constant;
  return word == "linear" ? fem::Falloff::linear : fem::Falloff::smooth;
}

double falloff_weight(fem::Falloff falloff, double s) {
  if (s >= 1) return 0;
  switch (falloff) {
    case fem::Falloff::constant:
      return 1;
    case fem::Falloff::linear:
      return 1 - s;
    case fem::Falloff::smooth:
      return (1 - s * s) * (1 - s * s);
  }
  return 0;
}

}  // namespace argil::sculpt
