#include "subdiv/edit/peak.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "subdiv/edit/cuts.h"
#include "subdiv/edit/extrude.h"
#include "subdiv/edit/rewrite.h"
#include "subdiv/error.h"
#include "subdiv/radial_edge.h"

namespace argil::subdiv {

Edit raise_peaks(Transaction& transaction, const Eigen::Matrix3Xd& rest, std::span<const FaceId> faces,
                 double height) {
  const Solid& solid = transaction.solid();
  check_boundary_faces(solid, faces);
  std::vector<Eigen::Vector3d> offsets;
  for (const FaceId f : faces) {
    const auto loop = use_vertices(solid, solid.boundary_use(f));
    Eigen::Vector3d area = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < loop.size(); ++i)
      area += rest.col(static_cast<Eigen::Index>(loop[i].index()))
                  .cross(rest.col(static_cast<Eigen::Index>(loop[(i + 1) % loop.size()].index())));
    if (area.norm() < 1e-300)
      throw Error(ErrorCode::bad_geometry,
                  fmt::format("face {} has no area, and so no direction for a peak; leave it out", f.value),
                  fmt::format("face {}", f.value));
    offsets.push_back(height * area.normalized());
  }
  Edit edit;
  std::vector<VertexId> touched;
  for (std::size_t n = 0; n < faces.size(); ++n) {
    const auto loop = use_vertices(solid, solid.boundary_use(faces[n]));
    const VertexId apex = add_mean(transaction, loop, edit);
    edit.placed.back().offset = offsets[n];
    std::vector<Loop> loops{{loop.rbegin(), loop.rend()}};
    for (std::size_t i = 0; i < loop.size(); ++i) loops.push_back({loop[i], loop[(i + 1) % loop.size()], apex});
    transaction.add_cell(loops);
    edit.next_vertices.push_back(apex);
    touched.insert(touched.end(), loop.begin(), loop.end());
  }
  drop_interior_sharpness(transaction, touched);
  check_links(solid, touched);
  return edit;
}

}  // namespace argil::subdiv
