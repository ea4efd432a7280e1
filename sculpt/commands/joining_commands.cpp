#include <fmt/format.h>

#include <array>

#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/region.h"
#include "sculpt/session.h"
#include "subdiv/edit/bridge.h"
#include "subdiv/edit/collapse.h"
#include "subdiv/edit/fill.h"
#include "subdiv/edit/merge.h"
#include "subdiv/edit/regions.h"
#include "subdiv/edit/weld.h"
#include "subdiv/error.h"
#include "subdiv/solid_measures.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

constexpr ElementType k_faces[] = {ElementType::faces};
constexpr ElementType k_vertices[] = {ElementType::vertices};

template <class IdType>
std::vector<IdType> ids(const Selection& selection) {
  return {selection.ids.begin(), selection.ids.end()};
}

// The chosen faces and those of a named set; or the two patches that the chosen ones make.
std::array<std::vector<FaceId>, 2> two_regions(const Session& session, const Arguments& arguments) {
  const auto faces = ids<FaceId>(acted_on(session, arguments, k_faces));
  const Solid& solid = session.document().solid();
  if (!arguments.has("with")) {
    check_boundary_faces(solid, faces, "join");
    return two_regions(solid, faces);
  }
  const std::string& name = arguments.word("with");
  const auto& sets = *session.document().state().sets;
  const auto found = sets.find(name);
  if (found == sets.end() || found->second.type != ElementType::faces)
    throw Error(
        ErrorCode::not_found,
        fmt::format("there is no set of faces named '{}'; make one with `select faces as {} where …`", name, name));
  return {faces, ids<FaceId>(found->second)};
}

std::string counted(std::size_t count, const char* one, const char* several) {
  return fmt::format("{} {}", count, count == 1 ? one : several);
}

// A cell without volume can be meant, on the way to another shape; but the user should know.
void report_flat_cells(const Session& session, const std::vector<CellId>& cells) {
  const Document& document = session.document();
  std::size_t flat = 0;
  for (const CellId c : cells) flat += cell_volume(document.solid(), *document.state().rest, c) > 1e-12 ? 0 : 1;
  if (flat > 0)
    session.print(fmt::format("flat or inside out: {} of {}; `arc` rounds a bridge, or move its ends apart", flat,
                              counted(cells.size(), "new cell", "new cells")));
}

void merge_regions(Session& session, const Arguments& arguments) {
  const auto [first, second] = two_regions(session, arguments);
  const std::string word = arguments.word("at", "middle");
  const MergeAt at = word == "first" ? MergeAt::first : word == "second" ? MergeAt::second : MergeAt::middle;
  std::size_t gone = 0;
  edit_solid(session, [&](Transaction& transaction, const Eigen::Matrix3Xd& rest) {
    Edit edit = merge(transaction, rest, first, second, at);
    gone = edit.merged.size();
    return edit;
  });
  session.print(fmt::format("glued {}, {} gone", counted(first.size(), "pair of faces", "pairs of faces"),
                            counted(gone, "vertex", "vertices")));
}

void weld_vertices(Session& session, const Arguments& arguments) {
  require_solid(session);
  std::vector<VertexId> vertices;
  if (arguments.has("where")) {
    vertices = ids<VertexId>(acted_on(session, arguments, k_vertices));
  } else {
    for (const VertexId v : session.document().solid().vertices()) vertices.push_back(v);
  }
  Weld done;
  edit_solid(session, [&](Transaction& transaction, const Eigen::Matrix3Xd& rest) {
    const double tolerance = arguments.number("tolerance", 1e-6 * extent(transaction.solid(), rest));
    done = weld(transaction, rest, vertices, tolerance);
    return done.edit;
  });
  session.print(done.vertices_gone == 0
                    ? "nothing lies within the tolerance; a larger one may be given with `tolerance`"
                    : fmt::format("welded: {} gone, {} glued", counted(done.vertices_gone, "vertex", "vertices"),
                                  counted(done.faces_glued, "pair of faces", "pairs of faces")));
}

void bridge_regions(Session& session, const Arguments& arguments) {
  const auto [first, second] = two_regions(session, arguments);
  const BridgeOptions options{.steps = static_cast<int>(arguments.integer("steps", 1)),
                              .twist = static_cast<int>(arguments.integer("twist", 0)),
                              .arc = arguments.has("arc")};
  check_cells(session, static_cast<double>(session.document().solid().cell_count()) +
                           static_cast<double>(options.steps) * static_cast<double>(first.size()));
  std::vector<CellId> made;
  edit_solid(session, [&](Transaction& transaction, const Eigen::Matrix3Xd& rest) {
    Edit edit = bridge(transaction, rest, first, second, options);
    made = edit.next_cells;
    return edit;
  });
  report_flat_cells(session, made);
}

