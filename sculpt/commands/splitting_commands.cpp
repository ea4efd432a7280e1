#include <fmt/format.h>

#include <Eigen/Geometry>

#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/region.h"
#include "sculpt/session.h"
#include "subdiv/edit/cut_face.h"
#include "subdiv/edit/cut_plane.h"
#include "subdiv/edit/cut_ring.h"
#include "subdiv/edit/cuts.h"
#include "subdiv/edit/split_cells.h"
#include "subdiv/error.h"
#include "subdiv/radial_edge.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

constexpr ElementType k_edges[] = {ElementType::edges};
constexpr ElementType k_faces[] = {ElementType::faces};
constexpr ElementType k_cells[] = {ElementType::cells};

template <class IdType>
std::vector<IdType> ids_of(const Selection& selection) {
  std::vector<IdType> ids;
  for (const std::uint32_t id : selection.ids) ids.emplace_back(id);
  return ids;
}

// A cell gives one for each of its corners.
void check_split(const Session& session, const Solid& solid, const std::vector<CellId>& cells) {
  double count = static_cast<double>(solid.cell_count());
  for (const CellId c : cells)
    if (solid.is_live(c)) count += static_cast<double>(cell_vertices(solid, c).size()) - 1;
  check_cells(session, count);
}

void split(Session& session, const Arguments& arguments) {
  const auto cells = ids_of<CellId>(acted_on(session, arguments, k_cells));
  edit_solid(session, [&](Transaction& transaction, const Eigen::Matrix3Xd&) {
    check_split(session, transaction.solid(), cells);
    Edit edit = split_cells(transaction, cells);
    for (long again = arguments.integer("times", 1); again > 1; --again) {
      const std::vector<CellId> children = edit.next_cells;
      check_split(session, transaction.solid(), children);
      append_edit(edit, split_cells(transaction, children));
    }
    return edit;
  });
}

void cut_by_plane(Session& session, const Arguments& arguments) {
  if (!arguments.has("normal"))
    throw Error(ErrorCode::bad_input,
                "expected the direction across the plane, as in `cut plane 0 0 1 at 0 0 0.5`");
  const Document& document = session.document();
  std::vector<CellId> cells;
  if (arguments.has("where") || document.state().selection->type == ElementType::cells)
    cells = ids_of<CellId>(acted_on(session, arguments, k_cells));
  else
    cells.assign(document.solid().cells().begin(), document.solid().cells().end());
  const Eigen::Matrix3Xd& rest = document.rest();
  Eigen::AlignedBox3d box;
  for (const CellId c : cells)
    for (const VertexId v : cell_vertices(document.solid(), c))
      box.extend(Eigen::Vector3d(rest.col(static_cast<Eigen::Index>(v.index()))));
  const Plane plane{arguments.vector("normal"), arguments.vector("at", box.center())};
  const double tolerance = arguments.number("tolerance", 1e-6 * box.diagonal().norm());
  check_cells(session, static_cast<double>(document.solid().cell_count()) + static_cast<double>(cells.size()));
  edit_solid(session, [&](Transaction& transaction, const Eigen::Matrix3Xd& before) {
    return cut_plane(transaction, before, cells, plane, tolerance);
  });
}

VertexId nearest(const Solid& solid, const Eigen::Matrix3Xd& rest, const std::vector<VertexId>& of,
                 const Eigen::Vector3d& point) {
  const auto distance = [&](VertexId v) {
    return (rest.col(static_cast<Eigen::Index>(v.index())) - point).squaredNorm();
  };
  VertexId best;
  const auto offer = [&](VertexId v) {
    if (!best.valid() || distance(v) < distance(best)) best = v;
  };
  if (of.empty())
    for (const VertexId v : solid.vertices()) offer(v);
  else
    for (const VertexId v : of) offer(v);
  return best;
}

VertexId vertex_of(const Solid& solid, double number) {
  if (number >= static_cast<double>(solid.vertex_capacity()) ||
      !solid.is_live(VertexId{static_cast<std::size_t>(number)}))
    throw Error(ErrorCode::not_found, fmt::format("there is no vertex {:.0f}; choose another", number));
  return VertexId{static_cast<std::size_t>(number)};
}

