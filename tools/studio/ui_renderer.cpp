#include "tools/studio/ui_renderer.h"

#include <imgui.h>

#include <cstddef>
#include <cstdint>

namespace argil::studio {

namespace {

constexpr const char* k_vertex = R"(
precision highp float;
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 texture_place;
layout(location = 2) in vec4 tint;
uniform vec2 size;
out vec2 at;
out vec4 shade;
void main() {
  at = texture_place;
  shade = tint;
  gl_Position = vec4(2.0 * position.x / size.x - 1.0, 1.0 - 2.0 * position.y / size.y, 0.0, 1.0);
})";
constexpr const char* k_fragment = R"(
precision highp float;
in vec2 at;
in vec4 shade;
uniform sampler2D image;
out vec4 colour;
void main() { colour = shade * texture(image, at); })";

const void* place_of(std::size_t offset) {
  return reinterpret_cast<const void*>(static_cast<std::uintptr_t>(offset));
}

}  // namespace

UiRenderer::UiRenderer(const view::Gl& gl) : gl_(&gl), program_(gl, k_vertex, k_fragment) {
  gl.GenVertexArrays(1, &array_);
  gl.BindVertexArray(array_);
  gl.GenBuffers(1, &vertices_);
  gl.GenBuffers(1, &indices_);
  gl.BindBuffer(GL_ARRAY_BUFFER, vertices_);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  for (const GLuint location : {0U, 1U, 2U}) gl.EnableVertexAttribArray(location);
  const auto size = static_cast<GLsizei>(sizeof(ImDrawVert));
  gl.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, size, place_of(offsetof(ImDrawVert, pos)));
  gl.VertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, size, place_of(offsetof(ImDrawVert, uv)));
  gl.VertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, size, place_of(offsetof(ImDrawVert, col)));
}

UiRenderer::~UiRenderer() {
  gl_->DeleteVertexArrays(1, &array_);
  gl_->DeleteBuffers(1, &vertices_);
  gl_->DeleteBuffers(1, &indices_);
  if (atlas_ != 0) gl_->DeleteTextures(1, &atlas_);
  for (const GLuint picture : pictures_) gl_->DeleteTextures(1, &picture);
}

void UiRenderer::load(GLuint texture, int width, int height, const unsigned char* rgba) const {
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_2D, texture);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl_->TexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    gl_->TexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
  gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
}

void UiRenderer::load_atlas() {
  unsigned char* rgba = nullptr;
  int width = 0, height = 0;
  ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&rgba, &width, &height);
  if (atlas_ == 0) gl_->GenTextures(1, &atlas_);
  load(atlas_, width, height, rgba);
}

unsigned UiRenderer::add_picture(const sculpt::Picture& picture) {
  GLuint texture = 0;
  gl_->GenTextures(1, &texture);
  pictures_.push_back(texture);
  load(texture, picture.width, picture.height, picture.rgba.data());
  return texture;
}

void UiRenderer::draw(const ImDrawData& data) const {
  const view::Gl& gl = *gl_;
  const int width = static_cast<int>(data.DisplaySize.x), height = static_cast<int>(data.DisplaySize.y);
  if (width <= 0 || height <= 0) return;
  gl.Viewport(0, 0, width, height);
  gl.Disable(GL_DEPTH_TEST);
  gl.Disable(GL_CULL_FACE);
  gl.Enable(GL_BLEND);
  gl.BlendEquation(GL_FUNC_ADD);
  gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl.Enable(GL_SCISSOR_TEST);
  program_.use();
  gl.Uniform2f(program_.at("size"), data.DisplaySize.x, data.DisplaySize.y);
  gl.Uniform1i(program_.at("image"), 0);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, atlas_);
  gl.BindVertexArray(array_);
  gl.BindBuffer(GL_ARRAY_BUFFER, vertices_);
  for (int n = 0; n < data.CmdListsCount; ++n) {
    const ImDrawList& list = *data.CmdLists[n];
    gl.BufferData(GL_ARRAY_BUFFER, list.VtxBuffer.size_in_bytes(), list.VtxBuffer.Data, GL_STREAM_DRAW);
    gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, list.IdxBuffer.size_in_bytes(), list.IdxBuffer.Data, GL_STREAM_DRAW);
    for (const ImDrawCmd& command : list.CmdBuffer) {
      const ImVec4& clip = command.ClipRect;
      if (clip.z <= clip.x || clip.w <= clip.y) continue;
      gl.Scissor(static_cast<GLint>(clip.x), height - static_cast<GLint>(clip.w),
                 static_cast<GLsizei>(clip.z - clip.x), static_cast<GLsizei>(clip.w - clip.y));
      const auto named = static_cast<GLuint>(reinterpret_cast<std::uintptr_t>(command.GetTexID()));
      gl.BindTexture(GL_TEXTURE_2D, named != 0 ? named : atlas_);
      gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount), GL_UNSIGNED_SHORT,
                      place_of(command.IdxOffset * sizeof(ImDrawIdx)));
    }
  }
  gl.Disable(GL_SCISSOR_TEST);
  gl.Disable(GL_BLEND);
}

}  // namespace argil::studio
