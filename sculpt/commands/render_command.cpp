#include <fmt/format.h>

#include "io/image.h"
#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/commands/reference_argument.h"
#include "sculpt/commands/render_request.h"
#include "sculpt/picture.h"
#include "sculpt/session.h"
#include "sculpt/shown_fields.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

// One picture of two halves: the control cage alone, and the scene.
Picture with_cage_beside(Renderer& renderer, const Document& document, const Scene& scene, PictureOptions options) {
  Scene cage = scene;
  cage.draw_surface = false;
  cage.legend.reset();
  cage.cage_lines.clear();
  cage.cage_points.clear();
  add_cage(cage, document.solid(), document.positions(), true);
  PictureOptions of_cage = options;
  of_cage.width = options.width / 2;
  options.width -= of_cage.width;
  of_cage.contact_shadow = false;
  const Picture left = renderer.render(cage, of_cage), right = renderer.render(scene, options);
  Picture both{.width = left.width + right.width, .height = left.height, .rgba = {}, .cell_ids = {}};
  for (int y = 0; y < both.height; ++y)
    for (const Picture* half : {&left, &right}) {
      const auto row = half->rgba.begin() + std::ptrdiff_t{4} * half->width * y;
      both.rgba.insert(both.rgba.end(), row, row + std::ptrdiff_t{4} * half->width);
    }
  return both;
}

void read_field(const Session& session, const Arguments& arguments, PictureRequest& request) {
  request.field = arguments.word("field", "");
  if (arguments.has("range")) {
    const auto& range = arguments.numbers("range");
    if (!(range[0] < range[1])) throw Error(ErrorCode::bad_input, "a range rises: `range 0 0.1`");
    request.range = {range[0], range[1]};
    if (request.field.empty()) throw Error(ErrorCode::bad_input, "a range is of a field; add `field strain`");
  }
  if (arguments.has("colours")) {
    const std::string& map = arguments.word("colours");
    request.colours = map == "cividis"     ? ColourMap::cividis
                      : map == "balanced"  ? ColourMap::balanced
                      : map == "green_red" ? ColourMap::green_red
                                           : ColourMap::viridis;
    if (request.field.empty())
      throw Error(ErrorCode::bad_input, "colours are those of a field; add `field strain`");
  }
  if (arguments.has("reference") && request.field != "error")
    throw Error(ErrorCode::bad_input, "a reference is for `field error`; to see its edges, write `overlay FILE`");
  request.reference = reference_of(session, arguments);
  request.volume = arguments.has("volume");
  if (request.volume && request.field.empty())
    throw Error(ErrorCode::bad_input, "a volume is of a field; add `field strain`");
  if (request.field == "error" && !request.reference)
    throw Error(ErrorCode::bad_input, "an error is against another solution; add `reference FILE`");
  if (arguments.has("opacity") && !request.volume)
    throw Error(ErrorCode::bad_input, "opacity is that of a volume; add `volume field strain`");
  request.opacity = arguments.number("opacity", 1);
}

/// Other meshes, springs, frames and lines that go with the surface or take its place.
void read_lines(const Session& session, const Arguments& arguments, PictureRequest& request) {
  if (arguments.has("frames"))
    request.frames = arguments.word("frames") == "rotated" ? FrameKind::rotated : FrameKind::tangent;
  if (arguments.has("corner")) request.corner = static_cast<std::uint32_t>(arguments.integer("corner", 0));
  if (arguments.has("overlay")) {
    if (arguments.word("overlay") == "rest")
      request.overlay_rest = true;
    else
      request.overlay =
          read_compared_mesh(session.path_to_read(arguments.word("overlay")), session.document().limits.cells)
              .surface;
  }
  if (arguments.has("underlay")) {
    for (const char* other : {"volume", "clip", "peel", "frames", "style", "corner", "net", "reference", "colours"})
      if (arguments.has(other))
        throw Error(
            ErrorCode::bad_input,
            fmt::format("an underlay takes the place of the surface, so that {0} has nothing to show; leave "
                        "out {0} or the underlay",
                        other));
    request.underlay = std::make_shared<const ComparedMesh>(
        read_compared_mesh(session.path_to_read(arguments.word("underlay")), session.document().limits.cells));
  }
  request.springs = arguments.has("springs");
  if (request.springs && !request.underlay)
    for (const char* other : {"field", "volume", "frames", "style", "corner", "net"})
      if (arguments.has(other))
        throw Error(ErrorCode::bad_input,
                    fmt::format("springs take the place of the surface, so that {0} has nothing to show; leave out "
                                "{0} or springs",
                                other));
  if (arguments.has("line")) {
    const std::vector<double>& ends = arguments.numbers("line");
    request.line = {Eigen::Vector3d(ends[0], ends[1], ends[2]), Eigen::Vector3d(ends[3], ends[4], ends[5])};
    if ((*request.line)[0] == (*request.line)[1])
      throw Error(ErrorCode::bad_input,
                  "the two ends of the line are the same point; give two, as in `line 0 0.3 "
                  "0.05 0.6 0.3 0.05`");
  }
}

