#include "sculpt/field_transfer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <map>
#include <vector>

#include "subdiv/radial_edge.h"
#include "subdiv/sort_unique.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

// For each level, which element of `after` an element of `before` became (invalid: it is gone).
struct LevelMap {
  std::vector<VertexId> vertex;
  std::vector<EdgeId> edge;
  std::vector<FaceId> face;
  std::vector<CellId> cell;
};

template <class IdType>
std::vector<IdType> same_ids(const Solid& before, const Solid& after, std::size_t capacity) {
  std::vector<IdType> map(capacity);
  for (std::size_t i = 0; i < capacity; ++i)
    if (before.is_live(IdType{i}) && after.is_live(IdType{i})) map[i] = IdType{i};
  return map;
}

// Ids are never reused, so an element of the control solid that lives on kept its id.
LevelMap control_map(const Solid& before, const Solid& after) {
  return {same_ids<VertexId>(before, after, before.vertex_capacity()),
          same_ids<EdgeId>(before, after, before.edge_capacity()),
          same_ids<FaceId>(before, after, before.face_capacity()),
          same_ids<CellId>(before, after, before.cell_capacity())};
}

// The fine vertices of a step in refine()'s order, as numbers by kind and coarse id.
struct PointIds {
  std::vector<std::uint32_t> vertex, edge, face, cell;
};

PointIds point_ids(const Solid& coarse) {
  PointIds ids{
      std::vector<std::uint32_t>(coarse.vertex_capacity()), std::vector<std::uint32_t>(coarse.edge_capacity()),
      std::vector<std::uint32_t>(coarse.face_capacity()), std::vector<std::uint32_t>(coarse.cell_capacity())};
  std::uint32_t next = 0;
  for (const VertexId v : coarse.vertices()) ids.vertex[v.index()] = next++;
  for (const EdgeId e : coarse.edges()) ids.edge[e.index()] = next++;
  for (const FaceId f : coarse.faces()) ids.face[f.index()] = next++;
  for (const CellId c : coarse.cells()) ids.cell[c.index()] = next++;
  return ids;
}

LevelMap finer_map(const Refinement& before, const Refinement& after, int fine_level, const LevelMap& coarse) {
  const std::size_t l = static_cast<std::size_t>(fine_level);
  const Solid& coarse_before = before.levels[l - 1];
  const Solid& coarse_after = after.levels[l - 1];
  const Solid& fine_before = before.levels[l];
  const Solid& fine_after = after.levels[l];
  const PointIds from = point_ids(coarse_before), to = point_ids(coarse_after);
  LevelMap map;
  map.vertex.resize(fine_before.vertex_capacity());
  const auto carry = [&](const auto& live, const auto& coarse_map, const auto& from_ids, const auto& to_ids) {
    for (const auto id : live) {
      const auto there = coarse_map[id.index()];
      if (there.valid()) map.vertex[from_ids[id.index()]] = VertexId{to_ids[there.index()]};
    }
  };
  carry(coarse_before.vertices(), coarse.vertex, from.vertex, to.vertex);
  carry(coarse_before.edges(), coarse.edge, from.edge, to.edge);
  carry(coarse_before.faces(), coarse.face, from.face, to.face);
  carry(coarse_before.cells(), coarse.cell, from.cell, to.cell);

  map.edge.resize(fine_before.edge_capacity());
  for (const EdgeId e : fine_before.edges()) {
    const auto& ends = fine_before.edge_vertices(e);
    const VertexId a = map.vertex[ends[0].index()], b = map.vertex[ends[1].index()];
    if (a.valid() && b.valid()) map.edge[e.index()] = fine_after.find_edge(a, b).value_or(EdgeId{});
  }
  map.face.resize(fine_before.face_capacity());
  std::vector<VertexId> loop;
  for (const FaceId f : fine_before.faces()) {
    loop.clear();
    for (const VertexId v : fine_before.face_vertices(f)) loop.push_back(map.vertex[v.index()]);
    if (std::all_of(loop.begin(), loop.end(), [](VertexId v) { return v.valid(); }))
      map.face[f.index()] = fine_after.find_face(loop).value_or(FaceId{});
  }
  map.cell.resize(fine_before.cell_capacity());
  std::vector<std::pair<std::array<std::uint32_t, 2>, CellId>> children;  // (parent, corner) of the solid after
  for (const CellId c : fine_after.cells())
    children.push_back({{after.parent[l][c].value, after.parent_corner[l][c].value}, c});
  std::sort(children.begin(), children.end());
  for (const CellId c : fine_before.cells()) {
    const CellId parent = coarse.cell[before.parent[l][c].index()];
    const VertexId corner = coarse.vertex[before.parent_corner[l][c].index()];
    if (!parent.valid() || !corner.valid()) continue;
    const std::array<std::uint32_t, 2> key{parent.value, corner.value};
    const auto found = std::lower_bound(children.begin(), children.end(), key,
                                        [](const auto& child, const auto& k) { return child.first < k; });
    if (found != children.end() && found->first == key) map.cell[c.index()] = found->second;
  }
  return map;
}

}  // namespace

