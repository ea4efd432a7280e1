#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/near_names.h"
#include "sculpt/obstacles.h"
#include "sculpt/session.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

/// Which arguments each shape takes.
struct ShapeArguments {
  std::string name;
  std::vector<std::string> required, optional;
};
const std::vector<ShapeArguments>& shape_arguments() {
  static const std::vector<ShapeArguments> all{{"plane", {}, {"at", "normal"}},
                                               {"sphere", {"radius"}, {"at"}},
                                               {"box", {"size"}, {"at", "axis", "rotate"}},
                                               {"capsule", {"from", "to", "radius"}, {}}};
  return all;
}

constexpr std::array k_of_shapes{"at", "normal", "radius", "size", "axis", "rotate", "from", "to"};

void check_arguments(const std::string& shape, const Arguments& arguments) {
  for (const ShapeArguments& takes : shape_arguments()) {
    if (takes.name != shape) continue;
    for (const std::string& name : takes.required)
      if (!arguments.has(name))
        throw Error(ErrorCode::bad_input, fmt::format("a {} wants its {}; {} is missing", shape,
                                                      fmt::join(takes.required, " and "), name));
    for (const char* name : k_of_shapes) {
      const bool takes_it = std::ranges::find(takes.required, name) != takes.required.end() ||
                            std::ranges::find(takes.optional, name) != takes.optional.end();
      if (!takes_it && arguments.has(name))
        throw Error(ErrorCode::bad_input, fmt::format("a {} has no {}; leave it out", shape, name));
    }
  }
}

Eigen::Vector3d direction(const Eigen::Vector3d& v, const std::string& of) {
  const double length = v.norm();
  if (!(length > 0))
    throw Error(ErrorCode::bad_input, fmt::format("{} has no length; give a direction, as in 0 0 1", of));
  return v / length;
}

Eigen::Quaterniond turning_z_to(const Eigen::Vector3d& axis) {
  return Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), axis).normalized();
}

fem::Obstacle read_shape(const std::string& shape, const Arguments& arguments) {
  check_arguments(shape, arguments);
  fem::Obstacle body;
  body.position = arguments.vector("at", Eigen::Vector3d::Zero());
  if (shape == "plane") {
    body.shape = fem::ObstacleShape::plane;
    body.orientation = turning_z_to(direction(arguments.vector("normal", Eigen::Vector3d::UnitZ()), "the normal"));
  } else if (shape == "sphere") {
    body.shape = fem::ObstacleShape::sphere;
    body.size[0] = arguments.number("radius");
  } else if (shape == "box") {
    body.shape = fem::ObstacleShape::box;
    body.size = 0.5 * arguments.vector("size");
    if (arguments.has("axis") != arguments.has("rotate"))
      throw Error(ErrorCode::bad_input, "a turned box wants both `axis X Y Z` and `rotate DEGREES`");
    if (arguments.has("axis"))
      body.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(arguments.number("rotate") * M_PI / 180,
                                                              direction(arguments.vector("axis"), "the axis")));
  } else {
    body.shape = fem::ObstacleShape::capsule;
    const Eigen::Vector3d from = arguments.vector("from"), to = arguments.vector("to");
    body.position = 0.5 * (from + to);
    body.orientation = turning_z_to(direction(to - from, "the axis of a capsule"));
    body.size[0] = arguments.number("radius");
    body.size[1] = 0.5 * (to - from).norm();
  }
  return body;
}

// Of the body's longest side: a depth that contact itself does not come to, but where an obstacle was put over it.
constexpr double k_overlap = 0.01;
constexpr double k_push_out = 0.5;  // [s] in which it then leaves, as far as its own longest side

/// Softens what an obstacle does that stands in the body from the beginning, and says so.
void meet_overlap(Session& session, State& next, const NamedObstacle& obstacle) {
  const Document& document = session.document();
  fem::Contact contact;
  try {
    contact.surface = document.contact_surface();
  } catch (const Error&) {
    return;  // a body that cannot be simulated yet, which the first step will say
  }
  const double time = next.motion->time;
  contact.obstacles = moving_obstacles(next, time);
  const fem::Overlap overlap = fem::overlap(contact, *next.motion, obstacle.body.id);
  const Eigen::Matrix3Xd& rest = document.rest();
  const double size = (rest.rowwise().maxCoeff() - rest.rowwise().minCoeff()).maxCoeff();
  if (!(overlap.depth > k_overlap * size)) return;
  const double duration = k_push_out * std::max(1.0, overlap.depth / size);
  auto motion = std::make_shared<fem::BodyState>(*next.motion);
  fem::allow_overlap(contact, *motion, obstacle.body.id, duration);
  next.motion = motion;
  session.print(fmt::format(
      "note: the body is in {} already, {} of its {} contact points, the deepest by {:.4g} m; the "
      "obstacle pushes it "
      "out over the next {:.3g} s, at {:.4g} m/s and not by the force of that depth. `undo` and place it "
      "elsewhere if "
      "that is not meant",
      obstacle.name, overlap.points, contact.surface->point_count(), overlap.depth, duration,
      overlap.depth / duration));
}

