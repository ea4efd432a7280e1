#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>

#include "io/session_text.h"
#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/commands/named_forces.h"
#include "sculpt/commands/track_edits.h"
#include "sculpt/document_loads.h"
#include "sculpt/near_names.h"
#include "sculpt/obstacles.h"
#include "sculpt/region.h"
#include "sculpt/session.h"
#include "subdiv/error.h"

namespace argil::sculpt {

std::string no_such_pressure(const std::vector<AppliedPressure>& pressures, const std::string& name) {
  std::vector<std::string> names;
  for (const AppliedPressure& pressure : pressures)
    if (!pressure.name.empty()) names.push_back(pressure.name);
  return fmt::format("there is no pressure named '{}'{}; name one where it is made: `pressure 500 as {}`", name,
                     near_names_hint(name, names), io::quote(name));
}

std::string no_such_force(const std::vector<AppliedForce>& forces, const std::string& name) {
  std::vector<std::string> names;
  for (const AppliedForce& force : forces)
    if (!force.name.empty()) names.push_back(force.name);
  return fmt::format("there is no force named '{}'{}; name one where it is made: `force 0 0 3 as {}`", name,
                     near_names_hint(name, names), io::quote(name));
}

namespace {

constexpr double k_degree = std::numbers::pi / 180;

void key_pressure(Session& session, const Arguments& arguments, State& next) {
  if (!arguments.has("name"))
    throw Error(ErrorCode::bad_input,
                "which pressure? As in `key pressure bag amount 500 at 1`, of `pressure 0 as bag`");
  const std::string& name = arguments.word("name");
  auto loads = std::make_shared<AppliedLoads>(*next.loads);
  const auto found = std::find_if(loads->pressures.begin(), loads->pressures.end(),
                                  [&](const AppliedPressure& pressure) { return pressure.name == name; });
  if (found == loads->pressures.end()) throw Error(ErrorCode::not_found, no_such_pressure(loads->pressures, name));
  key_number(session, arguments, found->pressure, found->track, fmt::format("the pressure '{}'", name));
  next.loads = loads;
}

// There is no share without keys: to take the last key away leaves the fields with what acts now.
void key_prestress(Session& session, const Arguments& arguments, State& next) {
  refuse(arguments, {"name"}, "prestress is painted, and has no name");
  auto loads = std::make_shared<AppliedLoads>(*next.loads);
  double share = 1;
  key_number(session, arguments, share, loads->prestress_track, "the share of prestress");
  if (loads->prestress_track.empty() && share != 1) {
    auto fields = std::make_shared<Fields>(*next.fields);
    (*fields)[FieldName::prestress] *= share;
    next.fields = fields;
    session.print(fmt::format("the field prestress is {:g} of what it was: what acts now", share));
  }
  if (arguments.has("amount") || arguments.has("course"))
    if ((*next.fields)[FieldName::prestress].isZero(0))
      session.print(
          "no prestress is painted yet: `set prestress 5000`, or the tool paint, says where there is some");
  next.loads = loads;
}

void key_gravity(Session& session, const Arguments& arguments, State& next) {
  refuse(arguments, {"name"}, "gravity has no name");
  auto loads = std::make_shared<AppliedLoads>(*next.loads);
  key_vector(session, arguments, loads->gravity, loads->gravity_track, "gravity");
  next.loads = loads;
}

void key_force(Session& session, const Arguments& arguments, State& next) {
  if (!arguments.has("name"))
    throw Error(ErrorCode::bad_input, "which force? As in `key force push 0 0 3 at 1`, of `force 0 0 0 as push`");
  const std::string& name = arguments.word("name");
  auto loads = std::make_shared<AppliedLoads>(*next.loads);
  const auto found = std::find_if(loads->forces.begin(), loads->forces.end(),
                                  [&](const AppliedForce& force) { return force.name == name; });
  if (found == loads->forces.end()) throw Error(ErrorCode::not_found, no_such_force(loads->forces, name));
  key_vector(session, arguments, found->force, found->track, fmt::format("the force '{}'", name));
  next.loads = loads;
}

void key_obstacle(Session& session, const Arguments& arguments, State& next) {
  if (!arguments.has("name"))
    throw Error(ErrorCode::bad_input, "which obstacle? As in `key obstacle floor move 0 0 0.1 at 2`");
  refuse(arguments, {"value", "amount", "course"}, "an obstacle moves: `move X Y Z`, `rotate ANGLE axis X Y Z`");
  const std::string& name = arguments.word("name");
  const NamedObstacle* known = find_obstacle(next, name);
  if (!known) {
    std::vector<std::string> names;
    if (next.obstacles)
      for (const NamedObstacle& obstacle : *next.obstacles) names.push_back(obstacle.name);
    throw Error(ErrorCode::not_found,
                fmt::format("there is no obstacle named '{}'{}; `obstacle {} plane` makes one", name,
                            near_names_hint(name, names), io::quote(name)));
  }
  NamedObstacle obstacle = *known;
  const double now = next.motion->time;
  const std::string what = fmt::format("the obstacle '{}'", name);
  if (arguments.has("remove")) {
    const fem::Obstacle there = standing_obstacle(obstacle, now);
    remove_keys(obstacle.track, arguments, what);
    if (obstacle.track.empty()) obstacle.body = there;
  } else if (arguments.has("to")) {
    move_key(obstacle.track, arguments, what);
  } else {
    if (!obstacle.track.empty() && arguments.has("about"))
      throw Error(
          ErrorCode::bad_input,
          fmt::format("what {} turns about goes with its first key; `key obstacle {} remove` and begin again", what,
                      io::quote(name)));
    if (obstacle.track.empty()) obstacle.pivot = arguments.vector("about", obstacle.body.position);
    add_keys(obstacle.track, new_keys(arguments, motion_value(arguments), 6, now), now, Eigen::VectorXd::Zero(6),
             what, session);
  }
  auto obstacles = std::make_shared<std::vector<NamedObstacle>>(*next.obstacles);
  for (NamedObstacle& other : *obstacles)
    if (other.name == name) other = obstacle;
  next.obstacles = obstacles;
}

void key(Session& session, const Arguments& arguments) {
  require_solid(session);
  State next = session.document().state();
  const std::string& what = arguments.word("what");
  if (what == "gravity")
    key_gravity(session, arguments, next);
  else if (what == "force")
    key_force(session, arguments, next);
  else if (what == "pressure")
    key_pressure(session, arguments, next);
  else if (what == "prestress")
    key_prestress(session, arguments, next);
  else if (what == "pin")
    key_pin(session, arguments, next);
  else
    key_obstacle(session, arguments, next);
  session.change(std::move(next));
}

void list_track(const Session& session, const std::string& what, const Track& track) {
  session.print(fmt::format("{}, {}:", what, word(track.interpolation)));
  for (std::size_t k = 0; k < track.times.size(); ++k) {
    const Eigen::VectorXd value = track.values.col(static_cast<Eigen::Index>(k));
    std::string text = fmt::format("  {:g} s: ", track.times[k]);
    if (value.size() == 6) {
      const Eigen::Vector3d turn = value.tail<3>();
      text += fmt::format("move {:g} {:g} {:g}", value[0], value[1], value[2]);
      if (turn.norm() > 0)
        text += fmt::format(" rotate {:g} axis {:g} {:g} {:g}", turn.norm() / k_degree, turn.x() / turn.norm(),
                            turn.y() / turn.norm(), turn.z() / turn.norm());
    } else if (value.size() == 1) {
      text += fmt::format("{:g}", value[0]);
    } else {
      text += fmt::format("{:g} {:g} {:g}", value[0], value[1], value[2]);
    }
    session.print(text);
  }
}

void list_keys(Session& session, const Arguments&) {
  require_solid(session);
  const State& state = session.document().state();
  bool any = false;
  const auto list = [&](const std::string& what, const Track& track) {
    if (track.empty()) return;
    any = true;
    list_track(session, what, track);
  };
  list("gravity [m/s^2]", state.loads->gravity_track);
  for (const AppliedForce& force : state.loads->forces)
    list(fmt::format("force {} [N]", io::quote(force.name)), force.track);
  for (const AppliedPressure& pressure : state.loads->pressures)
    list(fmt::format("pressure {} [Pa]", io::quote(pressure.name)), pressure.track);
  list("prestress, the share that acts", state.loads->prestress_track);
  for (const PinMotion& motion : state.pins->motions)
    list(fmt::format("pin {} [m, degrees], {} about {:g} {:g} {:g}", io::quote(motion.name),
                     count_of(motion.members.ids.size(), motion.members.type), motion.pivot.x(), motion.pivot.y(),
                     motion.pivot.z()),
         motion.track);
  if (state.obstacles)
    for (const NamedObstacle& obstacle : *state.obstacles)
      list(fmt::format("obstacle {} [m, degrees], about {:g} {:g} {:g}", io::quote(obstacle.name),
                       obstacle.pivot.x(), obstacle.pivot.y(), obstacle.pivot.z()),
           obstacle.track);
  if (!any) session.print("nothing has keys; `key gravity 0 0 -9.81 at 0.5` makes one");
}

}  // namespace

std::vector<Command> key_commands() {
  const auto vector = [](const char* name, const char* help, const char* unit, double bound) {
    return Parameter{.name = name, .help = help, .unit = unit, .count = 3, .low = -bound, .high = bound};
  };
  Parameter value = vector("value", "of gravity [m/s^2] or a force [N] at that time", "", 1e12);
  value.positional = true;
  return {
      {.name = "key",
       .summary =
           "Says what gravity, a force, a pressure, the share of prestress that acts, a pin or an obstacle is "
           "at a time; in between it goes from key to key, before the "
           "first and after the last it stays. Pins move as one rigid body by the differences of their "
           "keys, from where "
           "they stand, obstacles from where they were put. A first key that lies ahead makes another, of "
           "what is now.",
       .parameters =
           {{.name = "what",
             .type = ArgumentType::word,
             .help = "what is keyed",
             .positional = true,
             .required = true,
             .choices = {"gravity", "force", "pressure", "prestress", "pin", "obstacle"}},
            {.name = "name",
             .type = ArgumentType::text,
             .help = "of the force or pressure (`force … as NAME`), of a set of pinned elements (`select … as "
                     "NAME`), or of the obstacle",
             .positional = true},
            value,
            {.name = "amount",
             .help = "of a pressure [Pa], or the share of the field prestress that acts (1: all) at that time",
             .low = -1e12,
             .high = 1e12},
            {.name = "at",
             .help = "the time; else now. A key that is there already is replaced",
             .unit = "s",
             .low = 0,
             .high = 1e9},
            {.name = "to",
             .help = "moves the key `at` that time to this one, with its value",
             .unit = "s",
             .low = 0,
             .high = 1e9},
            vector("move", "of a pin or obstacle: how far it has come", "m", 1e9),
            {.name = "rotate",
             .help = "of a pin or obstacle: how far it has turned; more than 360 goes round more than once",
             .unit = "degrees",
             .low = -36e5,
             .high = 36e5},
            vector("axis", "of the turn; else 0 0 1", "", 1e9),
            vector("about",
                   "with the first key: the point that it turns about; else the middle of the pins, or where the "
                   "obstacle stands",
                   "m", 1e9),
            {.name = "path",
             .help = "several keys at once: the time of each, and the value of a force or gravity or the way "
                     "of a pin or obstacle",
             .unit = "s N N N, s m m m",
             .count = 4,
             .low = -1e12,
             .high = 1e12,
             .list = true,
             .shown = "T X Y Z …"},
            {.name = "course",
             .help = "several keys of a pressure or of prestress at once: the time of each and its value",
             .unit = "s Pa",
             .count = 2,
             .low = -1e12,
             .high = 1e12,
             .list = true,
             .shown = "T NUMBER …"},
            {.name = "interpolation",
             .type = ArgumentType::word,
             .help = "between keys: smooth (at first), with level ends and turning points; linear; or step",
             .choices = {"smooth", "linear", "step"}},
            {.name = "remove",
             .help = "take the key `at` that time away, or all: it then stays what it is now",
             .flag = true}},
       .example = "key pin end move 0 0 0.1 rotate 90 axis 1 0 0 at 0.5",
       .before = {"new box 4 1 1 size 0.4 0.1 0.1", "levels 1", "pin where x < 0.01 or x > 0.39",
                  "select vertices as end where x > 0.39"},
       .run = key},
      {.name = "keys",
       .summary = "Lists the keys of gravity, forces, pressures, prestress, pins and obstacles over time.",
       .parameters = {},
       .example = "keys",
       .before = {"new box 2 2 2", "key gravity path 0 0 0 0 1 0 0 -9.81 interpolation linear"},
       .effect = Effect::output,
       .run = list_keys},
  };
}

}  // namespace argil::sculpt
