// Of keys.h: the table of actions, the gestures, and the keys of other programs.

#include "tools/studio/keys.h"

namespace argil::studio {

const std::array<ActionInfo, k_action_count>& action_table() {
  using enum Action;
  static const std::array<ActionInfo, k_action_count> table{{
      {new_block, "new_block", "New block", "Begins with a solid block, its foot held, ready to pull", "File",
       "Ctrl-N"},
      {open, "open", "Open…", "Opens a session (.argil) or a volume mesh", "File", "Ctrl-O"},
      {save, "save", "Save", "Saves all that was done as a session, which `argil replay` repeats to the bit",
       "File", "Ctrl-S"},
      {save_as, "save_as", "Save as…", "Saves the session under another name", "File", "Ctrl-Shift-S"},
      {screenshot, "screenshot", "Picture of the view",
       "Writes what the viewport shows as a PNG beside the journal", "File", "F12"},
      {film, "film", "Film of the session", "Makes a film of all that was simulated, beside the journal", "File",
       ""},
      {turntable, "turntable", "Turntable", "Makes a film of the solid as it turns, beside the journal", "File",
       ""},
      {quit, "quit", "Quit", "Leaves; the journal keeps what was done", "File", "Ctrl-Q"},
      {samples, "samples", "Samples…", "Shows the samples with their pictures; one opens as a new session", "File",
       "Ctrl-Shift-O"},
      {unsaved_work, "unsaved_work", "Unsaved work…", "Brings back what earlier windows left unsaved", "File", ""},
      {devices, "devices", "Devices…", "Chooses what to sculpt with: gamepad, 3D mouse, a force device by UDP",
       "Tool", "Ctrl-D"},
      {undo, "undo", "Undo", "Takes back the last stroke or command", "Edit", "Ctrl-Z"},
      {redo, "redo", "Redo", "Brings back what undo took", "Edit", "Ctrl-Shift-Z"},
      {search, "search", "Search commands…", "Finds any command by name or meaning and runs it", "Help", "F3"},
      {sheet_of_keys, "sheet_of_keys", "Keys", "Shows every key and gesture", "Help", "F1"},
      {cancel, "cancel", "Cancel", "Takes back the stroke under way, or closes what is open", "Edit", "Esc"},
      {forces_off, "forces_off", "All force off", "Lets go: ends the stroke, clears forces and gravity, pauses",
       "Physics", "Shift-Esc"},
      {play, "play", "Play", "Lets time run, or stops it", "Physics", "Space"},
      {one_step, "one_step", "One step", "Takes one step of the simulation", "Physics", "."},
      {to_rest, "to_rest", "Settle", "Finds where the solid comes to rest under its loads", "Physics",
       "Shift-Space"},
      {tool_1, "tool_1", "Tool 1 of the shelf", "Takes the first tool of the shelf", "Tool", "1"},
      {tool_2, "tool_2", "Tool 2 of the shelf", "Takes the second tool of the shelf", "Tool", "2"},
      {tool_3, "tool_3", "Tool 3 of the shelf", "Takes the third tool of the shelf", "Tool", "3"},
      {tool_4, "tool_4", "Tool 4 of the shelf", "Takes the fourth tool of the shelf", "Tool", "4"},
      {tool_5, "tool_5", "Tool 5 of the shelf", "Takes the fifth tool of the shelf", "Tool", "5"},
      {tool_6, "tool_6", "Tool 6 of the shelf", "Takes the sixth tool of the shelf", "Tool", "6"},
      {tool_7, "tool_7", "Tool 7 of the shelf", "Takes the seventh tool of the shelf", "Tool", "7"},
      {tool_8, "tool_8", "Tool 8 of the shelf", "Takes the eighth tool of the shelf", "Tool", "8"},
      {tool_9, "tool_9", "Tool 9 of the shelf", "Takes the ninth tool of the shelf", "Tool", "9"},
      {brush_radius, "brush_radius", "Size the brush", "Move the pointer, then click or let go of the key", "Tool",
       "F"},
      {brush_strength, "brush_strength", "Set the strength", "Move the pointer, then click or let go of the key",
       "Tool", "Shift-F"},
      {brush_smaller, "brush_smaller", "Smaller brush", "Makes the brush smaller by a tenth", "Tool", "["},
      {brush_larger, "brush_larger", "Larger brush", "Makes the brush larger by a tenth", "Tool", "]"},
      {symmetry, "symmetry", "Symmetry", "Works on both sides of the middle, along x; its plane shows", "Tool",
       "X"},
      {keep_shape, "keep_shape", "Keep the shape", "After a stroke the new shape is the shape at rest", "Tool",
       "K"},
      {cut_away, "cut_away", "Cut away", "Shows the inside; the wheel moves the plane", "View", "C"},
      {wireframe, "wireframe", "Wires of cells", "Shows the edges of the cells", "View", "W"},
      {cage, "cage", "Control cage", "Shows the control solid around its surface", "View", "G"},
      {next_field, "next_field", "Next field", "Colours the solid by the next field, or shows clay", "View", "V"},
      {frame_all, "frame_all", "Frame the solid", "Shows all of the solid", "View", "Home"},
      {from_front, "from_front", "From the front", "Looks along y", "View", "Numpad 1"},
      {from_side, "from_side", "From the side", "Looks along x", "View", "Numpad 3"},
      {from_top, "from_top", "From the top", "Looks down", "View", "Numpad 7"},
      {finer, "finer", "Finer", "Refines the solid once more", "Solid", "Ctrl-PageUp"},
      {coarser, "coarser", "Coarser", "Refines the solid once less", "Solid", "Ctrl-PageDown"},
      {panels, "panels", "Panels", "Shows or hides the panels", "View", "N"},
      {theme, "theme", "Light theme", "Changes between the dark and the light theme", "View", "Ctrl-L"},
      {first_minute, "first_minute", "First minute", "Shows the card of the first gestures", "Help", "Shift-F1"},
      {confirm, "confirm", "Do it", "Does what the ghost shows, or finishes the curve", "Edit", "Enter"},
      {erase, "erase", "Take the last point", "Takes the last point of the curve that is laid", "Edit",
       "Backspace"},
      {select_next_type, "select_next_type", "Select mode",
       "Goes on to selecting faces, edges, vertices, cells, and back to sculpting", "Select", "Tab"},
      {select_all, "select_all", "All", "Selects every one", "Select", "A"},
      {select_none, "select_none", "None", "Selects nothing", "Select", "Alt-A"},
      {select_inverse, "select_inverse", "Invert", "Selects all the others", "Select", "Ctrl-I"},
      {select_grow, "select_grow", "Grow", "Goes on to what touches the selection", "Select", "Ctrl-="},
      {select_shrink, "select_shrink", "Shrink", "Leaves out what touches the rest", "Select", "Ctrl--"},
      {select_component, "select_component", "Whole piece", "Goes on to the whole pieces that it touches", "Select",
       "L"},
      {select_loop, "select_loop", "Loop", "Goes on along edges, as a double click does", "Select", "Alt-L"},
      {select_ring, "select_ring", "Ring", "Goes on across faces, as a double click with Shift does", "Select",
       "Shift-L"},
      {select_name, "select_name", "Keep as a set…", "Keeps the selection under a name", "Select", "Ctrl-G"},
      {edit_extrude, "edit_extrude", "Extrude", "Draws the selected faces out; move the pointer, then click",
       "Solid", "E"},
      {edit_peak, "edit_peak", "Peak", "Raises a pyramid over each selected face", "Solid", "Alt-E"},
      {edit_move, "edit_move", "Move", "Moves what is selected along the view", "Solid", "T"},
      {edit_scale, "edit_scale", "Scale", "Makes what is selected larger or smaller about its middle", "Solid",
       "Alt-S"},
      {edit_turn, "edit_turn", "Turn", "Turns what is selected about its normal", "Solid", "R"},
      {edit_split, "edit_split", "Split", "Subdivides the selected cells where they are", "Solid", "S"},
      {edit_cut_ring, "edit_cut_ring", "Cut a ring", "Cuts the boxes beside the selected edges into two layers",
       "Solid", "Ctrl-R"},
      {edit_cut_plane, "edit_cut_plane", "Cut by a plane", "Cuts the selected cells by a plane across the view",
       "Solid", "Shift-C"},
      {edit_remove, "edit_remove", "Remove", "Removes the selected cells", "Solid", "Del"},
      {edit_merge, "edit_merge", "Merge", "Glues two selected faces, or regions of the same shape", "Solid", "M"},
      {edit_bridge, "edit_bridge", "Bridge", "Grows cells between two selected faces or regions", "Solid", "B"},
      {edit_fill, "edit_fill", "Fill", "Puts a cell into the opening between the selected faces", "Solid", "Alt-F"},
      {edit_weld, "edit_weld", "Weld", "Makes boundary vertices one that lie together", "Solid", "Shift-M"},
      {edit_collapse, "edit_collapse", "Collapse", "Shrinks each selected edge, face or cell to a point", "Solid",
       "Alt-M"},
      {edit_sharpen, "edit_sharpen", "Sharpen", "Makes selected edges creases and vertices corners; 0 smooths",
       "Solid", "Shift-E"},
      {edit_smooth, "edit_smooth", "Smooth", "Takes the bumps out of what is selected", "Solid", "Shift-S"},
      {edit_duplicate, "edit_duplicate", "Duplicate", "Copies the selected cells; move the pointer, then click",
       "Solid", "Shift-D"},
      {edit_mirror, "edit_mirror", "Mirror", "Grows the mirror image of the selected cells, across the view",
       "Solid", "Ctrl-M"},
      {edit_pin, "edit_pin", "Pin", "Holds what is selected where it is", "Physics", "H"},
      {edit_unpin, "edit_unpin", "Let go", "Releases what is selected", "Physics", "Alt-H"},
      {mask_clear, "mask_clear", "Clear the mask", "Takes the mask away everywhere", "Tool", "Alt-K"},
      {mask_invert, "mask_invert", "Invert the mask", "Masks what was not, and frees what was", "Tool", "Ctrl-K"},
      {mask_selected, "mask_selected", "Mask selection", "Protects the selection from all tools", "Tool",
       "Shift-K"},
      {mask_unselected, "mask_unselected", "Mask all else", "Protects all that is not selected", "Tool",
       "Ctrl-Shift-K"},
      {peel, "peel", "Peel", "Takes layers of cells away from the boundary; the wheel peels deeper", "View", "P"},
      {set_key, "set_key", "Set a key…", "Keys gravity, a force, a pin or an obstacle as it is at this time",
       "Physics", "I"},
  }};
  return table;
}

const ActionInfo& info(Action action) {
  return action_table()[static_cast<std::size_t>(action)];
}

const std::vector<Gesture>& gestures() {
  static const std::vector<Gesture> all{
      {"Drag on clay", "works with the tool"},
      {"Click while selecting", "selects the face, edge, vertex or cell; with Ctrl adds it or takes it away"},
      {"Drag while selecting", "selects what the box holds; with Shift also what lies behind"},
      {"Double click an edge", "selects its loop; with Shift its ring. Of the others the whole piece"},
      {"Right click", "shows what can be done with what is selected"},
      {"Drag beside it", "orbits"},
      {"Middle drag", "orbits"},
      {"Shift-middle drag", "pans"},
      {"Wheel", "zooms; moves the cut, and a tool in depth"},
      {"Ctrl held", "inverts the tool"},
      {"Shift held", "smooths; on a number, drags finely"},
      {"Double click a number", "resets it"},
      {"Drag a key of the timeline", "moves it; right click or Del on it removes it"},
  };
  return all;
}

const std::vector<KeyPreset>& key_presets() {
  static const std::vector<KeyPreset> all{
      {"Argil's keys", "Those that Argil comes with; they are Blender's where it has one", ""},
      {"ZBrush's keys", "Sizes, intensity, framing and subdivision as in ZBrush",
       "brush_radius = S\n"
       "brush_strength = U\n"
       "frame_all = F\n"
       "wireframe = Shift-F\n"
       "edit_split =\n"
       "edit_duplicate =\n"
       "devices =\n"
       "finer = Ctrl-D\n"
       "coarser = Shift-D\n"},
  };
  return all;
}

}  // namespace argil::studio
