#pragma once
// What became of a run, and how lines of a map are searched for the places where that changes.

#include <functional>
#include <string_view>
#include <vector>

namespace argil::atlas {

enum class Outcome {
  stable,      // near the reference
  inaccurate,  // ends, but far from it
  diverged,    // not finite, or more energy than was put in
  refused      // the model or method cannot be run there
};
[[nodiscard]] std::string_view word(Outcome outcome);

/// Points of a line are whole numbers 0 … coarse · 2^depth, evenly spread over its axis.
struct LineGrid {
  int coarse = 6;  // intervals looked at first
  int depth = 5;   // halvings of an interval at whose ends the outcome differs
  int last() const { return coarse << depth; }
};

struct LinePoint {
  int position = 0;
  Outcome outcome = Outcome::stable;
};

/// Asks for the outcome at the coarse points, then halves every interval whose ends differ until they are
/// neighbours; a third outcome in between is bracketed on both sides. What changes twice within a coarse interval
/// is not seen. Returns all points asked for, ascending.
[[nodiscard]] std::vector<LinePoint> search_line(const LineGrid& grid, const std::function<Outcome(int)>& outcome);

/// A stretch of one outcome. Ends lie halfway between the points where it changes, 0 and `last` at the rim.
struct Stretch {
  double begin = 0, end = 0;  // in points
  Outcome outcome = Outcome::stable;
};
[[nodiscard]] std::vector<Stretch> stretches(const LineGrid& grid, const std::vector<LinePoint>& points);

}  // namespace argil::atlas
