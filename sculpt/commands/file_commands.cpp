#include <fmt/format.h>

#include "io/volume_formats.h"
#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/import.h"
#include "sculpt/session.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

void open(Session& session, const Arguments& arguments) {
  const std::filesystem::path file = session.path_to_read(arguments.word("file"));
  session.progress_of("reading").at(0);
  io::VolumeMesh mesh = io::read_volume_mesh(file);
  check_cells(session, static_cast<double>(mesh.cells.cell_count()));
  session.progress_of("joining cells").at(0);
  Imported imported = import_solid(mesh, arguments.has("repair"));
  auto sets = std::make_shared<std::map<std::string, Selection>>(imported_sets(mesh, imported));
  for (const std::string& note : imported.notes) session.print(note);
  const auto point_from_vertex = imported.built.point_from_vertex;
  State next = state_of(std::move(imported.built));
  next.sets = std::move(sets);
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

}  // namespace

std::vector<Command> file_commands() {
  return {
      {.name = "open",
       .summary = "Begins with the cells of a volume mesh file, its fields and its named sets: " +
                  io::volume_endings() + ".",
       .parameters = {{.name = "file",
                       .type = ArgumentType::text,
                       .help = "beneath the session's own folder",
                       .positional = true,
                       .required = true},
                      {.name = "repair", .help = "turn cells round that are inside out", .flag = true}},
       .example = "open chair.vtk",
       .before = {"new box 2 2 1", "save chair.vtk"},
       .run = open},
  };
}

}  // namespace argil::sculpt
