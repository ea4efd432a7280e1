#pragma once
// What `measure` and `expect` can ask of a document: one table of names with units.

#include <optional>
#include <string>
#include <vector>

#include "sculpt/document.h"
#include "sculpt/shown_fields.h"
#include "sculpt/where.h"

namespace argil::sculpt {

struct MeasureInfo {
  std::string name{}, unit{}, help{};
  bool at_point = false;    // wants `at X Y Z`, a material point by its rest position
  bool over_nodes = false;  // may be narrowed by `where` on nodes
  bool against_reference = false;
};
/// In order of name.
[[nodiscard]] const std::vector<MeasureInfo>& measure_table();

struct MeasureQuery {
  std::string name{};
  std::optional<Eigen::Vector3d> at = std::nullopt;
  const Expression* where = nullptr;
  const ReferenceShape* reference = nullptr;
  double tool_force = 0;  // [N], of the session's last stroke: the document does not know it
};
/// @throws Error (not_found) for another name; (bad_input) for a missing or superfluous point or condition.
[[nodiscard]] double measure(const Document& document, const MeasureQuery& query);

}  // namespace argil::sculpt