void collapse_elements(Session& session, const Arguments& arguments) {
  constexpr ElementType types[] = {ElementType::edges, ElementType::faces, ElementType::cells};
  const Selection selection = acted_on(session, arguments, types);
  std::vector<VertexId> anchors;
  for (const std::uint32_t v : session.document().state().pins->control_points) anchors.emplace_back(v);
  const std::size_t before = session.document().solid().cell_count();
  edit_solid(session, [&](Transaction& transaction, const Eigen::Matrix3Xd&) {
    if (selection.type == ElementType::edges) return collapse(transaction, ids<EdgeId>(selection), anchors);
    if (selection.type == ElementType::faces) return collapse(transaction, ids<FaceId>(selection), anchors);
    return collapse(transaction, ids<CellId>(selection), anchors);
  });
  if (const std::size_t gone = before - session.document().solid().cell_count(); gone > 0)
    session.print(counted(gone, "cell", "cells") + " lost all volume and vanished");
}

void fill_openings(Session& session, const Arguments& arguments) {
  const auto faces = ids<FaceId>(acted_on(session, arguments, k_faces));
  std::size_t cells = 0;
  edit_solid(session, [&](Transaction& transaction, const Eigen::Matrix3Xd& rest) {
    Edit edit = fill(transaction, rest, faces);
    cells = edit.next_cells.size();
    return edit;
  });
  session.print("filled with " + counted(cells, "cell", "cells"));
}

}  // namespace

std::vector<Command> joining_commands() {
  const auto where = [](const char* what) {
    return Parameter{.name = "where",
                     .type = ArgumentType::expression,
                     .help = fmt::format("{}, by a condition; else those selected", what)};
  };
  const Parameter with{.name = "with",
                       .type = ArgumentType::text,
                       .help = "a named set of faces, the second region; else the chosen faces make two patches"};
  // Two blocks with a gap between them.
  const std::vector<std::string> gap{"new box 3 1 1 size 3 1 1", "remove where x > 1 and x < 2"};
  return {
      {.name = "merge",
       .summary =
           "Glues two faces, or two regions of faces of the same shape: of two parts, or of one, which closes "
           "a gap or a handle. Vertices that match become one.",
       .parameters = {{.name = "at",
                       .type = ArgumentType::word,
                       .help =
                           "where merged vertices stand: in the middle, or as on the first or second region (the "
                           "first has the lowest face; with a named set, the chosen faces are first)",
                       .choices = {"middle", "first", "second"}},
                      with,
                      where("the faces")},
       .example = "merge at first where x > 0.9 and x < 2.1",
       .before = gap,
       .run = merge_regions},
      {.name = "weld",
       .summary = "Makes vertices of the boundary one that lie together, and glues the faces that then coincide.",
       .parameters = {{.name = "tolerance",
                       .help = "how near they lie; else a millionth of the solid's extent",
                       .unit = "m",
                       .low = 0,
                       .high = 1e9},
                      {.name = "where",
                       .type = ArgumentType::expression,
                       .help = "only these vertices; else all of the boundary"}},
       .example = "weld tolerance 0.02",
       .before = {"new box 3 1 1 size 6 2 2", "remove where x > 2 and x < 4", "select vertices where x > 3",
                  "move -1.99 0 0"},
       .run = weld_vertices},
      {.name = "bridge",
       .summary =
           "Grows cells from one face, or region of faces, to another of the same shape. Within one part this "
           "makes a handle. The new cells are selected then.",
       .parameters =
           {{.name = "steps", .type = ArgumentType::integer, .help = "cells along the way", .low = 1, .high = 1000},
            {.name = "twist",
             .type = ArgumentType::integer,
             .help = "between two single faces: turn the far end by so many vertices",
             .low = -1000,
             .high = 1000},
            {.name = "arc", .help = "leave and arrive at right angles to the faces, on a round way", .flag = true},
            with,
            where("the faces")},
       .example = "bridge steps 2 where x > 0.9 and x < 2.1",
       .before = gap,
       .run = bridge_regions},
      {.name = "collapse",
       .summary = "Shrinks edges, faces or cells to a point each: their middle, or a pinned or sharp vertex of "
                  "theirs. Cells without volume vanish, and their neighbours are glued.",
       .parameters = {where("the edges")},
       .example = "collapse where x > 1.9 and y > 0.9",
       .before = {"new box 2 1 1 size 2 1 1"},
       .run = collapse_elements},
      {.name = "fill",
       .summary = "Puts a cell into an opening, between the faces around it: a notch, a pit, a tunnel or a void. "
                  "Loops of edges that stay open get a face, which is selected then.",
       .parameters = {where("the faces around it")},
       .example = "fill where x >= 1 and x <= 2 and z > 0.9",
       .before = {"new box 3 1 2 size 3 1 2", "remove where x > 1 and x < 2 and z > 1"},
       .run = fill_openings},
  };
}

}  // namespace argil::sculpt
