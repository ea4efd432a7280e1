#include "tools/studio/sheet.h"

#include <imgui.h>
#include <imgui_internal.h>

namespace argil::studio {

void open_sheet(Desk& desk, const char* name, const Rect& place, int width, int height) {
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  ui.come_to_front();
  // What lies behind is dimmed, and takes no clicks: one beside the sheet closes it.
  ui.begin_panel("behind", {0, 0, static_cast<float>(width), static_cast<float>(height)}, t.shade, 0);
  ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
  ImGui::SetCursorScreenPos({0, 0});
  if (ImGui::InvisibleButton("##behind", {static_cast<float>(width), static_cast<float>(height)}) &&
      desk.dialogue == desk.shown_dialogue)
    desk.dialogue = Dialogue::none;
  ui.end_panel();
  ui.begin_panel(name, place, 0, 0);
  ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
  ImDrawList& draw = ui.list();
  draw.PushClipRectFullScreen();
  ui.shadow(draw, place, 8);
  draw.PopClipRect();
  ui.box(draw, place, t.raised, 8);
  ui.frame(draw, place, t.outline, 8);
}

}  // namespace argil::studio
