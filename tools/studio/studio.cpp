#include "tools/studio/studio.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cfloat>

#include "tools/studio/device_dialogue.h"
#include "tools/studio/dialogues.h"
#include "tools/studio/key_editor.h"
#include "tools/studio/panels.h"
#include "tools/studio/plots.h"
#include "tools/studio/settings_file.h"
#include "tools/studio/timeline.h"
#include "tools/studio/ui_renderer.h"
#include "tools/studio/work_notes.h"

namespace argil::studio {

namespace {

// Text fields know keys by Dear ImGui's own numbers.
constexpr std::array<std::array<int, 2>, 22> k_text_keys{{{ImGuiKey_Tab, key::tab},
                                                          {ImGuiKey_LeftArrow, key::left},
                                                          {ImGuiKey_RightArrow, key::right},
                                                          {ImGuiKey_UpArrow, key::up},
                                                          {ImGuiKey_DownArrow, key::down},
                                                          {ImGuiKey_PageUp, key::page_up},
                                                          {ImGuiKey_PageDown, key::page_down},
                                                          {ImGuiKey_Home, key::home},
                                                          {ImGuiKey_End, key::end},
                                                          {ImGuiKey_Insert, key::insert},
                                                          {ImGuiKey_Delete, key::del},
                                                          {ImGuiKey_Backspace, key::backspace},
                                                          {ImGuiKey_Space, key::space},
                                                          {ImGuiKey_Enter, key::enter},
                                                          {ImGuiKey_Escape, key::escape},
                                                          {ImGuiKey_KeyPadEnter, key::pad_enter},
                                                          {ImGuiKey_A, 'A'},
                                                          {ImGuiKey_C, 'C'},
                                                          {ImGuiKey_V, 'V'},
                                                          {ImGuiKey_X, 'X'},
                                                          {ImGuiKey_Y, 'Y'},
                                                          {ImGuiKey_Z, 'Z'}}};

}  // namespace

Studio::Studio(const view::Gl& gl, Workshop& workshop, const StudioOptions& options)
    : workshop_(&workshop), context_(ImGui::CreateContext()) {
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.ConfigInputTextCursorBlink = !options.virtual_clock;
  io.BackendFlags |= ImGuiBackendFlags_HasMouseCursors;
  for (const auto& pair : k_text_keys) io.KeyMap[pair[0]] = pair[1];
  const Fonts fonts = load_fonts(options.scale);
  ui_ = std::make_unique<Ui>(dark_tokens(), fonts, options.scale);
  apply_style(ui_->tokens(), options.scale);
  renderer_ = std::make_unique<UiRenderer>(gl);
  renderer_->load_atlas();
  viewport_ = std::make_unique<Viewport>(gl);
  desk_.workshop = workshop_;
  desk_.ui = ui_.get();
  desk_.virtual_clock = options.virtual_clock;
  desk_.card = options.card;
  desk_.bindings.read(options.keys, "keys");
  read_settings(desk_.settings, options.settings, "window");
  desk_.now = workshop_->latest();
}

Studio::~Studio() {
  ImGui::DestroyContext(context_);
}

void Studio::perform(Action action) {
  if (desk_.dialogue == Dialogue::none && perform_on_timeline(desk_, action)) return;
  if (action == Action::cancel) {
    if (const auto work = workshop_->work(); work && work->can_end)
      workshop_->cancel_work();
    else if (desk_.dialogue != Dialogue::none)
      desk_.dialogue = Dialogue::none;
    else
      viewport_->perform(desk_, action);
    return;
  }
  if (viewport_->perform(desk_, action)) return;
  desk_.perform(action);
}

void Studio::take_input(const Input& input) {
  controls_before_ = {control_, shift_, alt_};
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(input.width), static_cast<float>(input.height)};
  io.DeltaTime = static_cast<float>(std::max(1e-4, input.seconds));
  io.MousePos = input.x < 0 ? ImVec2{-FLT_MAX, -FLT_MAX} : ImVec2{input.x, input.y};
  for (std::size_t i = 0; i < 3; ++i) io.MouseDown[i] = input.buttons[i];
  io.MouseWheel = input.wheel;
  // A key that comes and goes within one frame is down for all of it, else text fields would not see it.
  for (const int late : let_go_late_) io.KeysDown[late] = false;
  let_go_late_.clear();
  io.KeyCtrl = control_;
  io.KeyShift = shift_;
  io.KeyAlt = alt_;
  std::vector<int> came;
  for (const KeyEvent& event : input.keys) {
    follow_modifiers(event);
    io.KeyCtrl = io.KeyCtrl || control_;
    io.KeyShift = io.KeyShift || shift_;
    io.KeyAlt = io.KeyAlt || alt_;
    if (event.key <= 0 || event.key >= 512) continue;
    if (event.down) came.push_back(event.key);
    if (!event.down && std::find(came.begin(), came.end(), event.key) != came.end())
      let_go_late_.push_back(event.key);
    else
      io.KeysDown[event.key] = event.down;
  }
  if (came.empty()) {
    io.KeyCtrl = control_;
    io.KeyShift = shift_;
    io.KeyAlt = alt_;
  }
  for (const std::uint32_t c : input.characters) io.AddInputCharacter(c);
}

