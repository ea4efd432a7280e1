#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "sculpt/commands/commands.h"
#include "sculpt/haptics/scripted_device.h"
#include "sculpt/haptics/servo.h"
#include "sculpt/haptics/simulated_hand.h"
#include "sculpt/simulation.h"
#include "sculpt/stroke.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

struct Path {
  std::vector<PoseSegment> segments;
  StrokePose first;
  Tick end = 0;
};

Path line_path(const Arguments& arguments, const Eigen::Vector3d& start) {
  for (const char* name : {"turns", "pressures", "scales"})
    if (arguments.has(name))
      throw Error(ErrorCode::bad_input, fmt::format("{} go with `path`, one for each station", name));
  const DevicePose from{start, Eigen::Quaterniond::Identity()};
  const DevicePose to{arguments.vector("to"), Eigen::Quaterniond::Identity()};
  const Tick ticks = arguments.integer("ticks", 500), hold = arguments.integer("hold", 0);
  const Ease ease = arguments.word("ease", "linear") == "smooth" ? Ease::smooth : Ease::linear;
  Path path;
  path.segments = {{from, to, ticks, ease, 1}, {to, to, hold, Ease::linear, 1}};
  path.first.position = from.position;
  path.end = ticks + hold;
  return path;
}

Path station_path(const Arguments& arguments) {
  for (const char* name : {"from", "to", "ticks", "ease"})
    if (arguments.has(name))
      throw Error(ErrorCode::bad_input, fmt::format("`path` says it all; leave out {}", name));
  const std::vector<double>& numbers = arguments.numbers("path");
  const std::size_t count = numbers.size() / 4;
  std::vector<DevicePose> poses(count);
  std::vector<Tick> ticks;
  for (std::size_t i = 0; i < count; ++i) {
    const double tick = numbers[4 * i];
    if (tick != std::floor(tick) || (i == 0 ? tick != 0 : tick <= static_cast<double>(ticks.back())) || tick > 1e9)
      throw Error(ErrorCode::bad_input,
                  fmt::format("station {} of the path is at tick {}; ticks are whole, begin with 0 and ascend",
                              i + 1, tick));
    ticks.push_back(static_cast<Tick>(tick));
    poses[i].position = {numbers[4 * i + 1], numbers[4 * i + 2], numbers[4 * i + 3]};
  }
  if (arguments.has("turns")) {
    const std::vector<double>& turns = arguments.numbers("turns");
    if (turns.size() != 4 * count)
      throw Error(
          ErrorCode::bad_input,
          fmt::format("turns are one for each of the {} stations of the path, found {}", count, turns.size() / 4));
    for (std::size_t i = 0; i < count; ++i) {
      poses[i].orientation = Eigen::Quaterniond(turns[4 * i], turns[4 * i + 1], turns[4 * i + 2], turns[4 * i + 3]);
      if (std::abs(poses[i].orientation.norm() - 1) > 1e-6)
        throw Error(ErrorCode::bad_input,
                    fmt::format("turn {} has length {:g}; a turn is a quaternion w x y z of length 1", i + 1,
                                poses[i].orientation.norm()));
    }
  }
  std::vector<double> pressures(count, 1.0);
  if (arguments.has("pressures"))
    pressures = arguments.numbers("pressures");
  else if (arguments.has("scales"))
    throw Error(ErrorCode::bad_input, "scales says what pressures scale; give pressures, one for each station");
  if (pressures.size() != count)
    throw Error(ErrorCode::bad_input,
                fmt::format("pressures are one for each of the {} stations of the path, found {}", count,
                            pressures.size()));
  Path path;
  const auto add = [&](std::size_t from, std::size_t to, Tick length) {
    path.segments.push_back({poses[from], poses[to], length, Ease::linear, 1, pressures[from], pressures[to]});
  };
  add(0, 0, 0);
  for (std::size_t i = 1; i < count; ++i) add(i - 1, i, ticks[i] - ticks[i - 1]);
  const Tick hold = arguments.integer("hold", 0);
  add(count - 1, count - 1, hold);
  path.first = {poses[0].position, poses[0].orientation, pressures[0]};
  path.end = ticks.back() + hold;
  return path;
}

void run_stroke(Session& session, const Path& path, const StrokeOptions& options, bool by_hand) {
  const State& state = session.document().state();
  session.require_steps(
      std::floor((static_cast<double>(path.end) + state.tick_carry) * k_tick_seconds / state.time_step));
  const Tick life = static_cast<Tick>(std::ceil(3 * (state.time_step / k_tick_seconds)));
  Stroke stroke(session, path.first, options);

  ScriptedDevice script(path.segments);
  SimulatedHand hand(script);
  Device& device = by_hand ? static_cast<Device&>(hand) : script;
  ContactChannel channel;
  Servo servo(device, channel);
  channel.publish(stroke.felt(life));
  for (Tick tick = 1; tick <= path.end && !session.stop_requested(); ++tick) {
    const DeviceSample sample = servo.tick(tick).sample;
    if (stroke.tick({sample.pose.position, sample.pose.orientation, sample.pressure}))
      channel.publish(stroke.felt(tick + life));
  }
  static_cast<void>(stroke.finish());
}

bool by_hand(const Arguments& arguments) {
  return arguments.word("device", "scripted") == "hand";
}

