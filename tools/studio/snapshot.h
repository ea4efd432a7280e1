#pragma once
// What a frame knows of the session: a picture of its state that never changes once made. The simulation thread
// publishes one after each step and command; frames read the latest and wait for nothing.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sculpt/document.h"
#include "sculpt/picture.h"
#include "tools/studio/file_browser.h"
#include "tools/studio/safekeeping.h"
#include "tools/studio/selectable.h"

namespace argil::studio {

/// What the window wants to see; it changes nothing of the document.
struct Shown {
  std::string field;                           // empty: clay
  std::optional<std::array<double, 2>> range;  // else of the field's values
  std::optional<sculpt::ClipPlane> clip;
  bool cage = false;
  bool energy = false;                 // told in snapshots; it costs about as much as a tenth of a step
  bool finest_wires = false;           // else only those between control cells
  int peel = 0;                        // layers taken away from the boundary
  bool selectable = false;             // what of the control solid shows where
  std::vector<Eigen::Vector3d> curve;  // points to lay a curve through; empty: none
};

/// What an edit would make (ghost.h).
struct Ghost {
  std::vector<std::string> lines;
  std::string fault;                                                                 // empty: it can be done
  std::size_t cells_made = 0, cells_removed = 0, faces_made = 0, faces_removed = 0;  // faces: of the boundary
  std::vector<Eigen::Vector3f> corners;  // of the surface that would be new, three a triangle [m]
  std::vector<std::array<Eigen::Vector3f, 2>> wire;
  std::vector<float> shares;  // of each corner: how new it is, 0 … 1
  std::vector<float> gone;    // of each vertex of the surface drawn: how far it would go, 0 … 1
  std::uint64_t layout = 0;   // of the snapshot that has that surface
};

/// A curve as it lies on the surface now.
struct CurveOnSurface {
  std::vector<Eigen::Vector3d> handles;     // the nearest places to the points that were asked for
  std::vector<Eigen::Vector3d> line;        // from the first to the last
  std::vector<Eigen::VectorXd> influences;  // of the handles at each point of the line
};

struct HistoryEntry {
  std::string line;
  std::size_t depth = 0;  // of the undo stack after it
  long times = 1;         // equal ones in a row
  bool undone = false;
  double stroke_end = -1;  // [s]; −1: not a stroke
};

enum class MessageKind { note, warning, error };
struct Message {
  MessageKind kind = MessageKind::note;
  std::string text;
  std::uint64_t number = 0;  // rising; tells a new one
};

struct StrokeNow {
  Eigen::Vector3d held, force;  // [m], [N]
  double felt = 0;              // [N/m]: force over how far it went, or what the probe reads
  bool at_limit = false;
};

struct Snapshot {
  // What is drawn.
  std::uint64_t layout = 0;  // another one: faces, not only places, have changed
  std::uint64_t version = 0;
  std::uint64_t solid_number = 0;                // another one: a solid was begun or opened
  bool shade_again = false;                      // came to rest: hollows may be measured anew
  std::shared_ptr<const sculpt::Scene> scene;    // null: there is no solid
  std::vector<float> young_modulus, strain;      // per surface vertex, as of the last rest; may be empty
  std::vector<float> mask;                       // per surface vertex; empty: nothing is masked
  std::shared_ptr<const Selectable> selectable;  // of this layout; null where nobody asked
  std::shared_ptr<const Ghost> ghost;            // of the lines that were asked for last; null: none
  std::shared_ptr<const CurveOnSurface> curve;   // null: none
  int layers = 0;                                // of finest cells that can be peeled away
  Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = Eigen::Vector3d::Zero();  // of the surface [m]

  Eigen::Vector3d rest_middle = Eigen::Vector3d::Zero();  // of the rest shape: what symmetry mirrors about

  // The document.
  sculpt::Tool tool;
  std::uint64_t tool_number = 0;  // another one: a line took a tool, not a stroke
  sculpt::State state;  // its parts are shared and do not change; `solid` is not to be touched from another thread
  std::size_t control_cells = 0, elements = 0, unknowns = 0, pinned = 0;
  struct Material {
    double mean = 0;
    bool uniform = true;
  };
  std::array<Material, sculpt::k_field_count> materials{};
  double volume = 0, mass = 0;

  // What was done.
  std::shared_ptr<const std::vector<HistoryEntry>> history;
  std::size_t undo_depth = 0, redo_depth = 0, journal_lines = 0;
  bool saved = true;
  std::string file;                                         // empty: none yet
  std::shared_ptr<const std::vector<UnsavedWork>> unsaved;  // of earlier windows, the latest first
  std::shared_ptr<const std::vector<std::filesystem::path>> recent;
  std::shared_ptr<const FolderListing> listing;        // null before the first
  std::shared_ptr<const std::vector<Sample>> samples;  // null until they were looked for

  // What goes on.
  bool playing = false;
  std::optional<StrokeNow> stroke;
  double step_ms = 0;
  double energy = -1;  // elastic and kinetic [J]; −1: not asked for, or none
  long steps = 0, missed_ticks = 0;
  std::vector<Message> messages;  // the latest, oldest first
};

}  // namespace argil::studio
