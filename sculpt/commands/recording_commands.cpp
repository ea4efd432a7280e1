#include <fmt/format.h>

#include <algorithm>

#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/near_names.h"
#include "sculpt/recording.h"
#include "sculpt/session.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

void record(Session& session, const Arguments& arguments) {
  require_solid(session);
  const std::string name = arguments.word("file", "");
  if (arguments.has("stop")) {
    if (arguments.has("every") || arguments.has("fps"))
      throw Error(ErrorCode::bad_input, "what stops has no pace; leave out every and fps");
    std::vector<std::string> names;
    for (const auto& recording : session.recordings()) names.push_back(recording->name());
    if (names.empty() || (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()))
      throw Error(ErrorCode::bad_input,
                  names.empty() ? "nothing is being recorded; `record bounce.pvd` begins"
                                : fmt::format("'{}' is not being recorded{}", name, near_names_hint(name, names)));
    session.end_recordings(name);
    return;
  }
  if (name.empty())
    throw Error(ErrorCode::bad_input, "record wants a file: .pvd, .obj or .glb, as in `record bounce.glb fps 30`");
  if (arguments.has("every") && arguments.has("fps"))
    throw Error(ErrorCode::bad_input, "frames come by steps or by seconds; leave out every or fps");
  const FramePace pace{arguments.integer("every", 1), arguments.number("fps", 0)};
  session.record(std::make_unique<Recording>(session.document(), name, session.path_to_write(name), pace));
}

}  // namespace

std::vector<Command> recording_commands() {
  return {
      {.name = "record",
       .summary =
           "Writes a series while the simulation runs, beneath --out, from now until it is stopped or the "
           "session ends: NAME.pvd volume meshes NAME_0000.vtu … with their times, NAME.obj numbered surfaces "
           "NAME_0000.obj …, NAME.glb one animated surface. What undo takes back is left out again.",
       .parameters = {{.name = "file",
                       .type = ArgumentType::text,
                       .help = "a .pvd, .obj or .glb beneath the folder given with --out",
                       .positional = true},
                      {.name = "every",
                       .type = ArgumentType::integer,
                       .help = "a frame every so many steps; else 1",
                       .low = 1,
                       .high = 1e7},
                      {.name = "fps",
                       .help =
                           "instead: frames a second of simulated time, each the first step that reaches its time",
                       .unit = "1/s",
                       .low = 1e-6,
                       .high = 1e6},
                      {.name = "stop", .help = "end the recording of that file, or all", .flag = true}},
       .example = "record swing.pvd every 2",
       .before = {"new box 4 1 1 size 0.4 0.1 0.1", "levels 1", "pin where x < 0.01", "gravity 0 0 -9.81"},
       .effect = Effect::output,
       .run = record},
  };
}

}  // namespace argil::sculpt
