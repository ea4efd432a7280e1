#pragma once
// The groups that the command table is made of, one source file each.

#include <vector>

#include "sculpt/command.h"

namespace argil::sculpt {

std::vector<Command> shape_commands();       // new open extrude peak remove move sharpen levels space
std::vector<Command> selection_commands();   // select
std::vector<Command> material_commands();    // set paint model
std::vector<Command> simulation_commands();  // pin gravity force integrator step solve commit
std::vector<Command> tool_commands();        // tool stroke
std::vector<Command> history_commands();     // undo redo
std::vector<Command> output_commands();      // measure expect save render

}  // namespace argil::sculpt