void set_obstacle(Session& session, const Arguments& arguments) {
  require_solid(session);
  const std::string& name = arguments.word("name");
  const std::string& what = arguments.word("shape");
  State next = session.document().state();
  const NamedObstacle* before = find_obstacle(next, name);
  if (what == "remove") {
    for (const char* other : k_of_shapes)
      if (arguments.has(other))
        throw Error(ErrorCode::bad_input, fmt::format("what is removed needs no {}; leave it out", other));
    if (arguments.has("friction") || arguments.has("stiffness"))
      throw Error(ErrorCode::bad_input, "what is removed needs no friction or stiffness; leave them out");
    if (!before) {
      std::vector<std::string> names;
      if (next.obstacles)
        for (const NamedObstacle& obstacle : *next.obstacles) names.push_back(obstacle.name);
      throw Error(ErrorCode::not_found, names.empty()
                                            ? fmt::format("there is no obstacle '{}', nor any other", name)
                                            : fmt::format("there is no obstacle '{}'{}; there are {}", name,
                                                          near_names_hint(name, names), fmt::join(names, ", ")));
    }
    remove_obstacle(next, name);
    session.print(fmt::format("{} is gone", name));
    session.change(std::move(next));
    return;
  }
  NamedObstacle obstacle{name, read_shape(what, arguments)};
  obstacle.body.friction = arguments.number("friction", 0);
  obstacle.body.stiffness = arguments.number("stiffness", 0);
  session.print(description(obstacle) + (before ? "; in place of the one before" : ""));
  put_obstacle(next, std::move(obstacle));
  meet_overlap(session, next, *find_obstacle(next, name));
  session.change(std::move(next));
}

void set_plasticity(Session& session, const Arguments& arguments) {
  require_solid(session);
  State next = session.document().state();
  if (arguments.has("off")) {
    if (arguments.has("yield") || arguments.has("creep"))
      throw Error(ErrorCode::bad_input, "`plasticity off` takes nothing else; leave out yield and creep");
    next.plasticity = {};
    session.print(next.flow ? "the body flows no more and keeps the shape to which it has flowed"
                            : "the body is elastic");
  } else {
    if (!arguments.has("yield") && !arguments.has("creep"))
      throw Error(
          ErrorCode::bad_input,
          "plasticity wants a yield stress, a time of creep or both, as in `plasticity yield 2000 creep 0.1`, "
          "or `off`");
    fem::check_flow(next.model);
    next.plasticity = {true, {arguments.number("yield", 0), arguments.number("creep", 0)}};
    if (next.plasticity.law.yield == 0 && next.plasticity.law.relaxation == 0)
      throw Error(
          ErrorCode::bad_input,
          "with neither a yield stress nor a time of creep the body would hold no shear at all; give one of "
          "them a value above 0");
  }
  session.change(std::move(next));
}

}  // namespace

std::vector<Command> obstacle_commands() {
  return {
      {.name = "obstacle",
       .summary =
           "A rigid obstacle that the boundary cannot enter, with Coulomb friction. A point at depth d is "
           "pushed out by the pressure stiffness · d; nothing acts before it touches. One that is put over the "
           "body "
           "pushes it out over half a second, and says so. One of the same name is replaced; `remove` takes it "
           "away.",
       .parameters =
           {{.name = "name", .type = ArgumentType::word, .help = "any word", .positional = true, .required = true},
            {.name = "shape",
             .type = ArgumentType::word,
             .help = "what it is; or remove",
             .positional = true,
             .required = true,
             .choices = {"plane", "sphere", "box", "capsule", "remove"}},
            {.name = "at",
             .help = "a point of a plane, the middle of a sphere or box",
             .unit = "m",
             .count = 3,
             .low = -1e6,
             .high = 1e6},
            {.name = "normal",
             .help = "of a plane, to the side of the body; else 0 0 1",
             .count = 3,
             .low = -1e6,
             .high = 1e6},
            {.name = "radius", .help = "of a sphere or capsule", .unit = "m", .low = 1e-6, .high = 1e6},
            {.name = "size", .help = "edges of a box", .unit = "m", .count = 3, .low = 1e-6, .high = 1e6},
            {.name = "axis",
             .help = "about which a box is turned in its middle",
             .count = 3,
             .low = -1e6,
             .high = 1e6},
            {.name = "rotate", .help = "by which it is", .unit = "degrees", .low = -360, .high = 360},
            {.name = "from",
             .help = "one end of a capsule's axis",
             .unit = "m",
             .count = 3,
             .low = -1e6,
             .high = 1e6},
            {.name = "to", .help = "its other end", .unit = "m", .count = 3, .low = -1e6, .high = 1e6},
            {.name = "friction", .help = "Coulomb's coefficient; else 0", .low = 0, .high = 100},
            {.name = "stiffness",
             .help = "pressure a depth; else ten times Young's modulus over the width of a face, so that the body "
                     "sinks in by less than its cells give way",
             .unit = "Pa/m",
             .low = 1e-3,
             .high = 1e18}},
       .example = "obstacle floor plane at 0 0 -0.2 friction 0.5",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1"},
       .run = set_obstacle},
      {.name = "plasticity",
       .summary =
           "Lets the body flow and keep its new shape: where the von Mises stress exceeds the yield stress, "
           "the excess fades with the time of creep. Creep alone makes a fluid that forgets its shape, yield "
           "alone a plastic body. Volume is kept. `commit` makes the shape the rest shape and forgets the "
           "flow.",
       .parameters =
           {{.name = "off", .help = "elastic again; what has flowed stays", .flag = true},
            {.name = "yield", .help = "yield stress; else 0", .unit = "Pa", .low = 0, .high = 1e13},
            {.name = "creep", .help = "time of creep; else 0, at once", .unit = "s", .low = 0, .high = 1e9}},
       .example = "plasticity yield 2000 creep 0.1",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1"},
       .run = set_plasticity},
  };
}

}  // namespace argil::sculpt
