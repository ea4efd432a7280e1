#include "subdiv/edit/sharpen.h"

#include <fmt/format.h>

#include "subdiv/error.h"

namespace argil::subdiv {

namespace {

std::string name(const Solid& solid, EdgeId e) {
  const auto& ends = solid.edge_vertices(e);
  return fmt::format("edge {} (vertices {}-{})", e.value, ends[0].value, ends[1].value);
}
std::string name(const Solid&, VertexId v) {
  return fmt::format("vertex {}", v.value);
}

template <class IdType>
void sharpen_all(Transaction& transaction, std::span<const IdType> ids, double sharpness, const char* kind) {
  const Solid& solid = transaction.solid();
  if (sharpness != 0 && sharpness != k_infinitely_sharp)
    throw Error(
        ErrorCode::unsupported,
        fmt::format("expected sharpness 0 (smooth) or {} (sharp), found {}; values between are not supported",
                    k_infinitely_sharp, sharpness));
  for (const IdType id : ids) {
    const std::string place = fmt::format("{} {}", kind, id.value);
    if (!solid.is_live(id)) throw Error(ErrorCode::not_found, fmt::format("there is no {}", place), place);
    if (sharpness != 0 && !solid.is_boundary(id))
      throw Error(
          ErrorCode::unsupported,
          fmt::format("{} is inside the solid, and only the boundary can be sharp; leave it out", name(solid, id)),
          place);
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

}  // namespace argil::subdiv
