#include "subdiv/skin.h"

#include <algorithm>
#include <vector>

#include "subdiv/sort_unique.h"

namespace argil::subdiv {

namespace {

// The skin about a vertex: its edges, how they are sharp, and into how many pieces that share no edge its faces
// fall.
struct SkinStar {
  std::size_t edge_count = 0, sharp_count = 0, rim_count = 0, branch_count = 0, piece_count = 0;
};

SkinStar skin_star(const Solid& solid, const Skin& skin, VertexId v, Phase phase) {
  SkinStar star;
  std::vector<std::pair<FaceId, EdgeId>> sides;  // faces of the skin at v, with each of their two edges at v
  solid.for_each_edge(v, [&](EdgeId e) {
    std::size_t count = 0;
    solid.for_each_face(e, [&](FaceId f) {
      if (!skin.holds(f, phase)) return;
      ++count;
      sides.push_back({f, e});
    });
    if (count == 0) return;
    ++star.edge_count;
    if (count == 1) ++star.rim_count;
    if (count > 2) ++star.branch_count;
    if (count != 2 || is_sharp(skin.sharpness(e), phase)) ++star.sharp_count;
  });

  std::vector<std::size_t> piece(sides.size());
  for (std::size_t i = 0; i < sides.size(); ++i) piece[i] = i;
  bool changed = true;
  while (changed) {
    changed = false;
    for (std::size_t i = 0; i < sides.size(); ++i)
      for (std::size_t j = 0; j < sides.size(); ++j)
        if ((sides[i].first == sides[j].first || sides[i].second == sides[j].second) && piece[j] < piece[i]) {
          piece[i] = piece[j];
          changed = true;
        }
  }
  for (std::size_t i = 0; i < sides.size(); ++i) star.piece_count += piece[i] == i ? 1 : 0;
  return star;
}

// Calls visit(sharpness) for what may end at an edge.
template <class Visit>
void for_each_sharpness(const Solid& solid, const Skin& skin, EdgeId e, const Visit& visit) {
  visit(skin.sharpness(e));
  solid.for_each_face(e, [&](FaceId f) {
    if (!solid.is_boundary(f)) visit(solid.face_sharpness(f));
  });
}

template <class Visit>
void for_each_sharpness(const Solid& solid, const Skin& skin, VertexId v, const Visit& visit) {
  visit(skin.sharpness(v));
  std::vector<FaceId> faces;
  solid.for_each_edge(v, [&](EdgeId e) {
    visit(skin.sharpness(e));
    solid.for_each_face(e, [&](FaceId f) {
      if (solid.face_sharpness(f) > 0 && !solid.is_boundary(f)) faces.push_back(f);
    });
  });
  sort_unique(faces);
  for (const FaceId f : faces) visit(solid.face_sharpness(f));
}

template <class IdType>
double weight_of_parent(const Solid& solid, const Skin& skin, IdType id) {
  double sum = 0, count = 0;
  for_each_sharpness(solid, skin, id, [&](double sharpness) {
    if (!is_ending(sharpness)) return;
    sum += sharpness;
    count += 1;
  });
  return count == 0 ? 1 : sum / count;
}

}  // namespace

double Skin::sharpness(EdgeId e) const {
  const double own = solid_->edge_sharpness(e);
  if (own == 0) return 0;
  double skin = 0;
  solid_->for_each_face(e, [&](FaceId f) { skin = std::max(skin, sharpness(f)); });
  return std::min(own, skin);
}

double Skin::sharpness(VertexId v) const {
  const double own = solid_->vertex_sharpness(v);
  if (own == 0) return 0;
  double skin = 0;
  solid_->for_each_edge(
      v, [&](EdgeId e) { solid_->for_each_face(e, [&](FaceId f) { skin = std::max(skin, sharpness(f)); }); });
  return std::min(own, skin);
}

std::size_t Skin::face_count(EdgeId e, Phase phase) const {
  std::size_t count = 0;
  solid_->for_each_face(e, [&](FaceId f) { count += holds(f, phase) ? 1 : 0; });
  return count;
}

std::size_t Skin::edge_count(VertexId v, Phase phase) const {
  std::size_t count = 0;
  solid_->for_each_edge(v, [&](EdgeId e) { count += face_count(e, phase) > 0 ? 1 : 0; });
  return count;
}

EdgeRule Skin::rule(EdgeId e, Phase phase) const {
  const std::size_t count = face_count(e, phase);
  if (count == 0) return EdgeRule::interior;
  return count != 2 || is_sharp(sharpness(e), phase) ? EdgeRule::crease : EdgeRule::smooth;
}

VertexRule Skin::rule(VertexId v, Phase phase) const {
  const SkinStar star = skin_star(*solid_, *this, v, phase);
  if (star.edge_count == 0) return VertexRule::interior;
  if (is_sharp(sharpness(v), phase) || star.piece_count > 1) return VertexRule::corner;
  if (star.rim_count + star.branch_count > 0)
    return star.sharp_count == 2 && (star.rim_count == 2 || star.branch_count == 2) ? VertexRule::crease
                                                                                    : VertexRule::corner;
  if (star.sharp_count > 2) return VertexRule::corner;
  return star.sharp_count == 2 ? VertexRule::crease : VertexRule::smooth;
}

double Skin::parent_weight(EdgeId e) const {
  return weight_of_parent(*solid_, *this, e);
}

double Skin::parent_weight(VertexId v) const {
  return weight_of_parent(*solid_, *this, v);
}

bool Skin::is_semi_sharp_at(VertexId v) const {
  bool found = false;
  for_each_sharpness(*solid_, *this, v, [&](double sharpness) { found = found || is_semi_sharp(sharpness); });
  return found;
}

}  // namespace argil::subdiv
