#pragma once
// What a line of the command `key` does to a track: keys given, moved, taken away. Of gravity, forces, pressures,
// pins and obstacles alike (key_commands.cpp, key_pins.cpp).

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "sculpt/command.h"
#include "sculpt/session.h"
#include "sculpt/tracks.h"

namespace argil::sculpt {

/// "0.5, 1, 2", for messages.
[[nodiscard]] std::string listed(const Track& track);

/// The keys that a line gives: one `at` a time (else now), or several by `path` or `course`.
struct NewKeys {
  std::vector<std::pair<double, Eigen::VectorXd>> keys;
  std::optional<Interpolation> interpolation;
};
/// `value`: that of the one key, if the line has one. @throws Error (bad_input) if they contradict each other.
[[nodiscard]] NewKeys new_keys(const Arguments& arguments, const std::optional<Eigen::VectorXd>& value,
                               Eigen::Index components, double now);
/// Of a way and a turn, `move X Y Z rotate ANGLE axis X Y Z`: 6 components, or none.
[[nodiscard]] std::optional<Eigen::VectorXd> motion_value(const Arguments& arguments);

// `what` is the thing that is led, as messages name it. All @throw Error (bad_input, not_found).

/// Adds keys. The first one ahead of now has one of what is now with it: there is a way to go.
void add_keys(Track& track, const NewKeys& given, double now, const Eigen::VectorXd& present,
              const std::string& what, Session& session);
/// Takes away the key `at` a time, or all.
void remove_keys(Track& track, const Arguments& arguments, const std::string& what);
/// Takes the key `at` a time `to` another, with its value.
void move_key(Track& track, const Arguments& arguments, const std::string& what);
/// Refuses a line that has one of these arguments.
void refuse(const Arguments& arguments, std::initializer_list<const char*> names, const std::string& why);

/// All that a line may do to a vector over time, or to a number, and to what it is without keys, which it keeps of
/// the present when they go.
void key_vector(Session& session, const Arguments& arguments, Eigen::Vector3d& constant, Track& track,
                const std::string& what);
void key_number(Session& session, const Arguments& arguments, double& constant, Track& track,
                const std::string& what);
/// To pins, which are named as a set is (key_pins.cpp).
void key_pin(Session& session, const Arguments& arguments, State& next);

}  // namespace argil::sculpt
