#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "io/volume_mesh.h"
#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/field_transfer.h"
#include "sculpt/region.h"
#include "sculpt/session.h"
#include "subdiv/disjoint_sets.h"
#include "subdiv/edit/extrude.h"
#include "subdiv/edit/sharpen.h"
#include "subdiv/error.h"
#include "subdiv/primitives.h"
#include "subdiv/radial_edge.h"
#include "subdiv/solid_measures.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

constexpr ElementType k_faces[] = {ElementType::faces};
constexpr ElementType k_cells[] = {ElementType::cells};

// A new solid begins a new document: level 0, initial fields, nothing pinned.
State state_of(Built built) {
  State state;
  state.solid = std::make_shared<Solid>(std::move(built.solid));
  auto motion = std::make_shared<fem::BodyState>();
  motion->positions = built.positions;
  motion->velocities = Eigen::Matrix3Xd::Zero(3, built.positions.cols());
  state.motion = motion;
  state.rest = std::make_shared<Eigen::Matrix3Xd>(std::move(built.positions));
  state.fields = initial_fields(state.solid->vertex_capacity());
  state.pins = std::make_shared<Pins>();
  state.loads = std::make_shared<AppliedLoads>();
  state.selection = std::make_shared<Selection>();
  state.sets = std::make_shared<std::map<std::string, Selection>>();
  return state;
}

// Topology, stencils, elements and one step of a box of 373,248 cells took 2.5 GB.
constexpr double k_bytes_per_cell = 7000;

void check_cells(const Session& session, double cells) {
  const Limits& limits = session.options().limits;
  if (cells > static_cast<double>(limits.cells))
    throw Error(ErrorCode::limit_exceeded,
                fmt::format("this makes {:.0f} cells, more than {}; lower the level or the counts, "
                            "or raise --max-cells",
                            cells, limits.cells));
  if (k_bytes_per_cell * cells > static_cast<double>(limits.memory))
    throw Error(ErrorCode::limit_exceeded,
                fmt::format("{:.0f} cells would need about {:.2g} GB; lower the level or the counts, "
                            "or raise --max-memory",
                            cells, 1e-9 * k_bytes_per_cell * cells));
}

void new_solid(Session& session, const Arguments& arguments) {
  const std::string shape = arguments.word("shape");
  const Eigen::Vector3d size = arguments.vector("size", Eigen::Vector3d::Ones());
  Built built;
  if (shape == "box") {
    const int n[] = {static_cast<int>(arguments.integer("nx", 1)), static_cast<int>(arguments.integer("ny", 1)),
                     static_cast<int>(arguments.integer("nz", 1))};
    check_cells(session, double(n[0]) * n[1] * n[2]);
    built = box_grid(n[0], n[1], n[2], size);
  } else {
    if (arguments.has("nx"))
      throw Error(ErrorCode::bad_input, fmt::format("a {} has no counts; only a box has", shape));
    built = shape == "tetrahedron" ? tetrahedron(size) : shape == "wedge" ? wedge(size) : pyramid(size);
  }
  built.positions.colwise() += arguments.vector("at", Eigen::Vector3d::Zero());
  session.change(state_of(std::move(built)));
}

void open(Session& session, const Arguments& arguments) {
  const io::VolumeMesh mesh = io::read_volume_mesh(session.path_to_read(arguments.word("file")));
  check_cells(session, static_cast<double>(mesh.cells.cell_count()));
  Built built = build(mesh.cells);
  const auto unused = static_cast<std::size_t>(mesh.cells.positions.cols()) - built.point_from_vertex.size();
  if (unused > 0) session.print(fmt::format("{} points belong to no cell and were left out", unused));
  const auto point_from_vertex = built.point_from_vertex;
  State next = state_of(std::move(built));
  auto fields = std::make_shared<Fields>(*next.fields);
  for (const io::NamedField& held : mesh.point_fields) {
    for (const FieldInfo& info : field_table()) {
      if (held.name != info.word || held.components != 1) continue;
      for (std::size_t v = 0; v < point_from_vertex.size(); ++v) {
        const double value = held.values[point_from_vertex[v]];
        if (!(value >= info.low && value <= info.high))
          throw Error(ErrorCode::bad_input,
                      fmt::format("{} of point {} is {:g}; it must lie between {:g} and {:g}", info.word,
                                  point_from_vertex[v], value, info.low, info.high));
        (*fields)[info.name][static_cast<Eigen::Index>(v)] = value;
      }
    }
  }
  next.fields = fields;
  session.change(std::move(next));
}

