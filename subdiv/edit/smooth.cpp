#include "subdiv/edit/smooth.h"

namespace argil::subdiv {

namespace {

// Of Taubin's filter: shapes that are longer than this frequency stay as they are.
constexpr double k_pass_band = 0.1;

std::size_t boundary_face_count(const Solid& solid, EdgeId e) {
  std::size_t count = 0;
  solid.for_each_face(e, [&](FaceId f) { count += solid.is_boundary(f) ? 1 : 0; });
  return count;
}

}  // namespace

std::vector<VertexId> smoothing_neighbours(const Solid& solid, VertexId vertex) {
  std::vector<VertexId> all, boundary, crease;
  bool on_sheet = false;
  solid.for_each_edge(vertex, [&](EdgeId e) {
    const VertexId other = solid.other_vertex(e, vertex);
    all.push_back(other);
    const std::size_t faces = boundary_face_count(solid, e);
    if (faces > 0) boundary.push_back(other);
    if (faces > 2 || solid.edge_sharpness(e) > 0) crease.push_back(other);
    solid.for_each_face(
        e, [&](FaceId f) { on_sheet = on_sheet || (solid.face_sharpness(f) > 0 && !solid.is_boundary(f)); });
  });
  if (on_sheet || solid.vertex_sharpness(vertex) > 0 || crease.size() > 2) return {};
  if (crease.size() == 2) return crease;
  return boundary.empty() ? all : boundary;
}

void smooth(const Solid& solid, GuardedMotion& motion, std::span<const VertexId> vertices,
            const SmoothOptions& options) {
  std::vector<std::vector<VertexId>> neighbours;
  std::vector<std::uint8_t> interior;
  for (const VertexId v : vertices) {
    neighbours.push_back(smoothing_neighbours(solid, v));
    interior.push_back(solid.is_boundary(v) ? 0 : 1);
  }
  Eigen::Matrix3Xd targets(3, static_cast<Eigen::Index>(vertices.size()));
  const auto step = [&](double part, bool boundary_only) {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      Eigen::Vector3d mean = Eigen::Vector3d::Zero();
      for (const VertexId w : neighbours[i]) mean += motion.at(w) / static_cast<double>(neighbours[i].size());
      const Eigen::Vector3d here = motion.at(vertices[i]);
      const bool stays = neighbours[i].empty() || (boundary_only && interior[i]);
      targets.col(static_cast<Eigen::Index>(i)) = stays ? here : Eigen::Vector3d(here + part * (mean - here));
    }
    for (std::size_t i = 0; i < vertices.size(); ++i)
      (void)motion.move(vertices[i], targets.col(static_cast<Eigen::Index>(i)));
  };
  const double inwards = options.amount / 2, outwards = inwards / (1 - k_pass_band * inwards);
  for (int i = 0; i < options.times; ++i) {
    step(inwards, false);
    if (!options.shrink) step(-outwards, true);
  }
}

}  // namespace argil::subdiv
