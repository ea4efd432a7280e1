#include "subdiv/edit/mirror.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "subdiv/edit/join.h"
#include "subdiv/edit/rewrite.h"
#include "subdiv/error.h"
#include "subdiv/radial_edge.h"

namespace argil::subdiv {

namespace {

// Less than this is no fold.
constexpr double k_fold = std::numbers::pi / 6;
// A vertex so near the plane [m] is on neither side, even if it is not shared.
constexpr double k_on_plane = 1e-9;

Plane normalized(Plane plane) {
  const double length = plane.normal.norm();
  if (!(std::isfinite(length) && length > 0 && plane.point.allFinite()))
    throw Error(ErrorCode::bad_input, "the plane has no normal; give one that is not zero");
  plane.normal /= length;
  return plane;
}

// Named twice, the source takes the image into its sets and pins.
PlacedVertex placed(VertexId vertex, VertexId source, const Plane& plane, double times) {
  return {vertex,
          {{source, 0.5}, {source, 0.5}},
          times * plane.normal.dot(plane.point) * plane.normal,
          Eigen::Matrix3d::Identity() - times * plane.normal * plane.normal.transpose()};
}

class Mirror {
 public:
  Mirror(Transaction& transaction, const Eigen::Matrix3Xd& rest, std::span<const CellId> cells, const Plane& plane,
         double weld)
      : t_(transaction), solid_(transaction.solid()), rest_(rest), cells_(cells), plane_(plane), weld_(weld) {}

  Edit run() {
    check_sides();
    find_glued();
    CopiedCells copies = copy_cells(t_, cells_, shared_, true);
    for (const auto& [source, copy] : copies.copy_from_vertex)
      edit_.placed.push_back(placed(copy, source, plane_, copy == source ? 1 : 2));
    smooth_seam(copies);
    for (const auto& descent : copies.cells) edit_.next_cells.push_back(descent.made);
    edit_.edges = std::move(copies.edges);
    edit_.faces = std::move(copies.faces);
    edit_.cells = std::move(copies.cells);
    return std::move(edit_);
  }

 private:
  double height(VertexId v) const {
    return plane_.normal.dot(rest_.col(static_cast<Eigen::Index>(v.index())) - plane_.point);
  }

  void check_sides() {
    std::size_t above = 0, below = 0;
    CellId first_below;
    for (const CellId c : cells_) {
      bool up = false, down = false;
      for (const VertexId v : cell_vertices(solid_, c)) {
        const double h = height(v);
        if (std::abs(h) <= weld_) shared_.emplace(v, v);
        if (std::abs(h) > std::max(weld_, k_on_plane)) {
          (h > 0 ? up : down) = true;
        }
      }
      const std::string where = fmt::format("cell {}", c.value);
      if (!up && !down)
        throw Error(
            ErrorCode::bad_geometry,
            fmt::format("cell {} lies within {:g} m of the plane and would be flat; give a smaller weld, or "
                        "leave it out",
                        c.value, weld_),
            where);
      if (up && down)
        throw Error(
            ErrorCode::bad_geometry,
            fmt::format("cell {} reaches through the plane; cut or move it first, or give a larger weld", c.value),
            where);
      (up ? above : below) += 1;
      if (down && !first_below.valid()) first_below = c;
    }
    if (above > 0 && below > 0)
      throw Error(ErrorCode::bad_geometry,
                  fmt::format("{} cells lie on one side of the plane and {} on the other, so the image would lie "
                              "within the solid; remove one side first, or name the cells of one side",
                              above, below),
                  fmt::format("cell {}", first_below.value));
  }

