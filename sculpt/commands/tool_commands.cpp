#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/force_tools/pull.h"
#include "sculpt/haptics/scripted_device.h"
#include "sculpt/haptics/servo.h"
#include "sculpt/haptics/simulated_hand.h"
#include "sculpt/simulation.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

void set_tool(Session& session, const Arguments& arguments) {
  require_solid(session);
  State next = session.document().state();
  next.tool.name = arguments.word("tool");
  next.tool.radius = arguments.number("radius", next.tool.radius);
  next.tool.strength = arguments.number("strength", next.tool.strength);
  next.tool.largest_force = arguments.number("limit", next.tool.largest_force);
  next.tool.falloff = arguments.word("falloff", next.tool.falloff);
  session.change(std::move(next));
}

// What the device should feel: the spring's pull back, with its slope.
ContactModel felt(const PullGrip& grip, const Eigen::Vector3d& device, const Eigen::Matrix3Xd& positions,
                  Tick valid_until) {
  ContactModel model;
  model.point = device;
  model.force = -grip.force(device, positions);
  model.derivative = -grip.stiffness() * Eigen::Matrix3d::Identity();
  model.valid_until = valid_until;
  return model;
}

void stroke(Session& session, const Arguments& arguments) {
  require_simulation(session);
  Document& document = session.document();
  const Eigen::Vector3d from = arguments.vector("from"), to = arguments.vector("to");
  const Tick ticks = arguments.integer("ticks", 500), hold = arguments.integer("hold", 0);
  session.require_steps(std::floor((static_cast<double>(ticks + hold) + document.state().tick_carry) *
                                   k_tick_seconds / document.state().time_step));
  const PullGrip grip(document, document.state().tool, from);

  const Ease ease = arguments.word("ease", "linear") == "smooth" ? Ease::smooth : Ease::linear;
  ScriptedDevice script(
      {{{from, Eigen::Quaterniond::Identity()}, {to, Eigen::Quaterniond::Identity()}, ticks, ease, 1},
       {{to, Eigen::Quaterniond::Identity()}, {to, Eigen::Quaterniond::Identity()}, hold, Ease::linear, 1}});
  SimulatedHand hand(script);
  const bool by_hand = arguments.word("device", "scripted") == "hand";
  Device& device = by_hand ? static_cast<Device&>(hand) : script;
  ContactChannel channel;
  Servo servo(device, channel);

  const double step_ticks = document.state().time_step / k_tick_seconds;
  const Tick life = static_cast<Tick>(std::ceil(3 * step_ticks));
  channel.publish(felt(grip, from, document.positions(), life));
  const std::size_t first_step = session.steps().size();
  double pending = document.state().tick_carry, largest = 0;
  Eigen::Vector3d device_now = from;
  for (Tick tick = 1; tick <= ticks + hold && !session.stop_requested(); ++tick) {
    const ServoTick served = servo.tick(tick);
    const Eigen::Vector3d& at = served.sample.pose.position;
    pending += 1;
    while (pending >= step_ticks * (1 - 1e-12) && !session.stop_requested()) {
      pending -= step_ticks;
      // The carry is part of every step's state: a stroke that is stopped midway ends as its trace says.
      State now = document.state();
      now.tick_carry = std::max(0.0, pending);
      document.assign(std::move(now));
      device_now = at;
      largest = std::max(largest, grip.force(at, document.positions()).norm());
      simulation_step(session, {grip.spring(at, document.positions())}, document.state().time_step);
      channel.publish(felt(grip, at, document.positions(), tick + life));
    }
  }
  State next = document.state();
  next.tick_carry = std::max(0.0, pending);
  report_guard(session, first_step);
  session.print(fmt::format("pulled with up to {:.3g} N", largest));
  const ToolForce force{grip.held(document.positions()), grip.force(device_now, document.positions())};
  session.change(std::move(next));
  session.show_tool_force(force);
}

}  // namespace

std::vector<Command> tool_commands() {
  return {
      {.name = "tool",
       .summary = "Chooses the force tool that strokes use, and its brush.",
       .parameters = {{.name = "tool",
                       .type = ArgumentType::word,
                       .help = "pull: a spring from the device to what it touched; "
                               "a stroke into the solid pushes",
                       .positional = true,
                       .required = true,
                       .choices = {"pull"}},
                      {.name = "radius", .help = "of what it touches", .unit = "m", .low = 1e-9, .high = 1e9},
                      {.name = "strength", .help = "of the spring", .unit = "N/m", .low = 1e-9, .high = 1e12},
                      {.name = "limit", .help = "largest force", .unit = "N", .low = 1e-12, .high = 1e12},
                      {.name = "falloff",
                       .type = ArgumentType::word,
                       .help = "towards the rim",
                       .choices = {"smooth", "linear", "constant"}}},
       .example = "tool pull radius 0.15 strength 40",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1"},
       .run = set_tool},
      {.name = "stroke",
       .summary = "Moves the device along a line with the tool held on; the simulation advances with it.",
       .parameters = {{.name = "from",
                       .help = "where the tool takes hold of the surface",
                       .unit = "m",
                       .count = 3,
                       .required = true,
                       .low = -1e9,
                       .high = 1e9},
                      {.name = "to",
                       .help = "where the device goes",
                       .unit = "m",
                       .count = 3,
                       .required = true,
                       .low = -1e9,
                       .high = 1e9},
                      {.name = "ticks",
                       .type = ArgumentType::integer,
                       .help = "milliseconds on the way",
                       .required = true,
                       .low = 1,
                       .high = 1e7},
                      {.name = "hold",
                       .type = ArgumentType::integer,
                       .help = "milliseconds held at the end",
                       .low = 0,
                       .high = 1e7},
                      {.name = "ease",
                       .type = ArgumentType::word,
                       .help = "speed along the way",
                       .choices = {"linear", "smooth"}},
                      {.name = "device",
                       .type = ArgumentType::word,
                       .help = "scripted: follows the line exactly; hand: a simulated hand that feels the force",
                       .choices = {"scripted", "hand"}}},
       .example = "stroke from 0.3 0.3 0.1 to 0.3 0.3 -0.05 ticks 100",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1", "levels 1", "pin where x < 0.01",
                  "tool pull radius 0.15 strength 40"},
       .run = stroke},
  };
}

}  // namespace argil::sculpt
