#include "tools/view/overlay_painter.h"

namespace argil::view {

namespace {

constexpr std::array<Attribute, 3> k_triangle_attributes{{{0, 3}, {1, 3}, {2, 4}}};
constexpr float k_behind = 0.4F;           // what is left of what lies behind the surface
constexpr float k_veil_forward = 0.0006F;  // towards the eye, so that it lies over the surface, under its wires

constexpr const char* k_triangle_vertex = R"(
precision highp float;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tint;
uniform mat4 clip_from_world;
uniform mat3 view_from_world;
uniform vec3 eye;
uniform float forward;
out vec3 view_normal;
out vec4 shade;
void main() {
  view_normal = view_from_world * normal;
  shade = tint;
  gl_Position = clip_from_world * vec4(mix(position, eye, forward), 1.0);
})";
constexpr const char* k_triangle_fragment = R"(
precision highp float;
in vec3 view_normal;
in vec4 shade;
uniform float opacity;
out vec4 colour;
void main() {
  float lit = 0.5 + 0.5 * dot(normalize(view_normal), normalize(vec3(-0.42, 0.66, 0.62)));
  colour = vec4(shade.rgb * mix(0.72, 1.08, lit), shade.a * opacity);
})";

std::vector<TintedVertex> placed(const std::vector<TintedVertex>& vertices, const Place& place) {
  std::vector<TintedVertex> result = vertices;
  for (TintedVertex& vertex : result) vertex.position = place(vertex.position);
  return result;
}

}  // namespace

OverlayPainter::OverlayPainter(const Gl& gl)
    : gl_(&gl), triangle_program_(gl, k_triangle_vertex, k_triangle_fragment), shapes_(gl), veil_(gl), ghost_(gl) {}

void OverlayPainter::set(const Overlay& overlay, const Place& place) {
  veil_.set(placed(overlay.veil, place), k_triangle_attributes);
  ghost_.set(placed(overlay.ghost, place), k_triangle_attributes);
  lines_.clear();
  for (const Overlay::Lines& set : overlay.lines) {
    std::vector<std::array<Eigen::Vector3f, 2>> ends;
    for (const auto& line : set.ends) ends.push_back({place(line[0]), place(line[1])});
    lines_.push_back({std::make_unique<VertexArray>(*gl_), set.tint, set.tint, set.half_width, set.through});
    lines_.back().array->set(ends, k_line_attributes, 1);
  }
  dots_.clear();
  for (const Overlay::Dots& set : overlay.dots) {
    std::vector<Eigen::Vector3f> at;
    for (const Eigen::Vector3f& dot : set.at) at.push_back(place(dot));
    dots_.push_back({std::make_unique<VertexArray>(*gl_), set.tint, set.ring, set.radius, set.through});
    dots_.back().array->set(at, k_place_attributes, 1);
  }
}

void OverlayPainter::paint_triangles(const VertexArray& triangles, const Camera& camera, float opacity,
                                     float forward) const {
  const Gl& gl = *gl_;
  const Program& program = triangle_program_;
  program.use();
  gl.UniformMatrix4fv(program.at("clip_from_world"), 1, GL_FALSE, camera.clip_from_world.data());
  gl.UniformMatrix3fv(program.at("view_from_world"), 1, GL_FALSE, camera.view_from_world.data());
  gl.Uniform3f(program.at("eye"), camera.eye.x(), camera.eye.y(), camera.eye.z());
  gl.Uniform1f(program.at("forward"), forward);
  gl.Uniform1f(program.at("opacity"), opacity);
  triangles.bind();
  gl.DrawArrays(GL_TRIANGLES, 0, triangles.count());
}

void OverlayPainter::paint_shapes(const Camera& camera, const Sampling& sampling, bool hidden) const {
  for (const Shapes& set : lines_) {
    if (hidden && !set.through) continue;
    Colour tint = set.tint;
    if (hidden) tint.alpha *= k_behind;
    shapes_.lines(*set.array, camera, sampling, {tint, set.size, 0.5F, 0, 0.8F});
  }
  for (const Shapes& set : dots_) {
    if (hidden && !set.through) continue;
    shapes_.marks(*set.array, camera, sampling,
                  {MarkStyle::Shape::disc, set.size, set.tint, set.ring, hidden ? k_behind : 1, 0.01F});
  }
}

void OverlayPainter::paint(const Camera& camera, const Sampling& sampling) const {
  const Gl& gl = *gl_;
  gl.Viewport(0, 0, sampling.width * sampling.factor, sampling.height * sampling.factor);
  gl.Enable(GL_DEPTH_TEST);
  gl.Enable(GL_BLEND);
  gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl.DepthMask(GL_FALSE);
  gl.DepthFunc(GL_LEQUAL);
  if (veil_.count() > 0) paint_triangles(veil_, camera, 1, k_veil_forward);
  if (ghost_.count() > 0) {
    gl.DepthFunc(GL_GREATER);
    paint_triangles(ghost_, camera, k_behind, k_veil_forward);
    gl.DepthFunc(GL_LEQUAL);
    gl.DepthMask(GL_TRUE);  // its depth first, unseen, so that only what is in front of it shows
    paint_triangles(ghost_, camera, 0, k_veil_forward);
    gl.DepthMask(GL_FALSE);
    paint_triangles(ghost_, camera, 1, k_veil_forward);
  }
  gl.DepthFunc(GL_GREATER);
  paint_shapes(camera, sampling, true);
  gl.DepthFunc(GL_LEQUAL);
  paint_shapes(camera, sampling, false);
  gl.Disable(GL_BLEND);
  gl.DepthMask(GL_TRUE);
}

}  // namespace argil::view