// The area-weighted mean of the outward normals of some boundary faces.
Eigen::Vector3d mean_normal(const Solid& solid, const Eigen::Matrix3Xd& positions,
                            const std::vector<std::uint32_t>& faces) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::uint32_t id : faces) {
    const auto loop = use_vertices(solid, solid.boundary_use(FaceId{id}));
    for (std::size_t i = 0; i < loop.size(); ++i)
      sum += positions.col(static_cast<Eigen::Index>(loop[i].index()))
                 .cross(positions.col(static_cast<Eigen::Index>(loop[(i + 1) % loop.size()].index())));
  }
  if (sum.norm() < 1e-300)
    throw Error(ErrorCode::bad_geometry, "the faces have no common direction; give one with `along X Y Z`");
  return sum.normalized();
}

// For every vertex of a region the middle of its patch, the faces connected through shared vertices: four legs that
// are extruded together taper each about its own axis.
std::map<VertexId, Eigen::Vector3d> patch_middles(const Solid& solid, const std::vector<FaceId>& faces,
                                                  const Eigen::Matrix3Xd& positions) {
  DisjointSets patches(solid.vertex_capacity());
  std::map<std::uint32_t, std::pair<Eigen::Vector3d, double>> sums;
  std::map<VertexId, Eigen::Vector3d> middles;
  for (const FaceId f : faces)
    for (const VertexId v : solid.face_vertices(f)) {
      patches.unite(v.value, solid.face_vertices(f)[0].value);
      middles.try_emplace(v, Eigen::Vector3d::Zero());
    }
  for (const auto& [v, unused] : middles) {
    auto& [sum, count] = sums.try_emplace(patches.find(v.value), Eigen::Vector3d::Zero(), 0.0).first->second;
    sum += positions.col(static_cast<Eigen::Index>(v.index()));
    count += 1;
  }
  for (auto& [v, middle] : middles) {
    const auto& [sum, count] = sums.at(patches.find(v.value));
    middle = sum / count;
  }
  return middles;
}

void extrude_faces(Session& session, const Arguments& arguments) {
  const Selection selection = acted_on(session, arguments, k_faces);
  const int steps = static_cast<int>(arguments.integer("steps", 1));
  check_cells(session, static_cast<double>(session.document().solid().cell_count()) +
                           static_cast<double>(steps) * static_cast<double>(selection.ids.size()));
  const double distance = arguments.number("distance");
  const double scale = arguments.number("scale", 1);
  std::vector<FaceId> faces;
  for (const std::uint32_t id : selection.ids) {
    if (!session.document().solid().is_boundary(FaceId{id}))
      throw Error(ErrorCode::bad_input,
                  fmt::format("face {} is inside the solid; only boundary faces extrude", id));
    faces.emplace_back(id);
  }
  edit_topology(session, [&](Transaction& transaction, Eigen::Matrix3Xd& rest, Eigen::Matrix3Xd& present,
                             Selection& selected) {
    Eigen::Vector3d direction = arguments.vector("along", Eigen::Vector3d::Zero());
    if (!arguments.has("along")) direction = mean_normal(session.document().solid(), rest, selection.ids);
    if (!(direction.norm() > 0)) throw Error(ErrorCode::bad_input, "the direction is zero");
    const Eigen::Vector3d shift = distance * direction.normalized();
    const Extrusion grown = extrude(transaction, faces, steps);
    const auto middle = patch_middles(transaction.solid(), faces, rest);
    const auto vertices = static_cast<Eigen::Index>(transaction.solid().vertex_capacity());
    rest.conservativeResize(3, vertices);
    present.conservativeResize(3, vertices);
    for (std::size_t i = 0; i < grown.new_vertices.size(); ++i) {
      const auto source = static_cast<Eigen::Index>(grown.source_of_new[i].index());
      const auto made = static_cast<Eigen::Index>(grown.new_vertices[i].index());
      const double part = static_cast<double>(grown.step_of_new[i]) / steps;
      const Eigen::Vector3d offset =
          part * shift + part * (scale - 1) * (rest.col(source) - middle.at(grown.source_of_new[i]));
      rest.col(made) = rest.col(source) + offset;
      present.col(made) = present.col(source) + offset;
    }
    // The caps become the selection, so that one extrusion can follow another.
    selected = {ElementType::faces, {}};
    for (const FaceId cap : grown.caps) selected.ids.push_back(cap.value);
  });
}

