#pragma once
// Carries what names elements of the solid (selection, named sets, pins, loads) through a topology edit: what lives
// on stays, what continues or is a part of a member joins, what is gone drops out.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sculpt/document.h"
#include "subdiv/edit/edit.h"

namespace argil::sculpt {

class EditTransfer {
 public:
  /// `solid` as the edit left it. `node_map`: new node from old node of the finest level (k_no_node: gone); null on
  /// the control solid, whose nodes are its vertices. All must outlive this.
  EditTransfer(const subdiv::Solid& solid, const subdiv::Edit& edit, const std::vector<std::uint32_t>* node_map);

  // Each costs O(members, log) and O(edit, log).
  [[nodiscard]] Selection follow(const Selection& selection) const;
  [[nodiscard]] std::shared_ptr<const std::map<std::string, Selection>> follow(
      const std::map<std::string, Selection>& sets) const;
  [[nodiscard]] std::shared_ptr<const Pins> follow(const Pins& pins) const;
  /// Adds to `lost` how many forces went with their faces.
  [[nodiscard]] std::shared_ptr<const AppliedLoads> follow(const AppliedLoads& loads, int& lost) const;

 private:
  [[nodiscard]] std::vector<std::uint32_t> follow(ElementType type, const std::vector<std::uint32_t>& ids) const;

  const subdiv::Solid* solid_;
  const subdiv::Edit* edit_;
  const std::vector<std::uint32_t>* node_map_;
};

}  // namespace argil::sculpt
