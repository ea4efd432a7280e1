#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>

#include "io/session_text.h"
#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/commands/named_forces.h"
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

std::string listed(const Track& track) {
  std::string times;
  for (const double time : track.times) times += fmt::format("{}{:g}", times.empty() ? "" : ", ", time);
  return times;
}

/// The keys that a line gives: one `at` a time (else now), or several by `path`.
struct NewKeys {
  std::vector<std::pair<double, Eigen::VectorXd>> keys;
  std::optional<Interpolation> interpolation;
};

NewKeys new_keys(const Arguments& arguments, const std::optional<Eigen::VectorXd>& value, Eigen::Index components,
                 double now) {
  NewKeys result;
  if (arguments.has("interpolation")) result.interpolation = interpolation_by_word(arguments.word("interpolation"));
  if (value) result.keys.emplace_back(arguments.number("at", now), *value);
  if (arguments.has("path")) {
    if (value || arguments.has("at"))
      throw Error(ErrorCode::bad_input, "a path has its own times and values; leave out the others");
    const auto& numbers = arguments.numbers("path");
    for (std::size_t i = 0; i + 3 < numbers.size(); i += 4) {
      if (numbers[i] < 0)
        throw Error(ErrorCode::bad_input,
                    fmt::format("time begins at 0 s, and the path has a key at {:g} s", numbers[i]));
      Eigen::VectorXd key = Eigen::VectorXd::Zero(components);
      key.head<3>() = Eigen::Vector3d(numbers[i + 1], numbers[i + 2], numbers[i + 3]);
      result.keys.emplace_back(numbers[i], key);
    }
  }
  if (arguments.has("course")) {
    if (value || arguments.has("at"))
      throw Error(ErrorCode::bad_input, "a course has its own times and values; leave out the others");
    const auto& numbers = arguments.numbers("course");
    for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
      if (numbers[i] < 0)
        throw Error(ErrorCode::bad_input,
                    fmt::format("time begins at 0 s, and the course has a key at {:g} s", numbers[i]));
      result.keys.emplace_back(numbers[i], Eigen::VectorXd::Constant(1, numbers[i + 1]));
    }
  }
  if (result.keys.empty() && !result.interpolation)
    throw Error(ErrorCode::bad_input,
                components == 1
                    ? "a key wants a value, as in `key pressure bag amount 500 at 0.5`, an interpolation, or "
                      "`remove`"
                    : "a key wants a value, as in `key gravity 0 0 -9.81 at 0.5`, an interpolation, or "
                      "`remove`");
  if (result.keys.empty() && arguments.has("at"))
    throw Error(ErrorCode::bad_input, "`at` is the time of a value, and there is none");
  return result;
}

/// Adds keys. The first one ahead of now has one of what is now with it: there is a way to go.
void add_keys(Track& track, const NewKeys& given, double now, const Eigen::VectorXd& present,
              const std::string& what, Session& session) {
  if (track.empty() && given.keys.empty())
    throw Error(ErrorCode::not_found, fmt::format("{} has no keys yet; give it one, with a value and `at`", what));
  if (given.interpolation) track.interpolation = *given.interpolation;
  const auto ahead = [&](const auto& key) { return key.first > now + k_same_time; };
  if (track.empty() && std::all_of(given.keys.begin(), given.keys.end(), ahead)) {
    set_key(track, now, present);
    session.print(fmt::format("{} goes from what it is now, at {:g} s", what, now));
  }
  for (const auto& [time, value] : given.keys) set_key(track, time, value);
}

/// Takes away the key at a time, or all.
void remove_keys(Track& track, const Arguments& arguments, const std::string& what) {
  for (const char* other :
       {"value", "amount", "to", "path", "course", "move", "rotate", "axis", "about", "interpolation"})
    if (arguments.has(other))
      throw Error(ErrorCode::bad_input, fmt::format("`remove` takes keys away; leave out {}", other));
  if (track.empty()) throw Error(ErrorCode::not_found, fmt::format("{} has no keys", what));
  if (!arguments.has("at")) {
    track = {};
  } else if (!remove_key(track, arguments.number("at"))) {
    throw Error(ErrorCode::not_found, fmt::format("{} has no key at {:g} s; there are keys at {} s", what,
                                                  arguments.number("at"), listed(track)));
  }
}

