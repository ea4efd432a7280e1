#include "tools/view/gl.h"

#include "subdiv/error.h"

namespace argil::view {

Gl load_gl(void (*(*look_up)(const char*))()) {
  Gl gl;
#define ARGIL_GL_LOAD(type, name)                                                                    \
  gl.name = reinterpret_cast<type>(look_up("gl" #name));                                             \
  if (gl.name == nullptr)                                                                            \
    throw Error(ErrorCode::unsupported, "expected an OpenGL 3.3 context, found one without gl" #name \
                                        "; update Mesa or the display driver");
  ARGIL_GL_FUNCTIONS(ARGIL_GL_LOAD)
#undef ARGIL_GL_LOAD
  return gl;
}

}  // namespace argil::view
