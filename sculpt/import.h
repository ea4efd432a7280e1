#pragma once
// From a volume mesh file to the solid of a document: what is wrong with its cells is said, or mended on request,
// and its sets become those of the document.

#include <map>
#include <string>
#include <vector>

#include "io/volume_mesh.h"
#include "sculpt/document.h"
#include "subdiv/build.h"

namespace argil::sculpt {

struct Imported {
  subdiv::Built built;
  std::vector<std::string> notes;  // for the user
};

/// Builds the cells of a mesh. Cells that are inside out are counted in a note, the first one named; `repair` turns
/// them round first.
/// @throws Error as `subdiv::build`, with the number of cells inside out; (bad_topology) naming a hanging vertex.
[[nodiscard]] Imported import_solid(io::VolumeMesh& mesh, bool repair);

/// The sets of the mesh by name, as vertices, faces and cells of the solid. Where two kinds share a name, the later
/// one gets its kind behind it; that, and members which the solid does not have, are noted.
[[nodiscard]] std::map<std::string, Selection> imported_sets(const io::VolumeMesh& mesh, Imported& imported);

}  // namespace argil::sculpt
