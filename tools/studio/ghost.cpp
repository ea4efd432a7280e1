#include "tools/studio/ghost.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <set>

#include "sculpt/session.h"
#include "subdiv/error.h"
#include "subdiv/query/surface_tree.h"
#include "subdiv/radial_edge.h"

namespace argil::studio {

namespace {

constexpr double k_lines = 0.7;          // of the work: running them; the rest is to see what has changed
constexpr std::size_t k_between = 1024;  // places, two words of progress

Eigen::Vector3d middle_of(const sculpt::SceneSurface& surface, std::size_t face) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const std::size_t size = surface.offsets[face + 1] - surface.offsets[face];
  for (std::size_t c = surface.offsets[face]; c < surface.offsets[face + 1]; ++c)
    sum += surface.positions[surface.corners[c]].cast<double>();
  return sum / static_cast<double>(size);
}

// How far places are from a surface.
class Distances {
 public:
  explicit Distances(const sculpt::SceneSurface& surface) : triangles_(triangles_of(surface)) {
    for (const Eigen::Vector3f& p : surface.positions) there_.insert(key(p));
    if (!triangles_.corners.empty()) tree_.emplace(triangles_.points, triangles_.corners);
  }

  /// 0 … 1: how much it counts, from nothing on the surface to all at `whole` from it.
  float share(const Eigen::Vector3f& place, double whole) const {
    if (there_.contains(key(place))) return 0;  // most of a surface stays to the bit
    if (!tree_) return 1;
    const Eigen::Vector3d p = place.cast<double>();
    const double s = std::min(1.0, (tree_->nearest(p) - p).norm() / whole);
    return s < 0.02 ? 0.0F : static_cast<float>(s * s * (3 - 2 * s));
  }

 private:
  struct Triangles {
    Eigen::Matrix3Xd points;
    std::vector<std::array<std::uint32_t, 3>> corners;
  };
  static Triangles triangles_of(const sculpt::SceneSurface& surface) {
    Triangles result;
    result.points.resize(3, static_cast<Eigen::Index>(surface.positions.size() + surface.offsets.size() - 1));
    for (std::size_t v = 0; v < surface.positions.size(); ++v)
      result.points.col(static_cast<Eigen::Index>(v)) = surface.positions[v].cast<double>();
    for (std::size_t f = 0; f + 1 < surface.offsets.size(); ++f) {
      const auto middle = static_cast<std::uint32_t>(surface.positions.size() + f);
      result.points.col(middle) = middle_of(surface, f);
      const std::size_t first = surface.offsets[f], size = surface.offsets[f + 1] - first;
      for (std::size_t i = 0; i < size; ++i)
        result.corners.push_back({surface.corners[first + i], surface.corners[first + (i + 1) % size], middle});
    }
    return result;
  }
  static std::array<std::uint32_t, 3> key(const Eigen::Vector3f& p) {
    return {std::bit_cast<std::uint32_t>(p.x()), std::bit_cast<std::uint32_t>(p.y()),
            std::bit_cast<std::uint32_t>(p.z())};
  }

