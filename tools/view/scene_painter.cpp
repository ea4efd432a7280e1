#include "tools/view/scene_painter.h"

#include <algorithm>

#include "tools/view/arrow_mesh.h"
#include "tools/view/openness.h"
#include "tools/view/shaders.h"

namespace argil::view {

namespace {

constexpr float k_hidden = 0.28F;  // what is left of lines and arrows behind the surface
constexpr float k_hidden_pin = 0.32F;
constexpr float k_wire_in_volume = 0.45F;
constexpr float k_felt_below = 0.6F;  // of the force's colour, at the foot of the background
// Shorter lines fade, so that a fine mesh does not cover what it lies on [pixels].
constexpr float k_wire_length = 22, k_cage_length = 8;

using Line = std::array<Eigen::Vector3f, 2>;

struct LineStyle {
  Colour tint;
  float half_width = 0.55F, full_length = k_cage_length;
};

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

ScenePainter::ScenePainter(const Gl& gl)
    : gl_(&gl),
      background_program_(gl, shaders::k_whole_vertex, shaders::k_background_fragment),
      surface_program_(gl, shaders::k_surface_vertex, shaders::k_surface_fragment),
      id_program_(gl, shaders::k_surface_vertex, shaders::k_id_fragment),
      depth_program_(gl, shaders::k_surface_vertex, shaders::k_depth_fragment),
      line_program_(gl, shaders::k_line_vertex, shaders::k_line_fragment),
      mark_program_(gl, shaders::k_mark_vertex, shaders::k_mark_fragment),
      arrow_program_(gl, shaders::k_arrow_vertex, shaders::k_arrow_fragment),
      image_program_(gl, shaders::k_whole_vertex, shaders::k_image_fragment),
      obstacle_program_(gl, shaders::k_surface_vertex, shaders::k_obstacle_fragment),
      shadow_(gl),
      nothing_(gl),
      surface_(gl),
      wire_(gl),
      cage_lines_(gl),
      cage_points_(gl),
      handles_(gl),
      pins_(gl),
      arrows_(gl) {
  nothing_.set(std::vector<float>(4, 0.0F), std::array<Attribute, 1>{{{0, 1}}});
}

void ScenePainter::load(const sculpt::Scene& scene, const Place& place, const sculpt::PictureOptions& options) {
  set_look(options.wireframe, options.light_theme);
  draws_surface_ = scene.draw_surface;

  std::vector<Eigen::Vector3f> positions;
  for (const Eigen::Vector3f& position : scene.surface.positions) positions.push_back(place(position));
  mesh_ = surface_mesh(scene.surface, positions);
  if (draws_surface_) measure_openness(*gl_, depth_program_, mesh_);
  surface_.set(mesh_.vertices, k_surface_attributes, 0, mesh_.triangles);
  has_shadow_ = options.contact_shadow && (draws_surface_ || scene.volume) && !mesh_.triangles.empty();
  if (has_shadow_) shadow_.prepare(mesh_, surface_);
  draws_surface_ = draws_surface_ && !mesh_.triangles.empty();
  volume_.reset();
  load_lines(scene, place, positions);
}

void ScenePainter::move(const sculpt::Scene& scene, const Place& place, bool shade_again) {
  std::vector<Eigen::Vector3f> positions;
  positions.reserve(scene.surface.positions.size());
  for (const Eigen::Vector3f& position : scene.surface.positions) positions.push_back(place(position));
  argil::view::move(mesh_, scene.surface, positions);
  if (draws_surface_ && shade_again) measure_openness(*gl_, depth_program_, mesh_);
  if (!mesh_.vertices.empty()) surface_.refill(mesh_.vertices);
  if (has_shadow_) shadow_.prepare(mesh_, surface_);
  load_lines(scene, place, positions);
}

void ScenePainter::set_look(bool wireframe, bool light_theme, bool hidden_pins) {
  draws_hidden_pins_ = hidden_pins;
  theme_ = light_theme ? &k_light_theme : &k_dark_theme;
  draws_wire_ = wireframe;
}

void ScenePainter::set_arrows(std::vector<sculpt::SceneArrow> arrows, const Colour& tint) {
  arrow_ends_ = std::move(arrows);
  arrow_tint_ = tint;
}

void ScenePainter::load_lines(const sculpt::Scene& scene, const Place& place,
                              const std::vector<Eigen::Vector3f>& positions) {
  field_.reset();
  if (!scene.surface.values.empty()) field_ = scene.legend;
  std::vector<Line> lines;
  for (const auto& ends : scene.surface.wire) lines.push_back({positions[ends[0]], positions[ends[1]]});
  wire_.set(lines, k_line_attributes, 1);
  lines.clear();
  for (const auto& ends : scene.cage_lines) lines.push_back({place(ends[0]), place(ends[1])});
  cage_lines_.set(lines, k_line_attributes, 1);

  line_sets_.clear();
  for (const sculpt::SceneLines& set : scene.lines) {
    lines.clear();
    for (const auto& ends : set.lines) lines.push_back({place(ends[0]), place(ends[1])});
    line_sets_.push_back({set.look, std::make_unique<VertexArray>(*gl_)});
    line_sets_.back().lines->set(lines, k_line_attributes, 1);
  }

  obstacles_.clear();
  for (const sculpt::SceneObstacle& obstacle : scene.obstacles) {
    std::vector<Eigen::Vector3f> there;
    for (const Eigen::Vector3f& position : obstacle.surface.positions) there.push_back(place(position));
    const SurfaceMesh mesh = surface_mesh(obstacle.surface, there);
    if (mesh.triangles.empty()) continue;
    const SurfaceVertex& first = mesh.vertices.front();
    obstacles_.push_back({obstacle.is_ground, first.position, first.normal, std::make_unique<VertexArray>(*gl_)});
    obstacles_.back().surface->set(mesh.vertices, k_surface_attributes, 0, mesh.triangles);
  }

  const auto placed = [&](const std::vector<Eigen::Vector3f>& all) {
    std::vector<Eigen::Vector3f> result;
    for (const Eigen::Vector3f& position : all) result.push_back(place(position));
    return result;
  };
  cage_points_.set(placed(scene.cage_points), k_place_attributes, 1);
  handles_.set(placed(scene.handles), k_place_attributes, 1);
  pins_.set(placed(scene.pins), k_place_attributes, 1);
  felt_ = scene.felt ? static_cast<float>(std::clamp(scene.felt->share, 0.0, 1.0)) : 0.0F;
  arrow_tint_.reset();
  arrow_ends_.clear();
  for (const sculpt::SceneArrow& arrow : scene.arrows) arrow_ends_.push_back({place(arrow.from), place(arrow.to)});
}

void ScenePainter::set_volume(const std::vector<float>& picture, int width, int height) {
  std::vector<std::uint8_t> rgba(picture.size());
  const std::size_t row = 4 * static_cast<std::size_t>(width);
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y)
    for (std::size_t i = 0; i < row; ++i)
      rgba[(static_cast<std::size_t>(height) - 1 - y) * row + i] =
          static_cast<std::uint8_t>(255 * picture[y * row + i] + 0.5F);
  volume_ = std::make_unique<Image>(*gl_, width, height, rgba);
}

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
    draw_lines(*set.lines, camera, sampling, style.half_width, style.tint, style.full_length);
  }
}

