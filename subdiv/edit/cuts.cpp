#include "subdiv/edit/cuts.h"

#include <fmt/format.h>

#include <algorithm>

#include "subdiv/cell_check.h"
#include "subdiv/edit/rewrite.h"
#include "subdiv/error.h"
#include "subdiv/radial_edge.h"
#include "subdiv/sort_unique.h"

namespace argil::subdiv {

namespace {

// The outward loops of a cell that keeps whole.
std::vector<Loop> loops_with_cuts(const Solid& solid, const Cuts& cuts, CellId cell) {
  std::vector<Loop> loops;
  for (const FaceUseId use : solid.cell_face_uses(cell)) {
    const auto parted = cuts.faces.find(face_of(use));
    const std::size_t first = loops.size();
    if (parted == cuts.faces.end())
      loops.push_back(loop_with_cuts(solid, cuts, face_of(use)));
    else
      loops.insert(loops.end(), parted->second.begin(), parted->second.end());
    if (is_back(use))
      for (std::size_t i = first; i < loops.size(); ++i) std::reverse(loops[i].begin(), loops[i].end());
  }
  return loops;
}

void check_sphere(const NewCell& cell) {
  CellLoops loops;
  for (const Loop& loop : cell.loops) {
    for (const VertexId v : loop) loops.corners.push_back(v.value);
    loops.end_face();
  }
  if (const std::string fault = sphere_fault(loops); !fault.empty())
    throw Error(ErrorCode::bad_topology,
                fmt::format("cell {} cannot be cut like this: {}; cut it elsewhere, or choose other cells",
                            cell.source.value, fault),
                fmt::format("cell {}", cell.source.value));
}

template <class IdType>
std::vector<IdType> checked_ids(const Solid& solid, std::span<const IdType> ids, const char* kind) {
  if (ids.empty())
    throw Error(ErrorCode::bad_input, fmt::format("expected {}s to cut, found none; select some first", kind));
  std::vector<IdType> sorted(ids.begin(), ids.end());
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i < sorted.size(); ++i)
    if (!solid.is_live(sorted[i]) || (i > 0 && sorted[i] == sorted[i - 1]))
      throw Error(ErrorCode::not_found,
                  fmt::format("{0} {1} is not there or given twice; select {0}s again", kind, sorted[i].value),
                  fmt::format("{} {}", kind, sorted[i].value));
  return sorted;
}

// Replaces sources that `edit` made by what it made them of.
template <class IdType>
void append_descent(std::vector<Descent<IdType>>& edit, const std::vector<Descent<IdType>>& next) {
  std::multimap<IdType, IdType> sources;
  for (const auto& [made, source] : edit) sources.emplace(made, source);
  for (const auto& [made, source] : next) {
    const auto [begin, end] = sources.equal_range(source);
    if (begin == end) edit.push_back({made, source});
    for (auto at = begin; at != end; ++at) edit.push_back({made, at->second});
  }
}

}  // namespace

Loop loop_with_cuts(const Solid& solid, const Cuts& cuts, FaceId face) {
  const auto loop = solid.face_vertices(face);
  const auto edges = solid.face_edges(face);
  Loop result;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    result.push_back(loop[i]);
    if (const auto cut = cuts.edges.find(edges[i]); cut != cuts.edges.end()) result.push_back(cut->second);
  }
  return result;
}

std::map<CellId, std::vector<CellId>> apply_cuts(Transaction& transaction, const Cuts& cuts, Edit& edit) {
  const Solid& solid = transaction.solid();
  Rewrite change;
  for (const auto& [edge, vertex] : cuts.edges) {
    change.cut_edges[edge] = {vertex};
    const auto about = edge_cells(solid, edge);
    change.removed.insert(change.removed.end(), about.begin(), about.end());
  }
  for (const auto& [face, parts] : cuts.faces) {
    for (const Loop& part : parts) change.cut_faces.emplace_back(part, face);
    for (const bool back : {false, true})
      if (const CellId c = solid.owner(face_use(face, back)); c.valid()) change.removed.push_back(c);
  }
  for (const auto& [cell, parts] : cuts.cells) change.removed.push_back(cell);
  sort_unique(change.removed);
  for (const CellId c : change.removed) {
    if (const auto parted = cuts.cells.find(c); parted != cuts.cells.end())
      for (const auto& part : parted->second) change.added.push_back({part, c});
    else
      change.added.push_back({loops_with_cuts(solid, cuts, c), c});
  }
  for (const NewCell& cell : change.added) check_sphere(cell);
  const std::size_t first = edit.cells.size();
  rewrite(transaction, change, edit);
  std::map<CellId, std::vector<CellId>> parts;
  for (std::size_t i = first; i < edit.cells.size(); ++i)
    if (cuts.cells.count(edit.cells[i].source)) parts[edit.cells[i].source].push_back(edit.cells[i].made);
  return parts;
}

void append_edit(Edit& edit, Edit next) {
  std::map<VertexId, std::size_t> placed;
  for (std::size_t i = 0; i < edit.placed.size(); ++i) placed[edit.placed[i].vertex] = i;
  for (PlacedVertex& later : next.placed) {
    std::map<VertexId, double> weights;
    for (const auto& [source, weight] : later.sources) {
      const auto earlier = placed.find(source);
      if (earlier == placed.end()) {
        weights[source] += weight;
        continue;
      }
      const PlacedVertex& from = edit.placed[earlier->second];
      for (const auto& [v, w] : from.sources) weights[v] += weight * w;
      later.offset += weight * from.offset;
    }
    later.sources.assign(weights.begin(), weights.end());
  }
  for (PlacedVertex& later : next.placed) {
    if (const auto earlier = placed.find(later.vertex); earlier != placed.end())
      edit.placed[earlier->second] = std::move(later);
    else
      edit.placed.push_back(std::move(later));
  }
  edit.merged.insert(edit.merged.end(), next.merged.begin(), next.merged.end());
  append_descent(edit.edges, next.edges);
  append_descent(edit.faces, next.faces);
  append_descent(edit.cells, next.cells);
  edit.next_faces = std::move(next.next_faces);
  edit.next_cells = std::move(next.next_cells);
  edit.next_edges = std::move(next.next_edges);
  edit.next_vertices = std::move(next.next_vertices);
}

VertexId add_blend(Transaction& transaction, std::vector<std::pair<VertexId, double>> sources, Edit& edit) {
  const VertexId made = transaction.add_vertex();
  edit.placed.push_back({made, std::move(sources)});
  return made;
}

VertexId add_mean(Transaction& transaction, std::span<const VertexId> of, Edit& edit) {
  std::vector<std::pair<VertexId, double>> sources;
  for (const VertexId v : of) sources.emplace_back(v, 1.0 / static_cast<double>(of.size()));
  return add_blend(transaction, std::move(sources), edit);
}

std::vector<CellId> checked(const Solid& solid, std::span<const CellId> cells) {
  return checked_ids(solid, cells, "cell");
}

std::vector<EdgeId> checked(const Solid& solid, std::span<const EdgeId> edges) {
  return checked_ids(solid, edges, "edge");
}

}  // namespace argil::subdiv
