#include "tools/view/shape_painter.h"

#include <algorithm>

#include "tools/view/arrow_mesh.h"
#include "tools/view/shaders.h"

namespace argil::view {

namespace {

void set_colour(const Gl& gl, GLint place, const Colour& c, float opacity = 1) {
  gl.Uniform4f(place, c.red, c.green, c.blue, c.alpha * opacity);
}

}  // namespace

ShapePainter::ShapePainter(const Gl& gl)
    : gl_(&gl),
      line_program_(gl, shaders::k_line_vertex, shaders::k_line_fragment),
      mark_program_(gl, shaders::k_mark_vertex, shaders::k_mark_fragment),
      arrow_program_(gl, shaders::k_arrow_vertex, shaders::k_arrow_fragment),
      arrows_(gl) {}

float ShapePainter::use(const Program& program, const Camera& camera, const Sampling& sampling) const {
  const Gl& gl = *gl_;
  const auto factor = static_cast<float>(sampling.factor);
  program.use();
  gl.UniformMatrix4fv(program.at("clip_from_world"), 1, GL_FALSE, camera.clip_from_world.data());
  gl.Uniform3f(program.at("eye"), camera.eye.x(), camera.eye.y(), camera.eye.z());
  gl.Uniform2f(program.at("half_size"), 0.5F * factor * static_cast<float>(sampling.width),
               0.5F * factor * static_cast<float>(sampling.height));
  return factor * sampling.pixel;
}

void ShapePainter::lines(const VertexArray& lines, const Camera& camera, const Sampling& sampling,
                         const LineStyle& style, GLsizei most) const {
  const GLsizei count = std::min(most, lines.count());
  if (count == 0) return;
  const Gl& gl = *gl_;
  const Program& program = line_program_;
  const float scale = use(program, camera, sampling);
  gl.Uniform1f(program.at("half_width"), style.half_width * scale);
  gl.Uniform2f(program.at("visible_length"), style.faded_length * scale, style.full_length * scale);
  gl.Uniform3f(program.at("distances"), camera.nearest, camera.farthest, style.left_far);
  set_colour(gl, program.at("tint"), style.tint);
  lines.bind();
  gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
}

void ShapePainter::marks(const VertexArray& marks, const Camera& camera, const Sampling& sampling,
                         const MarkStyle& style) const {
  if (marks.count() == 0) return;
  const Gl& gl = *gl_;
  const Program& program = mark_program_;
  const float scale = use(program, camera, sampling);
  gl.Uniform1f(program.at("radius"), style.radius * scale);
  gl.Uniform1f(program.at("outline"), 1.3F * scale);
  gl.Uniform1f(program.at("forward"), style.forward);
  gl.Uniform1f(program.at("opacity"), style.opacity);
  gl.Uniform1i(program.at("shape"), static_cast<GLint>(style.shape));
  set_colour(gl, program.at("tint"), style.tint);
  set_colour(gl, program.at("ring"), style.ring);
  marks.bind();
  gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, marks.count());
}

void ShapePainter::arrows(const std::vector<sculpt::SceneArrow>& arrows, const Camera& camera,
                          const Sampling& sampling, const Colour& tint, const Colour& outline, float hidden) const {
  if (arrows.empty()) return;
  const Gl& gl = *gl_;
  const Program& program = arrow_program_;
  const float pixel = camera.pixel_at_unit_distance * sampling.pixel;
  std::vector<ArrowVertex> triangles;
  for (const sculpt::SceneArrow& arrow : arrows) add_arrow(triangles, arrow.from, arrow.to, camera, pixel);
  arrows_.set(triangles, k_line_attributes);
  program.use();
  gl.UniformMatrix4fv(program.at("clip_from_world"), 1, GL_FALSE, camera.clip_from_world.data());
  gl.UniformMatrix3fv(program.at("view_from_world"), 1, GL_FALSE, camera.view_from_world.data());
  arrows_.bind();
  const auto draw = [&](const Colour& colour, float grow, float shading, float opacity) {
    set_colour(gl, program.at("tint"), colour, opacity);
    gl.Uniform1f(program.at("grow"), grow * pixel);
    gl.Uniform1f(program.at("shading"), shading);
    gl.DrawArrays(GL_TRIANGLES, 0, arrows_.count());
  };
  gl.Enable(GL_DEPTH_TEST);
  gl.Enable(GL_CULL_FACE);
  gl.CullFace(GL_BACK);
  gl.DepthFunc(GL_GREATER);
  gl.DepthMask(GL_FALSE);
  draw(tint, 0, 0, hidden);
  gl.DepthFunc(GL_LEQUAL);
  gl.DepthMask(GL_TRUE);
  gl.CullFace(GL_FRONT);
  draw(outline, 1.1F, 0, 1);
  gl.CullFace(GL_BACK);
  draw(tint, 0, 1, 1);
  gl.Disable(GL_CULL_FACE);
  gl.DepthMask(GL_FALSE);
}

}  // namespace argil::view
