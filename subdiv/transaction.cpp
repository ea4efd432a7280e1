#include "subdiv/transaction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "subdiv/cell_check.h"
#include "subdiv/error.h"
#include "subdiv/radial_edge.h"

namespace argil::subdiv {

Transaction::~Transaction() {
  if (solid_) roll_back();
}

Delta::Step& Transaction::record(Delta::Kind kind, std::uint32_t id) {
  return delta_.steps_.emplace_back(
      Delta::Step{kind, id, delta_.payload_.size(), delta_.payload_.size(), 0.0, 0.0});
}

VertexId Transaction::add_vertex() {
  const VertexId v = solid_->push_vertex();
  record(Delta::Kind::add_vertex, v.value);
  return v;
}

EdgeId Transaction::add_edge(VertexId a, VertexId b) {
  assert(solid_->is_live(a) && solid_->is_live(b) && a != b);
  if (const auto e = solid_->find_edge(a, b)) return *e;
  if (b < a) std::swap(a, b);
  const EdgeId e = solid_->push_edge(a, b);
  Delta::Step& step = record(Delta::Kind::add_edge, e.value);
  delta_.payload_.insert(delta_.payload_.end(), {a.value, b.value});
  step.payload_end = delta_.payload_.size();
  return e;
}

FaceUseId Transaction::add_face(std::span<const VertexId> loop) {
  const auto fail = [](const std::string& message) { throw Error(ErrorCode::bad_topology, message); };
  if (loop.size() < 3) fail(fmt::format("a face needs at least 3 vertices, found {}", loop.size()));
  std::vector<VertexId> sorted(loop.begin(), loop.end());
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (!solid_->is_live(sorted[i])) fail(fmt::format("a face names vertex {}, which is removed", sorted[i].value));
    if (i > 0 && sorted[i] == sorted[i - 1]) fail(fmt::format("a face names vertex {} twice", sorted[i].value));
  }
  if (const auto f = solid_->find_face(loop)) {
    const auto stored = solid_->face_vertices(*f);
    const auto start = static_cast<std::size_t>(std::find(stored.begin(), stored.end(), loop[0]) - stored.begin());
    return face_use(*f, stored[(start + 1) % stored.size()] != loop[1]);
  }
  std::vector<EdgeId> edges;
  for (std::size_t i = 0; i < loop.size(); ++i) edges.push_back(add_edge(loop[i], loop[(i + 1) % loop.size()]));
  const FaceId f = solid_->push_face(loop, edges);
  Delta::Step& step = record(Delta::Kind::add_face, f.value);
  for (const VertexId v : loop) delta_.payload_.push_back(v.value);
  for (const EdgeId e : edges) delta_.payload_.push_back(e.value);
  step.payload_end = delta_.payload_.size();
  return face_use(f, false);
}

CellId Transaction::add_cell(std::span<const FaceUseId> uses) {
  const auto fail = [](const std::string& message) { throw Error(ErrorCode::bad_topology, message); };
  CellLoops loops;
  for (const FaceUseId use : uses) {
    if (!solid_->is_live(face_of(use)))
      fail(fmt::format("a cell names face {}, which is removed", use.index() / 2));
    if (const CellId c = solid_->owner(use); c.valid())
      fail(fmt::format("a new cell would lie in cell {}: that side of face {} is taken; choose a boundary face",
                       c.value, face_of(use).value));
    for (const VertexId v : use_vertices(*solid_, use)) loops.corners.push_back(v.value);
    loops.end_face();
  }
  if (const std::string fault = sphere_fault(loops); !fault.empty()) fail(fault);
  const CellId c = solid_->push_cell(uses);
  Delta::Step& step = record(Delta::Kind::add_cell, c.value);
  for (const FaceUseId use : uses) delta_.payload_.push_back(use.value);
  step.payload_end = delta_.payload_.size();
  return c;
}

