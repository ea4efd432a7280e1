#pragma once
// The radial-edge solid (Weiler 1986): vertices, edges, faces and cells of any kind, cells meeting in a face, an
// edge or only a vertex. A face has two sides (face-uses), each owned by at most one cell; a face with one owner is
// boundary. Every corner of a face is an edge-use; the edge-uses of an edge hang on it in ascending order of their
// faces, and `radial_fans` (radial_edge.h) gives them in radial order. Only topology and sharpness live here, never
// coordinates.
//
// Ids are never reused; a removed element leaves a dead id. All changes go through a Transaction (transaction.h),
// or through a Builder (build.h) for a solid made at one go.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "subdiv/ids.h"

namespace argil::subdiv {

/// Infinite sharpness. Values in between are semi-sharp (OpenSubdiv's scale).
inline constexpr double k_infinitely_sharp = 10.0;

class Solid {
 public:
  // Ids ever given: an array with one entry an id has this size.
  std::size_t vertex_capacity() const { return vertex_live_.size(); }
  std::size_t edge_capacity() const { return edges_.size(); }
  std::size_t face_capacity() const { return faces_.size(); }
  std::size_t cell_capacity() const { return cells_.size(); }
  // Live elements.
  std::size_t vertex_count() const { return vertex_count_; }
  std::size_t edge_count() const { return edge_count_; }
  std::size_t face_count() const { return face_count_; }
  std::size_t cell_count() const { return cell_count_; }
  bool is_live(VertexId v) const { return v.index() < vertex_live_.size() && vertex_live_[v.index()]; }
  bool is_live(EdgeId e) const { return e.index() < edges_.size() && edges_[e.index()].live; }
  bool is_live(FaceId f) const { return f.index() < faces_.size() && faces_[f.index()].live; }
  bool is_live(CellId c) const { return c.index() < cells_.size() && cells_[c.index()].live; }

  /// Range over the live ids of one kind, ascending.
  template <class IdType>
  class LiveRange;
  LiveRange<VertexId> vertices() const;
  LiveRange<EdgeId> edges() const;
  LiveRange<FaceId> faces() const;
  LiveRange<CellId> cells() const;

  const std::array<VertexId, 2>& edge_vertices(EdgeId e) const { return edges_[e.index()].vertices; }
  VertexId other_vertex(EdgeId e, VertexId v) const {
    const auto& ends = edge_vertices(e);
    return ends[0] == v ? ends[1] : ends[0];
  }
  /// The loop as seen from outside the owner of the front use.
  std::span<const VertexId> face_vertices(FaceId f) const {
    const Face& face = faces_[f.index()];
    return {corner_vertex_.data() + face.first_corner, face.corner_count};
  }
  /// Edge i joins vertices i and i + 1 of the loop.
  std::span<const EdgeId> face_edges(FaceId f) const {
    const Face& face = faces_[f.index()];
    return {corner_edge_.data() + face.first_corner, face.corner_count};
  }
  /// The cell that owns this side, or an invalid id.
  CellId owner(FaceUseId use) const { return faces_[use.index() / 2].owners[use.index() & 1U]; }
  std::span<const FaceUseId> cell_face_uses(CellId c) const {
    const Cell& cell = cells_[c.index()];
    return {cell_faces_.data() + cell.first_use, cell.use_count};
  }
  /// Number of faces at an edge, of edges at a vertex.
  std::size_t edge_valence(EdgeId e) const { return edges_[e.index()].face_count; }
  std::size_t vertex_valence(VertexId v) const { return vertex_lists_[v.index()].count; }

  /// Calls visit(FaceId) for the faces at an edge, ascending. Cost O(valence).
  template <class Visit>
  void for_each_face(EdgeId e, Visit visit) const {
    for (std::uint32_t c = edges_[e.index()].first_corner; c != k_none; c = corner_next_[c]) visit(corner_face_[c]);
  }
  /// Calls visit(EdgeId) for the edges at a vertex, ascending. Cost O(valence).
  template <class Visit>
  void for_each_edge(VertexId v, Visit visit) const {
    for (std::uint32_t l = vertex_lists_[v.index()].first; l != k_none; l = edge_link_next_[l])
      visit(EdgeId{l / 2});
  }

  std::optional<EdgeId> find_edge(VertexId a, VertexId b) const;
  /// The live face with exactly these vertices, in any rotation and direction.
  std::optional<FaceId> find_face(std::span<const VertexId> loop) const;

  bool is_boundary(FaceId f) const {
    const auto& o = faces_[f.index()].owners;
    return o[0].valid() != o[1].valid();
  }
  /// An edge or vertex is boundary if a boundary face holds it (or if no cell does).
  bool is_boundary(EdgeId e) const;
  bool is_boundary(VertexId v) const;
  /// The owned side of a boundary face: its loop is outward of the solid.
  FaceUseId boundary_use(FaceId f) const { return face_use(f, !faces_[f.index()].owners[0].valid()); }

