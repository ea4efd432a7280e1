#include "subdiv/edit/merge.h"

#include <fmt/format.h>

#include "subdiv/edit/identify.h"
#include "subdiv/edit/regions.h"
#include "subdiv/error.h"

namespace argil::subdiv {

namespace {

CellId owner_of(const Solid& solid, FaceId f) {
  return solid.owner(solid.boundary_use(f));
}

}  // namespace

Edit merge(Transaction& transaction, const Eigen::Matrix3Xd& positions, std::span<const FaceId> first,
           std::span<const FaceId> second, MergeAt at) {
  const Solid& solid = transaction.solid();
  std::vector<FaceId> both(first.begin(), first.end());
  both.insert(both.end(), second.begin(), second.end());
  check_boundary_faces(solid, both, "merge");
  const RegionMatch match = match_regions(solid, positions, first, second);
  for (const auto& [a, b] : match.faces)
    if (owner_of(solid, a) == owner_of(solid, b))
      throw Error(ErrorCode::bad_topology,
                  fmt::format("faces {} and {} are of the same cell {}, which would touch itself; split the cell "
                              "between them first",
                              a.value, b.value, owner_of(solid, a).value),
                  fmt::format("cell {}", owner_of(solid, a).value));

  Edit edit;
  identify(transaction, joined(match.vertices), Flattening::refused, edit);
  for (const auto& [a, b] : match.vertices) {
    if (a == b) continue;
    PlacedVertex placed{std::min(a, b), {}};
    if (at == MergeAt::middle) placed.sources = {{a, 0.5}, {b, 0.5}};
    if (at == MergeAt::first) placed.sources = {{a, 1.0}};
    if (at == MergeAt::second) placed.sources = {{b, 1.0}};
    edit.placed.push_back(std::move(placed));
  }
  return edit;
}

}  // namespace argil::subdiv