void raise_peaks(Session& session, const Arguments& arguments) {
  const Selection selection = acted_on(session, arguments, k_faces);
  const double height = arguments.number("height");
  edit_topology(session, [&](Transaction& transaction, Eigen::Matrix3Xd& rest, Eigen::Matrix3Xd& present,
                             Selection& selected) {
    for (const std::uint32_t id : selection.ids) {
      const Solid& solid = transaction.solid();
      const FaceId face{id};
      if (!solid.is_boundary(face))
        throw Error(ErrorCode::bad_input,
                    fmt::format("face {} is inside the solid; only boundary faces grow a peak", id));
      const std::vector<VertexId> loop = use_vertices(solid, solid.boundary_use(face));
      Eigen::Vector3d centre_rest = Eigen::Vector3d::Zero(), centre_present = Eigen::Vector3d::Zero();
      for (const VertexId v : loop) {
        centre_rest += rest.col(static_cast<Eigen::Index>(v.index())) / static_cast<double>(loop.size());
        centre_present += present.col(static_cast<Eigen::Index>(v.index())) / static_cast<double>(loop.size());
      }
      const Eigen::Vector3d offset = height * mean_normal(solid, rest, {id});
      const VertexId apex = transaction.add_vertex();
      rest.conservativeResize(3, rest.cols() + 1);
      present.conservativeResize(3, present.cols() + 1);
      rest.rightCols<1>() = centre_rest + offset;
      present.rightCols<1>() = centre_present + offset;
      std::vector<std::vector<VertexId>> loops{{loop.rbegin(), loop.rend()}};
      for (std::size_t i = 0; i < loop.size(); ++i) loops.push_back({loop[i], loop[(i + 1) % loop.size()], apex});
      transaction.add_cell(loops);
    }
    selected = {ElementType::faces, {}};
  });
}

void remove_cells(Session& session, const Arguments& arguments) {
  const Selection selection = acted_on(session, arguments, k_cells);
  edit_topology(session, [&](Transaction& transaction, Eigen::Matrix3Xd&, Eigen::Matrix3Xd&, Selection&) {
    for (const std::uint32_t id : selection.ids) transaction.remove_cell(CellId{id});
  });
}

void move(Session& session, const Arguments& arguments) {
  constexpr ElementType movable[] = {ElementType::vertices, ElementType::edges, ElementType::faces,
                                     ElementType::cells};
  const Selection selection = acted_on(session, arguments, movable);
  const Eigen::Vector3d shift = arguments.vector("by");
  State next = session.document().state();
  auto rest = std::make_shared<Eigen::Matrix3Xd>(*next.rest);
  auto motion = std::make_shared<fem::BodyState>(*next.motion);
  for (const std::uint32_t v : vertices_of(session.document(), selection)) {
    rest->col(v) += shift;
    motion->positions.col(v) += shift;
    if (motion->previous_positions.cols() > 0) motion->previous_positions.col(v) += shift;
  }
  next.rest = rest;
  next.motion = motion;
  session.change(std::move(next));
}

void sharpen_elements(Session& session, const Arguments& arguments) {
  constexpr ElementType types[] = {ElementType::edges, ElementType::vertices};
  const Selection selection = acted_on(session, arguments, types);
  const double value = arguments.number("value", k_infinitely_sharp);
  edit_topology(session, [&](Transaction& transaction, Eigen::Matrix3Xd&, Eigen::Matrix3Xd&, Selection&) {
    if (selection.type == ElementType::edges) {
      const std::vector<EdgeId> edges(selection.ids.begin(), selection.ids.end());
      sharpen(transaction, edges, value);
    } else {
      const std::vector<VertexId> vertices(selection.ids.begin(), selection.ids.end());
      sharpen(transaction, vertices, value);
    }
  });
}

