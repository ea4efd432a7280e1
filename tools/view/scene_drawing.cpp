// Of scene_painter.h: what is drawn, in its order.

#include <algorithm>
#include <string>

#include "tools/view/scene_painter.h"

namespace argil::view {

namespace {

constexpr float k_hidden = 0.28F;  // what is left of lines and arrows behind the surface
constexpr float k_hidden_pin = 0.32F;
constexpr float k_behind_fronts = 131072;  // of 2^24, the scene's range of depths
constexpr float k_wire_in_volume = 0.45F;
constexpr float k_felt_below = 0.6F;  // of the force's colour, at the foot of the background

LineStyle style_of(sculpt::LineLook look, const Theme& theme) {
  const Colour tint = line_colour(look, theme);
  switch (look) {
    case sculpt::LineLook::overlay:
      break;
    case sculpt::LineLook::axis_u:
    case sculpt::LineLook::axis_v:
    case sculpt::LineLook::axis_w:
      return {tint, 1.2F, 1};
    case sculpt::LineLook::side:
    case sculpt::LineLook::rest_side:
    case sculpt::LineLook::material_line:
      return {tint, 1.6F, 1};
    case sculpt::LineLook::curve:
      return {tint, 2.2F, 1};
    case sculpt::LineLook::edge_spring:
      return {tint, 1.2F, 4};
    case sculpt::LineLook::face_spring:
    case sculpt::LineLook::inner_spring:
      return {tint, 0.8F, 4};
  }
  return {tint};
}

Colour mixed(const Colour& a, const Colour& b, float t) {
  return {a.red + t * (b.red - a.red), a.green + t * (b.green - a.green), a.blue + t * (b.blue - a.blue), a.alpha};
}

void set_colour(const Gl& gl, GLint place, const Colour& c) {
  gl.Uniform4f(place, c.red, c.green, c.blue, c.alpha);
}

}  // namespace

void ScenePainter::draw_volume(const Sampling& sampling, int x, int y) const {
  const Gl& gl = *gl_;
  image_program_.use();
  volume_->bind_texture(GL_TEXTURE0);
  gl.Uniform1i(image_program_.at("image"), 0);
  gl.Uniform2f(image_program_.at("tile_origin"), static_cast<float>(x), static_cast<float>(y));
  gl.Uniform2f(image_program_.at("samples"), static_cast<float>(sampling.width * sampling.factor),
               static_cast<float>(sampling.height * sampling.factor));
  gl.Disable(GL_DEPTH_TEST);
  gl.Enable(GL_BLEND);
  gl.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  nothing_.bind();
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  gl.Disable(GL_BLEND);
}

void ScenePainter::draw_line_sets(const Camera& camera, const Sampling& sampling, float opacity) const {
  for (const LineSet& set : line_sets_) {
    LineStyle style = style_of(set.look, *theme_);
    style.tint.alpha *= opacity;
    shapes_.lines(*set.lines, camera, sampling, style);
  }
}

void ScenePainter::hide_behind_surface(bool hide) const {
  if (hide)
    gl_->Enable(GL_DEPTH_TEST);
  else
    gl_->Disable(GL_DEPTH_TEST);
}

void ScenePainter::look_from(const Program& program, const Camera& camera) const {
  const Gl& gl = *gl_;
  program.use();
  gl.UniformMatrix4fv(program.at("clip_from_world"), 1, GL_FALSE, camera.clip_from_world.data());
  gl.UniformMatrix3fv(program.at("view_from_world"), 1, GL_FALSE, camera.view_from_world.data());
  const Eigen::Vector3f eye = camera.view_from_world * camera.eye;
  gl.Uniform3f(program.at("eye"), eye.x(), eye.y(), eye.z());
}

void ScenePainter::draw_obstacles(const Camera& camera, bool beneath) const {
  const Gl& gl = *gl_;
  look_from(obstacle_program_, camera);
  set_colour(gl, obstacle_program_.at("tint"), theme_->obstacle);
  for (const Obstacle& obstacle : obstacles_) {
    const bool faces = obstacle.is_ground && obstacle.normal.dot(camera.eye - obstacle.at) > 0;
    if (faces != beneath) continue;
    obstacle.surface->bind();
    // They are convex: what faces the eye is what is nearest to it.
    if (!obstacle.is_ground) gl.Enable(GL_CULL_FACE);
    gl.DrawElements(GL_TRIANGLES, obstacle.surface->count(), GL_UNSIGNED_INT, nullptr);
    gl.Disable(GL_CULL_FACE);
  }
}

void ScenePainter::draw_background(const Sampling& sampling, int x, int y) const {
  const Gl& gl = *gl_;
  const Theme& theme = *theme_;
  gl.Disable(GL_BLEND);
  gl.Disable(GL_DEPTH_TEST);
  background_program_.use();
  const Colour top = mixed(theme.background_top, theme.felt, felt_);
  const Colour bottom = mixed(theme.background_bottom, theme.felt, k_felt_below * felt_);
  gl.Uniform3f(background_program_.at("top"), top.red, top.green, top.blue);
  gl.Uniform3f(background_program_.at("bottom"), bottom.red, bottom.green, bottom.blue);
  gl.Uniform2f(background_program_.at("tile_origin"), static_cast<float>(x), static_cast<float>(y));
  gl.Uniform1f(background_program_.at("sampling"), static_cast<float>(sampling.factor));
  gl.Uniform1f(background_program_.at("picture_height"), static_cast<float>(sampling.height));
  nothing_.bind();
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

void ScenePainter::draw_surface(const Camera& camera, const Sampling& sampling) const {
  const Gl& gl = *gl_;
  hide_behind_surface(true);
  gl.Enable(GL_POLYGON_OFFSET_FILL);
  gl.PolygonOffset(1, 2);
  look_from(surface_program_, camera);
  gl.Uniform1i(surface_program_.at("has_field"), field_ ? 1 : 0);
  if (field_)
    gl.Uniform2f(surface_program_.at("value_range"), static_cast<float>(field_->low),
                 static_cast<float>(field_->high));
  const MapColours& colours = map_colours(field_ ? field_->map : sculpt::ColourMap::viridis);
  for (std::size_t i = 0; i < k_map_size; ++i) {
    const auto& c = colours[i];
    const std::string name = "field_colours[" + std::to_string(i) + "]";
    gl.Uniform3f(surface_program_.at(name.c_str()), c[0], c[1], c[2]);
  }
  const auto brushes = static_cast<GLint>(std::min<std::size_t>(brush_.middles.size(), 2));
  gl.Uniform1i(surface_program_.at("brush_count"), brushes);
  for (GLint i = 0; i < brushes; ++i) {
    const Eigen::Vector3f middle = camera.view_from_world * brush_.middles[static_cast<std::size_t>(i)];
    const std::string name = "brush[" + std::to_string(i) + "]";
    gl.Uniform4f(surface_program_.at(name.c_str()), middle.x(), middle.y(), middle.z(), brush_.radius);
  }
  set_colour(gl, surface_program_.at("brush_tint"), brush_.tint);
  gl.Uniform2f(surface_program_.at("brush_look"), static_cast<float>(brush_.falloff),
               1.6F * sampling.pixel * static_cast<float>(sampling.factor));
  if (!mesh_.is_closed) {
    surface_.draw(shown_triangles_);
  } else {
    // No back shows, unless the body is turned inside out there; along the outline fronts must win.
    gl.Enable(GL_CULL_FACE);
    gl.CullFace(GL_BACK);
    surface_.draw(shown_triangles_);
    gl.CullFace(GL_FRONT);
    gl.PolygonOffset(1, k_behind_fronts);
    if (!sampling.hurried) surface_.draw(shown_triangles_);
    gl.CullFace(GL_BACK);
  }
  gl.Disable(GL_CULL_FACE);
  gl.Disable(GL_POLYGON_OFFSET_FILL);
}

void ScenePainter::draw_shapes(const Camera& camera, const Sampling& sampling) const {
  const Theme& theme = *theme_;
  Colour wire = !draws_surface_ ? theme.wire_alone : field_ ? theme.wire_on_field : theme.wire_on_clay;
  if (volume_) wire.alpha *= k_wire_in_volume;  // there it only says where the body ends
  if (draws_wire_) wires_.draw(shapes_, camera, sampling, wire);

  using Shape = MarkStyle::Shape;
  LineStyle cage{theme.cage};
  MarkStyle handle{Shape::disc, 6, theme.curve, theme.arrow_outline},
      pin{Shape::triangle, 7, theme.pin, theme.pin_outline};
  cage.tint.alpha *= k_hidden;
  handle.opacity = pin.opacity = k_hidden_pin;
  hide_behind_surface(false);
  shapes_.lines(cage_lines_, camera, sampling, cage);
  draw_line_sets(camera, sampling, k_hidden);
  shapes_.marks(handles_, camera, sampling, handle);
  if (draws_hidden_pins_) shapes_.marks(pins_, camera, sampling, pin);
  cage.tint = theme.cage;
  handle.opacity = pin.opacity = 1;
  hide_behind_surface(true);
  shapes_.lines(cage_lines_, camera, sampling, cage);
  draw_line_sets(camera, sampling, 1);
  shapes_.marks(cage_points_, camera, sampling, {Shape::disc, 3.3F, theme.cage_point, theme.cage_ring});
  shapes_.marks(handles_, camera, sampling, handle);
  shapes_.arrows(arrow_ends_, camera, sampling, arrow_tint_.value_or(theme.arrow), theme.arrow_outline, k_hidden);
  shapes_.marks(pins_, camera, sampling, pin);
}

void ScenePainter::paint(const Camera& camera, const Sampling& sampling, int x, int y) const {
  const Gl& gl = *gl_;
  gl.Viewport(-x, -y, sampling.width * sampling.factor, sampling.height * sampling.factor);
  gl.DepthMask(GL_TRUE);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
  draw_background(sampling, x, y);
  gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl.Enable(GL_BLEND);
  draw_obstacles(camera, true);
  gl.Disable(GL_BLEND);
  if (has_shadow_) shadow_.paint(camera, theme_->shadow);

  if (volume_) draw_volume(sampling, x, y);
  gl.DepthFunc(GL_LEQUAL);
  gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  if (draws_surface_) draw_surface(camera, sampling);
  gl.Enable(GL_BLEND);
  gl.DepthMask(GL_FALSE);
  hide_behind_surface(draws_surface_);
  draw_shapes(camera, sampling);
  hide_behind_surface(draws_surface_);
  draw_obstacles(camera, false);
  gl.Disable(GL_BLEND);
  gl.DepthMask(GL_TRUE);
}

void ScenePainter::paint_ids(const Camera& camera, const Sampling& sampling, int x, int y) const {
  paint_bytes(id_program_, camera, sampling, x, y);
}

void ScenePainter::paint_depth(const Camera& camera, const Sampling& sampling, int x, int y) const {
  paint_bytes(depth_program_, camera, sampling, x, y);
}

void ScenePainter::paint_bytes(const Program& program, const Camera& camera, const Sampling& sampling, int x,
                               int y) const {
  const Gl& gl = *gl_;
  gl.Viewport(-x, -y, sampling.width, sampling.height);
  gl.DepthMask(GL_TRUE);
  gl.DepthFunc(GL_LEQUAL);
  gl.Disable(GL_BLEND);
  gl.ClearColor(1, 1, 1, 1);
  gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  if (!draws_surface_) return;
  gl.Enable(GL_DEPTH_TEST);
  look_from(program, camera);
  surface_.draw(all_triangles_);
}

}  // namespace argil::view
