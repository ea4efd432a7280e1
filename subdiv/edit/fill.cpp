#include "subdiv/edit/fill.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "subdiv/disjoint_sets.h"
#include "subdiv/edit/new_cells.h"
#include "subdiv/edit/regions.h"
#include "subdiv/error.h"
#include "subdiv/radial_edge.h"
#include "subdiv/solid_measures.h"

namespace argil::subdiv {

namespace {

using Loop = std::vector<VertexId>;
using Patch = std::vector<FaceId>;

// Connected through edges, also where sheets only touch: they face one opening there.
std::vector<Patch> openings(const Solid& solid, std::span<const FaceId> faces) {
  std::map<EdgeId, std::uint32_t> first_at;
  DisjointSets sets(faces.size());
  for (std::uint32_t i = 0; i < faces.size(); ++i)
    for (const EdgeId e : solid.face_edges(faces[i])) sets.unite(i, first_at.try_emplace(e, i).first->second);
  std::map<std::uint32_t, Patch> by_first;
  for (std::uint32_t i = 0; i < faces.size(); ++i) by_first[sets.find(i)].push_back(faces[i]);
  std::vector<Patch> result;
  for (auto& [first, patch] : by_first) result.push_back(std::move(patch));
  return result;
}

std::string names(const Loop& loop) {
  std::string text;
  for (const VertexId v : loop) text += fmt::format("{}{}", text.empty() ? "" : "-", v.value);
  return text;
}

// The loops that the new cell's sides leave open, each as the cap over it sees it from outside the cell.
std::vector<Loop> open_loops(const std::vector<Loop>& sides) {
  std::map<std::pair<VertexId, VertexId>, int> runs;
  for (const Loop& side : sides)
    for (std::size_t i = 0; i < side.size(); ++i) ++runs[{side[i], side[(i + 1) % side.size()]}];
  std::map<VertexId, VertexId> next;
  for (const auto& [run, count] : runs) {
    const auto& [a, b] = run;
    if (count > 1)
      throw Error(ErrorCode::bad_topology,
                  fmt::format("the faces meet at edge {}-{} where the boundary touches itself; fill one side of it "
                              "after the other",
                              a.value, b.value),
                  fmt::format("edge {}-{}", a.value, b.value));
    if (runs.count({b, a}) == 0 && !next.try_emplace(b, a).second)
      throw Error(
          ErrorCode::bad_topology,
          fmt::format("the open edges meet twice at vertex {}; select the faces between them as well, or fill "
                      "one part after the other",
                      b.value),
          fmt::format("vertex {}", b.value));
  }
  std::vector<Loop> loops;
  while (!next.empty()) {
    Loop loop;
    for (auto at = next.begin(); at != next.end(); at = next.find(loop.back())) {
      if (loop.empty()) loop.push_back(at->first);
      const VertexId to = at->second;
      next.erase(at);
      if (to == loop.front()) break;
      loop.push_back(to);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

// Lies on the outer sides of the faces, with caps.
NewCell cell_for(const Solid& solid, const Patch& patch, std::vector<Loop>& caps) {
  NewCell cell;
  for (const FaceId f : patch) {
    Loop loop = use_vertices(solid, solid.boundary_use(f));
    std::reverse(loop.begin(), loop.end());
    cell.loops.push_back(std::move(loop));
  }
  caps = open_loops(cell.loops);
  for (const Loop& cap : caps)
    for (const FaceId f : patch)
      if (solid.find_face(cap) == f)
        throw Error(ErrorCode::bad_topology,
                    fmt::format("face {} alone is no opening: a cap over loop {} would lie on it; select the faces "
                                "around the opening too, or use bridge between two that face each other",
                                f.value, names(cap)),
                    fmt::format("face {}", f.value));
  cell.loops.insert(cell.loops.end(), caps.begin(), caps.end());
  return cell;
}

// With what follows the first fault, since a loop says more to a user than a vertex does.
void check(const Solid& solid, const Rewrite& change, const std::vector<std::vector<Loop>>& caps) {
  try {
    check_new_cells(solid, change);
  } catch (const Error& error) {
    std::string open;
    for (const auto& of_cell : caps)
      for (const Loop& cap : of_cell) open += (open.empty() ? "" : ", ") + names(cap);
    throw Error(error.code(),
                fmt::format("the faces do not close to one ball{}{}: {}",
                            open.empty() ? "" : " with caps over the open loops ", open, error.what()),
                error.where());
  }
}

}  // namespace

Edit fill(Transaction& transaction, const Eigen::Matrix3Xd& positions, std::span<const FaceId> faces) {
  const Solid& solid = transaction.solid();
  check_boundary_faces(solid, faces, "fill between");
  Rewrite change;
  std::vector<std::vector<Loop>> caps;
  std::vector<double> sizes;
  for (const Patch& patch : openings(solid, faces)) {
    caps.emplace_back();
    change.added.push_back(cell_for(solid, patch, caps.back()));
    change.glued.insert(change.glued.end(), patch.begin(), patch.end());
    double area = 0;
    for (const FaceId f : patch) area += area_vector(solid, positions, std::array{f}).norm();
    sizes.push_back(std::pow(area, 1.5));
    for (const Loop& cap : caps.back())
      if (const auto there = solid.find_face(cap)) change.glued.push_back(*there);
  }
  check(solid, change, caps);

  Edit edit;
  const std::size_t first_cell = solid.cell_capacity(), first_face = solid.face_capacity();
  rewrite(transaction, change, edit);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const CellId made{first_cell + i};
    const double volume = cell_volume(solid, positions, made);
    if (volume < 1e-9 * sizes[i])
      throw Error(ErrorCode::bad_geometry,
                  fmt::format("expected faces around an opening, but the cell between face {} and its neighbours "
                              "would have a volume of {:.3g}; select faces of a notch, a pit or a void",
                              change.glued[0].value, volume),
                  fmt::format("face {}", change.glued[0].value));
    edit.next_cells.push_back(made);
  }
  for (std::size_t f = first_face; f < solid.face_capacity(); ++f) edit.next_faces.emplace_back(f);
  return edit;
}

}  // namespace argil::subdiv
