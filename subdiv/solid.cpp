#include "subdiv/solid.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace argil::subdiv {

namespace {

// FNV-1a over 64-bit words; finished so that sums of such hashes do not cancel structure.
class WordHash {
 public:
  void add(std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) {
      state_ ^= (word >> (8 * byte)) & 0xffU;
      state_ *= 0x100000001b3ULL;
    }
  }
  void add(double value) {
    const double canonical = value == 0 ? 0.0 : value;  // -0 counts as +0
    std::uint64_t bits;
    std::memcpy(&bits, &canonical, sizeof bits);
    add(bits);
  }
  std::uint64_t finish() const {
    std::uint64_t x = state_;
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9ULL;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
  }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

}  // namespace

std::optional<EdgeId> Solid::find_edge(VertexId a, VertexId b) const {
  if (vertex_valence(b) < vertex_valence(a)) std::swap(a, b);
  for (std::uint32_t l = vertex_lists_[a.index()].first; l != k_none; l = edge_link_next_[l])
    if (edges_[l / 2].vertices[1 - (l & 1U)] == b) return EdgeId{l / 2};
  return std::nullopt;
}

std::optional<FaceId> Solid::find_face(std::span<const VertexId> loop) const {
  const auto edge = find_edge(loop[0], loop[1]);
  if (!edge) return std::nullopt;
  for (std::uint32_t c = edges_[edge->index()].first_corner; c != k_none; c = corner_next_[c]) {
    const auto other = face_vertices(corner_face_[c]);
    const std::size_t n = other.size();
    if (n != loop.size()) continue;
    const auto start = static_cast<std::size_t>(std::find(other.begin(), other.end(), loop[0]) - other.begin());
    bool forward = true, backward = true;
    for (std::size_t i = 0; i < n; ++i) {
      forward = forward && other[(start + i) % n] == loop[i];
      backward = backward && other[(start + n - i) % n] == loop[i];
    }
    if (forward || backward) return corner_face_[c];
  }
  return std::nullopt;
}

bool Solid::is_boundary(EdgeId e) const {
  const std::uint32_t first = edges_[e.index()].first_corner;
  for (std::uint32_t c = first; c != k_none; c = corner_next_[c])
    if (is_boundary(corner_face_[c])) return true;
  return first == k_none;
}

bool Solid::is_boundary(VertexId v) const {
  const std::uint32_t first = vertex_lists_[v.index()].first;
  for (std::uint32_t l = first; l != k_none; l = edge_link_next_[l])
    if (is_boundary(EdgeId{l / 2})) return true;
  return first == k_none;
}

VertexId Solid::push_vertex() {
  const VertexId v{vertex_live_.size()};
  vertex_live_.push_back(1);
  vertex_sharpness_.push_back(0);
  vertex_lists_.emplace_back();
  ++vertex_count_;
  add_to_hash(v);
  return v;
}

EdgeId Solid::push_edge(VertexId a, VertexId b) {
  const EdgeId e{edges_.size()};
  edges_.push_back({{a, b}, k_none, k_none, 0, true, 0});
  edge_link_next_.resize(2 * edges_.size(), k_none);
  link_edge(e);
  ++edge_count_;
  add_to_hash(e);
  return e;
}

FaceId Solid::push_face(std::span<const VertexId> loop, std::span<const EdgeId> edges) {
  const FaceId f{faces_.size()};
  Face face;
  face.first_corner = static_cast<std::uint32_t>(corner_vertex_.size());
  face.corner_count = static_cast<std::uint32_t>(loop.size());
  faces_.push_back(face);
  corner_vertex_.insert(corner_vertex_.end(), loop.begin(), loop.end());
  corner_edge_.insert(corner_edge_.end(), edges.begin(), edges.end());
  corner_face_.resize(corner_vertex_.size(), f);
  corner_next_.resize(corner_vertex_.size(), k_none);
  link_face(f);
  ++face_count_;
  add_to_hash(f);
  return f;
}

CellId Solid::push_cell(std::span<const FaceUseId> uses) {
  const CellId c{cells_.size()};
  cells_.push_back({static_cast<std::uint32_t>(cell_faces_.size()), static_cast<std::uint32_t>(uses.size()), true});
  cell_faces_.insert(cell_faces_.end(), uses.begin(), uses.end());
  for (const FaceUseId use : uses) {
    assert(!owner(use).valid());
    faces_[use.index() / 2].owners[use.index() & 1U] = c;
  }
  ++cell_count_;
  add_to_hash(c);
  return c;
}