/// Takes the key at a time to another, with its value.
void move_key(Track& track, const Arguments& arguments, const std::string& what) {
  for (const char* other :
       {"value", "amount", "path", "course", "move", "rotate", "axis", "about", "interpolation", "remove"})
    if (arguments.has(other))
      throw Error(ErrorCode::bad_input, fmt::format("`to` moves a key as it is; leave out {}", other));
  if (!arguments.has("at"))
    throw Error(ErrorCode::bad_input, "which key is to be moved? Give its time, as in `key gravity at 0.5 to 0.8`");
  const double from = arguments.number("at"), to = arguments.number("to");
  if (!track.has_key(from))
    throw Error(ErrorCode::not_found, track.empty() ? fmt::format("{} has no keys", what)
                                                    : fmt::format("{} has no key at {:g} s; there are keys at {} s",
                                                                  what, from, listed(track)));
  const Eigen::VectorXd value = value_at(track, from);
  remove_key(track, from);
  if (track.has_key(to))
    throw Error(
        ErrorCode::bad_input,
        fmt::format("{} has a key at {:g} s already; take that away before, or choose another time", what, to));
  set_key(track, to, value);
}

void refuse(const Arguments& arguments, std::initializer_list<const char*> names, const std::string& why) {
  for (const char* name : names)
    if (arguments.has(name)) throw Error(ErrorCode::bad_input, fmt::format("{}; leave out {}", why, name));
}

/// A vector over time and what it is without keys, which it keeps of the present when they go.
void key_vector(Session& session, const Arguments& arguments, Eigen::Vector3d& constant, Track& track,
                const std::string& what) {
  refuse(arguments, {"move", "rotate", "axis", "about"}, "pins move and turn, and " + what + " has a value");
  refuse(arguments, {"amount", "course"}, what + " has three components: `0 0 -9.81`, or a `path`");
  const double now = session.document().state().motion->time;
  const Eigen::VectorXd present = track.empty() ? Eigen::VectorXd(constant) : value_at(track, now);
  if (arguments.has("remove")) {
    remove_keys(track, arguments, what);
    if (track.empty()) constant = present;
    return;
  }
  if (arguments.has("to")) return move_key(track, arguments, what);
  std::optional<Eigen::VectorXd> value;
  if (arguments.has("value")) value = arguments.vector("value");
  add_keys(track, new_keys(arguments, value, 3, now), now, present, what, session);
}

/// The same of a number.
void key_number(Session& session, const Arguments& arguments, double& constant, Track& track,
                const std::string& what) {
  refuse(arguments, {"move", "rotate", "axis", "about"}, "pins move and turn, and " + what + " has a value");
  refuse(arguments, {"value", "path"}, what + " is one number: `amount NUMBER at TIME`, or `course T NUMBER …`");
  const double now = session.document().state().motion->time;
  const Eigen::VectorXd present = track.empty() ? Eigen::VectorXd::Constant(1, constant) : value_at(track, now);
  if (arguments.has("remove")) {
    remove_keys(track, arguments, what);
    if (track.empty()) constant = present[0];
    return;
  }
  if (arguments.has("to")) return move_key(track, arguments, what);
  std::optional<Eigen::VectorXd> value;
  if (arguments.has("amount")) value = Eigen::VectorXd::Constant(1, arguments.number("amount"));
  add_keys(track, new_keys(arguments, value, 1, now), now, present, what, session);
}

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

/// The members of a named set as pins: all pinned, and none in another motion.
Selection members_of(const Session& session, const Pins& pins, const std::string& name, const PinMotion* known) {
  const Document& document = session.document();
  const auto& sets = *document.state().sets;
  const auto found = sets.find(name);
  if (found == sets.end()) {
    if (known) return known->members;
    std::vector<std::string> names;
    for (const auto& [other, unused] : sets) names.push_back(other);
    throw Error(
        ErrorCode::not_found,
        fmt::format("there is no set named '{0}'{1}; make one of what is pinned: `select vertices as {2} where …`",
                    name, near_names_hint(name, names), io::quote(name)));
  }
  Selection members = found->second;
  if (members.type != ElementType::nodes) members = {ElementType::vertices, vertices_of(document, members)};
  std::size_t loose = 0;
  for (const std::uint32_t id : members.ids) {
    loose +=
        members.type == ElementType::vertices
            ? !std::binary_search(pins.control_points.begin(), pins.control_points.end(), id)
            : std::none_of(pins.nodes.begin(), pins.nodes.end(), [&](const SoftPin& p) { return p.node == id; });
    const PinMotion* other = motion_of(pins, members.type, id);
    if (other && other->name != name)
      throw Error(
          ErrorCode::bad_input,
          fmt::format("{} {} is led by '{}' already; a pin goes one way: choose a set without it, or `key pin {} "
                      "remove`",
                      members.type == ElementType::vertices ? "vertex" : "node", id, other->name,
                      io::quote(other->name)));
  }
  if (members.ids.empty()) throw Error(ErrorCode::bad_input, fmt::format("the set '{}' is empty", name));
  if (loose > 0)
    throw Error(
        ErrorCode::bad_input,
        fmt::format("{} of the {} of '{}' {} not pinned; write `select {} set {}` and `pin{}` before", loose,
                    count_of(members.ids.size(), members.type), name, loose == 1 ? "is" : "are", word(members.type),
                    io::quote(name), members.type == ElementType::nodes ? " stiffness 1e4" : ""));
  return members;
}

