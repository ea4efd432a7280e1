#include "subdiv/edit/extrude.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>

#include "subdiv/error.h"
#include "subdiv/radial_edge.h"
#include "subdiv/sort_unique.h"

namespace argil::subdiv {

namespace {

std::string where(FaceId f) {
  return fmt::format("face {}", f.value);
}

// A wall has one side for each direction in which faces of the region run along its edge.
void check_walls(const Solid& solid, std::span<const FaceId> faces) {
  std::vector<std::pair<EdgeId, bool>> sides;
  for (const FaceId f : faces) {
    const auto loop = solid.face_vertices(f);
    const auto edges = solid.face_edges(f);
    for (std::size_t i = 0; i < loop.size(); ++i)
      sides.emplace_back(edges[i], (solid.edge_vertices(edges[i])[0] == loop[i]) != is_back(solid.boundary_use(f)));
  }
  std::sort(sides.begin(), sides.end());
  const auto twice = std::adjacent_find(sides.begin(), sides.end());
  if (twice == sides.end()) return;
  const auto& ends = solid.edge_vertices(twice->first);
  throw Error(ErrorCode::bad_topology,
              fmt::format("faces to extrude meet at edge {}-{}, where the boundary touches itself, and their walls "
                          "would overlap; extrude them one after the other",
                          ends[0].value, ends[1].value),
              fmt::format("edge {}", twice->first.value));
}

// Of the sharpest sheet that ends at an edge of the boundary; 0 if none does.
double sheet_sharpness(const Solid& solid, EdgeId e) {
  double sharpness = 0;
  solid.for_each_face(e, [&](FaceId f) {
    if (!solid.is_boundary(f)) sharpness = std::max(sharpness, solid.face_sharpness(f));
  });
  return sharpness;
}

class Extruder {
 public:
  Extruder(Transaction& transaction, std::span<const FaceId> faces) : t_(transaction) {
    for (const FaceId f : faces) {
      const FaceUseId use = t_.solid().boundary_use(f);
      bottoms_.push_back(other_side(use));
      loops_.push_back(use_vertices(t_.solid(), use));
      for (const VertexId v : loops_.back())
        if (source_.emplace(v, trail_sharpness(t_.solid(), v)).second) sources_.push_back(v);
      for (const EdgeId e : t_.solid().face_edges(f)) {
        edges_.push_back(e);
        if (const double sharpness = sheet_sharpness(t_.solid(), e); sharpness > 0) {
          auto ends = t_.solid().edge_vertices(e);
          std::sort(ends.begin(), ends.end());
          sheets_[ends] = sharpness;
        }
      }
    }
    sort_unique(edges_);
    for (const VertexId v : sources_) top_[v] = v;
  }

  Extrusion run(int steps) {
    for (const FaceUseId use : bottoms_) t_.set_sharpness(face_of(use), 0);
    for (int step = 1; step <= steps; ++step) grow(step);
    pass_on_sharpness();
    for (const FaceUseId use : bottoms_) result_.caps.push_back(face_of(use));
    return std::move(result_);
  }

 private:
  void grow(int step) {
    const std::map<VertexId, VertexId> below = top_;
    for (const VertexId v : sources_) {
      top_[v] = t_.add_vertex();
      result_.new_vertices.push_back(top_[v]);
      result_.source_of_new.push_back(v);
      result_.step_of_new.push_back(step);
    }
    for (std::size_t f = 0; f < loops_.size(); ++f) {
      const auto& loop = loops_[f];
      std::vector<VertexId> cap;
      for (const VertexId v : loop) cap.push_back(top_[v]);
      std::vector<FaceUseId> uses{bottoms_[f], t_.add_face(cap)};
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const VertexId a = loop[i], b = loop[(i + 1) % loop.size()];
        uses.push_back(t_.add_face(std::array{below.at(a), below.at(b), top_[b], top_[a]}));
        const auto sheet = sheets_.find({std::min(a, b), std::max(a, b)});
        if (sheet != sheets_.end()) walls_on_sheets_.emplace_back(face_of(uses.back()), sheet->second);
      }
      result_.new_cells.push_back(t_.add_cell(uses));
      bottoms_[f] = other_side(uses[1]);
    }
    for (const VertexId v : sources_) trails_.emplace_back(t_.add_edge(below.at(v), top_[v]), source_.at(v));
  }

  void pass_on_sharpness() {
    const Solid& solid = t_.solid();
    for (const EdgeId e : edges_) {
      const auto ends = solid.edge_vertices(e);
      t_.set_sharpness(t_.add_edge(top_[ends[0]], top_[ends[1]]), solid.edge_sharpness(e));
      if (!solid.is_boundary(e)) t_.set_sharpness(e, 0);
    }
    for (const VertexId v : sources_) {
      t_.set_sharpness(top_[v], solid.vertex_sharpness(v));
      if (!solid.is_boundary(v)) t_.set_sharpness(v, 0);
    }
    for (const auto& [wall, sharpness] : walls_on_sheets_)
      if (!solid.is_boundary(wall)) t_.set_sharpness(wall, sharpness);
    for (const auto& [edge, sharpness] : trails_)
      if (solid.is_boundary(edge)) t_.set_sharpness(edge, sharpness);
  }

  Transaction& t_;
  Extrusion result_;
  std::vector<FaceUseId> bottoms_;            // sides that the next cells will own
  std::vector<std::vector<VertexId>> loops_;  // of the region, from outside
  std::vector<EdgeId> edges_;                 // of the region, ascending
  std::vector<VertexId> sources_;             // vertices of the region, as met
  std::map<VertexId, double> source_;         // and how sharp their trails are
  std::map<VertexId, VertexId> top_;          // the present cap's vertex
  std::vector<std::pair<EdgeId, double>> trails_;
  std::map<std::array<VertexId, 2>, double> sheets_;  // that end at an edge of the region, by its vertices
  std::vector<std::pair<FaceId, double>> walls_on_sheets_;
};

}  // namespace

void check_boundary_faces(const Solid& solid, std::span<const FaceId> faces) {
  if (faces.empty()) throw Error(ErrorCode::bad_input, "expected boundary faces, found none; select some first");
  for (const FaceId f : faces) {
    if (!solid.is_live(f))
      throw Error(ErrorCode::not_found, fmt::format("there is no face {}; select faces again", f.value), where(f));
    if (!solid.is_boundary(f))
      throw Error(
          ErrorCode::bad_topology,
          fmt::format("face {} is not on the boundary, and only boundary faces can grow; leave it out", f.value),
          where(f));
  }
  std::vector<FaceId> sorted(faces.begin(), faces.end());
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end())
    throw Error(ErrorCode::bad_input, fmt::format("face {} is given twice", twice->value), where(*twice));
}

void check_extrusion(const Solid& solid, std::span<const FaceId> faces, int steps) {
  if (steps < 1) throw Error(ErrorCode::bad_input, fmt::format("expected at least 1 step, found {}", steps));
  check_boundary_faces(solid, faces);
  check_walls(solid, faces);
}

double trail_sharpness(const Solid& solid, VertexId v) {
  std::vector<double> sharp;
  solid.for_each_edge(v, [&](EdgeId e) { sharp.push_back(solid.edge_sharpness(e)); });
  std::sort(sharp.begin(), sharp.end(), std::greater<>());
  return std::max(solid.vertex_sharpness(v), sharp.size() < 3 ? 0.0 : sharp[2]);
}

Extrusion extrude(Transaction& transaction, std::span<const FaceId> faces, int steps) {
  check_extrusion(transaction.solid(), faces, steps);
  return Extruder(transaction, faces).run(steps);
}

}  // namespace argil::subdiv
