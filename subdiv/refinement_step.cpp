#include "subdiv/refinement_step.h"

#include <algorithm>
#include <cassert>

#include "subdiv/build.h"
#include "subdiv/point_rules.h"

namespace argil::subdiv {

namespace {

constexpr std::size_t k_cells_between = 4096;  // two words of progress

template <class IdType, class Range>
std::vector<IdType> list(const Range& range, std::size_t count) {
  std::vector<IdType> ids;
  ids.reserve(count);
  for (const IdType id : range) ids.push_back(id);
  return ids;
}

template <class IdType>
ElementData<IdType, std::uint32_t> number(const std::vector<IdType>& ids, std::size_t capacity) {
  ElementData<IdType, std::uint32_t> result(capacity, 0);
  for (std::size_t i = 0; i < ids.size(); ++i) result[ids[i]] = static_cast<std::uint32_t>(i);
  return result;
}

// Makes the fine topology. Fine edges: two halves of every coarse edge, then one from the edge point to the face
// point at every corner of a face (by the edge that follows the corner), then one from the face point to the cell
// point at every face-use. Fine faces: a quarter at every corner of a face, then one at every (cell, edge).
class CellSplitter {
 public:
  CellSplitter(const Solid& coarse, const Incidence& incidence)
      : coarse_(coarse),
        incidence_(incidence),
        vertices_(list<VertexId>(coarse.vertices(), coarse.vertex_count())),
        edges_(list<EdgeId>(coarse.edges(), coarse.edge_count())),
        faces_(list<FaceId>(coarse.faces(), coarse.face_count())),
        cells_(list<CellId>(coarse.cells(), coarse.cell_count())),
        vertex_number_(number(vertices_, coarse.vertex_capacity())),
        edge_number_(number(edges_, coarse.edge_capacity())),
        first_corner_(coarse.face_capacity(), 0),
        fine_vertex_from_face_(coarse.face_capacity()) {
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      first_corner_[faces_[i]] = corner_count_;
      corner_count_ += coarse.face_vertices(faces_[i]).size();
      fine_vertex_from_face_[faces_[i]] = VertexId{first_face_point() + i};
    }
    for (const CellId c : cells_) use_count_ += coarse.cell_face_uses(c).size();
  }

  std::size_t first_edge_point() const { return vertices_.size(); }
  std::size_t first_face_point() const { return first_edge_point() + edges_.size(); }
  std::size_t first_cell_point() const { return first_face_point() + faces_.size(); }
  std::size_t fine_vertex_count() const { return first_cell_point() + cells_.size(); }

  const std::vector<VertexId>& vertices() const { return vertices_; }
  const std::vector<EdgeId>& edges() const { return edges_; }
  const std::vector<FaceId>& faces() const { return faces_; }
  const std::vector<CellId>& cells() const { return cells_; }

  void split(RefinementStep& step, const Progress& progress) {
    reserve();
    for (std::size_t i = 0; i < fine_vertex_count(); ++i) builder_.add_vertex();
    add_edges();
    add_quarter_faces();
    set_sharpness();
    step.coarse_from_fine.raw().reserve(incidence_.cell_vertex_count());
    step.corner_from_fine.raw().reserve(incidence_.cell_vertex_count());
    std::size_t first_use = 0;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (i % k_cells_between == 0) progress.at(static_cast<double>(i) / static_cast<double>(cells_.size()));
      collect_sides(cells_[i]);
      add_inner_faces(VertexId{first_cell_point() + i}, first_use);
      add_cells(cells_[i], step);
      first_use += coarse_.cell_face_uses(cells_[i]).size();
    }
    step.fine = builder_.finish();
  }

 private:
  // One of the two sides that an edge has in a cell.
  struct Side {
    EdgeId edge;
    std::uint32_t corner;  // of the face, the one that the edge follows
    std::uint32_t use;     // within the cell
    VertexId from;         // the edge runs from here as seen from outside the cell
    FaceUseId face;
  };

