#pragma once
// The controls that panels are made of, drawn by ourselves over Dear ImGui's input handling: buttons of signs, rows
// with a number, a choice, a switch or a reading, tabs, menus' lines. Every control has a name and a tooltip, and
// every number its unit; what is drawn in a frame is listed, so that a test can hold all controls to that and a
// script can press them by name.

#include <array>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/studio/fonts.h"
#include "tools/studio/theme.h"

struct ImDrawList;
struct ImFont;

namespace argil::studio {

struct Rect {
  float x = 0, y = 0, width = 0, height = 0;
  [[nodiscard]] float right() const { return x + width; }
  [[nodiscard]] float bottom() const { return y + height; }
  [[nodiscard]] bool contains(float at_x, float at_y) const {
    return at_x >= x && at_y >= y && at_x < right() && at_y < bottom();
  }
};

enum class ControlKind { button, number, choice, toggle, reading, text };
struct Control {
  ControlKind kind;
  std::string name, tooltip, unit;
  Rect place;
};

enum class Side { left, centre, right };

struct NumberStyle {
  std::string unit{}, tooltip{};
  double low = 0, high = 1, reset = 0;
  bool logarithmic = false;  // in dragging and in the bar
  bool bar = true;
};

class Ui {
 public:
  Ui(const Tokens& tokens, const Fonts& fonts, float scale) : tokens_(&tokens), fonts_(fonts), scale_(scale) {}

  const Tokens& tokens() const { return *tokens_; }
  void set_tokens(const Tokens& tokens) { tokens_ = &tokens; }
  const Fonts& fonts() const { return fonts_; }
  float scale() const { return scale_; }
  float px(float size) const { return size * scale_; }

  void begin_frame() {
    controls_.clear();
    front_ = 0;
    popup_ = {0, 0};
  }
  /// What is drawn from here on lies before all else: only it explains itself.
  void come_to_front() { front_ = controls_.size(); }
  /// The tooltip of what the pointer rests on, over everything.
  void end_frame();
  const std::vector<Control>& controls() const { return controls_; }
  const Control* find(std::string_view name) const;
  bool is_editing() const { return editing_ != 0; }

  // Panels. Between begin and end, rows are laid one below the other.
  void begin_panel(const char* name, const Rect& place, Ink fill, float corner, bool scrolls = false);
  void end_panel();
  /// What ImGui::OpenPopup of this name opened, on a raised sheet; end_popup only if it is open.
  bool begin_popup(const char* name, const Rect& place);
  void end_popup();
  void set_cursor(float x, float y, float width);
  float cursor_y() const { return y_; }
  void skip(float height) { y_ += px(height); }

  // What stands in a panel.
  void section(std::string_view title);
  bool icon_button(const char* name, const Rect& place, const Icon& icon, bool active, const std::string& tooltip,
                   bool enabled = true);
  bool text_button(const char* name, const Rect& place, const std::string& label, bool primary,
                   const std::string& tooltip, bool enabled = true);
  bool tab(const char* name, const Rect& place, bool active, const std::string& tooltip);
  /// True when a new value is set; while the pointer drags, `preview` takes each value.
  bool number_row(const char* name, double& value, const NumberStyle& style,
                  const std::function<void(double)>& preview = {});
  bool vector_row(const char* name, double (&values)[3], const NumberStyle& style);
  bool choice_row(const char* name, std::span<const std::string> options, std::size_t& chosen,
                  const std::string& tooltip);
  /// By the word that is chosen, of which `options` need not know.
  bool choice_row(const char* name, std::span<const std::string> options, std::string& chosen,
                  const std::string& tooltip);
  bool toggle_row(const char* name, bool& on, const std::string& tooltip);
  void reading_row(const char* name, const std::string& number, const std::string& unit,
                   const std::string& tooltip);
  void note(const std::string& text);  // wrapped, quiet
  /// A line of a menu or list; true when pressed.
  bool list_row(const std::string& name, const std::string& shortcut, bool marked, bool chosen,
                const std::string& tooltip, bool enabled = true);
  /// A line of text to type in. `entered`: Enter was pressed. True when it changed.
  bool text_field(const char* name, const Rect& place, std::string& text, const char* hint, bool take_focus,
                  bool& entered, const std::string& tooltip);

  // Drawing.
  ImDrawList& list() const;
  void text(ImDrawList& list, ImFont* font, const Rect& place, Ink colour, std::string_view text,
            Side side = Side::left) const;
  void icon(ImDrawList& list, const Rect& place, Ink colour, const Icon& icon, bool small = false) const;
  float width_of(ImFont* font, std::string_view text) const;
  /// The line, or as much of it as has room before an ellipsis.
  [[nodiscard]] std::string fitted(ImFont* font, std::string_view text, float width) const;
  void box(ImDrawList& list, const Rect& place, Ink colour, float corner = k_corner) const;
  void frame(ImDrawList& list, const Rect& place, Ink colour, float corner = k_corner) const;
  void shadow(ImDrawList& list, const Rect& place, float corner) const;
  /// Remembers a control of this frame; the tooltip shows when the pointer rests on it.
  void note_control(ControlKind kind, std::string_view name, const std::string& tooltip, const std::string& unit,
                    const Rect& place);

 private:
  struct Row {
    Rect label, value;
  };
  Row next_row();
  bool number_box(const char* name, const Rect& place, double& value, const NumberStyle& style,
                  const std::function<void(double)>& preview);
  /// A sheet with these words at a control, over everything.
  void draw_tip(const Rect& of, const std::string& words, Ink colour) const;
  bool press(const char* name, const Rect& place, bool& hovered, bool& held);

  const Tokens* tokens_;
  Fonts fonts_;
  float scale_;
  std::vector<Control> controls_;
  std::size_t front_ = 0;
  std::array<std::size_t, 2> popup_{0, 0};  // what the open menu has: while there is one, only that explains itself
  float x_ = 0, y_ = 0, width_ = 0;
  // The number that is typed or dragged.
  unsigned editing_ = 0, dragging_ = 0;
  int editing_waits_ = 0;  // frames until the text field has the keyboard
  bool edit_failed_ = false;
  double editing_since_ = 0;
  char edited_[96] = {};
  double drag_start_ = 0;
  std::string edit_error_;
  // The tooltip that waits.
  std::string rest_on_;
  double rested_ = 0;
};

}  // namespace argil::studio