void set_level(Session& session, const Arguments& arguments) {
  require_solid(session);
  Document& document = session.document();
  State next = document.state();
  const int level = static_cast<int>(arguments.integer("level", 0));
  check_cells(session, static_cast<double>(refined_cell_count(document.solid(), level)));
  if (level == next.level) {
    session.change(std::move(next));
    return;
  }
  const Refinement before = document.refinement();
  next.level = level;
  const std::shared_ptr<const Fields> old_fields = next.fields;
  document.assign(next);  // refine at the new level; a failure puts the old state back
  const Refinement& after = document.refinement();
  next.fields = fields_at_level(*old_fields, before, after);
  const auto node_map = nodes_at_level(before, after);
  auto pins = std::make_shared<Pins>(*next.pins);
  for (SoftPin& pin : pins->nodes) pin.node = node_map[pin.node];
  const auto lost = std::erase_if(pins->nodes, [](const SoftPin& pin) { return pin.node == k_no_node; });
  if (lost > 0)
    session.print(fmt::format("{} pinned nodes do not exist at level {} and are free now", lost, level));
  next.pins = pins;
  const auto carry = [&](const Selection& selection) {
    Selection result = selection;
    if (selection.type != ElementType::nodes) return result;
    for (auto& id : result.ids) id = node_map[id];
    std::erase(result.ids, k_no_node);
    std::sort(result.ids.begin(), result.ids.end());
    return result;
  };
  next.selection = std::make_shared<Selection>(carry(*next.selection));
  auto sets = std::make_shared<std::map<std::string, Selection>>();
  for (const auto& [name, set] : *next.sets) (*sets)[name] = carry(set);
  next.sets = sets;
  document.assign(next);
  if (level > 0) {
    check_discretization(session);
    const double kept =
        document.discretization().rest_volume / mass_properties(document.solid(), document.rest()).volume;
    if (kept < 0.6)
      session.print(fmt::format(
          "refinement keeps {:.0f} % of the volume; sharpen edges or begin with more cells to keep more",
          100 * kept));
    if (document.solid().cell_count() == 1 && document.solid().vertex_count() == 8)
      session.print("a lone hexahedron cannot move in all its ways once it is refined; begin with `new box 2 2 2`");
  }
  session.change(std::move(next));
}

void set_space(Session& session, const Arguments& arguments) {
  require_solid(session);
  State next = session.document().state();
  next.space = arguments.word("space") == "cubic" ? fem::Space::cubic : fem::Space::standard;
  next.split = static_cast<int>(arguments.integer("split", next.split));
  session.change(std::move(next));
}

}  // namespace

