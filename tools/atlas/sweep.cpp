#include "tools/atlas/sweep.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "io/file_bytes.h"
#include "subdiv/error.h"

namespace argil::atlas {

double Axis::at(double share) const {
  const double raw = is_logarithmic ? first * std::pow(last / first, share) : first + share * (last - first);
  return std::strtod(fmt::format("{:.9g}", raw).c_str(), nullptr);
}

double Axis::share_of(double number) const {
  return is_logarithmic ? std::log(number / first) / std::log(last / first) : (number - first) / (last - first);
}

std::vector<Sweep> sweep_table() {
  const Axis steps{&Scene::time_step, 1e-5, 1, true};
  std::vector<Sweep> table;
  table.push_back({.name = "time_step",
                   .title = "Time step",
                   .scene_words = "a bar of 4 × 1 × 1 control cells, stretched by 5 % and let go",
                   .scene = {.body = "bar", .motion = Motion::release},
                   .swept = {&Scene::young_modulus, 1e3, 1e7, true},
                   .searched = steps,
                   .searched_is_horizontal = true,
                   .reference_model = {}});
  table.push_back({.name = "young_modulus",
                   .title = "Young's modulus",
                   .scene_words = "an L that stands on its foot; gravity is switched on",
                   .scene = {.body = "l", .motion = Motion::weight},
                   .swept = {&Scene::young_modulus, 1e3, 1e9, true},
                   .searched = steps,
                   .reference_model = {}});
  table.push_back({.name = "poisson_ratio",
                   .title = "Poisson's ratio",
                   .scene_words = "a box of 2 × 2 × 2 control cells, held at one side, stretched by 5 % and let go",
                   .scene = {.body = "box", .motion = Motion::release},
                   .swept = {&Scene::poisson_gap, 0.5, 1e-4, true},
                   .searched = steps,
                   .reference_model = {}});
  table.push_back({.name = "contrast",
                   .title = "Contrast of the painted stiffness",
                   .scene_words = "a bar whose free half is stiffer, stretched by 5 % and let go",
                   .scene = {.body = "bar", .motion = Motion::release},
                   .swept = {&Scene::contrast, 1, 1e4, true},
                   .searched = steps,
                   .reference_model = {}});
  table.push_back({.name = "aspect",
                   .title = "Aspect ratio of the cells",
                   .scene_words =
                       "a box of 2 × 2 × 2 control cells, the flatter the further right, held at one side, "
                       "stretched by 5 % and let go",
                   .scene = {.body = "box", .motion = Motion::release},
                   .swept = {&Scene::aspect, 1, 100, true},
                   .searched = steps,
                   .reference_model = {}});
  table.push_back({.name = "rotation",
                   .title = "Rotation per step",
                   .scene_words = "a free box that turns, 0.5 s, steps of 1/60 s, against fine corotational steps",
                   .scene = {.body = "box", .motion = Motion::spin},
                   .swept = {&Scene::young_modulus, 1e3, 1e9, true},
                   .searched = {&Scene::rotation, 1e-3, 3, true},
                   .searched_is_horizontal = true,
                   .reference_model = "corotational"});
  table.push_back({.name = "inversion",
                   .title = "Initial inversion",
                   .scene_words = "a free box, pressed through itself along x and let go",
                   .scene = {.body = "box", .motion = Motion::invert},
                   .swept = {&Scene::inversion, 0, 2, false},
                   .searched = steps,
                   .reference_model = {}});
  table.push_back({.name = "pull",
                   .title = "Pull force",
                   .scene_words = "a bar held at one end; a force on the other one is switched on",
                   .scene = {.body = "bar", .motion = Motion::pull},
                   .swept = {&Scene::pull, 1e-3, 10, true},
                   .searched = steps,
                   .reference_model = {}});
  return table;
}

Sweep session_sweep(const std::filesystem::path& file) {
  Sweep sweep{.name = "session",
              .title = "Time step and stiffness of " + file.stem().string(),
              .scene_words = "the state at the end of the session, with its pins and loads",
              .scene = {.body = file.stem().string(), .motion = Motion::session, .young_modulus = 1},
              .swept = {&Scene::young_modulus, 1e-3, 1e3, true},
              .searched = {&Scene::time_step, 1e-4, 1, true},
              .searched_is_horizontal = true,
              .reference_model = {}};
  sweep.scene.session_file = file;
  sweep.scene.session_text = io::read_file(file);
  return sweep;
}

Scene scene_at(const Sweep& sweep, double swept, double searched) {
  Scene scene = sweep.scene;
  scene.*sweep.swept.value = sweep.swept.at(swept);
  scene.*sweep.searched.value = sweep.searched.at(searched);
  return scene;
}

}  // namespace argil::atlas
