#include "subdiv/build.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "subdiv/cell_check.h"
#include "subdiv/cell_kinds.h"
#include "subdiv/error.h"

namespace argil::subdiv {

namespace {

std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

// Open addressing from hashes to element numbers; what equality means is the caller's.
class ElementTable {
 public:
  explicit ElementTable(std::size_t expected) {
    std::size_t size = 16;
    while (size < 2 * expected) size *= 2;
    slots_.assign(size, {0, k_empty});
  }
  template <class Equal>
  std::uint32_t find(std::uint64_t hash, Equal equal) const {
    for (std::size_t s = hash & (slots_.size() - 1);; s = (s + 1) & (slots_.size() - 1)) {
      if (slots_[s].element == k_empty) return k_empty;
      if (slots_[s].hash == hash && equal(slots_[s].element)) return slots_[s].element;
    }
  }
  void insert(std::uint64_t hash, std::uint32_t element) {
    if (2 * (count_ + 1) > slots_.size()) {
      const std::vector<Slot> old = std::move(slots_);
      slots_.assign(2 * old.size(), {0, k_empty});
      for (const Slot& slot : old)
        if (slot.element != k_empty) place(slot);
    }
    place({hash, element});
    ++count_;
  }
  static constexpr std::uint32_t k_empty = 0xffffffffU;

 private:
  struct Slot {
    std::uint64_t hash;
    std::uint32_t element;
  };
  void place(Slot slot) {
    std::size_t s = slot.hash & (slots_.size() - 1);
    while (slots_[s].element != k_empty) s = (s + 1) & (slots_.size() - 1);
    slots_[s] = slot;
  }
  std::vector<Slot> slots_;
  std::size_t count_ = 0;
};

[[noreturn]] void fail(std::size_t cell, const std::string& message) {
  throw Error(ErrorCode::bad_topology, message, fmt::format("cell {}", cell));
}

void check_lists(const CellLists& lists) {
  const auto bad = [](const std::string& message) { throw Error(ErrorCode::bad_topology, message); };
  if (lists.offsets.size() != lists.kinds.size() + 1 || lists.offsets.front() != 0 ||
      lists.offsets.back() != lists.connectivity.size())
    bad(fmt::format("expected {} offsets from 0 to {}, one more than cells; found {}", lists.kinds.size() + 1,
                    lists.connectivity.size(), lists.offsets.size()));
  if (!std::is_sorted(lists.offsets.begin(), lists.offsets.end())) bad("the offsets of the cells do not ascend");
  // Ids and corners are 32 bits; a hexahedron's 8 numbers become 24 corners of its faces.
  if (lists.connectivity.size() > 0xffffffffULL / 4 || lists.positions.cols() > 0x7fffffffLL)
    throw Error(ErrorCode::limit_exceeded,
                fmt::format("expected at most 2^30 numbers in cell lists, found {}", lists.connectivity.size()));
  for (Eigen::Index i = 0; i < lists.positions.cols(); ++i)
    for (int k = 0; k < 3; ++k)
      if (!std::isfinite(lists.positions(k, i)))
        throw Error(ErrorCode::bad_geometry,
                    fmt::format("point {} has the non-finite {} coordinate {}; expected a number", i, "xyz"[k],
                                lists.positions(k, i)),
                    fmt::format("point {}", i));
}

// The outward loops of cell c, in point numbers.
void read_loops(const CellLists& lists, std::size_t c, CellLoops& loops) {
  loops.clear();
  const std::span numbers(lists.connectivity.data() + lists.offsets[c], lists.offsets[c + 1] - lists.offsets[c]);
  const auto point_count = static_cast<std::uint64_t>(lists.positions.cols());
  const auto check_range = [&](std::uint32_t point) {
    if (point >= point_count)
      fail(c, fmt::format("vertex {} is out of range; there are {} points, numbered from 0", point, point_count));
  };
  if (lists.kinds[c] != CellKind::polyhedron) {
    const std::size_t expected = vertex_count(lists.kinds[c]);
    if (numbers.size() != expected)
      fail(c, fmt::format("a {} has {} vertices, found {}", name(lists.kinds[c]), expected, numbers.size()));
    for (std::size_t i = 0; i < expected; ++i) {
      check_range(numbers[i]);
      for (std::size_t j = 0; j < i; ++j)
        if (numbers[i] == numbers[j])
          fail(c, fmt::format("vertex {} is repeated; a {} has {} different ones", numbers[i], name(lists.kinds[c]),
                              expected));
    }
    const auto table = face_table(lists.kinds[c]);
    for (std::size_t i = 0; i < table.size(); i += table[i] + 1U) {
      for (std::size_t j = 0; j < table[i]; ++j) loops.corners.push_back(numbers[table[i + 1 + j]]);
      loops.end_face();
    }
    return;
  }
  std::size_t at = 1;
  const std::size_t face_count = numbers.empty() ? 0 : numbers[0];
  for (std::size_t f = 0; f < face_count; ++f) {
    if (at >= numbers.size())
      fail(c, fmt::format("malformed face stream: it promises {} faces and ends after {}", face_count, f));
    const std::size_t size = numbers[at++];
    if (size > numbers.size() - at)
      fail(c, fmt::format("malformed face stream: face {} promises {} vertices, {} numbers are left", f, size,
                          numbers.size() - at));
    for (std::size_t j = 0; j < size; ++j, ++at) {
      check_range(numbers[at]);
      loops.corners.push_back(numbers[at]);
    }
    loops.end_face();
  }
  if (at != numbers.size() && !(numbers.empty() && at == 1))
    fail(c, fmt::format("malformed face stream: {} numbers are left after its {} faces", numbers.size() - at,
                        face_count));
}

// +1 if the loops run the same way, −1 if opposite, 0 if they are different faces.
int same_loop(std::span<const VertexId> a, std::span<const VertexId> b) {
  const std::size_t n = a.size();
  if (b.size() != n) return 0;
  const auto start = static_cast<std::size_t>(std::find(b.begin(), b.end(), a[0]) - b.begin());
  if (start == n) return 0;
  bool forward = true, backward = true;
  for (std::size_t i = 0; i < n && (forward || backward); ++i) {
    forward = forward && b[(start + i) % n] == a[i];
    backward = backward && b[(start + n - i) % n] == a[i];
  }
  return forward ? 1 : backward ? -1 : 0;
}

// Uses of a face beyond the two that a solid can hold are kept to name them.
struct FaceClaims {
  std::uint32_t count = 0;
  std::array<std::uint32_t, 2> cells{};
};

class Assembly {
 public:
  explicit Assembly(const CellLists& lists)
      : lists_(lists), edges_(2 * lists.connectivity.size()), faces_(lists.connectivity.size()) {}

