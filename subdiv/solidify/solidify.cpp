#include "subdiv/solidify/solidify.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "subdiv/boundary.h"
#include "subdiv/edit/smooth.h"
#include "subdiv/error.h"
#include "subdiv/guarded_motion.h"
#include "subdiv/query/surface_tree.h"
#include "subdiv/radial_edge.h"
#include "subdiv/solidify/voxels.h"

namespace argil::subdiv {

namespace {

constexpr std::uint32_t k_no_point = 0xffffffffU;
// Of a cube: how far its boundary gives way to the layers at first.
constexpr double k_retreat = 0.3;

// Blocks with layers about them, as lists whose last points, one a boundary vertex of the blocks, are outermost.
class BlockMesh {
 public:
  BlockMesh(const Voxels& voxels, int layers) : voxels_(voxels) {
    const auto& n = voxels.counts;
    point_.assign(static_cast<std::size_t>(n[0] + 1) * static_cast<std::size_t>(n[1] + 1) *
                      static_cast<std::size_t>(n[2] + 1),
                  k_no_point);
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i)
          if (voxels.is_filled(i, j, k)) add_cube({i, j, k});
    if (layers > 0) add_layers(layers);
    lists.positions.resize(3, static_cast<Eigen::Index>(points_.size()));
    for (std::size_t i = 0; i < points_.size(); ++i) lists.positions.col(static_cast<Eigen::Index>(i)) = points_[i];
  }

  CellLists lists;

 private:
  using Place = std::array<int, 3>;

  std::uint32_t point_at(const Place& p) {
    const auto& n = voxels_.counts;
    std::uint32_t& point = point_[(static_cast<std::size_t>(p[2]) * static_cast<std::size_t>(n[1] + 1) +
                                   static_cast<std::size_t>(p[1])) *
                                      static_cast<std::size_t>(n[0] + 1) +
                                  static_cast<std::size_t>(p[0])];
    if (point == k_no_point) {
      point = static_cast<std::uint32_t>(points_.size());
      points_.push_back(voxels_.origin + voxels_.size * Eigen::Vector3d(p[0], p[1], p[2]));
    }
    return point;
  }

  void end_hexahedron() {
    lists.kinds.push_back(CellKind::hexahedron);
    lists.offsets.push_back(lists.connectivity.size());
  }

  void add_cube(const Place& cube) {
    for (const Place& d :
         {Place{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}})
      lists.connectivity.push_back(point_at({cube[0] + d[0], cube[1] + d[1], cube[2] + d[2]}));
    end_hexahedron();
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        Place beside = cube;
        beside[axis] += side == 1 ? 1 : -1;
        if (voxels_.is_filled(beside[0], beside[1], beside[2])) continue;
        std::array<std::uint32_t, 4> quad{};  // counter-clockwise from outside
        for (std::size_t corner = 0; corner < 4; ++corner) {
          Place p = cube;
          p[axis] += side;
          const bool first = corner == 1 || corner == 2, second = corner >= 2;
          p[(axis + 1) % 3] += (side == 1 ? first : second) ? 1 : 0;
          p[(axis + 2) % 3] += (side == 1 ? second : first) ? 1 : 0;
          quad[corner] = point_at(p);
        }
        quads_.push_back(quad);
      }
  }

  void add_layers(int layers) {
    const std::size_t count = points_.size();
    std::vector<std::uint32_t> inner, rank(count, k_no_point);
    std::vector<Eigen::Vector3d> normal(count, Eigen::Vector3d::Zero());
    for (const auto& quad : quads_) {
      const Eigen::Vector3d n = (points_[quad[1]] - points_[quad[0]]).cross(points_[quad[3]] - points_[quad[0]]);
      for (const std::uint32_t v : quad) normal[v] += n.normalized();
    }
    for (const auto& quad : quads_)
      for (const std::uint32_t v : quad)
        if (rank[v] == k_no_point) {
          rank[v] = static_cast<std::uint32_t>(inner.size());
          inner.push_back(v);
        }
    for (int layer = 1; layer <= layers; ++layer)
      for (const std::uint32_t v : inner)
        points_.push_back(points_[v] - k_retreat * voxels_.size * (1 - static_cast<double>(layer) / layers) *
                                           normal[v].normalized());
    for (const std::uint32_t v : inner) points_[v] -= k_retreat * voxels_.size * normal[v].normalized();
    const auto point = [&](int layer, std::uint32_t v) {
      return layer == 0
                 ? v
                 : static_cast<std::uint32_t>(count + static_cast<std::size_t>(layer - 1) * inner.size() + rank[v]);
    };
    for (int layer = 0; layer < layers; ++layer)
      for (const auto& quad : quads_) {
        for (const int l : {layer, layer + 1})
          for (const std::uint32_t v : quad) lists.connectivity.push_back(point(l, v));
        end_hexahedron();
      }
  }

