#pragma once
// The sweeps of the atlas: which two parameters of which scene span a map, and along which one boundaries are
// searched.

#include <span>
#include <string>
#include <vector>

#include "tools/atlas/outcome.h"
#include "tools/atlas/scene.h"

namespace argil::atlas {

/// An axis over a parameter, from 0 at `first` to 1 at `last`; `first` may be the larger one.
struct Axis {
  double Scene::*value = nullptr;
  double first = 0, last = 1;
  bool is_logarithmic = true;

  double at(double share) const;        // rounded to nine digits, so that files name the same number
  double share_of(double value) const;  // inverse
};

struct Sweep {
  std::string name;
  std::string title;
  std::string scene_words;  // what moves, for pictures
  Scene scene;
  Axis swept;     // the parameter that gives the sweep its name
  Axis searched;  // boundaries are searched along this one, on lines of constant swept parameter
  /// Which of them runs to the right in the picture.
  bool searched_is_horizontal = false;
  std::string reference_model;  // empty: each model's own fine run
};

/// Those that `argil atlas` runs, in order.
[[nodiscard]] std::vector<Sweep> sweep_table();
/// Steps and stiffness of a session, as it ends. `file` is read. @throws Error as reading it does.
[[nodiscard]] Sweep session_sweep(const std::filesystem::path& file);

/// The scene at a point of the map, both shares from 0 to 1.
[[nodiscard]] Scene scene_at(const Sweep& sweep, double swept, double searched);

}  // namespace argil::atlas