  void find_glued() {
    for (const CellId c : cells_)
      for (const FaceUseId use : solid_.cell_face_uses(c)) {
        const auto loop = solid_.face_vertices(face_of(use));
        if (!std::all_of(loop.begin(), loop.end(), [&](VertexId v) { return shared_.count(v) != 0; })) continue;
        if (!solid_.is_boundary(face_of(use)))
          throw Error(ErrorCode::bad_topology,
                      fmt::format("face {} lies in the plane and has cells on both sides already; mirror all cells "
                                  "of one side, after removing the other",
                                  face_of(use).value),
                      fmt::format("face {}", face_of(use).value));
        glued_.push_back(face_of(use));
      }
  }

  Eigen::Vector3d normal_after(FaceId f, const std::map<VertexId, VertexId>& source_from_copy) const {
    const auto loop = use_vertices(solid_, solid_.boundary_use(f));
    const auto at = [&](VertexId v) -> Eigen::Vector3d {
      const auto copied = source_from_copy.find(v);
      const VertexId source = copied == source_from_copy.end() ? v : copied->second;
      const Eigen::Vector3d p = rest_.col(static_cast<Eigen::Index>(source.index()));
      const double times = copied != source_from_copy.end() ? 2 : shared_.count(v) != 0 ? 1 : 0;
      return p - times * height(source) * plane_.normal;
    };
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
      sum += (at(loop[i]) - at(loop[0])).cross(at(loop[i + 1]) - at(loop[0]));
    return sum.normalized();
  }

  void smooth_seam(const CopiedCells& copies) {
    std::map<VertexId, VertexId> source_from_copy;
    for (const auto& [source, copy] : copies.copy_from_vertex)
      if (copy != source) source_from_copy.emplace(copy, source);
    for (const FaceId f : glued_) {
      const auto loop = solid_.face_vertices(f);
      const auto edges = solid_.face_edges(f);
      for (std::size_t i = 0; i < edges.size(); ++i) {
        std::vector<FaceId> outer;
        solid_.for_each_face(edges[i], [&](FaceId g) {
          if (solid_.is_boundary(g)) outer.push_back(g);
        });
        if (outer.size() != 2 || solid_.edge_sharpness(edges[i]) == 0) continue;
        const double cosine =
            normal_after(outer[0], source_from_copy).dot(normal_after(outer[1], source_from_copy));
        if (cosine < std::cos(k_fold)) continue;
        t_.set_sharpness(edges[i], 0);
        t_.set_sharpness(loop[i], 0);
        t_.set_sharpness(loop[(i + 1) % loop.size()], 0);
      }
    }
  }

  Transaction& t_;
  const Solid& solid_;
  const Eigen::Matrix3Xd& rest_;
  std::span<const CellId> cells_;
  const Plane plane_;
  const double weld_;
  std::map<VertexId, VertexId> shared_;
  std::vector<FaceId> glued_;
  Edit edit_;
};

}  // namespace

Edit mirror(Transaction& transaction, const Eigen::Matrix3Xd& rest, std::span<const CellId> cells,
            const Plane& plane, const MirrorOptions& options) {
  if (cells.empty()) throw Error(ErrorCode::bad_input, "expected cells to mirror, found none; select some first");
  for (const CellId c : cells)
    if (!transaction.solid().is_live(c))
      throw Error(ErrorCode::not_found, fmt::format("there is no cell {}; select cells again", c.value),
                  fmt::format("cell {}", c.value));
  return Mirror(transaction, rest, cells, normalized(plane), options.weld).run();
}

Edit reflect(Transaction& transaction, const Plane& plane) {
  const Plane unit = normalized(plane);
  const Solid& solid = transaction.solid();
  Edit edit;
  Rewrite change;
  for (const CellId c : solid.cells()) {
    NewCell turned{cell_loops(solid, c), c};
    for (auto& loop : turned.loops) std::reverse(loop.begin(), loop.end());
    change.removed.push_back(c);
    change.added.push_back(std::move(turned));
  }
  for (const VertexId v : solid.vertices()) edit.placed.push_back(placed(v, v, unit, 2));
  rewrite(transaction, change, edit);
  return edit;
}

}  // namespace argil::subdiv
