#pragma once
// OpenGL objects that free themselves. Each keeps the table of functions that made it and must die while its
// context is current.

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "tools/view/gl.h"

namespace argil::view {

/// A shader program. Attribute locations are given by `layout(location = …)` in the shaders.
class Program {
 public:
  /// A shader that does not compile is our own bug: the log goes into the message of a std::logic_error.
  Program(const Gl& gl, const char* vertex_shader, const char* fragment_shader);
  ~Program() { gl_->DeleteProgram(program_); }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void use() const { gl_->UseProgram(program_); }
  GLint at(const char* uniform) const { return gl_->GetUniformLocation(program_, uniform); }

 private:
  const Gl* gl_;
  GLuint program_;
};

/// One attribute of interleaved 4-byte components.
struct Attribute {
  GLuint location;
  GLint components;
  bool integer = false;
};
/// Records of a place, and of a line's two ends: three floats each, as shaders of marks and lines take them.
inline constexpr std::array<Attribute, 1> k_place_attributes{{{0, 3}}};
inline constexpr std::array<Attribute, 2> k_line_attributes{{{0, 3}, {1, 3}}};

/// Some of a VertexArray's indices.
struct IndexRange {
  std::size_t first = 0, count = 0;
};

/// Interleaved vertices (or one record an instance) with optional indices.
class VertexArray {
 public:
  explicit VertexArray(const Gl& gl) : gl_(&gl) {}
  ~VertexArray() { clear(); }
  VertexArray(const VertexArray&) = delete;
  VertexArray& operator=(const VertexArray&) = delete;

  /// `divisor` 1: one record an instance.
  template <class Record>
  void set(const std::vector<Record>& records, std::span<const Attribute> attributes, GLuint divisor = 0,
           const std::vector<std::uint32_t>& indices = {}) {
    static_assert(sizeof(Record) % 4 == 0);
    upload(records.data(), records.size(), sizeof(Record), attributes, divisor, indices);
  }
  /// New contents for as many records as `set` was given; attributes and indices stay.
  template <class Record>
  void refill(const std::vector<Record>& records) {
    gl_->BindBuffer(GL_ARRAY_BUFFER, vertices_);
    gl_->BufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(records.size() * sizeof(Record)),
                       records.data());
  }
  void bind() const { gl_->BindVertexArray(array_); }
  /// Triangles of these indices.
  void draw(const IndexRange& triangles) const;
  GLsizei count() const { return count_; }  // indices if there are any, or records

 private:
  void upload(const void* records, std::size_t count, std::size_t size, std::span<const Attribute> attributes,
              GLuint divisor, const std::vector<std::uint32_t>& indices);
  void clear();
  const Gl* gl_;
  GLuint array_ = 0, vertices_ = 0, indices_ = 0;
  GLsizei count_ = 0;
};

/// An RGBA8 texture of given pixels, lowest row first, without filtering.
class Image {
 public:
  Image(const Gl& gl, int width, int height, const std::vector<std::uint8_t>& rgba);
  ~Image() { gl_->DeleteTextures(1, &texture_); }
  Image(const Image&) = delete;
  Image& operator=(const Image&) = delete;

  void bind_texture(GLenum unit) const {
    gl_->ActiveTexture(unit);
    gl_->BindTexture(GL_TEXTURE_2D, texture_);
  }

 private:
  const Gl* gl_;
  GLuint texture_ = 0;
};

/// A target of a texture, RGBA8 or of another format, with a depth buffer if asked for.
class Target {
 public:
  /// @throws Error (unsupported) if the context cannot hold it.
  Target(const Gl& gl, int width, int height, bool depth, GLenum format = GL_RGBA8);
  ~Target();
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;

  void bind() const { gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer_); }
  void bind_texture(GLenum unit) const {
    gl_->ActiveTexture(unit);
    gl_->BindTexture(GL_TEXTURE_2D, texture_);
  }
  /// Pixel for pixel into the framebuffer of this name, which is bound then; 0 is the window's.
  void copy_to(GLuint framebuffer) const;
  GLuint framebuffer() const { return framebuffer_; }
  int width() const { return width_; }
  int height() const { return height_; }
  /// Lowest row first, of the lowest `rows` rows. The target must be bound.
  void read(int width, int rows, std::vector<std::uint8_t>& rgba) const;

 private:
  const Gl* gl_;
  int width_, height_;
  GLuint framebuffer_ = 0, texture_ = 0, depth_ = 0;
};

}  // namespace argil::view
