#pragma once
// Do the faces of a cell close to one sphere? One answer for cells from a file, from an edit and in `validate`.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace argil::subdiv {

/// Faces of one cell, each counter-clockwise from outside; face i is corners [offsets[i], offsets[i+1]).
struct CellLoops {
  std::vector<std::uint32_t> corners;
  std::vector<std::size_t> offsets{0};

  std::size_t face_count() const { return offsets.size() - 1; }
  std::span<const std::uint32_t> loop(std::size_t i) const {
    return {corners.data() + offsets[i], offsets[i + 1] - offsets[i]};
  }
  void clear() {
    corners.clear();
    offsets.assign(1, 0);
  }
  /// Ends the face whose corners were appended.
  void end_face() { offsets.push_back(corners.size()); }
};

/// Why the loops are not one sphere (a face with fewer than 3 vertices or one twice, an open edge, faces that
/// disagree in orientation, more than two faces at an edge, a vertex where the surface is pinched, several pieces,
/// handles); empty if they are one. Names vertices by their numbers. Cost O(corners log corners).
[[nodiscard]] std::string sphere_fault(const CellLoops& loops);

}  // namespace argil::subdiv
