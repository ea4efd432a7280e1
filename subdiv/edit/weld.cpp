#include "subdiv/edit/weld.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "subdiv/edit/identify.h"
#include "subdiv/error.h"

namespace argil::subdiv {

namespace {

// Vertices by the box of a grid that they lie in; boxes are no smaller than the tolerance, so that what is within
// it lies in the same box or the next.
class Grid {
 public:
  Grid(const Eigen::Matrix3Xd& positions, std::span<const VertexId> vertices, double box) : positions_(positions) {
    for (const VertexId v : vertices) {
      const Eigen::Array3d place = (at(v) / box).array().floor();
      entries_.push_back({{std::int64_t(place[0]), std::int64_t(place[1]), std::int64_t(place[2])}, v});
    }
    std::sort(entries_.begin(), entries_.end());
  }

  std::vector<std::pair<VertexId, VertexId>> pairs_within(double tolerance) const {
    std::vector<std::pair<VertexId, VertexId>> pairs;
    for (const auto& [box, v] : entries_)
      for (int step = 0; step < 27; ++step) {
        const Box next{box[0] + step % 3 - 1, box[1] + step / 3 % 3 - 1, box[2] + step / 9 - 1};
        for (auto other = std::lower_bound(entries_.begin(), entries_.end(), Entry{next, VertexId{0U}});
             other != entries_.end() && other->first == next; ++other)
          if (v < other->second && (at(v) - at(other->second)).norm() <= tolerance)
            pairs.emplace_back(v, other->second);
      }
    return pairs;
  }

 private:
  using Box = std::array<std::int64_t, 3>;
  using Entry = std::pair<Box, VertexId>;
  Eigen::Vector3d at(VertexId v) const { return positions_.col(static_cast<Eigen::Index>(v.index())); }

  const Eigen::Matrix3Xd& positions_;
  std::vector<Entry> entries_;
};

}  // namespace

double extent(const Solid& solid, const Eigen::Matrix3Xd& positions) {
  Eigen::AlignedBox3d box;
  for (const VertexId v : solid.vertices())
    box.extend(Eigen::Vector3d(positions.col(static_cast<Eigen::Index>(v.index()))));
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

Weld weld(Transaction& transaction, const Eigen::Matrix3Xd& positions, std::span<const VertexId> vertices,
          double tolerance) {
  if (!(tolerance >= 0) || !std::isfinite(tolerance))
    throw Error(ErrorCode::bad_input, fmt::format("expected a tolerance of 0 or more, found {}", tolerance));
  const Solid& solid = transaction.solid();
  std::vector<VertexId> candidates;
  double reach = 0;
  for (const VertexId v : vertices) {
    if (!solid.is_live(v))
      throw Error(ErrorCode::not_found, fmt::format("there is no vertex {}; select vertices again", v.value),
                  fmt::format("vertex {}", v.value));
    if (!solid.is_boundary(v)) continue;
    candidates.push_back(v);
    reach = std::max(reach, positions.col(static_cast<Eigen::Index>(v.index())).cwiseAbs().maxCoeff());
  }
  // No finer than what the box numbers hold.
  const double box = std::max({tolerance, 1e-15 * reach, 1e-300});
  const auto groups = joined(Grid(positions, candidates, box).pairs_within(tolerance));

  Weld result;
  const std::size_t faces = solid.face_count();
  identify(transaction, groups, Flattening::refused, result.edit);
  result.faces_glued = faces - solid.face_count();
  for (const Joined& group : groups) {
    result.vertices_gone += group.size() - 1;
    PlacedVertex placed{group[0], {}};
    for (const VertexId v : group) placed.sources.emplace_back(v, 1.0 / static_cast<double>(group.size()));
    result.edit.placed.push_back(std::move(placed));
    result.edit.next_vertices.push_back(group[0]);
  }
  return result;
}

}  // namespace argil::subdiv