void Solid::pop_vertex() {
  const VertexId v{vertex_live_.size() - 1};
  take_from_hash(v);
  assert(vertex_live_.back() && vertex_lists_.back().count == 0);
  vertex_live_.pop_back();
  vertex_sharpness_.pop_back();
  vertex_lists_.pop_back();
  --vertex_count_;
}

void Solid::pop_edge() {
  const EdgeId e{edges_.size() - 1};
  take_from_hash(e);
  assert(edges_.back().live && edges_.back().face_count == 0);
  unlink_edge(e);
  edges_.pop_back();
  edge_link_next_.resize(2 * edges_.size());
  --edge_count_;
}

void Solid::pop_face() {
  const FaceId f{faces_.size() - 1};
  take_from_hash(f);
  assert(faces_.back().live && !faces_.back().owners[0].valid() && !faces_.back().owners[1].valid());
  unlink_face(f);
  const std::size_t corners = faces_.back().first_corner;
  corner_vertex_.resize(corners);
  corner_edge_.resize(corners);
  corner_face_.resize(corners);
  corner_next_.resize(corners);
  faces_.pop_back();
  --face_count_;
}

void Solid::pop_cell() {
  const CellId c{cells_.size() - 1};
  take_from_hash(c);
  assert(cells_.back().live);
  for (const FaceUseId use : cell_face_uses(c)) faces_[use.index() / 2].owners[use.index() & 1U] = CellId{};
  cell_faces_.resize(cells_.back().first_use);
  cells_.pop_back();
  --cell_count_;
}

void Solid::set_live(VertexId v, bool live) {
  assert(is_live(v) != live && vertex_lists_[v.index()].count == 0);
  if (!live) take_from_hash(v);
  vertex_live_[v.index()] = live ? 1 : 0;
  if (live) add_to_hash(v);
  vertex_count_ += live ? 1 : std::size_t(-1);
}

void Solid::set_live(EdgeId e, bool live) {
  assert(is_live(e) != live && edges_[e.index()].face_count == 0);
  if (live) {
    link_edge(e);
    edges_[e.index()].live = true;
    add_to_hash(e);
  } else {
    take_from_hash(e);
    unlink_edge(e);
    edges_[e.index()].live = false;
  }
  edge_count_ += live ? 1 : std::size_t(-1);
}

void Solid::set_live(FaceId f, bool live) {
  assert(is_live(f) != live);
  if (live) {
    link_face(f);
    faces_[f.index()].live = true;
    add_to_hash(f);
  } else {
    assert(!faces_[f.index()].owners[0].valid() && !faces_[f.index()].owners[1].valid());
    take_from_hash(f);
    unlink_face(f);
    faces_[f.index()].live = false;
  }
  face_count_ += live ? 1 : std::size_t(-1);
}

void Solid::set_live(CellId c, bool live) {
  assert(is_live(c) != live);
  if (!live) take_from_hash(c);
  for (const FaceUseId use : cell_face_uses(c))
    faces_[use.index() / 2].owners[use.index() & 1U] = live ? c : CellId{};
  cells_[c.index()].live = live;
  if (live) add_to_hash(c);
  cell_count_ += live ? 1 : std::size_t(-1);
}

void Solid::link_edge(EdgeId e) {
  for (std::uint32_t end = 0; end < 2; ++end) {
    const std::uint32_t link = static_cast<std::uint32_t>(2 * e.index()) + end;
    List& list = vertex_lists_[edges_[e.index()].vertices[end].index()];
    ++list.count;
    if (list.last == k_none || list.last < link) {
      edge_link_next_[link] = k_none;
      (list.last == k_none ? list.first : edge_link_next_[list.last]) = link;
      list.last = link;
      continue;
    }
    std::uint32_t* at = &list.first;
    while (*at < link) at = &edge_link_next_[*at];
    edge_link_next_[link] = *at;
    *at = link;
  }
}