void cut_one_face(Session& session, const Arguments& arguments) {
  const Document& document = session.document();
  const Solid& solid = document.solid();
  const Selection& selection = *document.state().selection;
  FaceId face;
  if (arguments.has("where") || (selection.type == ElementType::faces && !selection.ids.empty())) {
    const auto faces = ids_of<FaceId>(acted_on(session, arguments, k_faces));
    if (faces.size() != 1)
      throw Error(ErrorCode::bad_input,
                  fmt::format("expected one face to cut, found {}; select fewer", faces.size()));
    face = faces[0];
  }
  VertexId from, to;
  if (arguments.has("between") && !arguments.has("from") && !arguments.has("to")) {
    from = vertex_of(solid, arguments.numbers("between")[0]);
    to = vertex_of(solid, arguments.numbers("between")[1]);
  } else if (arguments.has("from") && arguments.has("to") && !arguments.has("between")) {
    std::vector<VertexId> corners;
    if (face.valid()) corners.assign(solid.face_vertices(face).begin(), solid.face_vertices(face).end());
    from = nearest(solid, document.rest(), corners, arguments.vector("from"));
    to = nearest(solid, document.rest(), corners, arguments.vector("to"));
  } else {
    throw Error(ErrorCode::bad_input,
                "expected the ends of the new edge: either `between V W`, two vertices, or `from X Y Z to X Y Z`, "
                "points near them");
  }
  edit_solid(session, [&](Transaction& transaction, const Eigen::Matrix3Xd&) {
    return cut_face(transaction, face.valid() ? face : face_between(solid, from, to), from, to);
  });
}

void cut_by_rings(Session& session, const Arguments& arguments) {
  const auto edges = ids_of<EdgeId>(acted_on(session, arguments, k_edges));
  check_cells(session, 2 * static_cast<double>(session.document().solid().cell_count()));
  edit_solid(session, [&](Transaction& transaction, const Eigen::Matrix3Xd&) {
    return cut_rings(transaction, edges, arguments.number("fraction", 0.5));
  });
}

// What each way of cutting understands beside `where`.
void cut(Session& session, const Arguments& arguments) {
  require_solid(session);
  const std::string way = arguments.word("way");
  const auto only = [&](const char* owner, std::initializer_list<const char*> names) {
    for (const char* name : names)
      if (way != owner && arguments.has(name))
        throw Error(ErrorCode::bad_input,
                    fmt::format("{} belongs to `cut {}`; leave it out of `cut {}`", name, owner, way));
  };
  only("plane", {"normal", "at", "tolerance"});
  only("face", {"between", "from", "to"});
  only("ring", {"fraction"});
  if (way == "plane") return cut_by_plane(session, arguments);
  if (way == "face") return cut_one_face(session, arguments);
  cut_by_rings(session, arguments);
}

}  // namespace

std::vector<Command> splitting_commands() {
  const auto point = [](const char* name, const char* help) {
    return Parameter{.name = name, .help = help, .unit = "m", .count = 3, .low = -1e9, .high = 1e9};
  };
  return {
      {.name = "split",
       .summary =
           "Subdivides cells where they are: a box gives 8, any cell one at each corner. The shape stays, and "
           "cells beside them keep whole. The new cells are selected then.",
       .parameters = {{.name = "times",
                       .type = ArgumentType::integer,
                       .help = "splits the new cells again, so often in all",
                       .low = 1,
                       .high = 8},
                      {.name = "where",
                       .type = ArgumentType::expression,
                       .help = "the cells; else those selected"}},
       .example = "split times 2 where x > 0.5 and y > 0.5 and z > 0.5",
       .before = {"new box 2 2 2"},
       .run = split},
      {.name = "cut",
       .summary =
           "Cuts cells by a plane, a face by an edge from corner to corner, or a ring of boxes (all those that "
           "lie side by side along a selected edge) into two layers. What lies where the plane's direction "
           "points, or the new edges, are selected then.",
       .parameters =
           {{.name = "way",
             .type = ArgumentType::word,
             .help = "plane: the cells (else those selected, else all); face: the one face; ring: from the edges",
             .positional = true,
             .required = true,
             .choices = {"plane", "face", "ring"}},
            {.name = "normal",
             .help = "plane: direction across it",
             .count = 3,
             .positional = true,
             .low = -1e9,
             .high = 1e9},
            point("at", "plane: a point of it; else the middle of the cells"),
            {.name = "tolerance",
             .help = "plane: vertices so near count as on it; else a millionth of the size of the cells",
             .unit = "m",
             .low = 0,
             .high = 1e9},
            {.name = "between",
             .type = ArgumentType::integer,
             .help = "face: the numbers of two of its vertices",
             .count = 2,
             .low = 0,
             .high = 4e9},
            point("from", "face: a point near the one vertex"),
            point("to", "face: a point near the other"),
            {.name = "fraction",
             .help = "ring: where along the edges, from the end with the vertex of lower number; else the middle",
             .low = 1e-3,
             .high = 1 - 1e-3},
            {.name = "where",
             .type = ArgumentType::expression,
             .help = "the cells, face or edges; else those selected"}},
       .example = "cut plane 1 0 1 at 0.5 0.5 0.4",
       .before = {"new box 2 2 2"},
       .run = cut},
  };
}

}  // namespace argil::sculpt