CellId Transaction::add_cell(const std::vector<std::vector<VertexId>>& loops) {
  const std::size_t before = delta_.steps_.size();
  try {
    std::vector<FaceUseId> uses;
    for (const auto& loop : loops) uses.push_back(add_face(loop));
    return add_cell(uses);
  } catch (const Error&) {
    take_back_to(before);
    throw;
  }
}

void Transaction::remove_cell(CellId c, bool dangling) {
  assert(solid_->is_live(c));
  const auto uses = solid_->cell_face_uses(c);
  std::vector<FaceId> faces;
  for (const FaceUseId use : uses) faces.push_back(face_of(use));
  std::sort(faces.begin(), faces.end());
  const auto edges = cell_edges(*solid_, c);
  const auto vertices = cell_vertices(*solid_, c);
  solid_->set_live(c, false);
  record(Delta::Kind::remove_cell, c.value);
  if (!dangling) return;
  for (const FaceId f : faces)
    if (!solid_->owner(face_use(f, false)).valid() && !solid_->owner(face_use(f, true)).valid()) remove_face(f);
  for (const EdgeId e : edges)
    if (solid_->edge_valence(e) == 0) remove_edge(e);
  for (const VertexId v : vertices)
    if (solid_->vertex_valence(v) == 0) remove_vertex(v);
}

void Transaction::remove_face(FaceId f) {
  solid_->set_live(f, false);
  record(Delta::Kind::remove_face, f.value);
}

void Transaction::remove_edge(EdgeId e) {
  assert(solid_->edge_valence(e) == 0);
  solid_->set_live(e, false);
  record(Delta::Kind::remove_edge, e.value);
}

void Transaction::remove_vertex(VertexId v) {
  assert(solid_->vertex_valence(v) == 0);
  solid_->set_live(v, false);
  record(Delta::Kind::remove_vertex, v.value);
}

void Transaction::assign_sharpness(Solid& solid, EdgeId e, double sharpness) {
  solid.take_from_hash(e);
  solid.edges_[e.index()].sharpness = sharpness;
  solid.add_to_hash(e);
}

void Transaction::assign_sharpness(Solid& solid, VertexId v, double sharpness) {
  solid.take_from_hash(v);
  solid.vertex_sharpness_[v.index()] = sharpness;
  solid.add_to_hash(v);
}

void Transaction::assign_sharpness(Solid& solid, FaceId f, double sharpness) {
  solid.take_from_hash(f);
  solid.faces_[f.index()].sharpness = sharpness;
  solid.add_to_hash(f);
}

template <class IdType>
void Transaction::change_sharpness(Delta::Kind kind, IdType id, double before, double after) {
  assert(solid_->is_live(id) && after >= 0 && after <= k_infinitely_sharp);
  if (before == after) return;
  Delta::Step& step = record(kind, id.value);
  step.before = before;
  step.after = after;
  assign_sharpness(*solid_, id, after);
}

void Transaction::set_sharpness(EdgeId e, double sharpness) {
  change_sharpness(Delta::Kind::edge_sharpness, e, solid_->edge_sharpness(e), sharpness);
}

void Transaction::set_sharpness(VertexId v, double sharpness) {
  change_sharpness(Delta::Kind::vertex_sharpness, v, solid_->vertex_sharpness(v), sharpness);
}

void Transaction::set_sharpness(FaceId f, double sharpness) {
  change_sharpness(Delta::Kind::face_sharpness, f, solid_->face_sharpness(f), sharpness);
}

Delta Transaction::commit() {
  assert(solid_);
  solid_ = nullptr;
  delta_.steps_.shrink_to_fit();
  delta_.payload_.shrink_to_fit();
  return std::move(delta_);
}

void Transaction::roll_back() {
  assert(solid_);
  take_back_to(0);
  solid_ = nullptr;
}