  Built run() {
    check_cells_and_add_vertices();
    CellLoops loops;
    use_offsets_.reserve(lists_.cell_count() + 1);
    for (std::size_t c = 0; c < lists_.cell_count(); ++c) {
      read_loops(lists_, c, loops);
      for (std::size_t f = 0; f < loops.face_count(); ++f) claim_face(loops.loop(f), c);
      use_offsets_.push_back(uses_.size());
    }
    check_claims();
    for (std::size_t c = 0; c < lists_.cell_count(); ++c)
      builder_.add_cell({uses_.data() + use_offsets_[c], use_offsets_[c + 1] - use_offsets_[c]});
    built_.solid = builder_.finish();
    return std::move(built_);
  }

 private:
  void check_cells_and_add_vertices() {
    const auto point_count = static_cast<std::size_t>(lists_.positions.cols());
    std::vector<std::uint8_t> used(point_count, 0);
    CellLoops loops;
    for (std::size_t c = 0; c < lists_.cell_count(); ++c) {
      read_loops(lists_, c, loops);
      // The other kinds close by their tables once their vertices differ.
      if (lists_.kinds[c] == CellKind::polyhedron)
        if (std::string fault = sphere_fault(loops); !fault.empty()) fail(c, fault);
      for (const std::uint32_t p : loops.corners) used[p] = 1;
    }
    vertex_from_point_.resize(point_count);
    for (std::uint32_t p = 0; p < point_count; ++p) {
      if (!used[p]) continue;
      vertex_from_point_[p] = builder_.add_vertex();
      built_.point_from_vertex.push_back(p);
    }
    built_.positions.resize(3, static_cast<Eigen::Index>(built_.point_from_vertex.size()));
    for (std::size_t v = 0; v < built_.point_from_vertex.size(); ++v)
      built_.positions.col(static_cast<Eigen::Index>(v)) = lists_.positions.col(built_.point_from_vertex[v]);
  }

