#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/session.h"

namespace argil::sculpt {

std::vector<Command> joining_commands() {
  return {};
}

}  // namespace argil::sculpt