void Transaction::take_back_to(std::size_t step_count) {
  while (delta_.steps_.size() > step_count) {
    undo_step(*solid_, delta_.steps_.back());
    delta_.payload_.resize(delta_.steps_.back().payload_begin);
    delta_.steps_.pop_back();
  }
}

void Transaction::undo_step(Solid& solid, const Delta::Step& step) {
  using Kind = Delta::Kind;
  // Additions are taken back in reverse order, so that each is the last of its kind: the allocator goes back too.
  switch (step.kind) {
    case Kind::add_vertex:
      assert(step.id + 1 == solid.vertex_capacity());
      return solid.pop_vertex();
    case Kind::add_edge:
      assert(step.id + 1 == solid.edge_capacity());
      return solid.pop_edge();
    case Kind::add_face:
      assert(step.id + 1 == solid.face_capacity());
      return solid.pop_face();
    case Kind::add_cell:
      assert(step.id + 1 == solid.cell_capacity());
      return solid.pop_cell();
    case Kind::remove_vertex:
      return solid.set_live(VertexId{step.id}, true);
    case Kind::remove_edge:
      return solid.set_live(EdgeId{step.id}, true);
    case Kind::remove_face:
      return solid.set_live(FaceId{step.id}, true);
    case Kind::remove_cell:
      return solid.set_live(CellId{step.id}, true);
    case Kind::edge_sharpness:
      return assign_sharpness(solid, EdgeId{step.id}, step.before);
    case Kind::vertex_sharpness:
      return assign_sharpness(solid, VertexId{step.id}, step.before);
    case Kind::face_sharpness:
      return assign_sharpness(solid, FaceId{step.id}, step.before);
  }
}

void Transaction::redo_step(Solid& solid, const Delta::Step& step, std::span<const std::uint32_t> payload) {
  using Kind = Delta::Kind;
  const auto ids = [&](auto id, std::size_t begin, std::size_t end) {
    std::vector<decltype(id)> result;
    for (std::size_t i = begin; i < end; ++i) result.emplace_back(payload[i]);
    return result;
  };
  [[maybe_unused]] std::uint32_t given = step.id;
  switch (step.kind) {
    case Kind::add_vertex:
      given = solid.push_vertex().value;
      break;
    case Kind::add_edge:
      given = solid.push_edge(VertexId{payload[0]}, VertexId{payload[1]}).value;
      break;
    case Kind::add_face: {
      const std::size_t n = payload.size() / 2;
      given = solid.push_face(ids(VertexId{}, 0, n), ids(EdgeId{}, n, 2 * n)).value;
      break;
    }
    case Kind::add_cell:
      given = solid.push_cell(ids(FaceUseId{}, 0, payload.size())).value;
      break;
    case Kind::remove_vertex:
      solid.set_live(VertexId{step.id}, false);
      break;
    case Kind::remove_edge:
      solid.set_live(EdgeId{step.id}, false);
      break;
    case Kind::remove_face:
      solid.set_live(FaceId{step.id}, false);
      break;
    case Kind::remove_cell:
      solid.set_live(CellId{step.id}, false);
      break;
    case Kind::edge_sharpness:
      assign_sharpness(solid, EdgeId{step.id}, step.after);
      break;
    case Kind::vertex_sharpness:
      assign_sharpness(solid, VertexId{step.id}, step.after);
      break;
    case Kind::face_sharpness:
      assign_sharpness(solid, FaceId{step.id}, step.after);
      break;
  }
  assert(given == step.id);
}

void Transaction::undo(Solid& solid, const Delta& delta) {
  for (auto step = delta.steps_.rbegin(); step != delta.steps_.rend(); ++step) undo_step(solid, *step);
}

void Transaction::redo(Solid& solid, const Delta& delta) {
  for (const Delta::Step& step : delta.steps_)
    redo_step(solid, step,
              std::span(delta.payload_).subspan(step.payload_begin, step.payload_end - step.payload_begin));
}

}  // namespace argil::subdiv
