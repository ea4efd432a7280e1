#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "fem/measure/quality.h"
#include "io/volume_formats.h"
#include "sculpt/export.h"
#include "sculpt/import.h"
#include "sculpt/session.h"
#include "subdiv/boundary.h"
#include "subdiv/build.h"
#include "subdiv/error.h"
#include "subdiv/inside_out.h"
#include "subdiv/limit.h"
#include "subdiv/radial_edge.h"
#include "subdiv/refinement.h"
#include "subdiv/solid_measures.h"
#include "tools/argil/program.h"
#include "tools/view/offscreen_renderer.h"

namespace argil::tools {

namespace {

using nlohmann::ordered_json;
using namespace subdiv;

Built read_solid(const std::filesystem::path& path) {
  io::VolumeMesh mesh = io::read_volume_mesh(path);
  try {
    sculpt::Imported imported = sculpt::import_solid(mesh, false);
    for (const std::string& note : imported.notes) std::fprintf(stderr, "argil: %s\n", note.c_str());
    return std::move(imported.built);
  } catch (const Error& error) {
    throw Error(error.code(), error.what(), path.string() + (error.where().empty() ? "" : ": " + error.where()));
  }
}

const char* kind_name(std::size_t kind) {
  static const char* const names[] = {"tetrahedron", "pyramid", "wedge", "hexahedron", "polyhedron"};
  return names[kind];
}

void check_count(const Solid& solid, int levels, std::size_t max_cells) {
  const std::size_t count = refined_cell_count(solid, levels);
  if (count > max_cells)
    throw Error(ErrorCode::limit_exceeded,
                fmt::format("level {} has {} cells, more than {}; lower --levels or raise --max-cells", levels,
                            count, max_cells));
}

// Asked before the work is done, not after it.
void check_ending(const std::filesystem::path& out) {
  if (!sculpt::is_surface_format(out) && !io::is_volume_format(out))
    throw Error(ErrorCode::unsupported, fmt::format("expected a name that ends in {}, or in .obj, .ply, .stl, "
                                                    ".off, .glb or .gltf for the boundary, found '{}'",
                                                    io::volume_endings(), out.string()));
}

void print_text(const ordered_json& json, int indent = 0) {
  for (const auto& [key, value] : json.items()) {
    if (value.is_object()) {
      fmt::print("{:{}}{}\n", "", indent, key);
      print_text(value, indent + 2);
    } else {
      fmt::print("{:{}}{:<{}} {}\n", "", indent, key, 24 - indent,
                 value.is_string() ? value.get<std::string>() : value.dump());
    }
  }
}

}  // namespace

int info(const std::filesystem::path& path, bool as_json) {
  const Built built = read_solid(path);
  const Solid& solid = built.solid;
  const BoundarySurface surface = boundary_surface(solid);
  ordered_json json;
  json["vertices"] = solid.vertex_count();
  json["edges"] = solid.edge_count();
  json["faces"] = solid.face_count();
  json["cells"] = solid.cell_count();
  json["boundary_faces"] = surface.faces.size();
  json["components"] = components(solid).count;
  json["boundary_components"] = surface.component_count;
  json["boundary_genus"] = surface.genus;
  const auto kinds = cell_kind_counts(solid);
  for (std::size_t kind = 0; kind < kinds.size(); ++kind)
    if (kinds[kind] > 0) json["cell_types"][kind_name(kind)] = kinds[kind];
  json["interior_edge_valences"] = ordered_json::object();
  for (const auto& [valence, count] : interior_edge_valences(solid))
    json["interior_edge_valences"][std::to_string(valence)] = count;
  const auto scaled = min_scaled_jacobian(solid, built.positions);
  json["min_scaled_jacobian"] = scaled ? ordered_json(scaled->value) : ordered_json(nullptr);
  const fem::WorstJacobian worst = fem::min_relative_jacobian(solid, built.positions);
  json["min_jacobian"] = worst.value;
  json["min_jacobian_cell"] = worst.cell.value;
  const InvertedCells inverted = inverted_cells(solid, built.positions);
  json["inverted_cells"] = inverted.count;
  if (inverted.count > 0) json["first_inverted_cell"] = inverted.first.value;
  const MassProperties mass = mass_properties(solid, built.positions);
  json["volume"] = mass.volume;
  json["centre"] = {mass.centre.x(), mass.centre.y(), mass.centre.z()};
  json["inertia"] = ordered_json::array();
  for (Eigen::Index row = 0; row < 3; ++row)
    json["inertia"].push_back({mass.inertia(row, 0), mass.inertia(row, 1), mass.inertia(row, 2)});
  if (as_json)
    fmt::print("{}\n", json.dump(2));
  else
    print_text(json);
  if (worst.value < 0.1)
    std::fprintf(stderr,
                 "argil: cell %u is badly shaped (relative Jacobian %.3g at a quadrature point, below 0.1)\n",
                 worst.cell.value, worst.value);
  return k_well;
}

int refine(const std::filesystem::path& in, const std::filesystem::path& out, int levels, bool limit,
           std::size_t max_cells) {
  check_ending(out);
  Built built = read_solid(in);
  check_count(built.solid, levels, max_cells);
  for (int level = 0; level < levels; ++level) {
    RefinementStep step = subdiv::refine(built.solid);
    built.positions = apply(step.stencils, built.positions);
    built.solid = std::move(step.fine);
  }
  if (limit) built.positions = apply(limit_stencils(built.solid), built.positions);
  if (sculpt::is_surface_format(out)) {
    io::write_surface(out, sculpt::surface_mesh(built.solid, built.positions));
  } else {
    io::VolumeMesh mesh;
    mesh.cells = cell_lists(built.solid, built.positions);
    built = {};
    io::write_volume_mesh(out, mesh);
  }
  return k_well;
}

int elements(const std::filesystem::path& path, int levels, const std::string& space, int split, bool as_json,
             std::size_t max_cells) {
  const Built built = read_solid(path);
  check_count(built.solid, levels, max_cells);
  const Refinement refinement = refine_to_level(built.solid, levels);
  const auto nodes = static_cast<Eigen::Index>(refinement.solid().vertex_capacity());
  const fem::NodalFields fields{Eigen::VectorXd::Constant(nodes, 1e5), Eigen::VectorXd::Constant(nodes, 0.3),
                                Eigen::VectorXd::Constant(nodes, 1000), Eigen::VectorXd::Zero(nodes)};
  const fem::Discretization d =
      fem::discretize(refinement, built.positions, fields, {.space = fem::space_by_name(space), .split = split});
  ordered_json json;
  json["space"] = space;
  json["levels"] = levels;
  json["cells"] = {{"regular", d.cells.regular},
                   {"regular_published", d.cells.regular_published},
                   {"extraordinary", d.cells.extraordinary},
                   {"irregular", d.cells.irregular}};
  json["elements"] = {{"cubic", d.elements.cubic}, {"linear", d.elements.linear}, {"pyramid", d.elements.pyramid}};
  json["pyramids_without_stiffness"] = d.elements.pyramids_without_stiffness;
  json["unknowns"] = 3 * built.solid.vertex_count();
  json["volume"] = d.rest_volume;
  if (as_json)
    fmt::print("{}\n", json.dump(2));
  else
    print_text(json);
  return k_well;
}

int convert(const ConvertArguments& arguments) {
  check_ending(arguments.out);
  io::WriteOptions options;
  if (!arguments.encoding.empty()) options.encoding = io::encoding_by_word(arguments.encoding);
  options.version = arguments.version;
  if (sculpt::is_surface_format(arguments.out)) {
    if (!arguments.encoding.empty() || !arguments.version.empty())
      throw Error(ErrorCode::bad_input, "--encoding and --version are those of volume meshes; leave them out here");
    const Built built = read_solid(arguments.in);
    io::write_surface(arguments.out, sculpt::surface_mesh(built.solid, built.positions));
    return k_well;
  }
  io::VolumeMesh mesh = io::read_volume_mesh(arguments.in);
  for (const std::string& note : mesh.notes) std::fprintf(stderr, "argil: %s\n", note.c_str());
  if (arguments.repair) {
    const auto cells = inside_out_cells(mesh.cells);
    for (const std::size_t cell : cells) turn_inside_out(mesh.cells, cell);
    std::fprintf(stderr, "argil: %zu cells were inside out and are turned round\n", cells.size());
  }
  for (const std::string& note : io::leave_out_what_is_not_held(mesh, io::volume_format_of(arguments.out)))
    std::fprintf(stderr, "argil: %s\n", note.c_str());
  io::write_volume_mesh(arguments.out, mesh, options);
  return k_well;
}

int formats(bool markdown) {
  fmt::print("{}", io::volume_format_table(markdown));
  if (!markdown) fmt::print(".obj, .ply, .stl  the boundary alone\n");
  return k_well;
}

int render(const RenderArguments& arguments) {
  const auto renderer = view::make_offscreen_renderer();
  if (arguments.out.extension() != ".png")
    throw Error(ErrorCode::unsupported, fmt::format("a picture is a .png file, not '{}'", arguments.out.string()));
  // Links that the user names are followed; those in a session's folder are not.
  std::error_code failure;
  const std::filesystem::path mesh = std::filesystem::canonical(arguments.mesh, failure);
  if (failure)
    throw Error(ErrorCode::not_found, "there is no such file; check the name and the folder",
                arguments.mesh.string());
  sculpt::SessionOptions options;
  options.read_root = mesh.parent_path();
  options.out = arguments.out.parent_path().empty() ? "." : arguments.out.parent_path();
  options.write_journal = false;
  options.limits.cells = arguments.max_cells;
  options.renderer = renderer.get();
  options.print = [](const std::string& message) { std::fprintf(stderr, "argil: %s\n", message.c_str()); };
  sculpt::Session session(options);
  session.run_line("open " + io::quote(mesh.filename().string()));
  if (arguments.levels > 0)
    session.run_line(io::parse_session_line(fmt::format("levels {}", arguments.levels), "--levels", 1));
  const std::string line = "render " + io::quote(arguments.out.filename().string()) + " " + arguments.options;
  session.run_line(io::parse_session_line(line, "--with", 1));
  return k_well;
}

int help_document() {
  fmt::print("{}", sculpt::commands_document());
  return 0;
}

int help(const std::string& command) {
  if (command.empty()) {
    fmt::print("Commands of a session, one a line; `argil help COMMAND` explains one.\n\n{}",
               sculpt::command_overview());
    return k_well;
  }
  const auto line = io::parse_session_line(command, "command", 1);
  if (line.tokens.empty()) throw Error(ErrorCode::bad_input, "help wants the name of a command");
  fmt::print("{}", sculpt::help_text(sculpt::find_command(line)));
  return k_well;
}

}  // namespace argil::tools
