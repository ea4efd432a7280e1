#include <fmt/format.h>

#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/force_tools/tool_table.h"
#include "sculpt/session.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

void set_tool(Session& session, const Arguments& arguments) {
  require_solid(session);
  if (arguments.has("value") && arguments.has("scale"))
    throw Error(ErrorCode::bad_input, "a tool paints a value or by a factor; leave out `value` or `scale`");
  State next = session.document().state();
  Tool& tool = next.tool;
  tool.name = arguments.word("tool");
  tool.radius = arguments.number("radius", tool.radius);
  tool.strength = arguments.number("strength", tool.strength);
  tool.largest_force = arguments.number("limit", tool.largest_force);
  tool.falloff = arguments.word("falloff", tool.falloff);
  if (arguments.has("symmetry")) {
    const std::string& axis = arguments.word("symmetry");
    tool.symmetry = axis == "none" ? '\0' : axis.front();
  }
  for (const char* amount : {"value", "scale"})
    if (arguments.has(amount)) {
      tool.amount = arguments.number(amount);
      tool.scales = std::string_view(amount) == "scale";
    }
  session.change(std::move(next));
}

}  // namespace

std::vector<Command> tool_commands() {
  std::vector<std::string> tools;
  std::string tool_help;
  for (const ToolKind& kind : tool_table()) {
    tools.emplace_back(kind.name);
    tool_help += (tool_help.empty() ? "" : " ") + fmt::format("{}: {}.", kind.name, kind.summary);
  }
  return {
      {.name = "tool",
       .summary = "Chooses the tool that strokes use, and its brush.",
       .parameters =
           {{.name = "tool",
             .type = ArgumentType::word,
             .help = tool_help,
             .positional = true,
             .required = true,
             .choices = tools},
            {.name = "radius", .help = "of what it touches", .unit = "m", .low = 1e-9, .high = 1e9},
            {.name = "strength",
             .help = "of all its springs together; times the radius it is the size of a force",
             .unit = "N/m",
             .low = 1e-9,
             .high = 1e12},
            {.name = "limit",
             .help = "largest force; of tools that push in more than one direction, summed over the points "
                     "that they touch",
             .unit = "N",
             .low = 1e-12,
             .high = 1e12},
            {.name = "falloff",
             .type = ArgumentType::word,
             .help = "towards the rim",
             .choices = {"smooth", "linear", "constant"}},
            {.name = "symmetry",
             .type = ArgumentType::word,
             .help = "the tool's mirror image acts as well, mirrored along this axis in the middle of the "
                     "rest shape",
             .choices = {"x", "y", "z", "none"}},
            {.name = "value", .help = "of paint tools: what to reach, in the unit of the field"},
            {.name = "scale", .help = "of paint tools: the factor to multiply by", .low = 1e-9, .high = 1e9}},
       .example = "tool pull radius 0.15 strength 40",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1"},
       .run = set_tool},
  };
}

}  // namespace argil::sculpt
