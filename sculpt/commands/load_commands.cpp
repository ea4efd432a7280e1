#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/commands/named_forces.h"
#include "sculpt/document_loads.h"
#include "sculpt/region.h"
#include "sculpt/session.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

void pin(Session& session, const Arguments& arguments) {
  constexpr ElementType types[] = {ElementType::vertices, ElementType::edges, ElementType::faces,
                                   ElementType::cells, ElementType::nodes};
  const Selection selection = acted_on(session, arguments, types);
  const Document& document = session.document();
  State next = document.state();
  auto pins = std::make_shared<Pins>(*next.pins);
  const bool off = arguments.has("off");
  if (off && arguments.has("stiffness"))
    throw Error(ErrorCode::bad_input, "what is released has no stiffness; leave it out");
  if (selection.type == ElementType::nodes) {
    std::erase_if(pins->nodes, [&](const SoftPin& p) {
      return std::binary_search(selection.ids.begin(), selection.ids.end(), p.node);
    });
    if (!off) {
      if (!arguments.has("stiffness"))
        throw Error(ErrorCode::bad_input,
                    "a refined node is pinned by a spring: give its stiffness, as in `pin stiffness 1e5`");
      const Eigen::Matrix3Xd now = document.surface_nodes(document.positions());
      const double time = next.motion->time;
      for (const std::uint32_t node : selection.ids) {
        const PinMotion* motion = motion_of(*pins, ElementType::nodes, node);
        pins->nodes.push_back(
            {node, arguments.number("stiffness"),
             motion ? target_before(*motion, now.col(node), time) : Eigen::Vector3d(now.col(node))});
      }
      std::sort(pins->nodes.begin(), pins->nodes.end(),
                [](const SoftPin& a, const SoftPin& b) { return a.node < b.node; });
    }
    session.print(fmt::format("{} {}", count_of(selection.ids.size(), ElementType::nodes),
                              off ? "released" : "held by springs"));
  } else {
    if (arguments.has("stiffness"))
      throw Error(ErrorCode::bad_input,
                  "a stiffness is for nodes (`select nodes where …`); control points are pinned exactly");
    const auto vertices = vertices_of(document, selection);
    std::vector<std::uint32_t> result;
    auto& old = pins->control_points;
    if (off)
      std::set_difference(old.begin(), old.end(), vertices.begin(), vertices.end(), std::back_inserter(result));
    else
      std::set_union(old.begin(), old.end(), vertices.begin(), vertices.end(), std::back_inserter(result));
    old = std::move(result);
    auto motion = std::make_shared<fem::BodyState>(*next.motion);
    if (!off)
      for (const std::uint32_t v : vertices) {
        motion->velocities.col(v).setZero();
        if (motion->previous_positions.cols() > 0) {
          motion->previous_positions.col(v) = motion->positions.col(v);
          motion->previous_velocities.col(v).setZero();
        }
        if (motion->accelerations.cols() > 0) motion->accelerations.col(v).setZero();
      }
    next.motion = motion;
    session.print(
        fmt::format("{} {}", count_of(vertices.size(), ElementType::vertices), off ? "released" : "pinned"));
  }
  next.pins = pins;
  session.change(std::move(next));
}

void set_gravity(Session& session, const Arguments& arguments) {
  require_solid(session);
  State next = session.document().state();
  auto loads = std::make_shared<AppliedLoads>(*next.loads);
  loads->gravity = arguments.vector("acceleration");
  if (!loads->gravity_track.empty()) session.print("the keys of gravity are gone: it is the same at all times now");
  loads->gravity_track = {};
  next.loads = loads;
  session.change(std::move(next));
}

/// What `force` acts on, by its arguments or the selection.
AppliedForce read_force(const Session& session, const Arguments& arguments) {
  AppliedForce applied;
  applied.force = arguments.vector("force");
  applied.name = arguments.word("as", "");
  if (arguments.has("at")) {
    applied.point = arguments.vector("at");
    (void)material_point(session.document(), applied.point);  // must lie inside
    return applied;
  }
  const ElementType type = arguments.has("through") ? ElementType::cells : ElementType::faces;
  auto& ids = type == ElementType::cells ? applied.cells : applied.faces;
  ids = acted_on(session, arguments, std::span(&type, 1)).ids;
  for (const std::uint32_t f : applied.faces)
    if (!session.document().solid().is_boundary(subdiv::FaceId{f}))
      throw Error(
          ErrorCode::bad_input,
          fmt::format("face {} is inside the solid; a force is spread over boundary faces, `through` cells, or "
                      "acts `at` a point inside",
                      f));
  return applied;
}

void clear_forces(const Arguments& arguments, std::vector<AppliedForce>& forces) {
  for (const char* other : {"force", "at", "through", "where"})
    if (arguments.has(other))
      throw Error(ErrorCode::bad_input, "`force clear` takes forces away; give a new one on a line of its own");
  if (!arguments.has("as")) {
    forces.clear();
    return;
  }
  const std::string& name = arguments.word("as");
  if (std::erase_if(forces, [&](const AppliedForce& force) { return force.name == name; }) == 0)
    throw Error(ErrorCode::not_found, no_such_force(forces, name));
}

