#include "subdiv/validate.h"

#include <fmt/format.h>

#include <algorithm>

#include "subdiv/cell_check.h"

namespace argil::subdiv {

class Validator {
 public:
  explicit Validator(const Solid& solid) : s_(solid) {}

  std::vector<std::string> run() {
    if (!sizes_agree()) return faults_;  // nothing may be indexed safely
    if (!ids_in_range()) return faults_;
    counts();
    edges();
    faces();
    edge_lists();
    corner_lists();
    cells();
    owners();
    hash();
    return faults_;
  }

 private:
  template <class... Values>
  void fault(fmt::format_string<Values...> text, Values&&... values) {
    if (faults_.size() < k_most_faults) faults_.push_back(fmt::format(text, std::forward<Values>(values)...));
  }
  void expect_size(const char* name, std::size_t found, std::size_t expected) {
    if (found != expected) fault("{} has {} entries, expected {}", name, found, expected);
  }

  bool sizes_agree() {
    const std::size_t vertices = s_.vertex_live_.size(), corners = s_.corner_vertex_.size();
    expect_size("vertex_sharpness", s_.vertex_sharpness_.size(), vertices);
    expect_size("vertex_lists", s_.vertex_lists_.size(), vertices);
    expect_size("edge_link_next", s_.edge_link_next_.size(), 2 * s_.edges_.size());
    expect_size("corner_edge", s_.corner_edge_.size(), corners);
    expect_size("corner_face", s_.corner_face_.size(), corners);
    expect_size("corner_next", s_.corner_next_.size(), corners);
    std::size_t first = 0;
    for (const auto& face : s_.faces_) {
      if (face.first_corner != first) fault("corners of faces are not one after the other");
      first = face.first_corner + std::size_t{face.corner_count};
    }
    expect_size("corner_vertex", corners, first);
    first = 0;
    for (const auto& cell : s_.cells_) {
      if (cell.first_use != first) fault("face-uses of cells are not one after the other");
      first = cell.first_use + std::size_t{cell.use_count};
    }
    expect_size("cell_faces", s_.cell_faces_.size(), first);
    return faults_.empty();
  }

  bool ids_in_range() {
    const auto link_fits = [](std::uint32_t link, std::size_t size) {
      return link == Solid::k_none || link < size;
    };
    for (std::size_t e = 0; e < s_.edges_.size(); ++e) {
      for (const VertexId v : s_.edges_[e].vertices)
        if (v.index() >= s_.vertex_capacity()) fault("edge {} names vertex {}", e, v.value);
      if (!link_fits(s_.edges_[e].first_corner, s_.corner_next_.size()) ||
          !link_fits(s_.edges_[e].last_corner, s_.corner_next_.size()))
        fault("edge {} hangs on a corner that is not there", e);
    }
    for (std::size_t v = 0; v < s_.vertex_lists_.size(); ++v)
      if (!link_fits(s_.vertex_lists_[v].first, s_.edge_link_next_.size()) ||
          !link_fits(s_.vertex_lists_[v].last, s_.edge_link_next_.size()))
        fault("vertex {} hangs on a link that is not there", v);
    for (const std::uint32_t link : s_.edge_link_next_)
      if (!link_fits(link, s_.edge_link_next_.size())) fault("a link of edges leads nowhere");
    for (const std::uint32_t link : s_.corner_next_)
      if (!link_fits(link, s_.corner_next_.size())) fault("a link of corners leads nowhere");
    for (std::size_t c = 0; c < s_.corner_vertex_.size(); ++c)
      if (s_.corner_vertex_[c].index() >= s_.vertex_capacity() ||
          s_.corner_edge_[c].index() >= s_.edge_capacity() || s_.corner_face_[c].index() >= s_.face_capacity())
        fault("corner {} names an element that is not there", c);
    for (const FaceUseId use : s_.cell_faces_)
      if (use.index() / 2 >= s_.face_capacity()) fault("a cell names face-use {}", use.value);
    for (std::size_t f = 0; f < s_.faces_.size(); ++f)
      for (const CellId c : s_.faces_[f].owners)
        if (c.valid() && c.index() >= s_.cell_capacity()) fault("face {} is owned by cell {}", f, c.value);
    return faults_.empty();
  }