  EdgeId edge(VertexId a, VertexId b) {
    if (b < a) std::swap(a, b);
    const std::uint64_t hash = mix(std::uint64_t{a.value} << 32 | b.value);
    const std::uint32_t found = edges_.find(hash, [&](std::uint32_t e) {
      return builder_.solid().edge_vertices(EdgeId{e}) == std::array<VertexId, 2>{a, b};
    });
    if (found != ElementTable::k_empty) return EdgeId{found};
    const EdgeId e = builder_.add_edge(a, b);
    edges_.insert(hash, e.value);
    return e;
  }

  void claim_face(std::span<const std::uint32_t> loop, std::size_t cell) {
    loop_.clear();
    loop_edges_.clear();
    for (const std::uint32_t p : loop) loop_.push_back(vertex_from_point_[p]);
    // The set of its edges tells a face from all others, whatever its rotation and direction.
    std::uint64_t hash = loop.size();
    for (std::size_t i = 0; i < loop_.size(); ++i) {
      loop_edges_.push_back(edge(loop_[i], loop_[(i + 1) % loop_.size()]));
      hash += mix(loop_edges_.back().value);
    }
    const std::uint32_t found = faces_.find(
        hash, [&](std::uint32_t f) { return same_loop(loop_, builder_.solid().face_vertices(FaceId{f})) != 0; });
    FaceId f{found};
    if (found == ElementTable::k_empty) {
      f = builder_.add_face(loop_, loop_edges_);
      faces_.insert(hash, f.value);
      claims_.emplace_back();
    }
    FaceClaims& claims = claims_[f.index()];
    if (claims.count < 2) claims.cells[claims.count] = static_cast<std::uint32_t>(cell);
    ++claims.count;
    uses_.push_back(face_use(f, same_loop(loop_, builder_.solid().face_vertices(f)) < 0));
  }

  void check_claims() const {
    std::vector<std::uint8_t> taken(2 * claims_.size(), 0);
    for (std::size_t c = 0; c < lists_.cell_count(); ++c)
      for (std::size_t u = use_offsets_[c]; u < use_offsets_[c + 1]; ++u) {
        const FaceClaims& claims = claims_[uses_[u].index() / 2];
        if (claims.count > 2)
          fail(c,
               fmt::format("the face of vertices {} is used three times ({} cells claim it, among them {} and {}); "
                           "a face has two sides",
                           names(face_of(uses_[u])), claims.count, claims.cells[0], claims.cells[1]));
        if (taken[uses_[u].index()]++)
          fail(c, fmt::format("cells {} and {} are on the same side of the face of vertices {} (incoherent "
                              "orientation); turn one of them inside out",
                              claims.cells[0], claims.cells[1], names(face_of(uses_[u]))));
      }
  }

  std::string names(FaceId f) const {
    std::string text;
    const auto loop = builder_.solid().face_vertices(f);
    for (std::size_t i = 0; i < loop.size() && i < 8; ++i)
      text += fmt::format("{}{}", i ? " " : "", built_.point_from_vertex[loop[i].index()]);
    return loop.size() > 8 ? text + " ..." : text;
  }

  const CellLists& lists_;
  Builder builder_;
  Built built_;
  ElementTable edges_, faces_;
  std::vector<VertexId> vertex_from_point_;
  std::vector<FaceClaims> claims_;
  std::vector<FaceUseId> uses_;
  std::vector<std::size_t> use_offsets_{0};
  std::vector<VertexId> loop_;
  std::vector<EdgeId> loop_edges_;
};

}  // namespace

Built build(const CellLists& lists) {
  check_lists(lists);
  return Assembly(lists).run();
}

void Builder::reserve(std::size_t vertices, std::size_t edges, std::size_t faces, std::size_t corners,
                      std::size_t cells, std::size_t uses) {
  solid_.vertex_live_.reserve(vertices);
  solid_.vertex_sharpness_.reserve(vertices);
  solid_.vertex_lists_.reserve(vertices);
  solid_.edge_link_next_.reserve(2 * edges);
  solid_.edges_.reserve(edges);
  solid_.faces_.reserve(faces);
  solid_.corner_vertex_.reserve(corners);
  solid_.corner_edge_.reserve(corners);
  solid_.corner_face_.reserve(corners);
  solid_.corner_next_.reserve(corners);
  solid_.cells_.reserve(cells);
  solid_.cell_faces_.reserve(uses);
}

}  // namespace argil::subdiv
