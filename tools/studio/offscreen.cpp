#include "tools/studio/offscreen.h"

#include <fmt/format.h>

#include "subdiv/error.h"
#include "tools/studio/settings_file.h"

namespace argil::studio {

Offscreen::Offscreen(const OffscreenOptions& options, const std::filesystem::path& file) : options_(options) {
  workshop_ = std::make_unique<Workshop>(options.bench, options.devices);
  resize(options.width, options.height, options.scale);
  if (file.empty())
    workshop_->post([](Bench& bench) { bench.begin_block(); });
  else
    workshop_->post([file](Bench& bench) { bench.open(file); });
  workshop_->advance(0);
  wait(2);
  if (options.real_time) workshop_->start();
}

Offscreen::~Offscreen() {
  context_.make_current();
  studio_.reset();
  target_.reset();
}

void Offscreen::resize(int width, int height, float scale) {
  const bool anew = !studio_ || scale != input_.scale;
  input_.width = static_cast<int>(static_cast<float>(width) * scale);
  input_.height = static_cast<int>(static_cast<float>(height) * scale);
  input_.scale = scale;
  context_.make_current();
  target_ = std::make_unique<view::Target>(context_.gl(), input_.width, input_.height, false);
  if (anew)
    studio_ = std::make_unique<Studio>(
        context_.gl(), *workshop_,
        StudioOptions{.scale = scale,
                      .virtual_clock = true,
                      .card = options_.card,
                      .keys = {},
                      .settings = studio_ ? settings_lines(studio_->desk().settings) : std::string()});
}

void Offscreen::frame() {
  studio_->frame(input_);
  input_.keys.clear();
  input_.characters.clear();
  input_.wheel = 0;
  if (!workshop_->is_running()) workshop_->advance(input_.seconds);
  ++frames_;
}

void Offscreen::wait(int frames) {
  for (int i = 0; i < frames; ++i) frame();
}

void Offscreen::move(double x, double y) {
  input_.x = static_cast<float>(x) * input_.scale;
  input_.y = static_cast<float>(y) * input_.scale;
  frame();
}

void Offscreen::button(int which, bool down) {
  input_.buttons[which] = down;
  frame();
}

void Offscreen::pen(double pressure, bool eraser) {
  input_.has_pen = true;
  input_.pressure = std::clamp(pressure, 0.0, 1.0);
  input_.eraser = eraser;
  frame();
}

void Offscreen::wheel(double notches) {
  input_.wheel = static_cast<float>(notches);
  frame();
}

void Offscreen::key(int which, bool down) {
  input_.keys.push_back({which, down});
  frame();
}

void Offscreen::together(const std::vector<KeyEvent>& events) {
  input_.keys.insert(input_.keys.end(), events.begin(), events.end());
  frame();
}

void Offscreen::press(const std::string& words) {
  const Chord chord = parse_chord(words);
  if (chord.control) key(key::left_control, true);
  if (chord.shift) key(key::left_shift, true);
  if (chord.alt) key(key::left_alt, true);
  key(chord.key, true);
  key(chord.key, false);
  if (chord.alt) key(key::left_alt, false);
  if (chord.shift) key(key::left_shift, false);
  if (chord.control) key(key::left_control, false);
}

void Offscreen::type(const std::string& text) {
  for (const char c : text) input_.characters.push_back(static_cast<unsigned char>(c));
  frame();
  frame();
}

void Offscreen::click(double x, double y) {
  move(x, y);
  move(x, y);
  button(0, true);
  button(0, false);
}

void Offscreen::drag(double x0, double y0, double x1, double y1, int frames, int which) {
  move(x0, y0);
  move(x0, y0);
  button(which, true);
  for (int i = 1; i <= frames; ++i) {
    const double share = static_cast<double>(i) / frames;
    move(x0 + share * (x1 - x0), y0 + share * (y1 - y0));
  }
  button(which, false);
}

void Offscreen::click(const std::string& name) {
  const Control* control = studio_->ui().find(name);
  if (control == nullptr) {
    std::string names;
    for (const Control& one : studio_->ui().controls()) names += (names.empty() ? "" : ", ") + one.name;
    throw Error(ErrorCode::not_found, fmt::format("there is no control '{}' now; there are {}", name, names));
  }
  const Rect place = control->place;
  // Of a row with a label the value is pressed.
  const bool is_row = control->kind == ControlKind::choice || control->kind == ControlKind::toggle;
  const double x = is_row ? place.right() - 14 * input_.scale : place.x + 0.5F * place.width;
  click(x / input_.scale, (place.y + 0.5F * place.height) / input_.scale);
}

void Offscreen::draw() {
  context_.make_current();
  studio_->draw(target_->framebuffer());
  std::uint8_t pixel[4];  // what is read has been drawn
  target_->bind();
  context_.gl().ReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
}

sculpt::Picture Offscreen::picture() {
  context_.make_current();
  do studio_->draw(target_->framebuffer());
  while (!studio_->viewport().is_finished());
  sculpt::Picture picture;
  picture.width = target_->width();
  picture.height = target_->height();
  std::vector<std::uint8_t> rows;
  target_->bind();
  target_->read(picture.width, picture.height, rows);
  const std::size_t row = 4 * static_cast<std::size_t>(picture.width);
  picture.rgba.resize(rows.size());
  for (std::size_t y = 0; y < static_cast<std::size_t>(picture.height); ++y)
    std::copy_n(
        rows.begin() + static_cast<std::ptrdiff_t>(row * (static_cast<std::size_t>(picture.height) - 1 - y)), row,
        picture.rgba.begin() + static_cast<std::ptrdiff_t>(row * y));
  for (std::size_t i = 3; i < picture.rgba.size(); i += 4) picture.rgba[i] = 255;
  return picture;
}

}  // namespace argil::studio