std::vector<Command> shape_commands() {
  const Parameter where_faces{
      .name = "where", .type = ArgumentType::expression, .help = "the faces, by a condition; else those selected"};
  return {
      {.name = "new",
       .summary = "Begins a new solid from a base shape; its lowest corner stands at the origin unless `at` says "
                  "otherwise.",
       .parameters = {{.name = "shape",
                       .type = ArgumentType::word,
                       .help = "what to begin with",
                       .positional = true,
                       .required = true,
                       .choices = {"box", "tetrahedron", "wedge", "pyramid"}},
                      {.name = "nx",
                       .type = ArgumentType::integer,
                       .help = "cells of a box along x",
                       .positional = true,
                       .low = 1,
                       .high = 1000},
                      {.name = "ny",
                       .type = ArgumentType::integer,
                       .help = "along y",
                       .positional = true,
                       .low = 1,
                       .high = 1000},
                      {.name = "nz",
                       .type = ArgumentType::integer,
                       .help = "along z",
                       .positional = true,
                       .low = 1,
                       .high = 1000},
                      {.name = "size", .help = "extent", .unit = "m", .count = 3, .low = 1e-9, .high = 1e9},
                      {.name = "at",
                       .help = "where its lowest corner stands",
                       .unit = "m",
                       .count = 3,
                       .low = -1e9,
                       .high = 1e9}},
       .example = "new box 4 4 1 size 0.6 0.6 0.1",
       .run = new_solid},
      {.name = "open",
       .summary = "Begins with the cells of a volume mesh file: .mesh, .vtk or .vtu.",
       .parameters = {{.name = "file",
                       .type = ArgumentType::text,
                       .help = "beneath the session's own folder",
                       .positional = true,
                       .required = true}},
       .example = "open chair.vtk",
       .run = open},
      {.name = "extrude",
       .summary = "Grows cells from boundary faces; neighbouring faces share their walls. The far faces are "
                  "selected then.",
       .parameters =
           {{.name = "distance",
             .help = "how far",
             .unit = "m",
             .positional = true,
             .required = true,
             .low = -1e9,
             .high = 1e9},
            {.name = "steps", .type = ArgumentType::integer, .help = "cells along the way", .low = 1, .high = 1000},
            {.name = "along",
             .help = "direction; else the mean normal of the faces",
             .count = 3,
             .low = -1e9,
             .high = 1e9},
            {.name = "scale",
             .help = "size of the far end against the near one, about the middle of each patch",
             .low = 1e-3,
             .high = 1e3},
            where_faces},
       .example = "extrude 0.4 steps 2",
       .run = extrude_faces},
      {.name = "peak",
       .summary = "Raises a pyramid over each boundary face.",
       .parameters = {{.name = "height",
                       .help = "of the apex over the middle of the face",
                       .unit = "m",
                       .positional = true,
                       .required = true,
                       .low = 1e-9,
                       .high = 1e9},
                      where_faces},
       .example = "peak 0.05 where z > 0.9",
       .run = raise_peaks},
      {.name = "remove",
       .summary = "Removes cells, with the faces, edges and vertices that nothing holds any more.",
       .parameters = {{.name = "where",
                       .type = ArgumentType::expression,
                       .help = "the cells; else those selected"}},
       .example = "remove where x > 0.5",
       .run = remove_cells},
      {.name = "move",
       .summary = "Moves the selected vertices, or those of the selected edges, faces or cells.",
       .parameters = {{.name = "by",
                       .help = "the shift",
                       .unit = "m",
                       .count = 3,
                       .positional = true,
                       .required = true,
                       .low = -1e9,
                       .high = 1e9},
                      {.name = "where",
                       .type = ArgumentType::expression,
                       .help = "the vertices; else what is selected"}},
       .example = "move 0 0.05 0 where z > 0.8",
       .run = move},
      {.name = "sharpen",
       .summary = "Makes boundary edges creases, or boundary vertices corners; 0 makes them smooth again.",
       .parameters = {{.name = "value",
                       .help = "sharpness: 10 is infinite, 0 smooth",
                       .positional = true,
                       .low = 0,
                       .high = 10},
                      {.name = "where",
                       .type = ArgumentType::expression,
                       .help = "the edges; else what is selected"}},
       .example = "sharpen 10",
       .run = sharpen_elements},
      {.name = "levels",
       .summary = "How often the control solid is refined before it becomes finite elements.",
       .parameters = {{.name = "level",
                       .type = ArgumentType::integer,
                       .help = "refinements",
                       .positional = true,
                       .required = true,
                       .low = 0,
                       .high = 8}},
       .example = "levels 2",
       .run = set_level},
      {.name = "space",
       .summary =
           "Which functions the solid may move by: trilinear ones on the refined nodes (default), or tricubic "
           "B-splines where cells are regular.",
       .parameters = {{.name = "space",
                       .type = ArgumentType::word,
                       .help = "the space",
                       .positional = true,
                       .required = true,
                       .choices = {"default", "cubic"}},
                      {.name = "split",
                       .type = ArgumentType::integer,
                       .help = "cubic: how often the remaining cells are split",
                       .low = 0,
                       .high = 3}},
       .example = "space cubic split 1",
       .run = set_space},
  };
}

}  // namespace argil::sculpt