void read_cells(const Arguments& arguments, PictureRequest& request) {
  request.peel = static_cast<int>(arguments.integer("peel", 0));
  if (arguments.has("clip")) {
    const auto& plane = arguments.numbers("clip");
    request.clip = ClipPlane{{plane[0], plane[1], plane[2]}, {plane[3], plane[4], plane[5]}};
    if (plane[3] == 0 && plane[4] == 0 && plane[5] == 0)
      throw Error(ErrorCode::bad_input, "the normal of the clip plane is zero; `clip 0 0 0 1 0 0` looks along x");
  }
  if (arguments.has("net_steps") && !arguments.has("net"))
    throw Error(ErrorCode::bad_input, "net_steps are those of a cell's net; add `net CELL`");
  if (arguments.has("net")) request.net_cell = static_cast<std::uint32_t>(arguments.integer("net", 0));
  request.net_steps = static_cast<int>(arguments.integer("net_steps", 4));
  const std::string style = arguments.word("style", "solid");
  request.style = style == "wireframe"            ? PictureStyle::wireframe
                  : style == "boundary_wireframe" ? PictureStyle::boundary_wireframe
                                                  : PictureStyle::solid;
}

/// Finer for the picture only.
void read_smooth(const Session& session, const Arguments& arguments, PictureRequest& request) {
  request.smooth = static_cast<int>(arguments.integer("smooth", 0));
  if (request.smooth == 0) return;
  for (const char* other : {"frames", "corner", "net", "springs", "shrink", "cell_kinds"})
    if (arguments.has(other))
      throw Error(ErrorCode::bad_input,
                  fmt::format("{0} shows the elements as they are simulated; leave out smooth or {0}", other));
  const int level = session.document().state().level + request.smooth;
  check_cells(session, static_cast<double>(subdiv::refined_cell_count(session.document().solid(), level)));
}

/// Every cell by itself.
void read_separate_cells(const Arguments& arguments, PictureRequest& request) {
  request.cell_kinds = arguments.has("cell_kinds");
  if (arguments.has("shrink")) request.shrink = arguments.number("shrink");
  if (!request.cell_kinds && !request.shrink) return;
  const std::string what = request.shrink ? "shrink" : "cell_kinds";
  for (const char* other : {"volume", "underlay", "frames", "style", "corner", "net", "springs"})
    if (arguments.has(other))
      throw Error(
          ErrorCode::bad_input,
          fmt::format("{0} draws the cells, {1} something in their place; leave out {0} or {1}", what, other));
  if (arguments.word("wire", "cells") == "control")
    throw Error(ErrorCode::bad_input,
                fmt::format("{0} shows every cell with its own edges; leave out `wire control` "
                            "or {0}",
                            what));
  if (request.cell_kinds && !request.field.empty())
    throw Error(ErrorCode::bad_input, "cells have one colour; leave out field or cell_kinds");
}