  double edge_sharpness(EdgeId e) const { return edges_[e.index()].sharpness; }
  double vertex_sharpness(VertexId v) const { return vertex_sharpness_[v.index()]; }
  /// Above 0 on an interior face, it belongs to a sharp sheet; on a boundary face it says nothing.
  double face_sharpness(FaceId f) const { return faces_[f.index()].sharpness; }

  /// Sum over the live elements of a hash of each (id, what it is made of, sharpness), and of the capacities.
  /// Kept up to date by edits; O(elements) only after a bulk build.
  std::uint64_t topology_hash() const;

  /// Bytes held, capacity included.
  std::size_t memory() const;

 private:
  friend class Transaction;
  friend class Builder;
  friend class Validator;
  friend struct SolidTester;

  static constexpr std::uint32_t k_none = 0xffffffffU;

  struct Edge {
    std::array<VertexId, 2> vertices;
    std::uint32_t first_corner = k_none, last_corner = k_none;
    std::uint32_t face_count = 0;
    bool live = true;
    double sharpness = 0;
  };
  struct Face {
    std::uint32_t first_corner = 0, corner_count = 0;
    std::array<CellId, 2> owners;
    bool live = true;
    double sharpness = 0;
  };
  struct Cell {
    std::uint32_t first_use = 0, use_count = 0;
    bool live = true;
  };
  struct List {
    std::uint32_t first = k_none, last = k_none, count = 0;
  };

  // Raw changes; each keeps the incidence lists sorted. They know nothing of undo or of what makes a valid solid.
  VertexId push_vertex();
  EdgeId push_edge(VertexId a, VertexId b);
  FaceId push_face(std::span<const VertexId> loop, std::span<const EdgeId> edges);
  CellId push_cell(std::span<const FaceUseId> uses);
  void pop_vertex();
  void pop_edge();
  void pop_face();
  void pop_cell();
  void set_live(VertexId v, bool live);
  void set_live(EdgeId e, bool live);
  void set_live(FaceId f, bool live);
  void set_live(CellId c, bool live);
  void link_edge(EdgeId e);
  void unlink_edge(EdgeId e);
  void link_face(FaceId f);
  void unlink_face(FaceId f);

  std::uint64_t element_hash(VertexId v) const;
  std::uint64_t element_hash(EdgeId e) const;
  std::uint64_t element_hash(FaceId f) const;
  std::uint64_t element_hash(CellId c) const;
  template <class IdType>
  void add_to_hash(IdType id) {
    if (hash_) *hash_ += element_hash(id);
  }
  template <class IdType>
  void take_from_hash(IdType id) {
    if (hash_) *hash_ -= element_hash(id);
  }

  std::vector<std::uint8_t> vertex_live_;
  std::vector<double> vertex_sharpness_;
  std::vector<List> vertex_lists_;             // edges at the vertex, as links 2 * edge + end
  std::vector<std::uint32_t> edge_link_next_;  // 2 an edge
  std::vector<Edge> edges_;
  std::vector<Face> faces_;
  std::vector<VertexId> corner_vertex_;  // corners of faces, a face's own ones together
  std::vector<EdgeId> corner_edge_;
  std::vector<FaceId> corner_face_;
  std::vector<std::uint32_t> corner_next_;  // next corner at the same edge
  std::vector<Cell> cells_;
  std::vector<FaceUseId> cell_faces_;
  std::size_t vertex_count_ = 0, edge_count_ = 0, face_count_ = 0, cell_count_ = 0;
  mutable std::optional<std::uint64_t> hash_;  // absent until asked for after a bulk build
};

template <class IdType>
class Solid::LiveRange {
 public:
  class Iterator {
   public:
    using value_type = IdType;
    using difference_type = std::ptrdiff_t;
    Iterator() = default;
    Iterator(const Solid* solid, std::size_t i, std::size_t end) : solid_(solid), i_(i), end_(end) { skip(); }
    IdType operator*() const { return IdType{i_}; }
    Iterator& operator++() {
      ++i_;
      skip();
      return *this;
    }
    Iterator operator++(int) {
      Iterator old = *this;
      ++*this;
      return old;
    }
    bool operator==(const Iterator& other) const { return i_ == other.i_; }

   private:
    void skip() {
      while (i_ < end_ && !solid_->is_live(IdType{i_})) ++i_;
    }
    const Solid* solid_ = nullptr;
    std::size_t i_ = 0, end_ = 0;
  };
  LiveRange(const Solid* solid, std::size_t capacity) : solid_(solid), capacity_(capacity) {}
  Iterator begin() const { return {solid_, 0, capacity_}; }
  Iterator end() const { return {solid_, capacity_, capacity_}; }

 private:
  const Solid* solid_;
  std::size_t capacity_;
};

inline Solid::LiveRange<VertexId> Solid::vertices() const {
  return {this, vertex_capacity()};
}
inline Solid::LiveRange<EdgeId> Solid::edges() const {
  return {this, edge_capacity()};
}
inline Solid::LiveRange<FaceId> Solid::faces() const {
  return {this, face_capacity()};
}
inline Solid::LiveRange<CellId> Solid::cells() const {
  return {this, cell_capacity()};
}

}  // namespace argil::subdiv
