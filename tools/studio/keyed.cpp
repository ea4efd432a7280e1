#include "tools/studio/keyed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/session_text.h"
#include "sculpt/document_loads.h"
#include "sculpt/obstacles.h"

namespace argil::studio {

namespace {

constexpr double k_degree = std::numbers::pi / 180;

/// The value of a key as the command takes it: a vector, or a way and a turn; to the bit, or as one reads it.
std::string value_words(const Eigen::VectorXd& value, bool exact) {
  const auto word = [&](double number) {
    return exact ? io::format_number(number) : fmt::format("{:.3g}", number);
  };
  const auto words = [&](const Eigen::Vector3d& v) { return word(v.x()) + ' ' + word(v.y()) + ' ' + word(v.z()); };
  if (value.size() == 1) return "amount " + word(value[0]);
  if (value.size() == 3) return words(value);
  const Eigen::Vector3d turn = value.tail<3>();
  const double angle = std::sqrt(turn.x() * turn.x() + turn.y() * turn.y() + turn.z() * turn.z());
  std::string line = "move " + words(value.head<3>());
  if (angle > 0) line += " rotate " + word(angle / k_degree) + " axis " + words(turn / angle);
  return line;
}

std::string named(const char* what, const std::string& name) {
  return std::string(what) + ' ' + io::quote(name);
}

/// A name for a set that none has yet.
std::string free_name(const sculpt::State& state) {
  for (int number = 1;; ++number) {
    std::string name = fmt::format("held_{}", number);
    if (!state.sets || !state.sets->contains(name)) return name;
  }
}

}  // namespace

std::vector<Keyed> keyed(const sculpt::State& state) {
  std::vector<Keyed> all;
  const auto add = [&](std::string name, const char* unit, const sculpt::Track& track) {
    if (!track.empty()) all.push_back({std::move(name), unit, track});
  };
  add("gravity", "m/s²", state.loads->gravity_track);
  for (const sculpt::AppliedForce& force : state.loads->forces) add(named("force", force.name), "N", force.track);
  for (const sculpt::AppliedPressure& pressure : state.loads->pressures)
    add(named("pressure", pressure.name), "Pa", pressure.track);
  add("prestress", "of the field", state.loads->prestress_track);
  for (const sculpt::PinMotion& motion : state.pins->motions)
    add(named("pin", motion.name), "m, degrees", motion.track);
  if (state.obstacles)
    for (const sculpt::NamedObstacle& obstacle : *state.obstacles)
      add(named("obstacle", obstacle.name), "m, degrees", obstacle.track);
  return all;
}

std::vector<double> key_times(const sculpt::State& state) {
  std::vector<double> times;
  for (const Keyed& one : keyed(state)) times.insert(times.end(), one.track.times.begin(), one.track.times.end());
  std::sort(times.begin(), times.end());
  const auto same = [](double a, double b) { return b - a <= sculpt::k_same_time; };
  times.erase(std::unique(times.begin(), times.end(), same), times.end());
  return times;
}

std::string line_to_set_key(const Keyed& one, double time) {
  return fmt::format("key {} {} at {}", one.name, value_words(sculpt::value_at(one.track, time), true),
                     io::format_number(time));
}

std::string words_at(const sculpt::State& state, double time) {
  std::string words;
  for (const Keyed& one : keyed(state)) {
    if (!one.track.has_key(time)) continue;
    words += fmt::format("{}{} {} {}", words.empty() ? "" : "; ", one.name,
                         value_words(sculpt::value_at(one.track, time), false), one.unit);
  }
  return words;
}

std::vector<std::string> lines_to_move_keys(const sculpt::State& state, double from, double to) {
  std::vector<std::string> lines;
  for (const Keyed& one : keyed(state))
    if (one.track.has_key(from))
      lines.push_back(fmt::format("key {} at {} to {}", one.name, io::format_number(from), io::format_number(to)));
  return lines;
}

std::vector<std::string> lines_to_remove_keys(const sculpt::State& state, double time) {
  std::vector<std::string> lines;
  for (const Keyed& one : keyed(state))
    if (one.track.has_key(time))
      lines.push_back(fmt::format("key {} remove at {}", one.name, io::format_number(time)));
  return lines;
}

std::vector<Keyable> keyable(const sculpt::State& state) {
  const double now = state.motion->time;
  std::vector<Keyable> all;
  const auto add = [&](const std::string& name, const std::string& help, const Eigen::VectorXd& value) {
    all.push_back({name, help, {fmt::format("key {} {}", name, value_words(value, true))}});
  };
  const auto way = [&](const sculpt::Track& track) {
    return track.empty() ? Eigen::VectorXd(Eigen::VectorXd::Zero(6)) : sculpt::value_at(track, now);
  };
  // What is led already is keyed by its own name, further down.
  const auto is_led = [&](const sculpt::Selection& selection) {
    return std::any_of(state.pins->motions.begin(), state.pins->motions.end(),
                       [&](const sculpt::PinMotion& motion) {
                         return motion.members.type == selection.type && motion.members.ids == selection.ids;
                       });
  };
  if (state.selection && !state.selection->ids.empty() && state.selection->type != sculpt::ElementType::nodes &&
      !is_led(*state.selection)) {
    const char* type = sculpt::word(state.selection->type);
    const std::string name = free_name(state);
    all.push_back(
        {fmt::format("the selection ({} {})", state.selection->ids.size(), type),
         "Holds what is selected, and keys where it is: it goes as later keys say",
         {fmt::format("select {} selected as {}", type, name), "pin", fmt::format("key pin {} move 0 0 0", name)}});
  }
  add("gravity", "Keys gravity as it is now", sculpt::gravity_at(*state.loads, now));
  for (const sculpt::AppliedForce& force : state.loads->forces)
    if (!force.name.empty())
      add(named("force", force.name), "Keys this force as it is now", sculpt::force_at(force, now));
  for (const sculpt::AppliedPressure& pressure : state.loads->pressures)
    if (!pressure.name.empty())
      add(named("pressure", pressure.name), "Keys this pressure as it is now",
          Eigen::VectorXd::Constant(1, sculpt::pressure_at(pressure, now)));
  if (!(*state.fields)[sculpt::FieldName::prestress].isZero(0))
    add("prestress", "Keys which share of the field prestress acts now",
        Eigen::VectorXd::Constant(1, sculpt::prestress_share_at(*state.loads, now)));
  for (const sculpt::PinMotion& motion : state.pins->motions)
    add(named("pin", motion.name), "Keys where these pins are now", way(motion.track));
  if (state.obstacles)
    for (const sculpt::NamedObstacle& obstacle : *state.obstacles)
      add(named("obstacle", obstacle.name), "Keys where this obstacle is now", way(obstacle.track));
  return all;
}

}  // namespace argil::studio