PictureOptions read_view(const Arguments& arguments, PictureRequest& request) {
  if (arguments.has("from") && arguments.vector("from").isZero(0))
    throw Error(ErrorCode::bad_input, "the direction to the eye is zero; `from 0 -1 0` looks at the front");
  PictureOptions options;
  if (arguments.has("size")) {
    options.width = static_cast<int>(arguments.numbers("size")[0]);
    options.height = static_cast<int>(arguments.numbers("size")[1]);
  }
  options.title = arguments.word("title", "");
  if (arguments.has("frame")) {
    const std::vector<double>& box = arguments.numbers("frame");
    if (box[0] == box[3] && box[1] == box[4] && box[2] == box[5])
      throw Error(ErrorCode::bad_input, "the two corners of the frame are the same; `frame 0 0 0 1 1 1` is a cube");
    options.frame = box_frame({box[0], box[1], box[2]}, {box[3], box[4], box[5]});
  }
  options.view_from = arguments.vector("from", options.view_from);
  options.zoom = arguments.number("zoom", 1);
  // The cells of both sides of a translucent body would hide it.
  const std::string wire = arguments.word("wire", request.volume ? "control" : request.underlay ? "none" : "cells");
  options.wireframe = wire != "none";
  request.underlay_wires = request.underlay && wire == "cells";
  request.control_wire = wire == "control";
  options.light_theme = arguments.has("light");
  return options;
}

void render(Session& session, const Arguments& arguments) {
  require_solid(session);
  RenderRequest request = read_render(session, arguments);
  const std::string& name = arguments.word("file");
  if (!name.ends_with(".png"))
    throw Error(ErrorCode::bad_input, fmt::format("a picture is a .png file, not '{}'", name));
  const auto path = session.path_to_write(name);
  Renderer* renderer = session.options().renderer;
  if (!renderer) {
    ++session.skipped_pictures;
    session.print(fmt::format("{} skipped: there is no renderer", name));
    return;
  }
  request.options.progress = session.progress_of("drawing");
  const Picture picture = make_picture(*renderer, session.document(), request);
  io::write_png(path, picture.width, picture.height, picture.rgba);
}

}  // namespace

RenderRequest read_render(const Session& session, const Arguments& arguments) {
  RenderRequest request;
  read_field(session, arguments, request.picture);
  read_lines(session, arguments, request.picture);
  read_cells(arguments, request.picture);
  read_smooth(session, arguments, request.picture);
  read_separate_cells(arguments, request.picture);
  request.picture.cage = arguments.has("cage");
  request.picture.marks = !arguments.has("plain");
  if (session.tool_force()) {
    request.picture.tool_force = {session.tool_force()->at, session.tool_force()->force};
    request.picture.curve_handles = session.tool_force()->curve_handles;
  }
  if (arguments.has("felt")) request.picture.felt = arguments.number("felt");
  request.options = read_view(arguments, request.picture);
  request.beside = arguments.has("beside");
  return request;
}

Picture make_picture(Renderer& renderer, const Document& document, const RenderRequest& request) {
  const Scene scene = make_scene(document, request.picture);
  return request.beside ? with_cage_beside(renderer, document, scene, request.options)
                        : renderer.render(scene, request.options);
}

