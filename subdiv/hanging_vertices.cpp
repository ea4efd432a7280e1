#include "subdiv/hanging_vertices.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "subdiv/disjoint_sets.h"
#include "subdiv/sort_unique.h"

namespace argil::subdiv {
namespace {

// A tree over points: each node splits its points at the median of the longest side of their box.
class PointTree {
 public:
  PointTree(const Eigen::Matrix3Xd& positions, std::vector<VertexId> vertices)
      : positions_(&positions), vertices_(std::move(vertices)) {
    if (!vertices_.empty()) make(0, vertices_.size());
  }

  /// Calls visit(VertexId) for the points in a box.
  template <class Visit>
  void in_box(const Eigen::AlignedBox3d& box, Visit visit) const {
    if (!nodes_.empty()) search(0, box, visit);
  }

 private:
  static constexpr std::size_t k_leaf = 8;
  struct Node {
    Eigen::AlignedBox3d box;
    std::size_t begin, end;
    std::size_t right = 0;  // 0: a leaf; the left child follows
  };

  Eigen::Vector3d at(VertexId v) const { return positions_->col(static_cast<Eigen::Index>(v.index())); }

  std::size_t make(std::size_t begin, std::size_t end) {
    Eigen::AlignedBox3d box;
    for (std::size_t i = begin; i < end; ++i) box.extend(at(vertices_[i]));
    const std::size_t node = nodes_.size();
    nodes_.push_back({box, begin, end});
    if (end - begin <= k_leaf) return node;
    Eigen::Index axis = 0;
    box.sizes().maxCoeff(&axis);
    const std::size_t middle = (begin + end) / 2;
    const auto first = vertices_.begin();
    std::nth_element(first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(middle),
                     first + static_cast<std::ptrdiff_t>(end), [&](VertexId a, VertexId b) {
                       const double x = at(a)[axis], y = at(b)[axis];
                       return x != y ? x < y : a < b;
                     });
    make(begin, middle);
    const std::size_t right = make(middle, end);
    nodes_[node].right = right;
    return node;
  }

  template <class Visit>
  void search(std::size_t index, const Eigen::AlignedBox3d& box, Visit& visit) const {
    const Node& node = nodes_[index];
    if (!node.box.intersects(box)) return;
    if (node.right != 0) {
      search(index + 1, box, visit);
      search(node.right, box, visit);
      return;
    }
    for (std::size_t i = node.begin; i < node.end; ++i)
      if (box.contains(at(vertices_[i]))) visit(vertices_[i]);
  }

  const Eigen::Matrix3Xd* positions_;
  std::vector<VertexId> vertices_;
  std::vector<Node> nodes_;
};

double distance_squared_to_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                    const Eigen::Vector3d& c) {
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const double area = normal.squaredNorm();
  const bool inside = area > 0 && normal.dot((b - a).cross(p - a)) >= 0 && normal.dot((c - b).cross(p - b)) >= 0 &&
                      normal.dot((a - c).cross(p - c)) >= 0;
  if (inside) return std::pow(normal.dot(p - a), 2) / area;
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [from, to] : {std::pair{&a, &b}, std::pair{&b, &c}, std::pair{&c, &a}}) {
    const Eigen::Vector3d along = *to - *from;
    const double length = along.squaredNorm();
    const double t = length > 0 ? std::clamp(along.dot(p - *from) / length, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, (p - *from - t * along).squaredNorm());
  }
  return nearest;
}

}  // namespace

std::optional<HangingVertex> find_hanging_vertex(const Solid& solid, const Eigen::Matrix3Xd& positions,
                                                 double tolerance) {
  // Boundary faces, and their vertices, piece after piece.
  DisjointSets pieces(solid.vertex_capacity());
  for (const EdgeId e : solid.edges())
    pieces.unite(solid.edge_vertices(e)[0].value, solid.edge_vertices(e)[1].value);
  std::vector<std::pair<std::uint32_t, FaceId>> faces;
  std::vector<std::pair<std::uint32_t, VertexId>> vertices;
  for (const FaceId f : solid.faces()) {
    if (!solid.is_boundary(f)) continue;
    const std::uint32_t piece = pieces.find(solid.face_vertices(f)[0].value);
    faces.emplace_back(piece, f);
    for (const VertexId v : solid.face_vertices(f)) vertices.emplace_back(piece, v);
  }
  std::sort(faces.begin(), faces.end());
  sort_unique(vertices);
  const auto at = [&](VertexId v) -> Eigen::Vector3d {
    return positions.col(static_cast<Eigen::Index>(v.index()));
  };

  std::optional<HangingVertex> found;
  PointTree tree(positions, {});
  std::size_t next_vertex = 0;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const auto [piece, f] = faces[i];
    if (i == 0 || piece != faces[i - 1].first) {
      std::vector<VertexId> of_piece;
      for (; next_vertex < vertices.size() && vertices[next_vertex].first == piece; ++next_vertex)
        of_piece.push_back(vertices[next_vertex].second);
      tree = PointTree(positions, std::move(of_piece));
    }
    const auto loop = solid.face_vertices(f);
    Eigen::AlignedBox3d box;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const VertexId v : loop) {
      box.extend(at(v));
      middle += at(v);
    }
    middle /= static_cast<double>(loop.size());
    const double near = tolerance * box.diagonal().norm();
    const Eigen::AlignedBox3d wide(box.min().array() - near, box.max().array() + near);
    const CellId owner = solid.owner(solid.boundary_use(f));
    const auto lies_on = [&](VertexId v) {
      for (std::size_t k = 0; k < loop.size(); ++k)
        if ((at(v) - at(loop[k])).norm() <= near)
          return false;  // beside a corner: a double point, not a hanging one
      for (std::size_t k = 0; k < loop.size(); ++k)
        if (distance_squared_to_triangle(at(v), at(loop[k]), at(loop[(k + 1) % loop.size()]), middle) <=
            near * near)
          return true;
      return false;
    };
    tree.in_box(wide, [&](VertexId v) {
      if (found && !(v < found->vertex)) return;
      for (const FaceUseId use : solid.cell_face_uses(owner)) {  // a flat cell's own corners do not hang
        const auto own = solid.face_vertices(face_of(use));
        if (std::find(own.begin(), own.end(), v) != own.end()) return;
      }
      if (lies_on(v)) found = HangingVertex{v, f, owner};
    });
  }
  return found;
}

}  // namespace argil::subdiv
