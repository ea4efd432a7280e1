#pragma once
// What the timeline knows of keys: everything of the document that has keys or could have one now, and the lines of
// the session that set, move and remove them. A mark of the timeline stands for all keys of its time.

#include <string>
#include <vector>

#include "sculpt/document.h"

namespace argil::studio {

/// Something that keys lead: gravity, a force, a pin or an obstacle.
struct Keyed {
  std::string name;  // as the command `key` has it: "gravity", "force gust"
  std::string unit;  // of its values
  sculpt::Track track;
};
/// All that have keys. Cost O(keys).
[[nodiscard]] std::vector<Keyed> keyed(const sculpt::State& state);
/// Their times, ascending, each once [s].
[[nodiscard]] std::vector<double> key_times(const sculpt::State& state);
/// The line that sets the key of a time again, to be given other numbers. It has a key then.
[[nodiscard]] std::string line_to_set_key(const Keyed& one, double time);
/// What they say at a time, as "gravity 0 0 -9.81 m/s²", one after the other.
[[nodiscard]] std::string words_at(const sculpt::State& state, double time);

/// The lines that take all keys of one time to another [s].
[[nodiscard]] std::vector<std::string> lines_to_move_keys(const sculpt::State& state, double from, double to);
[[nodiscard]] std::vector<std::string> lines_to_remove_keys(const sculpt::State& state, double time);

/// What can be given a key of what it is now.
struct Keyable {
  std::string label, help;
  std::vector<std::string> lines;
};
/// Gravity, named forces and pressures, prestress that is painted, what is selected (which is held from then on),
/// the sets that are led already, obstacles.
[[nodiscard]] std::vector<Keyable> keyable(const sculpt::State& state);

}  // namespace argil::studio
