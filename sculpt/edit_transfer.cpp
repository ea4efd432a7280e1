#include "sculpt/edit_transfer.h"

#include <algorithm>

#include "sculpt/field_transfer.h"
#include "subdiv/sort_unique.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

template <class IdType>
void keep_live(const Solid& solid, std::vector<std::uint32_t>& ids) {
  std::erase_if(ids, [&](std::uint32_t id) { return !solid.is_live(IdType{id}); });
}

bool contains(const std::vector<std::uint32_t>& sorted, std::uint32_t id) {
  return std::binary_search(sorted.begin(), sorted.end(), id);
}

// Descent may lead over an element that the same edit made, so members are asked of what was added as well.
template <class IdType>
void add_descent(const std::vector<Descent<IdType>>& descent, const std::vector<std::uint32_t>& members,
                 std::vector<std::uint32_t>& result) {
  for (const auto& [made, source] : descent)
    if (contains(members, source.value) || std::find(result.begin() + static_cast<std::ptrdiff_t>(members.size()),
                                                     result.end(), source.value) != result.end())
      result.push_back(made.value);
}

}  // namespace

EditTransfer::EditTransfer(const Solid& solid, const Edit& edit, const std::vector<std::uint32_t>* node_map)
    : solid_(&solid), edit_(&edit), node_map_(node_map) {}

std::vector<std::uint32_t> EditTransfer::follow(ElementType type, const std::vector<std::uint32_t>& ids) const {
  if (ids.empty()) return {};
  std::vector<std::uint32_t> result = ids;
  switch (type) {
    case ElementType::vertices:
      add_descent(edit_->merged, ids, result);
      for (const PlacedVertex& placed : edit_->placed)
        if (placed.sources.size() > 1 &&
            std::all_of(placed.sources.begin(), placed.sources.end(),
                        [&](const auto& source) { return contains(ids, source.first.value); }))
          result.push_back(placed.vertex.value);
      keep_live<VertexId>(*solid_, result);
      break;
    case ElementType::edges:
      add_descent(edit_->edges, ids, result);
      keep_live<EdgeId>(*solid_, result);
      break;
    case ElementType::faces:
      add_descent(edit_->faces, ids, result);
      keep_live<FaceId>(*solid_, result);
      break;
    case ElementType::cells:
      add_descent(edit_->cells, ids, result);
      keep_live<CellId>(*solid_, result);
      break;
    case ElementType::nodes:
      if (!node_map_) return follow(ElementType::vertices, ids);
      result.clear();
      for (const std::uint32_t id : ids)
        if (id < node_map_->size() && (*node_map_)[id] != k_no_node) result.push_back((*node_map_)[id]);
      break;
  }
  subdiv::sort_unique(result);
  return result;
}

Selection EditTransfer::follow(const Selection& selection) const {
  return {selection.type, follow(selection.type, selection.ids)};
}

std::shared_ptr<const std::map<std::string, Selection>> EditTransfer::follow(
    const std::map<std::string, Selection>& sets) const {
  auto result = std::make_shared<std::map<std::string, Selection>>();
  for (const auto& [name, set] : sets) (*result)[name] = follow(set);
  return result;
}

std::shared_ptr<const Pins> EditTransfer::follow(const Pins& pins) const {
  auto result = std::make_shared<Pins>();
  result->control_points = follow(ElementType::vertices, pins.control_points);
  for (const SoftPin& pin : pins.nodes) {
    // A soft pin stays with its own node: several that came of it would hold the body several times.
    SoftPin there = pin;
    if (node_map_)
      there.node = pin.node < node_map_->size() ? (*node_map_)[pin.node] : k_no_node;
    else if (!solid_->is_live(VertexId{pin.node}))
      there.node = k_no_node;
    if (there.node != k_no_node) result->nodes.push_back(there);
  }
  std::sort(result->nodes.begin(), result->nodes.end(),
            [](const SoftPin& a, const SoftPin& b) { return a.node < b.node; });
  for (PinMotion motion : pins.motions) {
    motion.members = follow(motion.members);
    result->motions.push_back(std::move(motion));
  }
  return result;
}

std::shared_ptr<const AppliedLoads> EditTransfer::follow(const AppliedLoads& loads, int& lost) const {
  auto result = std::make_shared<AppliedLoads>();
  result->gravity = loads.gravity;
  result->gravity_track = loads.gravity_track;
  for (const AppliedForce& force : loads.forces) {
    AppliedForce there = force;
    there.faces = follow(ElementType::faces, force.faces);
    std::erase_if(there.faces, [&](std::uint32_t f) { return !solid_->is_boundary(FaceId{f}); });
    there.cells = follow(ElementType::cells, force.cells);
    if (there.at_point() && !force.at_point())
      ++lost;
    else
      result->forces.push_back(std::move(there));
  }
  for (const AppliedPressure& pressure : loads.pressures) {
    AppliedPressure there = pressure;
    there.faces = follow(ElementType::faces, pressure.faces);
    std::erase_if(there.faces, [&](std::uint32_t f) { return !solid_->is_boundary(FaceId{f}); });
    if (there.faces.empty())
      ++lost;
    else
      result->pressures.push_back(std::move(there));
  }
  result->prestress_track = loads.prestress_track;
  return result;
}

}  // namespace argil::sculpt
