#include "subdiv/edit/cut_face.h"

#include <fmt/format.h>

#include <algorithm>

#include "subdiv/edit/cuts.h"
#include "subdiv/error.h"
#include "subdiv/radial_edge.h"

namespace argil::subdiv {

namespace {

std::string name(FaceId face) {
  return fmt::format("face {}", face.value);
}

void check_vertices(const Solid& solid, VertexId from, VertexId to) {
  for (const VertexId v : {from, to})
    if (!solid.is_live(v))
      throw Error(ErrorCode::not_found, fmt::format("there is no vertex {}; choose another", v.value),
                  fmt::format("vertex {}", v.value));
  if (from == to)
    throw Error(ErrorCode::bad_input, fmt::format("expected two vertices of the face, found {} twice", from.value));
}

}  // namespace

Edit cut_face(Transaction& transaction, FaceId face, VertexId from, VertexId to) {
  const Solid& solid = transaction.solid();
  if (!solid.is_live(face))
    throw Error(ErrorCode::not_found, fmt::format("there is no {}; select faces again", name(face)), name(face));
  if (!solid.owner(face_use(face, false)).valid() && !solid.owner(face_use(face, true)).valid())
    throw Error(ErrorCode::bad_topology,
                fmt::format("{} belongs to no cell; choose a face of one (`remove dangling` sweeps such faces)",
                            name(face)),
                name(face));
  check_vertices(solid, from, to);
  Loop loop{solid.face_vertices(face).begin(), solid.face_vertices(face).end()};
  for (const VertexId v : {from, to})
    if (!std::count(loop.begin(), loop.end(), v))
      throw Error(ErrorCode::bad_input,
                  fmt::format("vertex {} is not a corner of {}; choose two of its corners", v.value, name(face)),
                  name(face));
  if (solid.find_edge(from, to))
    throw Error(ErrorCode::bad_input,
                fmt::format("an edge joins vertices {} and {} already; choose two corners of {} that none joins",
                            from.value, to.value, name(face)),
                name(face));
  std::rotate(loop.begin(), std::find(loop.begin(), loop.end(), from), loop.end());
  const auto middle = std::find(loop.begin(), loop.end(), to);
  Loop first{loop.begin(), middle + 1}, second{middle, loop.end()};
  second.push_back(from);
  Cuts cuts;
  cuts.faces[face] = {first, second};
  Edit edit;
  (void)apply_cuts(transaction, cuts, edit);
  edit.next_edges = {solid.find_edge(from, to).value()};
  return edit;
}

FaceId face_between(const Solid& solid, VertexId from, VertexId to) {
  check_vertices(solid, from, to);
  std::vector<FaceId> both, outer;
  for (const FaceId f : vertex_faces(solid, from)) {
    const auto loop = solid.face_vertices(f);
    if (!std::count(loop.begin(), loop.end(), to)) continue;
    both.push_back(f);
    if (solid.is_boundary(f)) outer.push_back(f);
  }
  const auto& found = outer.empty() ? both : outer;
  if (found.empty())
    throw Error(
        ErrorCode::bad_input,
        fmt::format("no face has both vertices {} and {}; choose two corners of one face", from.value, to.value));
  if (found.size() > 1)
    throw Error(
        ErrorCode::bad_input,
        fmt::format("{} faces have both vertices {} and {}; select the one to cut, and choose two corners that "
                    "no edge joins",
                    found.size(), from.value, to.value));
  return found[0];
}

}  // namespace argil::subdiv
