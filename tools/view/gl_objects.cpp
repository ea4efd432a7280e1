#include "tools/view/gl_objects.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "subdiv/error.h"

namespace argil::view {

namespace {

GLuint compile(const Gl& gl, GLenum kind, const char* text) {
  const GLuint shader = gl.CreateShader(kind);
  const std::array<const char*, 2> parts{gl.shader_prefix.c_str(), text};
  gl.ShaderSource(shader, 2, parts.data(), nullptr);
  gl.CompileShader(shader);
  GLint good = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == 0) {
    std::array<char, 2048> log{};
    gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw std::logic_error(std::string("a shader of the picture does not compile: ") + log.data());
  }
  return shader;
}

}  // namespace

Program::Program(const Gl& gl, const char* vertex_shader, const char* fragment_shader)
    : gl_(&gl), program_(gl.CreateProgram()) {
  for (const GLuint shader :
       {compile(gl, GL_VERTEX_SHADER, vertex_shader), compile(gl, GL_FRAGMENT_SHADER, fragment_shader)}) {
    gl.AttachShader(program_, shader);
    gl.DeleteShader(shader);
  }
  gl.LinkProgram(program_);
  GLint good = 0;
  gl.GetProgramiv(program_, GL_LINK_STATUS, &good);
  if (good == 0) {
    std::array<char, 2048> log{};
    gl.GetProgramInfoLog(program_, static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw std::logic_error(std::string("a shader program of the picture does not link: ") + log.data());
  }
}

void VertexArray::clear() {
  if (array_ == 0) return;
  gl_->DeleteVertexArrays(1, &array_);
  gl_->DeleteBuffers(1, &vertices_);
  if (indices_ != 0) gl_->DeleteBuffers(1, &indices_);
  array_ = vertices_ = indices_ = 0;
  count_ = 0;
}

void VertexArray::upload(const void* records, std::size_t count, std::size_t size,
                         std::span<const Attribute> attributes, GLuint divisor,
                         const std::vector<std::uint32_t>& indices) {
  clear();
  gl_->GenVertexArrays(1, &array_);
  gl_->BindVertexArray(array_);
  gl_->GenBuffers(1, &vertices_);
  gl_->BindBuffer(GL_ARRAY_BUFFER, vertices_);
  gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(count * size), records, GL_STATIC_DRAW);
  std::uintptr_t offset = 0;
  for (const Attribute& attribute : attributes) {
    const auto* place = reinterpret_cast<const void*>(offset);
    gl_->EnableVertexAttribArray(attribute.location);
    if (attribute.integer)
      gl_->VertexAttribIPointer(attribute.location, attribute.components, GL_UNSIGNED_INT,
                                static_cast<GLsizei>(size), place);
    else
      gl_->VertexAttribPointer(attribute.location, attribute.components, GL_FLOAT, GL_FALSE,
                               static_cast<GLsizei>(size), place);
    gl_->VertexAttribDivisor(attribute.location, divisor);
    offset += 4 * static_cast<std::uintptr_t>(attribute.components);
  }
  assert(offset == size);
  count_ = static_cast<GLsizei>(count);
  if (!indices.empty()) {
    gl_->GenBuffers(1, &indices_);
    gl_->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
    gl_->BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)),
                    indices.data(), GL_STATIC_DRAW);
    count_ = static_cast<GLsizei>(indices.size());
  }
}

void VertexArray::draw(const IndexRange& triangles) const {
  bind();
  gl_->DrawElements(GL_TRIANGLES, static_cast<GLsizei>(triangles.count), GL_UNSIGNED_INT,
                    reinterpret_cast<const void*>(static_cast<std::uintptr_t>(4 * triangles.first)));
}

Image::Image(const Gl& gl, int width, int height, const std::vector<std::uint8_t>& rgba) : gl_(&gl) {
  gl.GenTextures(1, &texture_);
  bind_texture(GL_TEXTURE0);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl.TexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    gl.TexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
}

Target::Target(const Gl& gl, int width, int height, bool depth, GLenum format)
    : gl_(&gl), width_(width), height_(height) {
  gl.GenTextures(1, &texture_);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, texture_);
  gl.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl.TexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    gl.TexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
  gl.GenFramebuffers(1, &framebuffer_);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
  if (depth) {
    gl.GenRenderbuffers(1, &depth_);
    gl.BindRenderbuffer(GL_RENDERBUFFER, depth_);
    gl.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
  }
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw Error(ErrorCode::unsupported, "expected a drawing surface of " + std::to_string(width) + " x " +
                                            std::to_string(height) +
                                            " pixels, found that OpenGL gives none; ask for a smaller picture");
}

Target::~Target() {
  gl_->DeleteFramebuffers(1, &framebuffer_);
  gl_->DeleteTextures(1, &texture_);
  if (depth_ != 0) gl_->DeleteRenderbuffers(1, &depth_);
}

void Target::copy_to(GLuint framebuffer) const {
  gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  gl_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  gl_->BlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
}

void Target::read(int width, int rows, std::vector<std::uint8_t>& rgba) const {
  rgba.resize(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(rows));
  gl_->PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl_->ReadPixels(0, 0, width, rows, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
}

}  // namespace argil::view