void apply_force(Session& session, const Arguments& arguments) {
  require_solid(session);
  State next = session.document().state();
  auto loads = std::make_shared<AppliedLoads>(*next.loads);
  if (arguments.has("clear")) {
    clear_forces(arguments, loads->forces);
  } else {
    if (arguments.has("at") && (arguments.has("where") || arguments.has("through")))
      throw Error(ErrorCode::bad_input,
                  "a force acts at a point, on faces or through cells; leave out `at`, or `where` and `through`");
    if (!arguments.has("force"))
      throw Error(ErrorCode::bad_input,
                  "force wants its three components, as in `force 0 0 -10 where z > 0.9`, or `clear`");
    AppliedForce applied = read_force(session, arguments);
    const auto same = std::find_if(loads->forces.begin(), loads->forces.end(), [&](const AppliedForce& force) {
      return !applied.name.empty() && force.name == applied.name;
    });
    if (same != loads->forces.end())
      *same = std::move(applied);
    else
      loads->forces.push_back(std::move(applied));
  }
  next.loads = loads;
  session.change(std::move(next));
}

void apply_pressure(Session& session, const Arguments& arguments) {
  require_solid(session);
  State next = session.document().state();
  auto loads = std::make_shared<AppliedLoads>(*next.loads);
  auto& pressures = loads->pressures;
  const std::string name = arguments.word("as", "");
  if (arguments.has("clear")) {
    for (const char* other : {"pressure", "where"})
      if (arguments.has(other))
        throw Error(ErrorCode::bad_input,
                    "`pressure clear` takes pressures away; give a new one on a line of its own");
    if (name.empty())
      pressures.clear();
    else if (std::erase_if(pressures, [&](const AppliedPressure& pressure) { return pressure.name == name; }) == 0)
      throw Error(ErrorCode::not_found, no_such_pressure(pressures, name));
  } else {
    if (!arguments.has("pressure"))
      throw Error(ErrorCode::bad_input, "pressure wants its size, as in `pressure 500 where z > 0.9`, or `clear`");
    AppliedPressure applied;
    applied.pressure = arguments.number("pressure");
    applied.name = name;
    constexpr ElementType type = ElementType::faces;
    applied.faces = acted_on(session, arguments, std::span(&type, 1)).ids;
    for (const std::uint32_t f : applied.faces)
      if (!session.document().solid().is_boundary(subdiv::FaceId{f}))
        throw Error(
            ErrorCode::bad_input,
            fmt::format("face {} is inside the solid; pressure acts on the boundary. For pressure from within "
                        "matter set the field `prestress`",
                        f));
    session.print(fmt::format("{} under {:g} Pa", count_of(applied.faces.size(), type), applied.pressure));
    const auto same = std::find_if(pressures.begin(), pressures.end(), [&](const AppliedPressure& pressure) {
      return !name.empty() && pressure.name == name;
    });
    if (same != pressures.end())
      *same = std::move(applied);
    else
      pressures.push_back(std::move(applied));
  }
  next.loads = loads;
  session.change(std::move(next));
}

}  // namespace

std::vector<Command> load_commands() {
  return {
      {.name = "pin",
       .summary = "Holds the selected control points exactly where they are, or the selected nodes by springs.",
       .parameters = {{.name = "off", .help = "release instead", .flag = true},
                      {.name = "stiffness",
                       .help = "of the springs that hold nodes",
                       .unit = "N/m",
                       .low = 1e-9,
                       .high = 1e15},
                      {.name = "where",
                       .type = ArgumentType::expression,
                       .help = "the control vertices; else what is selected"}},
       .example = "pin where x < 0.01",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1"},
       .run = pin},
      {.name = "gravity",
       .summary = "The acceleration that acts on every mass.",
       .parameters = {{.name = "acceleration",
                       .help = "its components",
                       .unit = "m/s^2",
                       .count = 3,
                       .positional = true,
                       .required = true,
                       .low = -1e6,
                       .high = 1e6}},
       .example = "gravity 0 0 -9.81",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1"},
       .run = set_gravity},
      {.name = "force",
       .summary =
           "A force in total, spread over boundary faces by area, through cells by volume, or acting at a point "
           "inside; it stays until cleared. One with a name can be keyed over time; given again it is "
           "replaced.",
       .parameters = {{.name = "force",
                       .help = "its components",
                       .unit = "N",
                       .count = 3,
                       .positional = true,
                       .low = -1e12,
                       .high = 1e12},
                      {.name = "at", .help = "a material point, by its rest position", .unit = "m", .count = 3},
                      {.name = "through", .help = "spread it through cells, not over faces", .flag = true},
                      {.name = "as", .type = ArgumentType::text, .help = "its name, for `key force`"},
                      {.name = "clear", .help = "take all forces away, or with `as` that one", .flag = true},
                      {.name = "where",
                       .type = ArgumentType::expression,
                       .help = "the faces, or cells; else those selected"}},
       .example = "force 0 0 -10 where z > 0.09",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1"},
       .run = apply_force},
      {.name = "pressure",
       .summary =
           "A pressure on boundary faces that follows them: along the normal and on the area that they have at the "
           "moment. It stays until cleared. Positive pushes against the face, negative draws it outwards; on the "
           "walls "
           "of a hollow, positive inflates. One with a name can be keyed over time; given again it is replaced.",
       .parameters =
           {{.name = "pressure", .help = "how much", .unit = "Pa", .positional = true, .low = -1e12, .high = 1e12},
            {.name = "as", .type = ArgumentType::text, .help = "its name, for `key pressure`"},
            {.name = "clear", .help = "take all pressures away, or with `as` that one", .flag = true},
            {.name = "where", .type = ArgumentType::expression, .help = "the faces; else those selected"}},
       .example = "pressure 500 as wind where z > 0.09",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1"},
       .run = apply_pressure},
  };
}

}  // namespace argil::sculpt
