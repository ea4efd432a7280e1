#include "subdiv/edit/sharpen.h"

#include <fmt/format.h>

#include "subdiv/edit/rewrite.h"
#include "subdiv/error.h"
#include "subdiv/skin.h"

namespace argil::subdiv {

namespace {

std::string refusal(const Solid& solid, EdgeId e) {
  if (Skin(solid).face_count(e, Phase::parent) > 0) return {};
  const auto& ends = solid.edge_vertices(e);
  return fmt::format(
      "edge {} (vertices {}-{}) is inside the solid and on no sharp sheet; leave it out, or sharpen faces there "
      "first",
      e.value, ends[0].value, ends[1].value);
}
std::string refusal(const Solid& solid, VertexId v) {
  if (Skin(solid).edge_count(v, Phase::parent) > 0) return {};
  return fmt::format(
      "vertex {} is inside the solid and on no sharp sheet; leave it out, or sharpen faces there first", v.value);
}
std::string refusal(const Solid& solid, FaceId f) {
  if (!solid.is_boundary(f)) return {};
  return fmt::format(
      "face {} is on the boundary, and only faces inside the solid can be sharp; add `and not boundary` to the "
      "condition, or sharpen the edges of the face",
      f.value);
}

template <class IdType>
void sharpen_all(Transaction& transaction, std::span<const IdType> ids, double sharpness, const char* kind) {
  const Solid& solid = transaction.solid();
  if (!(sharpness >= 0 && sharpness <= k_infinitely_sharp))
    throw Error(ErrorCode::bad_input, fmt::format("expected a sharpness from 0 (smooth) to {} (for ever), found {}",
                                                  k_infinitely_sharp, sharpness));
  for (const IdType id : ids) {
    const std::string place = fmt::format("{} {}", kind, id.value);
    if (!solid.is_live(id)) throw Error(ErrorCode::not_found, fmt::format("there is no {}", place), place);
    if (sharpness == 0) continue;
    if (const std::string fault = refusal(solid, id); !fault.empty())
      throw Error(ErrorCode::unsupported, fault, place);
  }
  for (const IdType id : ids) transaction.set_sharpness(id, sharpness);
}

}  // namespace

void sharpen(Transaction& transaction, std::span<const EdgeId> edges, double sharpness) {
  sharpen_all(transaction, edges, sharpness, "edge");
}

void sharpen(Transaction& transaction, std::span<const VertexId> vertices, double sharpness) {
  sharpen_all(transaction, vertices, sharpness, "vertex");
}

void sharpen(Transaction& transaction, std::span<const FaceId> faces, double sharpness) {
  sharpen_all(transaction, faces, sharpness, "face");
  if (sharpness != 0) return;
  std::vector<VertexId> vertices;
  for (const FaceId f : faces) {
    const auto loop = transaction.solid().face_vertices(f);
    vertices.insert(vertices.end(), loop.begin(), loop.end());
  }
  drop_interior_sharpness(transaction, vertices);
}

}  // namespace argil::subdiv
