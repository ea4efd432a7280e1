#include "subdiv/edit/bridge.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "subdiv/edit/extrude.h"
#include "subdiv/edit/new_cells.h"
#include "subdiv/edit/regions.h"
#include "subdiv/error.h"
#include "subdiv/radial_edge.h"

namespace argil::subdiv {

namespace {

using Loop = std::vector<VertexId>;

Eigen::Matrix3d rotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix();
}

// How a frame turns that leaves along `out`, travels along `way` and arrives along `in`.
Eigen::Matrix3d carried(const Eigen::Vector3d& out, const Eigen::Vector3d& way, const Eigen::Vector3d& in) {
  if (!(out.norm() > 0) || !(in.norm() > 0)) return Eigen::Matrix3d::Identity();
  const bool ahead = out.normalized().dot(in.normalized()) > 0.5;
  if (ahead || !(way.norm() > 0)) return rotation(out, in);
  return rotation(way, in) * rotation(out, way);
}

// The length of a Hermite curve's end tangents that makes it close to an arc of a circle over a chord of 1.
double arc_tangent(const Eigen::Vector3d& out, const Eigen::Vector3d& in) {
  const double angle = std::acos(std::clamp(out.dot(in), -1.0, 1.0));
  return angle < 1e-6 ? 1.0 : 2 * std::tan(angle / 4) / std::sin(angle / 2);
}

class Bridger {
 public:
  Bridger(Transaction& transaction, const Eigen::Matrix3Xd& positions, std::span<const FaceId> first,
          std::span<const FaceId> second, const BridgeOptions& options)
      : t_(transaction), positions_(positions), options_(options) {
    const Solid& solid = t_.solid();
    out_ = area_vector(solid, positions, first);
    in_ = -area_vector(solid, positions, second);
    const Eigen::Vector3d way = middle(solid, positions, second) - middle(solid, positions, first);
    match_ = match_regions(solid, positions, first, second, carried(out_, way, in_));
    if (options.twist != 0) twist();
    if (options.arc) {
      if (!(out_.norm() > 0) || !(in_.norm() > 0))
        throw Error(ErrorCode::bad_geometry, "a region has no mean normal to leave along; leave out arc");
      out_.normalize();
      in_.normalize();
    }
  }

  Edit run() {
    lay_rings();
    Rewrite change;
    for (const auto& [face, other] : match_.faces) {
      change.glued.insert(change.glued.end(), {face, other});
      const Loop loop = use_vertices(t_.solid(), t_.solid().boundary_use(face));
      for (int step = 1; step <= options_.steps; ++step) change.added.push_back({cell(loop, step), {}});
    }
    // The trails' sharpness is read while what becomes interior still has its own.
    std::vector<double> sharpness;
    for (const auto& [a, b] : match_.vertices)
      sharpness.push_back(std::min(trail_sharpness(t_.solid(), a), trail_sharpness(t_.solid(), b)));
    check_new_cells(t_.solid(), change);
    const std::size_t before = t_.solid().cell_capacity();
    rewrite(t_, change, edit_);
    for (std::size_t i = 0; i < match_.vertices.size(); ++i) {
      const auto& column = rings_.at(match_.vertices[i].first);
      for (std::size_t step = 0; step + 1 < column.size(); ++step)
        if (const auto e = t_.solid().find_edge(column[step], column[step + 1]);
            column[step] != column[step + 1] && e && t_.solid().is_boundary(*e))
          t_.set_sharpness(*e, std::max(sharpness[i], t_.solid().edge_sharpness(*e)));
    }
    for (std::size_t c = before; c < t_.solid().cell_capacity(); ++c) edit_.next_cells.emplace_back(c);
    return std::move(edit_);
  }

 private:
  void twist() {
    if (match_.faces.size() != 1)
      throw Error(ErrorCode::bad_input,
                  fmt::format("expected single faces to twist between, found regions of {}; leave out twist",
                              match_.faces.size()));
    for (const auto& [a, b] : match_.vertices)
      if (a == b)
        throw Error(
            ErrorCode::bad_input,
            fmt::format("the faces share vertex {}, which fixes how they correspond; leave out twist", a.value));
    const Loop there = use_vertices(t_.solid(), t_.solid().boundary_use(match_.faces[0].second));
    const auto n = static_cast<long>(there.size());
    for (auto& [a, b] : match_.vertices) {
      const long place = std::find(there.begin(), there.end(), b) - there.begin();
      b = there[static_cast<std::size_t>(((place + options_.twist) % n + n) % n)];
    }
  }

  void lay_rings() {
    for (const auto& [a, b] : match_.vertices) {
      auto& column = rings_[a];
      column.push_back(a);
      for (int step = 1; step < options_.steps; ++step) column.push_back(a == b ? a : between(a, b, step));
      column.push_back(b);
    }
  }

  VertexId between(VertexId a, VertexId b, int step) {
    const double s = static_cast<double>(step) / options_.steps;
    PlacedVertex placed{t_.add_vertex(), {{a, 1 - s}, {b, s}}};
    if (options_.arc) {
      const Eigen::Vector3d chord = positions_.col(static_cast<Eigen::Index>(b.index())) -
                                    positions_.col(static_cast<Eigen::Index>(a.index()));
      const double length = chord.norm() * arc_tangent(out_, in_);
      const double blend = s * s * (3 - 2 * s) - s;  // Hermite's weight of b, less the linear one
      placed.offset = blend * chord + s * (1 - s) * (1 - s) * length * out_ - s * s * (1 - s) * length * in_;
    }
    edit_.placed.push_back(placed);
    return placed.vertex;
  }

  std::vector<Loop> cell(const Loop& loop, int step) const {
    const auto at = [&](VertexId v, int ring) { return rings_.at(v)[static_cast<std::size_t>(ring)]; };
    std::vector<Loop> loops(2);
    for (const VertexId v : loop) loops[1].push_back(at(v, step));
    for (auto v = loop.rbegin(); v != loop.rend(); ++v) loops[0].push_back(at(*v, step - 1));
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const VertexId a = loop[i], b = loop[(i + 1) % loop.size()];
      Loop wall{at(a, step - 1), at(b, step - 1), at(b, step), at(a, step)};
      wall.erase(std::unique(wall.begin(), wall.end()), wall.end());
      if (wall.front() == wall.back()) wall.pop_back();
      if (wall.size() >= 3) loops.push_back(std::move(wall));
    }
    return loops;
  }

  Transaction& t_;
  const Eigen::Matrix3Xd& positions_;
  const BridgeOptions& options_;
  Eigen::Vector3d out_, in_;  // the way's directions at its ends
  RegionMatch match_;
  std::map<VertexId, std::vector<VertexId>> rings_;  // by the first region's vertex, from it to its match
  Edit edit_;
};

}  // namespace

Edit bridge(Transaction& transaction, const Eigen::Matrix3Xd& positions, std::span<const FaceId> first,
            std::span<const FaceId> second, const BridgeOptions& options) {
  if (options.steps < 1)
    throw Error(ErrorCode::bad_input, fmt::format("expected at least 1 step, found {}", options.steps));
  std::vector<FaceId> both(first.begin(), first.end());
  both.insert(both.end(), second.begin(), second.end());
  check_boundary_faces(transaction.solid(), both, "bridge");
  return Bridger(transaction, positions, first, second, options).run();
}

}  // namespace argil::subdiv
