#pragma once
// Draws what Dear ImGui made with our own table of OpenGL functions, so that the same code serves a window and
// OSMesa (the library's own backend loads libGL itself and cannot start there).

#include <memory>
#include <vector>

#include "sculpt/renderer.h"
#include "tools/view/gl_objects.h"

struct ImDrawData;

namespace argil::studio {

class UiRenderer {
 public:
  /// `gl` must outlive it and be current whenever a function is called.
  explicit UiRenderer(const view::Gl& gl);
  ~UiRenderer();

  /// Takes the atlas of the current Dear ImGui context to the graphics card.
  void load_atlas();
  /// A picture that draw lists may name, as long as this lives.
  [[nodiscard]] unsigned add_picture(const sculpt::Picture& picture);
  /// Into the bound framebuffer.
  void draw(const ImDrawData& data) const;

 private:
  const view::Gl* gl_;
  view::Program program_;
  void load(GLuint texture, int width, int height, const unsigned char* rgba) const;

  std::vector<GLuint> pictures_;
  GLuint array_ = 0, vertices_ = 0, indices_ = 0, atlas_ = 0;
};

}  // namespace argil::studio