void Solid::unlink_edge(EdgeId e) {
  for (std::uint32_t end = 0; end < 2; ++end) {
    const std::uint32_t link = static_cast<std::uint32_t>(2 * e.index()) + end;
    List& list = vertex_lists_[edges_[e.index()].vertices[end].index()];
    --list.count;
    std::uint32_t before = k_none;
    std::uint32_t* at = &list.first;
    while (*at != link) {
      before = *at;
      at = &edge_link_next_[*at];
    }
    *at = edge_link_next_[link];
    if (list.last == link) list.last = before;
    edge_link_next_[link] = k_none;
  }
}

void Solid::link_face(FaceId f) {
  const Face& face = faces_[f.index()];
  for (std::uint32_t c = face.first_corner; c < face.first_corner + face.corner_count; ++c) {
    Edge& edge = edges_[corner_edge_[c].index()];
    ++edge.face_count;
    if (edge.last_corner == k_none || edge.last_corner < c) {
      corner_next_[c] = k_none;
      (edge.last_corner == k_none ? edge.first_corner : corner_next_[edge.last_corner]) = c;
      edge.last_corner = c;
      continue;
    }
    std::uint32_t* at = &edge.first_corner;
    while (*at < c) at = &corner_next_[*at];
    corner_next_[c] = *at;
    *at = c;
  }
}

void Solid::unlink_face(FaceId f) {
  const Face& face = faces_[f.index()];
  for (std::uint32_t c = face.first_corner; c < face.first_corner + face.corner_count; ++c) {
    Edge& edge = edges_[corner_edge_[c].index()];
    --edge.face_count;
    std::uint32_t before = k_none;
    std::uint32_t* at = &edge.first_corner;
    while (*at != c) {
      before = *at;
      at = &corner_next_[*at];
    }
    *at = corner_next_[c];
    if (edge.last_corner == c) edge.last_corner = before;
    corner_next_[c] = k_none;
  }
}

std::uint64_t Solid::element_hash(VertexId v) const {
  WordHash hash;
  hash.add(std::uint64_t{1} << 56 | v.value);
  hash.add(vertex_sharpness_[v.index()]);
  return hash.finish();
}

std::uint64_t Solid::element_hash(EdgeId e) const {
  const Edge& edge = edges_[e.index()];
  WordHash hash;
  hash.add(std::uint64_t{2} << 56 | e.value);
  hash.add(std::uint64_t{edge.vertices[0].value} << 32 | edge.vertices[1].value);
  hash.add(edge.sharpness);
  return hash.finish();
}

std::uint64_t Solid::element_hash(FaceId f) const {
  WordHash hash;
  hash.add(std::uint64_t{3} << 56 | f.value);
  for (const VertexId v : face_vertices(f)) hash.add(std::uint64_t{v.value});
  // Only where there is one, so that solids without sharp sheets keep the hashes that sessions have recorded.
  if (face_sharpness(f) != 0) hash.add(face_sharpness(f));
  return hash.finish();
}

std::uint64_t Solid::element_hash(CellId c) const {
  WordHash hash;
  hash.add(std::uint64_t{4} << 56 | c.value);
  for (const FaceUseId use : cell_face_uses(c)) hash.add(std::uint64_t{use.value});
  return hash.finish();
}

std::uint64_t Solid::topology_hash() const {
  if (!hash_) {
    std::uint64_t sum = 0;
    for (const VertexId v : vertices()) sum += element_hash(v);
    for (const EdgeId e : edges()) sum += element_hash(e);
    for (const FaceId f : faces()) sum += element_hash(f);
    for (const CellId c : cells()) sum += element_hash(c);
    hash_ = sum;
  }
  WordHash hash;
  hash.add(*hash_);
  hash.add(std::uint64_t{vertex_capacity()});
  hash.add(std::uint64_t{edge_capacity()});
  hash.add(std::uint64_t{face_capacity()});
  hash.add(std::uint64_t{cell_capacity()});
  return hash.finish();
}

std::size_t Solid::memory() const {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return bytes(vertex_live_) + bytes(vertex_sharpness_) + bytes(vertex_lists_) + bytes(edge_link_next_) +
         bytes(edges_) + bytes(faces_) + bytes(corner_vertex_) + bytes(corner_edge_) + bytes(corner_face_) +
         bytes(corner_next_) + bytes(cells_) + bytes(cell_faces_);
}

}  // namespace argil::subdiv
