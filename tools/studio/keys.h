#pragma once
// What the keyboard does, as data: every action with its name, what it is for and its key. The sheet under F1, the
// menus and the tooltips are made from this table, and a sculptor's own keys are read over it.

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace argil::studio {

/// Keys as GLFW numbers them: letters, digits and signs by their character, the others from 256 on.
namespace key {
inline constexpr int space = 32, escape = 256, enter = 257, tab = 258, backspace = 259, insert = 260, del = 261,
                     right = 262, left = 263, down = 264, up = 265, page_up = 266, page_down = 267, home = 268,
                     end = 269, f1 = 290, pad_0 = 320, pad_enter = 335, left_shift = 340, left_control = 341,
                     left_alt = 342, right_shift = 344, right_control = 345, right_alt = 346;
}

struct Chord {
  int key = 0;  // 0: none
  bool control = false, shift = false, alt = false;
  bool operator==(const Chord&) const = default;
};
/// "Ctrl-Shift-Z", "F3", "Numpad 1", "[". @throws Error (bad_input) naming what is not a key.
[[nodiscard]] Chord parse_chord(std::string_view text);
[[nodiscard]] std::string word(const Chord& chord);

enum class Action {
  new_block,
  open,
  save,
  save_as,
  screenshot,
  film,
  turntable,
  quit,
  samples,
  unsaved_work,
  devices,
  undo,
  redo,
  search,
  sheet_of_keys,
  cancel,
  forces_off,
  play,
  one_step,
  to_rest,
  tool_1,
  tool_2,
  tool_3,
  tool_4,
  tool_5,
  tool_6,
  tool_7,
  tool_8,
  tool_9,
  brush_radius,
  brush_strength,
  brush_smaller,
  brush_larger,
  symmetry,
  keep_shape,
  cut_away,
  wireframe,
  cage,
  next_field,
  frame_all,
  from_front,
  from_side,
  from_top,
  finer,
  coarser,
  panels,
  theme,
  first_minute,
  confirm,
  erase,
  select_next_type,
  select_all,
  select_none,
  select_inverse,
  select_grow,
  select_shrink,
  select_component,
  select_loop,
  select_ring,
  select_name,
  edit_extrude,
  edit_peak,
  edit_move,
  edit_scale,
  edit_turn,
  edit_split,
  edit_cut_ring,
  edit_cut_plane,
  edit_remove,
  edit_merge,
  edit_bridge,
  edit_fill,
  edit_weld,
  edit_collapse,
  edit_sharpen,
  edit_smooth,
  edit_duplicate,
  edit_mirror,
  edit_pin,
  edit_unpin,
  mask_clear,
  mask_invert,
  mask_selected,
  mask_unselected,
  peel,
  set_key
};
inline constexpr std::size_t k_action_count = static_cast<std::size_t>(Action::set_key) + 1;

struct ActionInfo {
  Action action;
  const char* word;   // in a file of keys
  const char* label;  // in menus
  const char* help;
  const char* menu;  // of the menu that has it
  const char* keys;  // by default; "" none
};
/// In the order of Action.
[[nodiscard]] const std::array<ActionInfo, k_action_count>& action_table();
[[nodiscard]] const ActionInfo& info(Action action);

/// What the mouse does, and keys while they are held: for the sheet, and taken when other keys are bound.
struct Gesture {
  const char* gesture;
  const char* help;
};
[[nodiscard]] const std::vector<Gesture>& gestures();

/// Keys as another program has them, as lines that are read over the table's.
struct KeyPreset {
  const char *name, *help, *lines;
};
[[nodiscard]] const std::vector<KeyPreset>& key_presets();

class Bindings {
 public:
  /// Those of the table.
  Bindings();
  /// Takes lines `action = key`, # beginning a comment; `action =` takes the key away.
  /// @throws Error (bad_input) with the line, also where two actions would have one key; nothing is changed then.
  void read(std::string_view text, const std::string& file_name);

  [[nodiscard]] Chord key_of(Action action) const { return chords_[static_cast<std::size_t>(action)]; }
  [[nodiscard]] std::string word_of(Action action) const { return word(key_of(action)); }
  [[nodiscard]] std::optional<Action> action_of(const Chord& chord) const;
  /// Gives the action this key, none if its key is 0. Who had it loses it, and is returned.
  std::optional<Action> bind(Action action, const Chord& chord);
  /// The lines that `read` needs to make these of the table's.
  [[nodiscard]] std::string changes() const;
  /// Two actions with one key, if there are such.
  [[nodiscard]] std::optional<std::array<Action, 2>> collision() const;

 private:
  std::array<Chord, k_action_count> chords_;
};

}  // namespace argil::studio