std::shared_ptr<const Fields> fields_at_level(const Fields& fields, const Refinement& from, const Refinement& to) {
  auto result = std::make_shared<Fields>(fields);
  for (int level = from.finest(); level < to.finest(); ++level)
    for (auto& values : result->values) {
      // Means lie between the least and the largest; cut there, rounding neither leaves a range nor blurs a
      // constant.
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const VertexId v : to.levels[static_cast<std::size_t>(level)].vertices()) {
        low = std::min(low, values[static_cast<Eigen::Index>(v.index())]);
        high = std::max(high, values[static_cast<Eigen::Index>(v.index())]);
      }
      values = apply(to.step_stencils[static_cast<std::size_t>(level) + 1], values).cwiseMax(low).cwiseMin(high);
    }
  for (int level = from.finest(); level > to.finest(); --level) {
    // The first fine vertices stand for the coarse ones.
    const Solid& coarse = from.levels[static_cast<std::size_t>(level) - 1];
    for (auto& values : result->values) {
      Eigen::VectorXd restricted = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(coarse.vertex_capacity()));
      Eigen::Index next = 0;
      for (const VertexId v : coarse.vertices()) restricted[static_cast<Eigen::Index>(v.index())] = values[next++];
      values = std::move(restricted);
    }
  }
  return result;
}

std::vector<std::uint32_t> nodes_at_level(const Refinement& from, const Refinement& to) {
  std::vector<std::uint32_t> map(from.solid().vertex_capacity());
  for (std::size_t v = 0; v < map.size(); ++v) map[v] = static_cast<std::uint32_t>(v);
  const auto ranks = [](const Solid& coarse) { return point_ids(coarse).vertex; };
  for (int level = from.finest(); level < to.finest(); ++level) {
    const auto rank = ranks(to.levels[static_cast<std::size_t>(level)]);
    for (auto& node : map) node = rank[node];
  }
  for (int level = from.finest(); level > to.finest(); --level) {
    const Solid& coarse = from.levels[static_cast<std::size_t>(level) - 1];
    std::vector<std::uint32_t> coarse_from_fine(from.levels[static_cast<std::size_t>(level)].vertex_capacity(),
                                                k_no_node);
    std::uint32_t next = 0;
    for (const VertexId v : coarse.vertices()) coarse_from_fine[next++] = v.value;
    for (auto& node : map)
      if (node != k_no_node) node = coarse_from_fine[node];
  }
  return map;
}

std::vector<std::uint32_t> nodes_after_edit(const Refinement& before, const Refinement& after) {
  assert(before.finest() == after.finest());
  LevelMap map = control_map(before.levels[0], after.levels[0]);
  for (int level = 1; level <= after.finest(); ++level) map = finer_map(before, after, level, map);
  std::vector<std::uint32_t> nodes(map.vertex.size());
  std::transform(map.vertex.begin(), map.vertex.end(), nodes.begin(), [](VertexId v) { return v.value; });
  static_assert(VertexId::k_invalid == k_no_node);
  return nodes;
}

