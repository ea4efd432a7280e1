#pragma once
// An OpenGL 3.3 context without a display, by Mesa's off-screen library. The library is opened when it is first
// needed and with its names kept local, so that it does not clash with a window's libGL.

#include <array>
#include <span>

#include "tools/view/gl.h"

namespace argil::view {

inline constexpr std::array<const char*, 3> k_osmesa_names{"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};

class OsmesaContext {
 public:
  /// Opens the first library of these names that is there. The context is current on return.
  /// @throws Error (unsupported) with what to install.
  explicit OsmesaContext(std::span<const char* const> library_names = k_osmesa_names);
  ~OsmesaContext();
  OsmesaContext(const OsmesaContext&) = delete;
  OsmesaContext& operator=(const OsmesaContext&) = delete;

  /// Makes the context current on this thread. @throws Error (unsupported).
  void make_current();
  const Gl& gl() const { return gl_; }

 private:
  using Context = struct osmesa_context*;
  Context context_ = nullptr;
  unsigned char (*make_current_)(Context, void*, GLenum, GLsizei, GLsizei) = nullptr;
  void (*destroy_)(Context) = nullptr;
  std::array<unsigned char, 4> default_pixel_{};  // the context wants a buffer; pictures go to framebuffer objects
  Gl gl_;
};

}  // namespace argil::view
