#pragma once
// The groups that the command table is made of, one source file each.

#include <vector>

#include "sculpt/command.h"

namespace argil::sculpt {

std::vector<Command> base_commands();        // new join solidify
std::vector<Command> file_commands();        // open
std::vector<Command> level_commands();       // levels space rules
std::vector<Command> topology_commands();    // extrude peak remove
std::vector<Command> joining_commands();     // merge weld bridge collapse fill
std::vector<Command> splitting_commands();   // split cut
std::vector<Command> sharpen_commands();     // sharpen
std::vector<Command> transform_commands();   // move transform mirror duplicate
std::vector<Command> smoothing_commands();   // smooth project
std::vector<Command> selection_commands();   // select sets
std::vector<Command> material_commands();    // set paint model
std::vector<Command> mask_commands();        // mask
std::vector<Command> load_commands();        // pin gravity force
std::vector<Command> key_commands();         // key keys
std::vector<Command> simulation_commands();  // integrator guard step solve commit
std::vector<Command> tool_commands();        // tool
std::vector<Command> stroke_commands();      // stroke curve
std::vector<Command> history_commands();     // undo redo
std::vector<Command> output_commands();      // measure expect save
std::vector<Command> recording_commands();   // record
std::vector<Command> render_commands();      // render
std::vector<Command> sampling_commands();    // sample plot
std::vector<Command> obstacle_commands();    // obstacle plasticity
std::vector<Command> panel_commands();       // panels

}  // namespace argil::sculpt
