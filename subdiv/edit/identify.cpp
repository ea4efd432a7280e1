#include "subdiv/edit/identify.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "subdiv/disjoint_sets.h"
#include "subdiv/edit/new_cells.h"
#include "subdiv/edit/rewrite.h"
#include "subdiv/error.h"
#include "subdiv/radial_edge.h"
#include "subdiv/sort_unique.h"

namespace argil::subdiv {

namespace {

using Loop = std::vector<VertexId>;

std::string where(CellId c) {
  return fmt::format("cell {}", c.value);
}

class Identifier {
 public:
  Identifier(const Solid& solid, std::span<const Joined> groups, Flattening flattening)
      : solid_(solid), flattening_(flattening) {
    for (const Joined& group : groups)
      for (std::size_t i = 1; i < group.size(); ++i) {
        change_.replaced[group[i]] = group[0];
        const auto cells = vertex_cells(solid, group[i]);
        change_.removed.insert(change_.removed.end(), cells.begin(), cells.end());
      }
    sort_unique(change_.removed);
  }

  Rewrite run() {
    for (const CellId c : change_.removed) {
      if (flattening_ == Flattening::refused) check_apart(c);
      NewCell cell{image_of(c), c};
      if (cell.loops.empty()) continue;
      change_.added.push_back(std::move(cell));
    }
    check_new_cells(solid_, change_);
    return std::move(change_);
  }

 private:
  VertexId image(VertexId v) const {
    const auto found = change_.replaced.find(v);
    return found == change_.replaced.end() ? v : found->second;
  }

  void check_apart(CellId c) const {
    std::map<VertexId, VertexId> first;
    for (const VertexId v : cell_vertices(solid_, c))
      if (const auto [at, fresh] = first.try_emplace(image(v), v); !fresh)
        throw Error(ErrorCode::bad_topology,
                    fmt::format("vertices {} and {} of cell {} would become one, and the cell would touch itself; "
                                "split it between them first, or collapse the edge if that is meant",
                                at->second.value, v.value, c.value),
                    where(c));
  }

  std::vector<Loop> image_of(CellId c) const {
    std::vector<Loop> loops;
    for (Loop loop : cell_loops(solid_, c)) {
      for (VertexId& v : loop) v = image(v);
      loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
      while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
      if (loop.size() < 3) continue;
      Loop sorted = loop;
      std::sort(sorted.begin(), sorted.end());
      if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end())
        throw Error(ErrorCode::bad_topology,
                    fmt::format("a face of cell {} would touch itself at vertex {}; choose more of its edges, or "
                                "split the face there first",
                                c.value, twice->value),
                    where(c));
      // Two faces that lie on each other back to back leave nothing between them.
      const auto opposite = std::find(loops.begin(), loops.end(), canonical({loop.rbegin(), loop.rend()}));
      if (flattening_ == Flattening::allowed && opposite != loops.end())
        loops.erase(opposite);
      else
        loops.push_back(canonical(std::move(loop)));
    }
    return loops;
  }

  static Loop canonical(Loop loop) {
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    return loop;
  }

  const Solid& solid_;
  Flattening flattening_;
  Rewrite change_;
};

}  // namespace

std::vector<Joined> joined(std::span<const std::pair<VertexId, VertexId>> pairs) {
  std::vector<VertexId> vertices;
  for (const auto& [a, b] : pairs) vertices.insert(vertices.end(), {a, b});
  sort_unique(vertices);
  const auto number = [&](VertexId v) {
    return static_cast<std::uint32_t>(std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin());
  };
  DisjointSets sets(vertices.size());
  for (const auto& [a, b] : pairs) sets.unite(number(a), number(b));
  std::map<std::uint32_t, Joined> by_first;
  for (std::uint32_t i = 0; i < vertices.size(); ++i) by_first[sets.find(i)].push_back(vertices[i]);
  std::vector<Joined> result;
  for (auto& [first, group] : by_first)
    if (group.size() > 1) result.push_back(std::move(group));
  return result;
}

void identify(Transaction& transaction, std::span<const Joined> groups, Flattening flattening, Edit& edit) {
  rewrite(transaction, Identifier(transaction.solid(), groups, flattening).run(), edit);
  std::vector<VertexId> kept;
  for (const Joined& group : groups) kept.push_back(group[0]);
  check_boundary_left(transaction.solid(), kept);
}

}  // namespace argil::subdiv
