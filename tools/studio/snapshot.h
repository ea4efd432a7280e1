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

namespace argil::studio {

/// What the window wants to see; it changes nothing of the document.
struct Shown {
  std::string field;                           // empty: clay
  std::optional<std::array<double, 2>> range;  // else of the field's values
  std::optional<sculpt::ClipPlane> clip;
  bool cage = false;
  bool finest_wires = false;  // else only those between control cells
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
  std::uint64_t solid_number = 0;              // another one: a solid was begun or opened
  bool shade_again = false;                    // came to rest: hollows may be measured anew
  std::shared_ptr<const sculpt::Scene> scene;  // null: there is no solid
  std::vector<float> young_modulus, strain;    // per surface vertex, as of the last rest; may be empty
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
  long steps = 0, missed_ticks = 0;
  std::vector<Message> messages;  // the latest, oldest first
};

}  // namespace argil::studio