  const Voxels& voxels_;
  std::vector<std::uint32_t> point_;  // of a corner of the grid
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::array<std::uint32_t, 4>> quads_;  // the blocks' boundary
};

double gap_between(const ClosedSurface& surface, const Built& built) {
  const BoundarySurface boundary = boundary_surface(built.solid);
  const SurfaceTriangles fanned = triangulate(boundary);
  std::vector<std::array<std::uint32_t, 3>> triangles(fanned.face_from_triangle.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      triangles[t][i] = boundary.vertex_from_surface[fanned.corners[3 * t + i]].value;
  const SurfaceTree tree(built.positions, triangles);
  double largest = 0;
  for (const auto& t : surface.triangles)
    for (const std::uint32_t v : t) {
      const Eigen::Vector3d p = surface.positions.col(v);
      largest = std::max(largest, (tree.nearest(p) - p).norm());
    }
  return largest;
}

}  // namespace

double box_cell_count(const ClosedSurface& surface, double cell_size) {
  const Eigen::Vector3d box = surface.positions.rowwise().maxCoeff() - surface.positions.rowwise().minCoeff();
  return (box / cell_size).array().ceil().max(1).prod();
}

Solidified solidify(const ClosedSurface& surface, const SolidifyOptions& options,
                    const std::function<void(double, const char*)>& progress) {
  const auto tell = [&](double part, const char* what) {
    if (progress) progress(part, what);
  };
  Solidified result;
  Voxels voxels = voxel_grid(surface, options.cell_size);
  fill(voxels, surface, [&](double part) { tell(0.4 * part, "finding the inside"); });
  if (std::find(voxels.filled.begin(), voxels.filled.end(), 1) == voxels.filled.end())
    throw Error(ErrorCode::bad_geometry,
                fmt::format("the surface is thinner than cells of {:.3g} m everywhere; ask for smaller cells",
                            options.cell_size));
  result.overlapping_samples = voxels.overlapping;
  result.inside_out_samples = voxels.inside_out;
  result.added_cubes = make_manifold(voxels);
  result.built = build(BlockMesh(voxels, options.layers).lists);
  Built& built = result.built;
  result.component_count = static_cast<std::size_t>(components(built.solid).count);

  std::vector<VertexId> outside, inside;
  for (const VertexId v : built.solid.vertices()) (built.solid.is_boundary(v) ? outside : inside).push_back(v);
  std::vector<VertexId> all = outside;
  all.insert(all.end(), inside.begin(), inside.end());
  GuardedMotion motion(built.solid, built.positions, all);
  const SurfaceTree tree(surface.positions, surface.triangles);
  const auto go_to_surface = [&] {
    Eigen::Matrix3Xd targets(3, static_cast<Eigen::Index>(outside.size()));
    for (std::size_t i = 0; i < outside.size(); ++i)
      targets.col(static_cast<Eigen::Index>(i)) = tree.nearest(motion.at(outside[i]));
    return move_guarded(motion, outside, targets);
  };
  for (int round = 0; round < options.rounds; ++round) {
    tell(0.4 + 0.5 * round / options.rounds, "going to the surface");
    result.off_surface = go_to_surface();
    smooth(built.solid, motion, inside, {.times = 2, .shrink = true});
    if (round + 1 == options.rounds) break;
    smooth(built.solid, motion, outside, {.times = 1, .amount = 0.5, .shrink = true});
  }
  result.off_surface = go_to_surface();
  built.positions = motion.positions();
  tell(0.95, "measuring");
  result.largest_gap = gap_between(surface, built);
  return result;
}

}  // namespace argil::subdiv