std::vector<Command> render_commands() {
  return {
      {.name = "render",
       .summary = "Makes a picture of the solid as it is now.",
       .parameters =
           {{.name = "file",
             .type = ArgumentType::text,
             .help = "a .png beneath the folder given with --out",
             .positional = true,
             .required = true},
            {.name = "field",
             .type = ArgumentType::word,
             .help = "colours, with a legend",
             .choices = shown_field_names()},
            {.name = "range", .help = "of the colours; else that of what is shown", .count = 2},
            {.name = "colours",
             .type = ArgumentType::word,
             .help = "else balanced (blue, white, red) for what has a sign, cividis for material, viridis; "
                     "green_red: from soft to stiff",
             .choices = {"viridis", "cividis", "balanced", "green_red"}},
            reference_parameter(),
            {.name = "volume",
             .help = "the field inside as a translucent volume, in place of the surface",
             .flag = true},
            {.name = "opacity", .help = "of the volume; 1 is usual", .low = 0.01, .high = 100},
            {.name = "frames",
             .type = ArgumentType::word,
             .help = "axes u, v, w of each hexahedron: tangent stretch and shear with it, rotated only turn",
             .choices = {"tangent", "rotated"}},
            {.name = "corner",
             .type = ArgumentType::integer,
             .help = "instead, the most sheared corner at this vertex of the finest level: its sides to a "
                     "and b, and to a′ and b′ without shear",
             .low = 0,
             .high = 4e9},
            {.name = "overlay",
             .type = ArgumentType::text,
             .help = "edges of another mesh: a volume or surface file, or rest for the solid at rest"},
            {.name = "underlay",
             .type = ArgumentType::text,
             .help = "another mesh, a volume file, as the surface under the edges of the solid; of a file with a "
                     "point field displacement, as save writes it, `field displacement` shows that"},
            {.name = "springs",
             .help = "the springs of a mass–spring model by kind, in place of the surface",
             .flag = true},
            {.name = "line",
             .help = "a straight line of the solid at rest, from one point to another, where it is now",
             .unit = "m",
             .count = 6,
             .low = -1e9,
             .high = 1e9},
            {.name = "peel",
             .type = ArgumentType::integer,
             .help = "so many layers of the finest cells are taken away from the boundary inwards",
             .low = 0,
             .high = 1e6},
            {.name = "clip",
             .help = "a plane (point, then normal): whole cells beyond it are taken away",
             .count = 6},
            {.name = "style",
             .type = ArgumentType::word,
             .help = "how",
             .choices = {"solid", "wireframe", "boundary_wireframe"}},
            {.name = "smooth",
             .type = ArgumentType::integer,
             .help = "refined so many times more, for this picture only",
             .low = 0,
             .high = 4},
            {.name = "shrink",
             .help = "every cell by itself, drawn about its middle to this part of its size",
             .low = 0.01,
             .high = 1},
            {.name = "cell_kinds",
             .help = "every cell by itself, coloured by what decides its element: regular (it has a net of 64), "
                     "extraordinary, irregular (no hexahedron)",
             .flag = true},
            {.name = "cage", .help = "with the control cage", .flag = true},
            {.name = "beside", .help = "the cage alone beside it, in the left half", .flag = true},
            {.name = "plain", .help = "without arrows, pins and the curve of a stroke", .flag = true},
            {.name = "wire",
             .type = ArgumentType::word,
             .help = "edges drawn: of the finest cells, of the control cells, none",
             .choices = {"cells", "control", "none"}},
            {.name = "light", .help = "on light ground", .flag = true},
            {.name = "felt",
             .help = "the ground takes colour by the force of the last stroke, all of it at this force",
             .unit = "N",
             .low = 1e-9,
             .high = 1e12},
            {.name = "title", .type = ArgumentType::text, .help = "above the picture"},
            {.name = "size",
             .type = ArgumentType::integer,
             .help = "width and height",
             .unit = "px",
             .count = 2,
             .low = 1,
             .high = 4096},
            {.name = "from", .help = "direction from the solid to the eye", .count = 3},
            {.name = "frame",
             .help = "two corners of a box that fills the picture, whatever else is there: for pictures of one "
                     "scale; else the "
                     "solid, arrows and legend",
             .unit = "m",
             .count = 6,
             .low = -1e9,
             .high = 1e9},
            {.name = "zoom", .help = "1 shows everything", .low = 0.01, .high = 1000},
            {.name = "net",
             .type = ArgumentType::integer,
             .help = "this cell of the finest level in its 4×4×4 net instead",
             .low = 0,
             .high = 4e9},
            {.name = "net_steps",
             .type = ArgumentType::integer,
             .help = "1 the cell, 2 face, 3 edge, 4 vertex neighbours",
             .low = 1,
             .high = 4}},
       .example = "render chair.png field strain",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1", "levels 1", "pin where x < 0.01", "gravity 0 0 -9.81",
                  "step 10"},
       .effect = Effect::output,
       .run = render},
  };
}

}  // namespace argil::sculpt
