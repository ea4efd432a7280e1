#include "sculpt/commands/track_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

constexpr double k_degree = std::numbers::pi / 180;

}  // namespace

std::string listed(const Track& track) {
  std::string times;
  for (const double time : track.times) times += fmt::format("{}{:g}", times.empty() ? "" : ", ", time);
  return times;
}

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

}  // namespace argil::sculpt
