// Of viewport.h: what is drawn.

#include <fmt/format.h>
#include <imgui.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cfloat>
#include <cmath>
#include <set>
#include <string_view>

#include "tools/studio/quantity.h"
#include "tools/studio/viewport.h"

namespace argil::studio {

namespace {

constexpr double k_longest_arrow = 0.3;  // of the solid's radius, at the force limit or where the force is large

/// Others hold what they took at their press, whatever the pen does then.
bool goes_over_clay(const ShelfTool& tool) {
  return tool.kind == ToolKind::paint || tool.kind == ToolKind::mask ||
         (tool.kind == ToolKind::force &&
          std::set<std::string_view>{"inflate", "pinch", "smooth"}.contains(tool.name));
}

}  // namespace

void Viewport::draw(const Desk& desk, const Input& input, unsigned framebuffer) {
  const Snapshot& now = *desk.now;
  const Settings& settings = desk.settings;
  if (!average_ || average_->width() != input.width || average_->height() != input.height) {
    scene_changed_ = true;
    average_ = std::make_unique<view::SampleAverage>(*gl_, input.width, input.height);
  }

  if (now.version != version_ || layout_ == 0 || !loaded_ != !now.scene) {
    static const sculpt::Scene k_nothing;
    const sculpt::Scene& scene = now.scene ? *now.scene : k_nothing;
    if (layout_ == 0 || now.layout != layout_ || !loaded_ != !now.scene) {
      // Coordinates of the picture stay while the solid is of about the same size, so that nothing swims.
      const Box box = box_of(now);
      if (layout_ == 0 || !(box.radius() < 2 * place_.radius && box.radius() > 0.3 * place_.radius))
        place_ = view::place_of(scene.surface.positions);
      painter_.load(scene, place_, {.wireframe = settings.wireframe, .light_theme = settings.light});
    } else if (now.scene != loaded_ || now.shade_again) {
      painter_.move(scene, place_, now.shade_again);
    }
    scene_changed_ = scene_changed_ || layout_ != now.layout || now.scene != loaded_ || now.shade_again;
    layout_ = std::max<std::uint64_t>(1, now.layout);
    version_ = now.version;
    loaded_ = now.scene;
  }
  painter_.set_look(settings.wireframe, settings.light, false);
  if (painter_.shade_on()) scene_changed_ = true;

  // The force, where it holds the solid.
  const Tokens& t = desk.ui->tokens();
  std::vector<sculpt::SceneArrow> arrows;
  view::Colour arrow_tint = colour_of(t.accent);
  if (now.stroke && now.stroke->force.norm() > 0) {
    const double most =
        now.tool.largest_force < 1e5 ? now.tool.largest_force : now.tool.strength * 0.5 * box_of(now).radius();
    const double share = now.stroke->force.norm() / std::max(1e-12, most);
    const double length = k_longest_arrow * place_.radius * 2 * std::min(1.0, std::sqrt(share));
    const Eigen::Vector3d tip = now.stroke->held + length * now.stroke->force.normalized();
    arrows.push_back({place_(now.stroke->held.cast<float>()), place_(tip.cast<float>())});
    if (now.stroke->at_limit) arrow_tint = colour_of(t.warning);
  } else if (now.scene) {
    for (const sculpt::SceneArrow& arrow : now.scene->arrows)
      arrows.push_back({place_(arrow.from), place_(arrow.to)});
  }

  // The brush, on the surface itself.
  view::BrushMark mark;
  const bool shows_brush =
      now.scene && desk.tool().kind != ToolKind::extrude && !desk.settings.choosing && desk.pending.tool == nullptr;
  double radius = drag_ == Drag::radius ? brush_now_ : desk.brush.radius;
  if (drag_ == Drag::stroke && settings.pen == PenScales::radius && goes_over_clay(desk.tool()))
    radius *= pressure_;
  mark.radius = static_cast<float>(radius / place_.radius);
  mark.falloff = desk.brush.falloff == "linear" ? 1 : desk.brush.falloff == "constant" ? 2 : 0;
  Ink tint = inverts_ ? t.mark : t.accent;
  if (shows_brush && now.stroke) {
    if (now.stroke->at_limit) tint = t.warning;
    mark.middles = {place_(now.stroke->held.cast<float>())};
  } else if (shows_brush && hover_) {
    mark.middles = {place_(hover_->at.cast<float>())};
    if (desk.brush.symmetry != 0) {
      const int axis = desk.brush.symmetry - 'x';
      Eigen::Vector3d other = hover_->at;
      other[axis] = 2 * now.rest_middle[axis] - other[axis];
      mark.middles.push_back(place_(other.cast<float>()));
    }
  }
  mark.tint = colour_of(tint);

  Box box = box_of(now);
  if (now.stroke) {
    const Eigen::Vector3d reach = now.stroke->held + now.stroke->force.normalized() * place_.radius;
    if (reach.allFinite()) box = {box.low.cwiseMin(reach), box.high.cwiseMax(reach)};
  }
  update_overlay(desk);
  // Where nothing moved, the picture of before is taken again, with smoother edges.
  const view::Camera camera = camera_.camera(place_, box);
  std::vector<float> drawn(camera.clip_from_world.data(), camera.clip_from_world.data() + 16);
  for (const Eigen::Vector3f& middle : mark.middles) drawn.insert(drawn.end(), middle.data(), middle.data() + 3);
  for (const sculpt::SceneArrow& arrow : arrows) {
    drawn.insert(drawn.end(), arrow.from.data(), arrow.from.data() + 3);
    drawn.insert(drawn.end(), arrow.to.data(), arrow.to.data() + 3);
  }
  for (const double value :
       {static_cast<double>(mark.radius), static_cast<double>(mark.falloff), static_cast<double>(mark.tint.red),
        static_cast<double>(arrow_tint.red), settings.wireframe ? 1.0 : 0.0, settings.light ? 1.0 : 0.0})
    drawn.push_back(static_cast<float>(value));
  const bool moves = scene_changed_ || overlay_changed_ || drawn != drawn_;
  pace_.frame(input.seconds, moves);
  if (moves) {
    painter_.set_brush(std::move(mark));
    painter_.set_arrows(std::move(arrows), arrow_tint);
    drawn_ = std::move(drawn);
    scene_changed_ = overlay_changed_ = false;
    average_->restart();
  }
  // What was drawn in haste does not stay.
  if (!moves && hurried_) average_->restart();
  hurried_ = moves && pace_.samples() == 1;
  const view::Sampling sampling{input.width, input.height, 1, input.scale, hurried_};
  for (int i = 0; i < pace_.samples() && average_->count() < view::SampleAverage::k_most; ++i) {
    const view::Camera shifted = average_->shifted(camera);
    average_->begin_sample();
    painter_.paint(shifted, sampling, 0, 0);
    overlay_.paint(shifted, sampling);
  }
  average_->show(framebuffer);
}

void Viewport::draw_marks(Desk& desk) {
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  const Snapshot& now = *desk.now;
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const auto label = [&](Eigen::Vector2d at, const std::string& line, Ink colour) {
    const float width = ui.width_of(ui.fonts().small_strong, line) + ui.px(14), height = ui.px(22);
    const Rect place{static_cast<float>(at.x()), static_cast<float>(at.y()) - 0.5F * height, width, height};
    ui.box(draw, place, faded(t.panel, 0.92F), 4);
    ui.text(draw, ui.fonts().small_strong, place, colour, line, Side::centre);
  };
  // What takes more than a line is wrapped, and stays within the view.
  const auto note = [&](const std::string& text, Ink colour) {
    const float most = ui.px(360), margin = ui.px(8);
    const ImVec2 size =
        ui.fonts().small_strong->CalcTextSizeA(ui.fonts().small_strong->FontSize, FLT_MAX, most, text.c_str());
    Rect place{static_cast<float>(x_) + ui.px(18), static_cast<float>(y_) + ui.px(14), size.x + 2 * margin,
               size.y + margin};
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const bool panels = desk.settings.panels;
    if (x_ < 0) place.x = 0.5F * (window.x - place.width), place.y = ui.px(k_menu_height + 96);  // no pointer
    place.x = std::max(ui.px(panels ? k_shelf_width + 2 * k_gap : k_gap),
                       std::min(place.x, window.x - place.width - ui.px(panels ? k_panel_width + 28 : 8)));
    place.y = std::max(ui.px(k_menu_height + 8),
                       std::min(place.y, window.y - ui.px(k_status_height + k_timeline_height + 8) - place.height));
    ui.box(draw, place, faded(t.panel, 0.92F), 4);
    draw.AddText(ui.fonts().small_strong, ui.fonts().small_strong->FontSize,
                 {place.x + margin, place.y + 0.5F * margin}, colour, text.c_str(), nullptr, most);
  };
  const auto line = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b, Ink colour, float width) {
    const Eigen::Vector2d from = camera_.pixel(a), to = camera_.pixel(b);
    draw.AddLine({static_cast<float>(from.x()), static_cast<float>(from.y())},
                 {static_cast<float>(to.x()), static_cast<float>(to.y())}, colour, ui.px(width));
  };

