#include "fem/contact/contact_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fem/loads.h"
#include "subdiv/radial_edge.h"

namespace argil::fem {

namespace {

constexpr std::uint32_t k_none = std::numeric_limits<std::uint32_t>::max();

/// Area of a bilinear quadrilateral that belongs to the places u, v of Simpson's rule, before its weight.
double jacobian(const std::array<Eigen::Vector3d, 4>& x, double u, double v) {
  const Eigen::Vector3d along_u = (1 - v) * (x[1] - x[0]) + v * (x[2] - x[3]);
  const Eigen::Vector3d along_v = (1 - u) * (x[3] - x[0]) + u * (x[2] - x[1]);
  const Eigen::Vector3d n = along_u.cross(along_v);
  return std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
}

/// Adds up points as quadrilaterals share them, then makes stencils of them.
class Points {
 public:
  explicit Points(ContactSurface& surface) : surface_(surface) {}

  std::uint32_t add() {
    surface_.areas.push_back(0);
    surface_.stiffness.push_back(0);
    return static_cast<std::uint32_t>(surface_.areas.size() - 1);
  }
  /// `stiffness` is taken in by area, until finish() divides.
  void give(std::uint32_t point, double area, double stiffness) {
    surface_.areas[point] += area;
    surface_.stiffness[point] += area * stiffness;
  }
  void finish() {
    for (std::size_t i = 0; i < surface_.areas.size(); ++i)
      if (surface_.areas[i] > 0) surface_.stiffness[i] /= surface_.areas[i];
  }

 private:
  ContactSurface& surface_;
};

}  // namespace

ContactSurface contact_surface(const Discretization& discretization, const subdiv::Solid& finest,
                               const Eigen::VectorXd& young_modulus) {
  std::vector<subdiv::FaceId> faces;
  for (const subdiv::FaceId f : finest.faces())
    if (finest.is_boundary(f)) faces.push_back(f);
  const SurfacePatch patch = surface_patch(discretization, finest, faces);

  // Simpson's places of a face in the order corners, edges, middle; edge e runs from corner e to the next.
  constexpr std::array<std::array<double, 2>, 9> k_places{
      {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0}, {1, 0.5}, {0.5, 1}, {0, 0.5}, {0.5, 0.5}}};
  constexpr std::array<double, 9> k_weights{1.0 / 36, 1.0 / 36, 1.0 / 36, 1.0 / 36, 1.0 / 9,
                                            1.0 / 9,  1.0 / 9,  1.0 / 9,  4.0 / 9};
  ContactSurface result;
  Points points(result);
  subdiv::Stencils from_nodes;  // points in nodes of the surface
  from_nodes.column_count = discretization.nodes.node_count();
  std::vector<std::uint32_t> at_vertex(finest.vertex_capacity(), k_none), at_edge(finest.edge_capacity(), k_none);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto loop = subdiv::use_vertices(finest, finest.boundary_use(faces[f]));
    const std::array<std::uint32_t, 4>& quad = patch.quads[f];
    std::array<Eigen::Vector3d, 4> x;
    double modulus = 0;
    for (std::size_t c = 0; c < 4; ++c) {
      x[c] = discretization.rest_nodes.col(static_cast<Eigen::Index>(quad[c]));
      modulus += 0.25 * young_modulus[static_cast<Eigen::Index>(loop[c].index())];
    }
    const double area = jacobian(x, 0.5, 0.5);
    const double stiffness = area > 0 ? k_contact_stiffness * modulus / std::sqrt(area) : 0;
    for (std::size_t place = 0; place < 9; ++place) {
      std::uint32_t own = k_none;
      std::uint32_t* point = &own;
      if (place < 4) {
        point = &at_vertex[loop[place].index()];
      } else if (place < 8) {
        const subdiv::VertexId a = loop[place - 4], b = loop[(place - 3) % 4];
        for (const subdiv::EdgeId e : finest.face_edges(faces[f])) {
          const auto& ends = finest.edge_vertices(e);
          if ((ends[0] == a && ends[1] == b) || (ends[0] == b && ends[1] == a)) point = &at_edge[e.index()];
        }
      }
      if (*point == k_none) {
        *point = points.add();
        std::array<std::uint32_t, 4> nodes = quad;
        std::size_t count = 4;
        if (place < 4)
          nodes[0] = quad[place], count = 1;
        else if (place < 8)
          nodes = {quad[place - 4], quad[(place - 3) % 4], 0, 0}, count = 2;
        std::sort(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(count));
        const std::array<double, 4> weights{1.0 / static_cast<double>(count), 1.0 / static_cast<double>(count),
                                            0.25, 0.25};
        from_nodes.append({nodes.data(), count}, {weights.data(), count});
      }
      points.give(*point, k_weights[place] * jacobian(x, k_places[place][0], k_places[place][1]), stiffness);
    }
  }
  points.finish();
  result.rows = subdiv::compose(from_nodes, discretization.nodes.rows);
  return result;
}

}  // namespace argil::fem