  template <class Range>
  void expect_count(const char* name, Range live, std::size_t kept) {
    std::size_t found = 0;
    for ([[maybe_unused]] const auto id : live) ++found;
    if (found != kept) fault("{} {} live, the count says {}", found, name, kept);
  }
  void counts() {
    expect_count("vertices", s_.vertices(), s_.vertex_count());
    expect_count("edges", s_.edges(), s_.edge_count());
    expect_count("faces", s_.faces(), s_.face_count());
    expect_count("cells", s_.cells(), s_.cell_count());
  }

  void edges() {
    std::vector<std::array<VertexId, 2>> pairs;
    for (const EdgeId e : s_.edges()) {
      auto ends = s_.edge_vertices(e);
      for (const VertexId v : ends)
        if (!s_.is_live(v)) fault("edge {} ends in dead vertex {}", e.value, v.value);
      if (ends[0] == ends[1]) fault("edge {} joins vertex {} to itself", e.value, ends[0].value);
      if (!(s_.edge_sharpness(e) >= 0)) fault("edge {} has sharpness {}", e.value, s_.edge_sharpness(e));
      if (ends[1] < ends[0]) std::swap(ends[0], ends[1]);
      pairs.push_back(ends);
    }
    for (const VertexId v : s_.vertices())
      if (!(s_.vertex_sharpness(v) >= 0)) fault("vertex {} has sharpness {}", v.value, s_.vertex_sharpness(v));
    std::sort(pairs.begin(), pairs.end());
    for (auto at = pairs.begin(); (at = std::adjacent_find(at, pairs.end())) != pairs.end(); ++at)
      fault("two edges join vertices {} and {}", (*at)[0].value, (*at)[1].value);
  }

  void faces() {
    std::vector<std::vector<EdgeId>> sets;
    for (const FaceId f : s_.faces()) {
      const auto loop = s_.face_vertices(f);
      const auto loop_edges = s_.face_edges(f);
      if (loop.size() < 3) fault("face {} has {} vertices", f.value, loop.size());
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const EdgeId e = loop_edges[i];
        const VertexId a = loop[i], b = loop[(i + 1) % loop.size()];
        const auto& ends = s_.edge_vertices(e);
        if (!s_.is_live(e)) fault("face {} has dead edge {}", f.value, e.value);
        if (!(ends[0] == a && ends[1] == b) && !(ends[0] == b && ends[1] == a))
          fault("edge {} of face {} does not join its corners {} and {}", e.value, f.value, a.value, b.value);
      }
      std::vector<VertexId> sorted(loop.begin(), loop.end());
      std::sort(sorted.begin(), sorted.end());
      if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
        fault("face {} repeats a vertex", f.value);
      sets.emplace_back(loop_edges.begin(), loop_edges.end());
      std::sort(sets.back().begin(), sets.back().end());
    }
    std::sort(sets.begin(), sets.end());
    for (auto at = sets.begin(); (at = std::adjacent_find(at, sets.end())) != sets.end(); ++at)
      fault("two faces have the same edges, {} among them", at->front().value);
  }

  // Walks a sorted list of links; each must be one of `expected`, and it must end at `last`.
  void walk(const char* name, std::size_t id, std::uint32_t first, std::uint32_t last, std::size_t count,
            const std::vector<std::uint32_t>& next, const std::vector<std::uint32_t>& expected) {
    std::uint32_t before = Solid::k_none;
    std::size_t found = 0;
    for (std::uint32_t l = first; l != Solid::k_none; l = next[l]) {
      if (before != Solid::k_none && l <= before) return fault("the list of {} {} does not ascend", name, id);
      if (found < expected.size() && expected[found] != l)
        return fault("the list of {} {} holds {}, expected {}", name, id, l, expected[found]);
      before = l;
      ++found;
    }
    if (before != last) fault("the list of {} {} does not end where it says", name, id);
    if (found != count || found != expected.size())
      fault("the list of {} {} has {} entries, its count says {}, expected {}", name, id, found, count,
            expected.size());
  }