  if (desk.brush.symmetry != 0 && now.scene) {
    const int axis = desk.brush.symmetry - 'x';
    const Box box = box_of(now);
    const Eigen::Vector3d half = 0.58 * (box.high - box.low);
    Eigen::Vector3d middle = box.middle();
    middle[axis] = now.rest_middle[axis];
    const Eigen::Vector3d u = Eigen::Vector3d::Unit((axis + 1) % 3) * half[(axis + 1) % 3],
                          v = Eigen::Vector3d::Unit((axis + 2) % 3) * half[(axis + 2) % 3];
    const Eigen::Vector3d corners[] = {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
    for (int i = 0; i < 4; ++i) line(corners[i], corners[(i + 1) % 4], faded(t.mark, 0.55F), 1);
  }
  if (const auto box = drag_ == Drag::choose ? select_.box(desk, x_, y_) : std::nullopt) {
    const ImVec2 low{static_cast<float>(box->left), static_cast<float>(box->top)},
        high{static_cast<float>(box->right), static_cast<float>(box->bottom)};
    draw.AddRectFilled(low, high, faded(t.accent, 0.12F));
    draw.AddRect(low, high, faded(t.accent, 0.8F), 0, 0, ui.px(1));
  }
  if (desk.pending.tool != nullptr && now.ghost && now.ghost->lines == desk.pending.lines()) {
    std::string said = now.ghost->fault.empty() ? counts_of(*now.ghost) : now.ghost->fault;
    if (const std::size_t more = said.find(';'); !now.ghost->fault.empty() && more != said.npos) said.resize(more);
    note(said, now.ghost->fault.empty() ? t.accent : t.warning);
  }
  if (desk.settings.cut && now.scene) {
    const Settings& s = desk.settings;
    const Box box = box_of(now);
    Eigen::Index axis = 0;
    s.cut_normal.cwiseAbs().maxCoeff(&axis);
    const Eigen::Vector3d side = Eigen::Vector3d::Unit((axis + 1) % 3),
                          other = Eigen::Vector3d::Unit((axis + 2) % 3);
    const Eigen::Vector3d half = 0.56 * (box.high - box.low);
    const double u = half.dot(side), v = half.dot(other);
    const Eigen::Vector3d& p = s.cut_point;
    const Eigen::Vector3d corners[] = {p - u * side - v * other, p + u * side - v * other, p + u * side + v * other,
                                       p - u * side + v * other};
    for (int i = 0; i < 4; ++i) line(corners[i], corners[(i + 1) % 4], faded(t.mark, 0.6F), 1);
    const Eigen::Vector3d tip = p + 0.16 * box.radius() * s.cut_normal;
    line(p, tip, t.mark, 2);
    const Eigen::Vector2d handle = camera_.pixel(p);
    const ImVec2 at{static_cast<float>(handle.x()), static_cast<float>(handle.y())};
    draw.AddCircleFilled(at, ui.px(7), t.panel, 24);
    draw.AddCircleFilled(at, ui.px(5), t.mark, 24);
    ui.note_control(ControlKind::button, "Handle of the cut",
                    "Drag it along the arrow, or turn the wheel, to move the plane", "",
                    {at.x - ui.px(9), at.y - ui.px(9), ui.px(18), ui.px(18)});
  }

  if (now.stroke && now.stroke->force.norm() > 0) {
    const Quantity force = shown(now.stroke->force.norm(), "N");
    label(Eigen::Vector2d(x_ + ui.px(18), y_ - ui.px(14)), force.number + ' ' + force.unit,
          now.stroke->at_limit ? t.warning : t.accent);
  }
  // What could not be done is said where the hand is.
  if (!now.messages.empty() && now.messages.back().kind == MessageKind::error &&
      desk.time - desk.message_since < 3 && desk.dialogue == Dialogue::none) {
    std::string said = now.messages.back().text;
    if (const std::size_t more = said.find(';'); more != said.npos) said.resize(more);
    note(said, t.warning);
  }
  if (drag_ == Drag::radius || drag_ == Drag::strength) {
    const Quantity size = shown(brush_now_, drag_ == Drag::radius ? "m" : "N/m");
    label(Eigen::Vector2d(x_ + ui.px(18), y_), size.number + ' ' + size.unit, t.accent);
  }
  if (desk.tool().kind == ToolKind::probe && hover_ && drag_ == Drag::none) {
    const Quantity young = shown(desk.reading.young_modulus, "Pa");
    std::string words = young.number + ' ' + young.unit;
    if (desk.reading.strain >= 0) words += "  ·  " + shown(100 * desk.reading.strain, "%").number + " %";
    label(Eigen::Vector2d(x_ + ui.px(16), y_), words, t.text);
  }
}

}  // namespace argil::studio
