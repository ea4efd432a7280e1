#pragma once
// The tools of the window that edit what is selected, as data: what they act on, the amount that a hand gives them,
// and the line of the session that they are. Menus, the panel, the context menu and keys follow this one table.

#include <span>
#include <string>
#include <vector>

#include "sculpt/document.h"
#include "tools/studio/keys.h"
#include "tools/studio/ui.h"

namespace argil::studio {

/// Where a tool is aimed: given by what is selected and how it is looked at.
struct Aim {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::UnitZ();  // of what is selected
  Eigen::Vector3d across = Eigen::Vector3d::UnitX();  // the axis that lies most across the view
  Eigen::Vector3d way = Eigen::Vector3d::Zero();      // that the pointer went, in the plane of the view [m]
  sculpt::ElementType type = sculpt::ElementType::faces;
};

/// What the pointer gives.
enum class Amount { none, distance, share, count, way };

struct EditTool {
  Action action;
  std::vector<sculpt::ElementType> types;  // that it acts on; the first is what it is for
  Icon icon;
  std::string (*line)(double amount, const Aim& aim);
  Amount amount = Amount::none;
  const char* amount_name = "";
  const char* unit = "";
  double low = 0, high = 1, initial = 0;
  bool at_once = false;  // there is nothing to see of it before
};
[[nodiscard]] std::span<const EditTool> edit_tools();
/// Null for an action that is none of them.
[[nodiscard]] const EditTool* edit_tool(Action action);
[[nodiscard]] bool acts_on(const EditTool& tool, sculpt::ElementType type);

/// A tool that has been taken, shown as a ghost and not yet done.
struct PendingEdit {
  const EditTool* tool = nullptr;  // null: none
  double amount = 0;
  Aim aim;
  std::string choice;    // a line that chooses what it acts on; empty: what is selected
  bool follows = false;  // the pointer gives the amount
  double from_x = 0, from_y = 0, from_amount = 0;
  std::size_t journal_lines = 0;  // when it was last asked for: what is done since calls for another ghost

  [[nodiscard]] std::vector<std::string> lines() const;
};

/// "+3 cells  −1 face", as far as there are any.
struct Ghost;
[[nodiscard]] std::string counts_of(const Ghost& ghost);

}  // namespace argil::studio