Eigen::Vector3d middle_of(const Document& document, const Selection& members) {
  const Eigen::Matrix3Xd now =
      members.type == ElementType::nodes ? document.surface_nodes(document.positions()) : document.positions();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::uint32_t id : members.ids) sum += now.col(id);
  return sum / static_cast<double>(members.ids.size());
}

/// From here on the targets of its soft pins are what they are now, whatever becomes of the keys.
void settle(Pins& pins, PinMotion& motion, double now) {
  if (motion.members.type == ElementType::nodes && !motion.track.empty())
    for (SoftPin& pin : pins.nodes)
      if (std::binary_search(motion.members.ids.begin(), motion.members.ids.end(), pin.node))
        pin.target = led_target(motion, pin.target, now);
  motion.since = now;
}

std::optional<Eigen::VectorXd> motion_value(const Arguments& arguments) {
  if (arguments.has("axis") && !arguments.has("rotate"))
    throw Error(ErrorCode::bad_input, "an axis is that of a turn; add `rotate ANGLE`");
  if (!arguments.has("move") && !arguments.has("rotate")) return std::nullopt;
  const Eigen::Vector3d axis = arguments.vector("axis", {0, 0, 1});
  if (!(axis.norm() > 0)) throw Error(ErrorCode::bad_input, "the axis has no length; `axis 0 0 1` is upright");
  Eigen::VectorXd value(6);
  value << arguments.vector("move", {0, 0, 0}), arguments.number("rotate", 0) * k_degree * axis.normalized();
  return value;
}

void key_pin(Session& session, const Arguments& arguments, State& next) {
  if (!arguments.has("name"))
    throw Error(ErrorCode::bad_input,
                "which pins? Name a set of what is pinned, as in `key pin foot move 0 0 0.1 at 2`");
  refuse(arguments, {"value", "amount", "course"}, "a pin moves: `move X Y Z`, `rotate ANGLE axis X Y Z`");
  const std::string& name = arguments.word("name");
  const double now = next.motion->time;
  auto pins = std::make_shared<Pins>(*next.pins);
  auto& motions = pins->motions;
  const auto place =
      std::lower_bound(motions.begin(), motions.end(), name,
                       [](const PinMotion& motion, const std::string& of) { return motion.name < of; });
  const bool known = place != motions.end() && place->name == name;
  const std::string what = fmt::format("the pin '{}'", name);
  if (arguments.has("remove") || arguments.has("to")) {
    if (!known) {
      std::vector<std::string> names;
      for (const PinMotion& motion : motions) names.push_back(motion.name);
      throw Error(ErrorCode::not_found, fmt::format("no pin named '{}' has keys{}; `keys` lists them", name,
                                                    near_names_hint(name, names)));
    }
    settle(*pins, *place, now);
    if (arguments.has("to"))
      move_key(place->track, arguments, what);
    else
      remove_keys(place->track, arguments, what);
    if (place->track.empty()) motions.erase(place);
    next.pins = pins;
    return;
  }
  const NewKeys given = new_keys(arguments, motion_value(arguments), 6, now);
  PinMotion motion;
  if (known) motion = *place;
  motion.name = name;
  settle(*pins, motion, now);
  motion.members = members_of(session, *pins, name, known ? &*place : nullptr);
  if (known && arguments.has("about"))
    throw Error(ErrorCode::bad_input,
                fmt::format("what {} turns about goes with its first key; `key pin {} remove` and begin again",
                            what, io::quote(name)));
  if (!known)
    motion.pivot =
        arguments.has("about") ? arguments.vector("about") : middle_of(session.document(), motion.members);
  add_keys(motion.track, given, now, Eigen::VectorXd::Zero(6), what, session);
  if (known)
    *place = std::move(motion);
  else
    motions.insert(place, std::move(motion));
  next.pins = pins;
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