  Triangles triangles_;
  std::set<std::array<std::uint32_t, 3>> there_;
  std::optional<subdiv::SurfaceTree> tree_;
};

// A cell beside a finer one is made anew with more faces, but keeps its corners: to a sculptor it is the same.
bool goes_on(const subdiv::Solid& before, subdiv::CellId cell, const subdiv::Solid& after) {
  using namespace subdiv;
  const auto sorted = [](std::vector<VertexId> vertices) {
    std::sort(vertices.begin(), vertices.end());
    return vertices;
  };
  const auto corners = sorted(cell_vertices(before, cell));
  if (!after.is_live(corners.front())) return false;
  const auto around = vertex_cells(after, corners.front());
  return std::any_of(around.begin(), around.end(), [&](CellId c) {
    const auto others = sorted(cell_vertices(after, c));
    return !before.is_live(c) && std::includes(others.begin(), others.end(), corners.begin(), corners.end());
  });
}

// Numbers are never given twice, so that what has its number still is what it was.
void count_elements(const subdiv::Solid& before, const subdiv::Solid& after, Ghost& ghost) {
  using namespace subdiv;
  const auto shows = [](const Solid& solid, FaceId f) { return solid.is_live(f) && solid.is_boundary(f); };
  std::size_t anew = 0;
  for (const CellId c : before.cells()) {
    if (after.is_live(c)) continue;
    ++(goes_on(before, c, after) ? anew : ghost.cells_removed);
  }
  for (const CellId c : after.cells()) ghost.cells_made += before.is_live(c) ? 0 : 1;
  ghost.cells_made -= std::min(anew, ghost.cells_made);
  for (const FaceId f : before.faces()) ghost.faces_removed += shows(before, f) && !shows(after, f) ? 1 : 0;
  for (const FaceId f : after.faces()) ghost.faces_made += shows(after, f) && !shows(before, f) ? 1 : 0;
}

std::vector<float> shares_from(const Distances& distances, const sculpt::SceneSurface& surface, double whole,
                               const Progress& progress) {
  std::vector<float> shares;
  shares.reserve(surface.positions.size());
  for (const Eigen::Vector3f& p : surface.positions) {
    if (shares.size() % k_between == 0)
      progress.at(static_cast<double>(shares.size()) / static_cast<double>(surface.positions.size()));
    shares.push_back(distances.share(p, whole));
  }
  return shares;
}

// What is new fades in with its distance from the surface that is there.
void take_new_faces(const sculpt::SceneSurface& surface, const std::vector<float>& share, Ghost& ghost) {
  for (std::size_t f = 0; f + 1 < surface.offsets.size(); ++f) {
    const std::size_t first = surface.offsets[f], size = surface.offsets[f + 1] - first;
    float sum = 0;
    for (std::size_t i = 0; i < size; ++i) sum += share[surface.corners[first + i]];
    if (size < 3 || !(sum > 0)) continue;
    const Eigen::Vector3f middle = middle_of(surface, f).cast<float>();
    for (std::size_t i = 0; i < size; ++i) {
      const std::uint32_t a = surface.corners[first + i], b = surface.corners[first + (i + 1) % size];
      ghost.corners.insert(ghost.corners.end(), {surface.positions[a], surface.positions[b], middle});
      ghost.shares.insert(ghost.shares.end(), {share[a], share[b], sum / static_cast<float>(size)});
    }
  }
  for (const auto& ends : surface.wire)
    if (share[ends[0]] > 0.05F && share[ends[1]] > 0.05F)
      ghost.wire.push_back({surface.positions[ends[0]], surface.positions[ends[1]]});
}

}  // namespace

sculpt::State detached(const sculpt::State& state) {
  sculpt::State copy = state;
  copy.solid = std::make_shared<subdiv::Solid>(*state.solid);
  copy.rest = std::make_shared<Eigen::Matrix3Xd>(*state.rest);
  copy.motion = std::make_shared<fem::BodyState>(*state.motion);
  copy.fields = std::make_shared<sculpt::Fields>(*state.fields);
  return copy;
}

Ghost make_ghost(const GhostSubject& subject, const std::vector<std::string>& lines,
                 const Progress::Listener& progress) {
  Ghost ghost;
  ghost.lines = lines;
  ghost.layout = subject.layout;
  const sculpt::SceneSurface& surface = subject.scene->surface;
  const Progress whole_work(progress, "preview");
  try {
    sculpt::SessionOptions alone;
    alone.out = subject.out;
    alone.limits = subject.limits;
    alone.write_journal = false;
    double share = 0;
    alone.progress = [&](double of_line, const std::string& what) {
      share = std::max(share, k_lines * of_line);
      progress(share, what.c_str());
    };
    sculpt::Session session(alone);
    session.document().assign(detached(subject.state));  // edits change the solid in place
    for (const std::string& line : lines) {
      const auto effect = sculpt::find_command(io::parse_session_line(line, "input", 1)).effect;
      if (effect != sculpt::Effect::state)
        throw Error(ErrorCode::bad_input, "only what changes the document can be shown before it is done");
      session.run_line(line);
    }
    share = k_lines;
    whole_work.at(k_lines);
    count_elements(*subject.state.solid, session.document().solid(), ghost);
    sculpt::PictureRequest plain = subject.request;
    plain.field.clear();
    plain.cage = plain.marks = false;
    Eigen::Vector3f low = Eigen::Vector3f::Constant(HUGE_VALF), high = -low;
    for (const Eigen::Vector3f& p : surface.positions) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    // A hundredth of the solid is a change that is seen as one.
    const double whole = std::max(1e-30, 0.01 * static_cast<double>((high - low).norm()));
    const sculpt::SceneSurface result = sculpt::make_scene(session.document(), plain).surface;
    take_new_faces(result, shares_from(Distances(surface), result, whole, whole_work.part(0.8, 0.9)), ghost);
    ghost.gone = shares_from(Distances(result), surface, whole, whole_work.part(0.9, 1));
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    ghost.fault = error.what();
  }
  return ghost;
}

}  // namespace argil::studio
