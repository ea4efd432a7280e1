// Of track_edits.h: pins that are led.

#include <fmt/format.h>

#include <algorithm>

#include "io/session_text.h"
#include "sculpt/commands/edit.h"
#include "sculpt/commands/track_edits.h"
#include "sculpt/document_loads.h"
#include "sculpt/near_names.h"
#include "sculpt/region.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

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

}  // namespace

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

}  // namespace argil::sculpt
