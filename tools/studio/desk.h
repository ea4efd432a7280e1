#pragma once
// What the parts of the window share: the snapshot that this frame shows, the sculptor's settings, and the way from
// an action to an order of the workshop.

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "tools/studio/edit_tools.h"
#include "tools/studio/keys.h"
#include "tools/studio/ui.h"
#include "tools/studio/workshop.h"

namespace argil::studio {

/// What the pointer does on clay.
enum class ToolKind {
  force,
  paint,
  mask,
  pin,
  extrude,
  curve,
  probe
};  // a hairline of the shelf stands between two

struct ShelfTool {
  ToolKind kind;
  const char* name;  // as the command `tool` has it; "": not a stroke
  const char* label;
  const char* verb;  // what dragging on clay does
  const char* help;
  Icon icon;
  const char* field = "";  // that it paints: shown while it is taken
};
/// Those that this program can do, in the order of the shelf.
[[nodiscard]] const std::vector<ShelfTool>& shelf_tools();

enum class Panel { tool, material, physics, fields, history };
inline constexpr std::array<const char*, 5> k_panel_names{"Tool", "Material", "Physics", "Fields", "History"};

/// What the pressure of a pen scales.
enum class PenScales { strength, radius, nothing };

struct Settings {
  std::size_t tool = 0;  // of the shelf
  bool keep_shape = true, wireframe = true, finest_wires = false, cage = false, light = false, panels = true;
  bool cut = false, field_of_tool = false;
  Eigen::Vector3d cut_point = Eigen::Vector3d::Zero(), cut_normal{0, -1, 0};
  int peel = 0;                                 // layers of cells that are taken away
  std::optional<sculpt::ElementType> choosing;  // select mode, and of what; none: sculpting
  std::string field;                            // empty: clay
  bool fixed_range = false;
  double range_low = 0, range_high = 1;
  Panel panel = Panel::tool;
  PenScales pen = PenScales::strength;  // kept from one window to the next
};

/// What lies under the brush.
struct Reading {
  bool there = false;
  double young_modulus = 0, strain = -1, felt = 0;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
};

/// A curve while it is laid on the clay, and once it can be drawn by its handles.
struct CurveLaid {
  std::vector<Eigen::Vector3d> points;
  bool finished = false;
};

/// A mark of the timeline under the pointer, or held by it [s].
struct KeyMark {
  std::optional<double> pointed;  // as of the last frame
  std::optional<double> held;     // the time that it had
  double to = 0;                  // where it is dragged
  bool dropped = false;           // by Esc, until the button goes up
  std::optional<double> menu;     // whose menu is open
  bool wants_key_menu = false;
};

/// What has the keyboard in front of everything else.
enum class Dialogue { none, search, keys, open, save, samples, unsaved, devices };

struct Desk {
  Workshop* workshop = nullptr;
  Ui* ui = nullptr;
  Bindings bindings;
  Settings settings;
  std::shared_ptr<const Snapshot> now;
  sculpt::Tool brush;                             // of the next stroke; it becomes the document's when one begins
  std::uint64_t brush_solid = 0, brush_line = 0;  // of the snapshot that the brush follows
  sculpt::Tool fitted_brush;                      // chosen to fit the solid
  Reading reading;
  std::optional<std::uint32_t> pointed;  // the element under the pointer in select mode
  PendingEdit pending;
  CurveLaid curve;
  KeyMark key_mark;
  bool wants_context_menu = false;                                      // where the pointer is
  std::array<float, 2> context_menu_at{-1, -1};                         // where it stands open [pixels]
  Dialogue dialogue = Dialogue::none, shown_dialogue = Dialogue::none;  // asked for, and as of the last frame
  std::string typed;                                                    // in the dialogue
  std::size_t chosen = 0;                                               // of what a search found
  bool retake_focus = false;
  std::string listed;                     // what the workshop was asked to list last
  std::vector<unsigned> sample_pictures;  // of Snapshot::samples, as the graphics card names them
  std::optional<Action> rebinds;          // waits for its new key
  std::string key_note;
  ReadyBrush ready;  // as the workshop was told it for a device
  bool brush_is_ready = false;
  bool unsaved_seen = false;  // the offer to bring work back was answered
  float panel_height = 0;     // that the panel wants
  bool card = true;           // of the first minute
  bool quits = false, takes_picture = false;
  bool has_pen = false;
  std::filesystem::path folder = ".";  // where files are opened and saved
  double frame_ms = 0, frames_a_second = 0;
  std::vector<float> force_plot, energy_plot;  // [N], [J]; the latest last
  bool wants_energy = false;
  std::uint64_t plotted_solid = 0, plotted_version = 0;
  double time = 0;  // [s], since the window opened
  std::uint64_t seen_message = 0;
  double message_since = 0;
  bool virtual_clock = false;  // no speed is shown, so that pictures are the same

  [[nodiscard]] const ShelfTool& tool() const { return shelf_tools()[settings.tool]; }
  /// What the pointer lights up: what is chosen in select mode, or faces for the tool that draws them out.
  [[nodiscard]] std::optional<sculpt::ElementType> pointing() const;
  /// What is selected in the document, possibly nothing.
  [[nodiscard]] const sculpt::Selection& selection() const;
  /// Goes to select mode of these elements, or back to sculpting.
  void choose(std::optional<sculpt::ElementType> type);
  /// The tool that has been taken is laid down again, and its ghost with it.
  void drop_pending();
  void run(const std::string& line) const { workshop->run(line); }
  void take_tool(std::size_t index);
  /// Takes the brush of a solid that was begun or opened.
  void follow_solid();
  /// Tells the workshop what of the settings concerns the scene.
  void show() const;
  /// True if it was done here; the viewport does those of the camera and the brush.
  bool perform(Action action);
  void open_dialogue(Dialogue which, const std::string& text = "");
  [[nodiscard]] std::string tooltip(Action action) const;
};

/// Field names in the order in which V goes through them.
[[nodiscard]] const std::vector<std::string>& cycled_fields();

}  // namespace argil::studio