  void reserve() {
    std::size_t cell_corners = 0;
    for (const CellId c : cells_)
      for (const FaceUseId use : coarse_.cell_face_uses(c))
        cell_corners += coarse_.face_vertices(face_of(use)).size();
    const std::size_t fine_faces = corner_count_ + cell_corners / 2;
    builder_.reserve(fine_vertex_count(), 2 * edges_.size() + corner_count_ + use_count_, fine_faces,
                     4 * fine_faces, incidence_.cell_vertex_count(), 2 * cell_corners);
  }

  VertexId edge_point(EdgeId e) const { return VertexId{first_edge_point() + edge_number_[e]}; }
  EdgeId half_edge(EdgeId e, VertexId end) const {
    return EdgeId{2 * std::size_t{edge_number_[e]} + (coarse_.edge_vertices(e)[0] == end ? 0 : 1)};
  }
  EdgeId spoke(std::size_t corner) const { return EdgeId{2 * edges_.size() + corner}; }
  EdgeId cell_spoke(std::size_t use) const { return EdgeId{2 * edges_.size() + corner_count_ + use}; }

  void add_edges() {
    for (const EdgeId e : edges_)
      for (const VertexId end : coarse_.edge_vertices(e))
        builder_.add_edge(VertexId{std::size_t{vertex_number_[end]}}, edge_point(e));
    for (const FaceId f : faces_)
      for (const EdgeId e : coarse_.face_edges(f)) builder_.add_edge(edge_point(e), fine_vertex_from_face_[f]);
    for (std::size_t i = 0; i < cells_.size(); ++i)
      for (const FaceUseId use : coarse_.cell_face_uses(cells_[i]))
        builder_.add_edge(fine_vertex_from_face_[face_of(use)], VertexId{first_cell_point() + i});
  }