void ScenePainter::hide_behind_surface(bool hide) const {
  if (hide)
    gl_->Enable(GL_DEPTH_TEST);
  else
    gl_->Disable(GL_DEPTH_TEST);
}

void ScenePainter::draw_surface(const Program& program, const Camera& camera) const {
  const Gl& gl = *gl_;
  program.use();
  gl.UniformMatrix4fv(program.at("clip_from_world"), 1, GL_FALSE, camera.clip_from_world.data());
  gl.UniformMatrix3fv(program.at("view_from_world"), 1, GL_FALSE, camera.view_from_world.data());
  gl.Uniform3f(program.at("eye"), camera.eye.x(), camera.eye.y(), camera.eye.z());
  surface_.bind();
  gl.DrawElements(GL_TRIANGLES, surface_.count(), GL_UNSIGNED_INT, nullptr);
}

float ScenePainter::use_in_pixels(const Program& program, const Camera& camera, const Sampling& sampling) const {
  const Gl& gl = *gl_;
  const auto factor = static_cast<float>(sampling.factor);
  program.use();
  gl.UniformMatrix4fv(program.at("clip_from_world"), 1, GL_FALSE, camera.clip_from_world.data());
  gl.Uniform3f(program.at("eye"), camera.eye.x(), camera.eye.y(), camera.eye.z());
  gl.Uniform2f(program.at("half_size"), 0.5F * factor * static_cast<float>(sampling.width),
               0.5F * factor * static_cast<float>(sampling.height));
  return factor * sampling.pixel;
}

