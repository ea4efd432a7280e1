#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/session.h"
#include "subdiv/disjoint_sets.h"
#include "subdiv/edit/extrude.h"
#include "subdiv/error.h"
#include "subdiv/radial_edge.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

constexpr ElementType k_faces[] = {ElementType::faces};
constexpr ElementType k_cells[] = {ElementType::cells};

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

}  // namespace

std::vector<Command> topology_commands() {
  const Parameter where_faces{
      .name = "where", .type = ArgumentType::expression, .help = "the faces, by a condition; else those selected"};
  return {
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
  };
}

}  // namespace argil::sculpt