void stroke(Session& session, const Arguments& arguments) {
  require_simulation(session);
  const Path path =
      arguments.has("path") ? station_path(arguments) : line_path(arguments, arguments.vector("from"));
  StrokeOptions options;
  options.invert = arguments.has("invert");
  options.smoothing = arguments.has("smoothing");
  options.inside = arguments.has("inside");
  options.scales_radius = arguments.word("scales", "strength") == "radius";
  run_stroke(session, path, options, by_hand(arguments));
}

void curve(Session& session, const Arguments& arguments) {
  require_simulation(session);
  StrokeOptions options;
  options.curve = arguments.points("through");
  const std::size_t handle = static_cast<std::size_t>(arguments.integer("handle", 1));
  if (handle > options.curve.size())
    throw Error(ErrorCode::bad_input,
                fmt::format("the curve has handles 1 to {}, not {}", options.curve.size(), handle));
  options.handle = handle - 1;
  const Path path =
      arguments.has("path") ? station_path(arguments) : line_path(arguments, options.curve[options.handle]);
  run_stroke(session, path, options, by_hand(arguments));
}

// Where the device goes: what `stroke` and `curve` have in common.
std::vector<Parameter> way_parameters() {
  return {
      {.name = "to",
       .help = "where the device goes",
       .unit = "m",
       .count = 3,
       .required = true,
       .low = -1e9,
       .high = 1e9,
       .unless = "path"},
      {.name = "ticks",
       .type = ArgumentType::integer,
       .help = "milliseconds on the way",
       .required = true,
       .low = 1,
       .high = 1e7,
       .unless = "path"},
      {.name = "hold",
       .type = ArgumentType::integer,
       .help = "milliseconds held at the end",
       .low = 0,
       .high = 1e7},
      {.name = "ease", .type = ArgumentType::word, .help = "speed along the way", .choices = {"linear", "smooth"}},
      {.name = "device",
       .type = ArgumentType::word,
       .help = "scripted: follows the line exactly; hand: a simulated hand that feels the force",
       .choices = {"scripted", "hand"}},
      {.name = "path",
       .help = "instead of a line: tick [ms] and place [m] of each station, from tick 0 on, straight "
               "between them; what a window journals",
       .unit = "ms m m m",
       .count = 4,
       .low = -1e9,
       .high = 1e9,
       .list = true,
       .shown = "TICK X Y Z"},
      {.name = "turns",
       .help = "how the device is turned at each station: a quaternion of length 1; else not at all",
       .count = 4,
       .low = -1.001,
       .high = 1.001,
       .list = true,
       .shown = "W X Y Z"},
      {.name = "pressures",
       .help = "how hard it is pressed at each station, as a share of the strength; else 1",
       .low = 0,
       .high = 1,
       .list = true,
       .shown = "P"}};
}

std::vector<Parameter> with_way(std::vector<Parameter> before, const std::vector<Parameter>& after = {}) {
  const std::vector<Parameter> way = way_parameters();
  before.insert(before.end(), way.begin(), way.end());
  before.insert(before.end(), after.begin(), after.end());
  return before;
}

}  // namespace

std::vector<Command> stroke_commands() {
  std::vector<Parameter> of_curve =
      with_way({{.name = "through",
                 .help = "points on the boundary that the curve goes through: its handles",
                 .unit = "m",
                 .count = 3,
                 .required = true,
                 .low = -1e9,
                 .high = 1e9,
                 .list = true},
                {.name = "handle",
                 .type = ArgumentType::integer,
                 .help = "the one that moves, from 1",
                 .required = true,
                 .low = 1,
                 .high = 1e6}});
  for (Parameter& parameter : of_curve)
    if (parameter.name == "ticks") {
      parameter.required = false;
      parameter.help += "; else 500";
    }
  return {
      {.name = "curve",
       .summary =
           "Lays a cubic B-spline curve on the boundary and moves one of its handles: the boundary within the "
           "tool's radius of the curve follows it by springs of the tool's strength, while the simulation "
           "advances.",
       .parameters = of_curve,
       .example = "curve through 0.1 0.3 0.1 0.3 0.3 0.1 0.5 0.3 0.1 handle 2 to 0.3 0.3 0.15 ticks 100",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1", "levels 1", "pin where x < 0.01",
                  "tool pull radius 0.1 strength 200"},
       .run = curve},
      {.name = "stroke",
       .summary = "Moves the device along a line or a path with the tool held on; the simulation advances with it.",
       .parameters =
           with_way({{.name = "from",
                      .help = "where the tool takes hold of the surface",
                      .unit = "m",
                      .count = 3,
                      .required = true,
                      .low = -1e9,
                      .high = 1e9,
                      .unless = "path"}},
                    {{.name = "scales",
                      .type = ArgumentType::word,
                      .help = "what pressures scale: the strength, or the radius of tools that go over the body "
                              "(inflate, pinch, smooth, those that paint); what holds on, as pull, is then as at 1",
                      .choices = {"strength", "radius"}},
                     {.name = "invert", .help = "the opposite of the tool: pull pushes", .flag = true},
                     {.name = "smoothing", .help = "smooth with the tool's brush, whatever the tool", .flag = true},
                     {.name = "inside",
                      .help = "hold what is within the radius inside the solid; else it is the surface, if that is "
                              "within the radius",
                      .flag = true}}),
       .example = "stroke from 0.3 0.3 0.1 to 0.3 0.3 -0.05 ticks 100",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1", "levels 1", "pin where x < 0.01",
                  "tool pull radius 0.15 strength 40"},
       .run = stroke},
  };
}

}  // namespace argil::sculpt
