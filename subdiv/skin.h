#pragma once
// The skin of a solid: its boundary faces, and the sharp faces inside it, which make sheets. Points of the skin
// follow the rules of a surface, from the skin alone: smooth; along a crease; or fixed. An edge where other than
// two faces of the skin meet (sheets that cross, a sheet on the boundary, the free rim of a sheet) is a crease.
//
// Sharpness falls by one a level, and infinite sharpness stays (OpenSubdiv's uniform creasing). Where something is
// sharp on this level and not on the next, a point is a blend of the rule as the parent has it and as its child
// will; the parent's weight is the mean sharpness of what ends, as OpenSubdiv has it. Faces of sheets count in it
// like edges and vertices (taken so; there is no model for it).

#include "subdiv/solid.h"

namespace argil::subdiv {

enum class Phase { parent, child };

/// Whether something of this sharpness is sharp in a phase.
[[nodiscard]] constexpr bool is_sharp(double sharpness, Phase phase) {
  return sharpness > (phase == Phase::parent ? 0.0 : 1.0);
}
/// Sharp on this level and not on the next.
[[nodiscard]] constexpr bool is_ending(double sharpness) {
  return sharpness > 0 && sharpness <= 1;
}
[[nodiscard]] constexpr bool is_semi_sharp(double sharpness) {
  return sharpness > 0 && sharpness < k_infinitely_sharp;
}
[[nodiscard]] constexpr double child_sharpness(double sharpness) {
  return sharpness >= k_infinitely_sharp ? sharpness : (sharpness > 1 ? sharpness - 1 : 0);
}

enum class EdgeRule { interior, smooth, crease };
enum class VertexRule { interior, smooth, crease, corner };

/// Looks only; the solid must outlive it. Every question costs O(valence).
class Skin {
 public:
  explicit Skin(const Solid& solid) : solid_(&solid) {}

  /// Infinite on the boundary.
  double sharpness(FaceId f) const {
    return solid_->is_boundary(f) ? k_infinitely_sharp : solid_->face_sharpness(f);
  }
  /// Inside the solid an edge or vertex is at most as sharp as the sharpest face of a sheet there.
  double sharpness(EdgeId e) const;
  double sharpness(VertexId v) const;

  bool holds(FaceId f, Phase phase) const {
    return solid_->is_boundary(f) || is_sharp(solid_->face_sharpness(f), phase);
  }
  std::size_t face_count(EdgeId e, Phase phase) const;
  std::size_t edge_count(VertexId v, Phase phase) const;

  EdgeRule rule(EdgeId e, Phase phase) const;
  /// A vertex is a corner if it is sharp, if the skin there falls into pieces that share no edge, or if more than
  /// two edges are creases; also where a crease of other than two faces ends, for no rule of one sheet suits the
  /// others.
  VertexRule rule(VertexId v, Phase phase) const;

  /// The weight of the parent's rule, the rest is the child's: 1 where nothing ends.
  double parent_weight(EdgeId e) const;
  double parent_weight(VertexId v) const;
  /// Whether v, an edge or a face at it is neither smooth nor infinitely sharp.
  bool is_semi_sharp_at(VertexId v) const;

 private:
  const Solid* solid_;
};

}  // namespace argil::subdiv