  void edge_lists() {
    std::vector<std::vector<std::uint32_t>> links(s_.vertex_capacity());
    for (const EdgeId e : s_.edges())
      for (std::uint32_t end = 0; end < 2; ++end)
        links[s_.edge_vertices(e)[end].index()].push_back(2 * e.value + end);
    for (std::size_t v = 0; v < links.size(); ++v) {
      const auto& list = s_.vertex_lists_[v];
      walk("vertex", v, list.first, list.last, list.count, s_.edge_link_next_, links[v]);
    }
  }

  void corner_lists() {
    std::vector<std::vector<std::uint32_t>> corners(s_.edge_capacity());
    for (const FaceId f : s_.faces()) {
      const auto& face = s_.faces_[f.index()];
      for (std::uint32_t c = face.first_corner; c < face.first_corner + face.corner_count; ++c) {
        if (s_.corner_face_[c] != f) fault("corner {} does not know that it is of face {}", c, f.value);
        corners[s_.corner_edge_[c].index()].push_back(c);
      }
    }
    for (std::size_t e = 0; e < corners.size(); ++e) {
      const auto& edge = s_.edges_[e];
      walk("edge", e, edge.first_corner, edge.last_corner, edge.face_count, s_.corner_next_, corners[e]);
    }
  }

  void cells() {
    listed_.assign(2 * s_.face_capacity(), 0);
    CellLoops loops;
    for (const CellId c : s_.cells()) {
      loops.clear();
      for (const FaceUseId use : s_.cell_face_uses(c)) {
        if (!s_.is_live(face_of(use))) fault("cell {} has dead face {}", c.value, face_of(use).value);
        ++listed_[use.index()];
        if (s_.owner(use) != c) fault("cell {} has face-use {}, whose owner is another", c.value, use.value);
        const auto loop = s_.face_vertices(face_of(use));
        for (const VertexId v : loop) loops.corners.push_back(v.value);
        if (is_back(use))
          std::reverse(loops.corners.end() - static_cast<std::ptrdiff_t>(loop.size()), loops.corners.end());
        loops.end_face();
      }
      if (const std::string text = sphere_fault(loops); !text.empty()) fault("cell {}: {}", c.value, text);
    }
  }

  void owners() {
    for (std::size_t f = 0; f < s_.faces_.size(); ++f)
      for (const bool back : {false, true}) {
        const FaceUseId use = face_use(FaceId{f}, back);
        const CellId c = s_.owner(use);
        if (!c.valid()) continue;
        if (!s_.faces_[f].live) fault("dead face {} is owned by cell {}", f, c.value);
        if (!s_.is_live(c)) {
          fault("face {} is owned by dead cell {}", f, c.value);
          continue;
        }
        if (listed_[use.index()] != 1)
          fault("face-use {} of cell {} is listed {} times by cells", use.value, c.value, listed_[use.index()]);
      }
  }

  void hash() {
    if (!s_.hash_) return;
    std::uint64_t sum = 0;
    for (const VertexId v : s_.vertices()) sum += s_.element_hash(v);
    for (const EdgeId e : s_.edges()) sum += s_.element_hash(e);
    for (const FaceId f : s_.faces()) sum += s_.element_hash(f);
    for (const CellId c : s_.cells()) sum += s_.element_hash(c);
    if (sum != *s_.hash_) fault("the topology hash kept by edits is not that of the elements");
  }

  static constexpr std::size_t k_most_faults = 100;
  const Solid& s_;
  std::vector<std::uint32_t> listed_;  // how often cells name a face-use
  std::vector<std::string> faults_;
};

std::vector<std::string> validate(const Solid& solid) {
  return Validator(solid).run();
}

}  // namespace argil::subdiv