  void add_quarter_faces() {
    for (const FaceId f : faces_) {
      const auto loop = coarse_.face_vertices(f);
      const auto edges = coarse_.face_edges(f);
      const std::size_t n = loop.size();
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t before = (i + n - 1) % n;
        builder_.add_face(std::array{VertexId{std::size_t{vertex_number_[loop[i]]}}, edge_point(edges[i]),
                                     fine_vertex_from_face_[f], edge_point(edges[before])},
                          std::array{half_edge(edges[i], loop[i]), spoke(first_corner_[f] + i),
                                     spoke(first_corner_[f] + before), half_edge(edges[before], loop[i])});
      }
    }
  }

  void set_sharpness() {
    const Skin skin(coarse_);
    for (const EdgeId e : edges_)
      if (const double sharpness = child_sharpness(skin.sharpness(e)); sharpness > 0)
        for (const VertexId end : coarse_.edge_vertices(e)) builder_.set_sharpness(half_edge(e, end), sharpness);
    for (const VertexId v : vertices_)
      if (const double sharpness = child_sharpness(skin.sharpness(v)); sharpness > 0)
        builder_.set_sharpness(VertexId{std::size_t{vertex_number_[v]}}, sharpness);
    for (const FaceId f : faces_) {
      if (coarse_.face_sharpness(f) == 0 || coarse_.is_boundary(f)) continue;
      for (std::size_t i = 0; i < coarse_.face_vertices(f).size(); ++i)
        builder_.set_sharpness(FaceId{first_corner_[f] + i}, child_sharpness(coarse_.face_sharpness(f)));
    }
  }

  void collect_sides(CellId cell) {
    sides_.clear();
    const auto uses = coarse_.cell_face_uses(cell);
    for (std::size_t u = 0; u < uses.size(); ++u) {
      const FaceId f = face_of(uses[u]);
      const auto loop = coarse_.face_vertices(f);
      const auto edges = coarse_.face_edges(f);
      for (std::size_t i = 0; i < loop.size(); ++i)
        sides_.push_back({edges[i], static_cast<std::uint32_t>(first_corner_[f] + i), static_cast<std::uint32_t>(u),
                          loop[is_back(uses[u]) ? (i + 1) % loop.size() : i], uses[u]});
    }
    std::sort(sides_.begin(), sides_.end(),
              [](const Side& a, const Side& b) { return a.edge != b.edge ? a.edge < b.edge : a.use < b.use; });
    assert(sides_.size() % 2 == 0);
  }

  // The face about an edge is seen counter-clockwise from the edge's far end, so that its front belongs to the fine
  // cell at the edge's first vertex.
  void add_inner_faces(VertexId cell_point, std::size_t first_use) {
    first_inner_face_ = builder_.solid().face_capacity();
    for (std::size_t s = 0; s < sides_.size(); s += 2) {
      const EdgeId e = sides_[s].edge;
      assert(sides_[s + 1].edge == e && sides_[s].from != sides_[s + 1].from);
      const bool first_leads = sides_[s].from == coarse_.edge_vertices(e)[0];
      const Side& a = sides_[first_leads ? s : s + 1];
      const Side& b = sides_[first_leads ? s + 1 : s];
      builder_.add_face(std::array{edge_point(e), fine_vertex_from_face_[face_of(b.face)], cell_point,
                                   fine_vertex_from_face_[face_of(a.face)]},
                        std::array{spoke(b.corner), cell_spoke(first_use + b.use), cell_spoke(first_use + a.use),
                                   spoke(a.corner)});
    }
  }

  void add_cells(CellId cell, RefinementStep& step) {
    const auto corners = incidence_.vertices(cell);
    uses_at_.resize(std::max(uses_at_.size(), corners.size()));
    for (auto& uses : uses_at_) uses.clear();
    const auto uses_of = [&](VertexId v) -> std::vector<FaceUseId>& {
      return uses_at_[static_cast<std::size_t>(std::lower_bound(corners.begin(), corners.end(), v) -
                                               corners.begin())];
    };
    for (const FaceUseId use : coarse_.cell_face_uses(cell)) {
      const auto loop = coarse_.face_vertices(face_of(use));
      for (std::size_t i = 0; i < loop.size(); ++i)
        uses_of(loop[i]).push_back(face_use(FaceId{first_corner_[face_of(use)] + i}, is_back(use)));
    }
    for (std::size_t s = 0; s < sides_.size(); s += 2) {
      const auto& ends = coarse_.edge_vertices(sides_[s].edge);
      const FaceId inner{first_inner_face_ + s / 2};
      uses_of(ends[0]).push_back(face_use(inner, false));
      uses_of(ends[1]).push_back(face_use(inner, true));
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      builder_.add_cell(uses_at_[i]);
      step.coarse_from_fine.push_back(cell);
      step.corner_from_fine.push_back(corners[i]);
    }
  }

  const Solid& coarse_;
  const Incidence& incidence_;
  std::vector<VertexId> vertices_;
  std::vector<EdgeId> edges_;
  std::vector<FaceId> faces_;
  std::vector<CellId> cells_;
  VertexData<std::uint32_t> vertex_number_;
  EdgeData<std::uint32_t> edge_number_;
  FaceData<std::size_t> first_corner_;
  FaceData<VertexId> fine_vertex_from_face_;
  std::size_t corner_count_ = 0, use_count_ = 0;

  Builder builder_;
  // Reused from cell to cell:
  std::vector<Side> sides_;
  std::size_t first_inner_face_ = 0;
  std::vector<std::vector<FaceUseId>> uses_at_;
};

}  // namespace

RefinementStep refine(const Solid& coarse, RuleSet rule_set, const Progress& progress) {
  progress.at(0);
  const PointRules rules(coarse, rule_set);
  CellSplitter splitter(coarse, rules.incidence());
  RefinementStep step;
  step.first_edge_point = splitter.first_edge_point();
  step.first_face_point = splitter.first_face_point();
  step.first_cell_point = splitter.first_cell_point();
  splitter.split(step, progress.part(0.2, 0.5));
  step.stencils = assemble_rows(
      splitter.fine_vertex_count(), coarse.vertex_capacity(),
      [&](std::size_t i, RowBuilder& row) {
        if (i < step.first_edge_point)
          rules.add_vertex_point(splitter.vertices()[i], 1, row);
        else if (i < step.first_face_point)
          rules.add_edge_point(splitter.edges()[i - step.first_edge_point], 1, row);
        else if (i < step.first_cell_point)
          rules.add_face_point(splitter.faces()[i - step.first_face_point], 1, row);
        else
          rules.add_cell_point(splitter.cells()[i - step.first_cell_point], 1, row);
      },
      progress.part(0.5, 1));
  return step;
}

}  // namespace argil::subdiv
