#include "tools/studio/edit_tools.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/studio/snapshot.h"

namespace argil::studio {

namespace {

using enum sculpt::ElementType;

std::string vector_words(const Eigen::Vector3d& v) {
  return fmt::format("{} {} {}", v.x(), v.y(), v.z());
}

/// A line that is the same whatever the amount.
template <const char* const& Text>
std::string plain(double, const Aim&) {
  return Text;
}

constexpr const char *k_merge = "merge", *k_fill = "fill", *k_collapse = "collapse", *k_remove = "remove",
                     *k_pin = "pin", *k_unpin = "pin off";

std::string extrude(double amount, const Aim&) {
  return fmt::format("extrude {}", amount);
}
std::string peak(double amount, const Aim&) {
  return fmt::format("peak {}", amount);
}
std::string move(double, const Aim& aim) {
  return "move " + vector_words(aim.way);
}
std::string bridge(double amount, const Aim&) {
  return fmt::format("bridge steps {:.0f}", amount);
}
std::string weld(double amount, const Aim&) {
  return amount > 0 ? fmt::format("weld tolerance {}", amount) : "weld";
}
std::string split(double amount, const Aim&) {
  return fmt::format("split times {:.0f}", amount);
}
std::string cut_ring(double amount, const Aim&) {
  return fmt::format("cut ring fraction {}", amount / 100);
}
std::string cut_plane(double amount, const Aim& aim) {
  return fmt::format("cut plane {} at {}", vector_words(aim.across),
                     vector_words(aim.middle + amount * aim.across));
}
std::string sharpen(double amount, const Aim&) {
  return fmt::format("sharpen {}", amount);
}
std::string smooth(double amount, const Aim&) {
  return fmt::format("smooth times {:.0f}", amount);
}
std::string scale(double amount, const Aim& aim) {
  return fmt::format("transform scale {} about {}", amount / 100, vector_words(aim.middle));
}
std::string turn(double amount, const Aim& aim) {
  return fmt::format("transform rotate {} axis {} about {}", amount, vector_words(aim.normal),
                     vector_words(aim.middle));
}
std::string duplicate(double, const Aim& aim) {
  return "duplicate by " + vector_words(aim.way);
}
std::string mirror(double, const Aim& aim) {
  return fmt::format("mirror normal {} at {} keep", vector_words(aim.across), vector_words(aim.middle));
}

const std::vector<EditTool>& table() {
  static const std::vector<EditTool> tools{
      {Action::edit_extrude, {faces}, icons::cube, &extrude, Amount::distance, "Distance", "m", -1e9, 1e9, 0},
      {Action::edit_peak, {faces}, icons::expand, &peak, Amount::distance, "Height", "m", 1e-9, 1e9, 0},
      {Action::edit_move, {vertices, edges, faces, cells}, icons::grab, &move, Amount::way},
      {Action::edit_scale,
       {faces, edges, vertices, cells},
       icons::expand,
       &scale,
       Amount::share,
       "Size",
       "%",
       1,
       400,
       100},
      {Action::edit_turn,
       {faces, edges, vertices, cells},
       icons::twist,
       &turn,
       Amount::share,
       "Turn",
       "degrees",
       -180,
       180,
       0},
      {Action::edit_split, {cells}, icons::grid, &split, Amount::count, "Times", "times", 1, 4, 1},
      {Action::edit_cut_ring, {edges}, icons::scissors, &cut_ring, Amount::share, "Place", "%", 0.1, 99.9, 50},
      {Action::edit_cut_plane, {cells}, icons::scissors, &cut_plane, Amount::distance, "Offset", "m", -1e9, 1e9, 0},
      {Action::edit_remove, {cells}, icons::cross, &plain<k_remove>},
      {Action::edit_merge, {faces}, icons::link, &plain<k_merge>},
      {Action::edit_bridge, {faces}, icons::link, &bridge, Amount::count, "Steps", "cells", 1, 50, 1},
      {Action::edit_fill, {faces}, icons::cubes, &plain<k_fill>},
      {Action::edit_weld,
       {vertices, faces, edges, cells},
       icons::link,
       &weld,
       Amount::distance,
       "Tolerance",
       "m",
       0,
       1e9,
       0},
      {Action::edit_collapse, {edges, faces, cells}, icons::pinch, &plain<k_collapse>},
      {Action::edit_sharpen,
       {edges, vertices, faces},
       icons::bolt,
       &sharpen,
       Amount::share,
       "Sharpness",
       "levels",
       0,
       10,
       10},
      {Action::edit_smooth,
       {vertices, edges, faces, cells},
       icons::drop,
       &smooth,
       Amount::count,
       "Times",
       "times",
       1,
       100,
       1},
      {Action::edit_duplicate, {cells}, icons::cubes, &duplicate, Amount::way},
      {Action::edit_mirror, {cells}, icons::cubes, &mirror},
      {.action = Action::edit_pin,
       .types = {vertices, edges, faces, cells},
       .icon = icons::pin,
       .line = &plain<k_pin>,
       .at_once = true},
      {.action = Action::edit_unpin,
       .types = {vertices, edges, faces, cells},
       .icon = icons::pin,
       .line = &plain<k_unpin>,
       .at_once = true},
  };
  return tools;
}

}  // namespace

std::span<const EditTool> edit_tools() {
  return table();
}

const EditTool* edit_tool(Action action) {
  const auto found =
      std::find_if(table().begin(), table().end(), [&](const EditTool& tool) { return tool.action == action; });
  return found == table().end() ? nullptr : &*found;
}

bool acts_on(const EditTool& tool, sculpt::ElementType type) {
  return std::find(tool.types.begin(), tool.types.end(), type) != tool.types.end();
}

std::vector<std::string> PendingEdit::lines() const {
  if (tool == nullptr) return {};
  std::vector<std::string> all;
  if (!choice.empty()) all.push_back(choice);
  all.push_back(tool->line(amount, aim));
  return all;
}

std::string counts_of(const Ghost& ghost) {
  std::string words;
  const auto add = [&](char sign, std::size_t count, const char* one, const char* many) {
    if (count > 0)
      words += fmt::format("{}{}{} {}", words.empty() ? "" : "  ", sign == '+' ? "+" : "−", count,
                           count == 1 ? one : many);
  };
  add('+', ghost.cells_made, "cell", "cells");
  add('-', ghost.cells_removed, "cell", "cells");
  add('+', ghost.faces_made, "face", "faces");
  add('-', ghost.faces_removed, "face", "faces");
  return words.empty() ? "the same cells" : words;
}

}  // namespace argil::studio