void ScenePainter::draw_obstacles(const Camera& camera, bool beneath) const {
  const Gl& gl = *gl_;
  obstacle_program_.use();
  set_colour(gl, obstacle_program_.at("tint"), theme_->obstacle);
  for (const Obstacle& obstacle : obstacles_) {
    const bool faces = obstacle.is_ground && obstacle.normal.dot(camera.eye - obstacle.at) > 0;
    if (faces != beneath) continue;
    gl.UniformMatrix4fv(obstacle_program_.at("clip_from_world"), 1, GL_FALSE, camera.clip_from_world.data());
    gl.UniformMatrix3fv(obstacle_program_.at("view_from_world"), 1, GL_FALSE, camera.view_from_world.data());
    gl.Uniform3f(obstacle_program_.at("eye"), camera.eye.x(), camera.eye.y(), camera.eye.z());
    obstacle.surface->bind();
    // They are convex: what faces the eye is what is nearest to it.
    if (!obstacle.is_ground) gl.Enable(GL_CULL_FACE);
    gl.DrawElements(GL_TRIANGLES, obstacle.surface->count(), GL_UNSIGNED_INT, nullptr);
    gl.Disable(GL_CULL_FACE);
  }
}

void ScenePainter::draw_lines(const VertexArray& lines, const Camera& camera, const Sampling& sampling,
                              float half_width, const Colour& tint, float full_length) const {
  if (lines.count() == 0) return;
  const Gl& gl = *gl_;
  const Program& program = line_program_;
  const float scale = use_in_pixels(program, camera, sampling);
  gl.Uniform1f(program.at("half_width"), half_width * scale);
  gl.Uniform2f(program.at("visible_length"), 0.07F * full_length * scale, full_length * scale);
  gl.Uniform3f(program.at("distances"), camera.nearest, camera.farthest, 0.35F);
  set_colour(gl, program.at("tint"), tint);
  lines.bind();
  gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, lines.count());
}

void ScenePainter::draw_marks(const VertexArray& marks, const Camera& camera, const Sampling& sampling, int shape,
                              float radius, const Colour& tint, const Colour& ring, float opacity) const {
  if (marks.count() == 0) return;
  const Gl& gl = *gl_;
  const Program& program = mark_program_;
  const float scale = use_in_pixels(program, camera, sampling);
  gl.Uniform1f(program.at("radius"), radius * scale);
  gl.Uniform1f(program.at("outline"), 1.3F * scale);
  gl.Uniform1f(program.at("forward"), 0.015F);
  gl.Uniform1f(program.at("opacity"), opacity);
  gl.Uniform1i(program.at("shape"), shape);
  set_colour(gl, program.at("tint"), tint);
  set_colour(gl, program.at("ring"), ring);
  marks.bind();
  gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, marks.count());
}

void ScenePainter::draw_arrows(const Camera& camera, const Sampling& sampling) const {
  if (arrow_ends_.empty()) return;
  const Gl& gl = *gl_;
  const Program& program = arrow_program_;
  const float pixel = camera.pixel_at_unit_distance * sampling.pixel;
  std::vector<ArrowVertex> triangles;
  for (const sculpt::SceneArrow& arrow : arrow_ends_) add_arrow(triangles, arrow.from, arrow.to, camera, pixel);
  arrows_.set(triangles, k_line_attributes);
  program.use();
  gl.UniformMatrix4fv(program.at("clip_from_world"), 1, GL_FALSE, camera.clip_from_world.data());
  gl.UniformMatrix3fv(program.at("view_from_world"), 1, GL_FALSE, camera.view_from_world.data());
  arrows_.bind();
  const auto draw = [&](const Colour& tint, float grow, float shading, float opacity) {
    set_colour(gl, program.at("tint"), {tint.red, tint.green, tint.blue, tint.alpha * opacity});
    gl.Uniform1f(program.at("grow"), grow * pixel);
    gl.Uniform1f(program.at("shading"), shading);
    gl.DrawArrays(GL_TRIANGLES, 0, arrows_.count());
  };
  gl.Enable(GL_DEPTH_TEST);
  gl.Enable(GL_CULL_FACE);
  gl.CullFace(GL_BACK);
  gl.DepthFunc(GL_GREATER);
  gl.DepthMask(GL_FALSE);
  const Colour tint_of_arrows = arrow_tint_.value_or(theme_->arrow);
  draw(tint_of_arrows, 0, 0, k_hidden);
  gl.DepthFunc(GL_LEQUAL);
  gl.DepthMask(GL_TRUE);
  gl.CullFace(GL_FRONT);
  draw(theme_->arrow_outline, 1.1F, 0, 1);
  gl.CullFace(GL_BACK);
  draw(tint_of_arrows, 0, 1, 1);
  gl.Disable(GL_CULL_FACE);
  gl.DepthMask(GL_FALSE);
}

