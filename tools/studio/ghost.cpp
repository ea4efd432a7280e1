#include "tools/studio/ghost.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "sculpt/session.h"
#include "subdiv/error.h"

namespace argil::studio {

namespace {

// Nothing of a copy is shared with the document: edits on the control solid add to its arrays in place.
sculpt::State copy_of(const sculpt::State& state) {
  sculpt::State copy = state;
  copy.solid = std::make_shared<subdiv::Solid>(*state.solid);
  copy.rest = std::make_shared<Eigen::Matrix3Xd>(*state.rest);
  copy.motion = std::make_shared<fem::BodyState>(*state.motion);
  copy.fields = std::make_shared<sculpt::Fields>(*state.fields);
  return copy;
}

// The middles of faces, to be found again where another surface has a face at the same place.
class FacePlaces {
 public:
  FacePlaces(const sculpt::SceneSurface& surface, double grid) : grid_(grid) {
    for (std::size_t f = 0; f + 1 < surface.offsets.size(); ++f) places_.push_back(middle(surface, f));
    for (std::size_t f = 0; f < places_.size(); ++f) at_.emplace(key(cell(places_[f])), f);
  }

  static Eigen::Vector3d middle(const sculpt::SceneSurface& surface, std::size_t face) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const std::size_t size = surface.offsets[face + 1] - surface.offsets[face];
    for (std::size_t c = surface.offsets[face]; c < surface.offsets[face + 1]; ++c)
      sum += surface.positions[surface.corners[c]].cast<double>();
    return sum / static_cast<double>(size);
  }

  bool has(const Eigen::Vector3d& place) const {
    const auto home = cell(place);
    for (long x = -1; x <= 1; ++x)
      for (long y = -1; y <= 1; ++y)
        for (long z = -1; z <= 1; ++z) {
          const auto [first, last] = at_.equal_range(key({home[0] + x, home[1] + y, home[2] + z}));
          for (auto one = first; one != last; ++one)
            if ((places_[one->second] - place).norm() < grid_) return true;
        }
    return false;
  }

  const std::vector<Eigen::Vector3d>& places() const { return places_; }

 private:
  std::array<long, 3> cell(const Eigen::Vector3d& place) const {
    return {std::lround(place.x() / grid_), std::lround(place.y() / grid_), std::lround(place.z() / grid_)};
  }
  static std::uint64_t key(const std::array<long, 3>& cell) {
    std::uint64_t hash = 0;
    for (const long c : cell) hash = hash * 0x9e3779b97f4a7c15U + static_cast<std::uint64_t>(c);
    return hash;
  }

  double grid_;
  std::vector<Eigen::Vector3d> places_;
  std::unordered_multimap<std::uint64_t, std::size_t> at_;
};

// Numbers are never given twice, so that what has its number still is what it was.
void count_elements(const subdiv::Solid& before, const subdiv::Solid& after, Ghost& ghost) {
  using namespace subdiv;
  const auto shows = [](const Solid& solid, FaceId f) { return solid.is_live(f) && solid.is_boundary(f); };
  for (const CellId c : before.cells()) ghost.cells_removed += after.is_live(c) ? 0 : 1;
  for (const CellId c : after.cells()) ghost.cells_made += before.is_live(c) ? 0 : 1;
  for (const FaceId f : before.faces()) ghost.faces_removed += shows(before, f) && !shows(after, f) ? 1 : 0;
  for (const FaceId f : after.faces()) ghost.faces_made += shows(after, f) && !shows(before, f) ? 1 : 0;
}

void take_new_faces(const sculpt::SceneSurface& surface, const FacePlaces& old, Ghost& ghost) {
  std::vector<std::uint8_t> is_new(surface.positions.size(), 0);
  for (std::size_t f = 0; f + 1 < surface.offsets.size(); ++f) {
    const std::size_t first = surface.offsets[f], size = surface.offsets[f + 1] - first;
    const Eigen::Vector3d middle = FacePlaces::middle(surface, f);
    if (size < 3 || old.has(middle)) continue;
    for (std::size_t i = 0; i < size; ++i) {
      const std::uint32_t a = surface.corners[first + i], b = surface.corners[first + (i + 1) % size];
      is_new[a] = 1;
      ghost.corners.insert(ghost.corners.end(), {surface.positions[a], surface.positions[b], middle.cast<float>()});
    }
  }
  for (const auto& ends : surface.wire)
    if (is_new[ends[0]] && is_new[ends[1]])
      ghost.wire.push_back({surface.positions[ends[0]], surface.positions[ends[1]]});
}

}  // namespace

Ghost make_ghost(const sculpt::Document& document, const std::vector<std::string>& lines,
                 const sculpt::PictureRequest& request, const sculpt::SceneSurface& surface,
                 const BenchOptions& options) {
  Ghost ghost;
  ghost.lines = lines;
  try {
    sculpt::SessionOptions alone;
    alone.out = options.out;
    alone.limits = options.limits;
    alone.write_journal = false;
    sculpt::Session session(alone);
    session.document().assign(copy_of(document.state()));
    for (const std::string& line : lines) {
      const auto effect = sculpt::find_command(io::parse_session_line(line, "input", 1)).effect;
      if (effect != sculpt::Effect::state)
        throw Error(ErrorCode::bad_input, "only what changes the document can be shown before it is done");
      session.run_line(line);
    }
    count_elements(document.solid(), session.document().solid(), ghost);
    sculpt::PictureRequest plain = request;
    plain.field.clear();
    plain.cage = plain.marks = false;
    // Faces are the same where they stand within a ten-thousandth of the solid of each other.
    Eigen::Vector3f low = Eigen::Vector3f::Constant(HUGE_VALF), high = -low;
    for (const Eigen::Vector3f& p : surface.positions) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const double grid = std::max(1e-30, 1e-4 * static_cast<double>((high - low).norm()));
    const sculpt::SceneSurface result = sculpt::make_scene(session.document(), plain).surface;
    const FacePlaces old(surface, grid), next(result, grid);
    take_new_faces(result, old, ghost);
    for (std::size_t f = 0; f < old.places().size(); ++f)
      if (!next.has(old.places()[f])) ghost.gone.push_back(static_cast<std::uint32_t>(f));
  } catch (const Error& error) {
    ghost.fault = error.what();
  }
  return ghost;
}

}  // namespace argil::studio