std::vector<std::uint32_t> copied_nodes(const Refinement& after, const Edit& edit) {
  const Solid& solid = after.levels[0];
  std::map<VertexId, VertexId> source_of;
  std::vector<CellId> candidates;
  for (const PlacedVertex& placed : edit.placed) {
    if (placed.sources.empty()) continue;
    const VertexId source = placed.sources[0].first;
    if (!solid.is_live(source) || !std::all_of(placed.sources.begin(), placed.sources.end(),
                                               [&](const auto& other) { return other.first == source; }))
      continue;
    source_of[placed.vertex] = source;
    if (placed.vertex == source) continue;
    for (const CellId c : vertex_cells(solid, placed.vertex)) candidates.push_back(c);
  }
  subdiv::sort_unique(candidates);

  LevelMap map{std::vector<VertexId>(solid.vertex_capacity()), std::vector<EdgeId>(solid.edge_capacity()),
               std::vector<FaceId>(solid.face_capacity()), std::vector<CellId>(solid.cell_capacity())};
  for (const CellId c : candidates) {
    std::vector<VertexId> sources;
    for (const VertexId v : cell_vertices(solid, c))
      if (const auto found = source_of.find(v); found != source_of.end()) sources.push_back(found->second);
    if (sources.size() != cell_vertices(solid, c).size()) continue;
    std::sort(sources.begin(), sources.end());
    for (const CellId original : vertex_cells(solid, sources[0])) {
      if (original == c || cell_vertices(solid, original) != sources) continue;
      map.cell[c.index()] = original;
      for (const VertexId v : cell_vertices(solid, c)) map.vertex[v.index()] = source_of.at(v);
      for (const EdgeId e : cell_edges(solid, c)) {
        const auto& ends = solid.edge_vertices(e);
        map.edge[e.index()] = solid.find_edge(source_of.at(ends[0]), source_of.at(ends[1])).value_or(EdgeId{});
      }
      for (const FaceUseId use : solid.cell_face_uses(c)) {
        std::vector<VertexId> loop;
        for (const VertexId v : solid.face_vertices(face_of(use))) loop.push_back(source_of.at(v));
        map.face[face_of(use).index()] = solid.find_face(loop).value_or(FaceId{});
      }
      break;
    }
  }
  for (int level = 1; level <= after.finest(); ++level) map = finer_map(after, after, level, map);
  std::vector<std::uint32_t> nodes(map.vertex.size());
  std::transform(map.vertex.begin(), map.vertex.end(), nodes.begin(), [](VertexId v) { return v.value; });
  return nodes;
}

std::shared_ptr<const Fields> fields_after_edit(const Fields& fields, const std::vector<std::uint32_t>& node_map,
                                                const Refinement& after,
                                                const std::vector<std::uint32_t>& source_from_node) {
  const Solid& solid = after.solid();
  const std::size_t count = solid.vertex_capacity();
  std::vector<std::uint8_t> known(count, 0);
  auto result = std::make_shared<Fields>(*initial_fields(count));
  for (std::size_t v = 0; v < node_map.size(); ++v) {
    const std::uint32_t there = node_map[v];
    if (there == k_no_node) continue;
    known[there] = 1;
    for (std::size_t f = 0; f < result->values.size(); ++f)
      result->values[f][there] = fields.values[f][static_cast<Eigen::Index>(v)];
  }
  std::vector<std::uint32_t> copied;
  for (std::uint32_t v = 0; v < source_from_node.size(); ++v)
    if (const std::uint32_t source = source_from_node[v]; source != k_no_node && !known[v] && known[source]) {
      copied.push_back(v);
      for (Eigen::VectorXd& values : result->values) values[v] = values[source];
    }
  for (const std::uint32_t v : copied) known[v] = 1;
  // What grew takes the mean of its known neighbours, layer by layer.
  std::vector<VertexId> unknown;
  for (const VertexId v : solid.vertices())
    if (!known[v.index()]) unknown.push_back(v);
  while (!unknown.empty()) {
    std::vector<VertexId> still, reached;
    for (const VertexId v : unknown) {
      std::array<double, k_field_count> sum{};
      int neighbours = 0;
      solid.for_each_edge(v, [&](EdgeId e) {
        const VertexId w = solid.other_vertex(e, v);
        if (!known[w.index()]) return;
        ++neighbours;
        for (std::size_t f = 0; f < sum.size(); ++f)
          sum[f] += result->values[f][static_cast<Eigen::Index>(w.index())];
      });
      if (neighbours == 0) {
        still.push_back(v);
        continue;
      }
      reached.push_back(v);
      for (std::size_t f = 0; f < sum.size(); ++f)
        result->values[f][static_cast<Eigen::Index>(v.index())] = sum[f] / neighbours;
    }
    if (reached.empty()) break;  // a component of its own keeps the initial values
    for (const VertexId v : reached) known[v.index()] = 1;
    unknown = std::move(still);
  }
  return result;
}

}  // namespace argil::sculpt