void ScenePainter::paint(const Camera& camera, const Sampling& sampling, int x, int y) const {
  const Gl& gl = *gl_;
  const Theme& theme = *theme_;
  gl.Viewport(-x, -y, sampling.width * sampling.factor, sampling.height * sampling.factor);
  gl.DepthMask(GL_TRUE);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
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
  gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl.Enable(GL_BLEND);
  draw_obstacles(camera, true);
  gl.Disable(GL_BLEND);
  if (has_shadow_) shadow_.paint(camera, theme.shadow);

  if (volume_) draw_volume(sampling, x, y);
  gl.DepthFunc(GL_LEQUAL);
  gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  if (draws_surface_) {
    hide_behind_surface(true);
    gl.Enable(GL_POLYGON_OFFSET_FILL);
    gl.PolygonOffset(1, 2);
    surface_program_.use();
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
      const Eigen::Vector3f& middle = brush_.middles[static_cast<std::size_t>(i)];
      const std::string name = "brush[" + std::to_string(i) + "]";
      gl.Uniform4f(surface_program_.at(name.c_str()), middle.x(), middle.y(), middle.z(), brush_.radius);
    }
    set_colour(gl, surface_program_.at("brush_tint"), brush_.tint);
    gl.Uniform2f(surface_program_.at("brush_look"), static_cast<float>(brush_.falloff),
                 1.6F * sampling.pixel * static_cast<float>(sampling.factor));
    draw_surface(surface_program_, camera);
    gl.Disable(GL_POLYGON_OFFSET_FILL);
  }

  gl.Enable(GL_BLEND);
  gl.DepthMask(GL_FALSE);
  hide_behind_surface(draws_surface_);
  const Colour& wire_tint = !draws_surface_ ? theme.wire_alone : field_ ? theme.wire_on_field : theme.wire_on_clay;
  Colour shown_wire = wire_tint;
  if (volume_) shown_wire.alpha *= k_wire_in_volume;  // there it only says where the body ends
  if (draws_wire_) draw_lines(wire_, camera, sampling, 0.5F, shown_wire, k_wire_length);

  Colour hidden_cage = theme.cage;
  hidden_cage.alpha *= k_hidden;
  hide_behind_surface(false);
  draw_lines(cage_lines_, camera, sampling, 0.55F, hidden_cage, k_cage_length);
  draw_line_sets(camera, sampling, k_hidden);
  draw_marks(handles_, camera, sampling, 0, 6, theme.curve, theme.arrow_outline, k_hidden_pin);
  if (draws_hidden_pins_) draw_marks(pins_, camera, sampling, 1, 7, theme.pin, theme.pin_outline, k_hidden_pin);
  hide_behind_surface(true);
  draw_lines(cage_lines_, camera, sampling, 0.55F, theme.cage, k_cage_length);
  draw_line_sets(camera, sampling, 1);
  draw_marks(cage_points_, camera, sampling, 0, 3.3F, theme.cage_point, theme.cage_ring, 1);
  draw_marks(handles_, camera, sampling, 0, 6, theme.curve, theme.arrow_outline, 1);
  draw_arrows(camera, sampling);
  draw_marks(pins_, camera, sampling, 1, 7, theme.pin, theme.pin_outline, 1);
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
  draw_surface(program, camera);
}

}  // namespace argil::view