void Studio::follow_modifiers(const KeyEvent& event) {
  if (event.key == key::left_control || event.key == key::right_control) control_ = event.down;
  if (event.key == key::left_shift || event.key == key::right_shift) shift_ = event.down;
  if (event.key == key::left_alt || event.key == key::right_alt) alt_ = event.down;
}

void Studio::take_keys(const Input& input) {
  const bool types = ImGui::GetIO().WantTextInput || ui_->is_editing();
  // A whole chord may come within one frame: each key goes with the modifiers that were down before it.
  control_ = controls_before_[0];
  shift_ = controls_before_[1];
  alt_ = controls_before_[2];
  for (const KeyEvent& event : input.keys) {
    follow_modifiers(event);
    if (!event.down) {
      viewport_->key_released(desk_, event.key);
      continue;
    }
    if (edit_key(desk_, {event.key, control_, shift_, alt_})) continue;
    if (search_key(desk_, event.key, [this](Action action) { perform(action); })) continue;
    const auto action = desk_.bindings.action_of({event.key, control_, shift_, alt_});
    if (!action) continue;
    // A menu that is open goes at any key that means something; Esc means no more than that.
    if (ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel)) {
      ImGui::ClosePopupToLevel(0, true);
      if (*action == Action::cancel) continue;
    }
    // What is typed is text; but what closes, searches or lets go works from everywhere.
    const bool always = *action == Action::search || *action == Action::sheet_of_keys ||
                        *action == Action::forces_off || (*action == Action::cancel && !ui_->is_editing());
    if (types && !always) continue;
    if (desk_.dialogue != Dialogue::none && !always) continue;
    // A stroke under way is ended or taken back before anything else is done.
    if (viewport_->is_busy() && *action != Action::cancel && *action != Action::forces_off) continue;
    perform(*action);
  }
}

void Studio::frame(const Input& input) {
  input_ = input;
  workshop_->frame_begins();
  ImGui::SetCurrentContext(context_);
  desk_.now = workshop_->latest();
  desk_.follow_solid();
  desk_.has_pen = input.has_pen;
  desk_.time += input.seconds;
  desk_.frame_ms += 0.1 * (1e3 * input.seconds - desk_.frame_ms);
  desk_.frames_a_second = desk_.frame_ms > 0 ? 1e3 / desk_.frame_ms : 0;
  if (!desk_.now->messages.empty() && desk_.now->messages.back().number != desk_.seen_message) {
    desk_.seen_message = desk_.now->messages.back().number;
    desk_.message_since = desk_.time;
  }
  if (desk_.now->samples && desk_.sample_pictures.empty())
    for (const Sample& sample : *desk_.now->samples)
      desk_.sample_pictures.push_back(renderer_->add_picture(sample.picture));
  follow_plots(desk_);
  const Tokens& tokens = desk_.settings.light ? light_tokens() : dark_tokens();
  if (&tokens != &ui_->tokens()) {
    ui_->set_tokens(tokens);
    apply_style(tokens, ui_->scale());
  }

  take_input(input);
  ImGui::NewFrame();
  ui_->begin_frame();
  const Layout layout = lay_out(desk_, input.width, input.height);
  const Perform perform_here = [this](Action action) { perform(action); };
  take_keys(input);
  for (const auto& file : input.dropped) workshop_->post([file](Bench& bench) { bench.open(file); });
  const ImGuiIO& io = ImGui::GetIO();
  const bool over_ui =
      !viewport_->is_busy() && (io.WantCaptureMouse || desk_.dialogue != Dialogue::none || input.x < 0);
  viewport_->camera_window(input.width, input.height, layout.free);
  viewport_->handle(desk_, input, control_, shift_, over_ui);

  lay_brush_ready(desk_, viewport_->camera());
  viewport_->draw_marks(desk_);
  draw_device_mark(desk_, viewport_->camera());
  draw_menu(desk_, layout, perform_here);
  draw_shelf(desk_, layout);
  draw_legend(desk_, layout);
  draw_panels(desk_, layout, perform_here);
  draw_timeline(desk_, layout, perform_here);
  draw_status(desk_, layout);
  draw_hints(desk_, layout, perform_here);
  draw_pending(desk_, layout.free, viewport_->select_mode());
  draw_context_menu(desk_, perform_here);
  draw_work(desk_, layout);
  draw_offer(desk_, layout);
  draw_dialogues(desk_, layout, perform_here, input.width, input.height);
  ui_->end_frame();
  ImGui::Render();
  workshop_->frame_ends();
}

void Studio::draw(unsigned framebuffer) {
  ImGui::SetCurrentContext(context_);
  viewport_->draw(desk_, input_, framebuffer);
  renderer_->draw(*ImGui::GetDrawData());
}

}  // namespace argil::studio
