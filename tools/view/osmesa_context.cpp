#include "tools/view/osmesa_context.h"

#include <dlfcn.h>

#include <cstdlib>
#include <string>

#include "subdiv/error.h"

#ifdef __SANITIZE_ADDRESS__
// The leak checker crashes on threads of OSMesa (Mesa 22.3: "Tracer caught signal 11"), which also never frees the
// buffer that a context was last current on: where it is loaded, leaks are not looked for.
namespace {
bool osmesa_is_loaded = false;
}
extern "C" int __lsan_is_turned_off();
extern "C" int __lsan_is_turned_off() {
  return osmesa_is_loaded ? 1 : 0;
}
#endif

namespace argil::view {

namespace {

// From Mesa's interface; its header is not included because it declares functions of libGL.
constexpr int k_format = 0x22, k_depth_bits = 0x30, k_profile = 0x33, k_core_profile = 0x34, k_major = 0x36,
              k_minor = 0x37;

template <class Function>
Function look_up(void* library, const char* name) {
  void* symbol = dlsym(library, name);
  if (symbol == nullptr)
    throw Error(ErrorCode::unsupported, std::string("expected OSMesa 17 or later, found one without ") + name +
                                            "; update it (Debian: apt-get install libosmesa6)");
  return reinterpret_cast<Function>(symbol);
}

}  // namespace

OsmesaContext::OsmesaContext(std::span<const char* const> library_names) {
  // Pictures are compared with references, byte for byte within a run: drawn by one thread, they depend on no order
  // of threads (about a fifth slower on two cores). Whoever sets the variable has his way.
  setenv("LP_NUM_THREADS", "0", 0);
  // Never closed again: Mesa keeps threads and thread-local data that outlive a context.
  void* library = nullptr;
  std::string tried;
  for (const char* name : library_names) {
    library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
    if (library != nullptr) break;
    tried += (tried.empty() ? "" : ", ") + std::string(name);
  }
  if (library == nullptr)
    throw Error(ErrorCode::unsupported,
                "expected OSMesa, which draws pictures without a display, found none of " + tried +
                    "; install it (Debian: apt-get install libosmesa6) or leave the pictures out");
#ifdef __SANITIZE_ADDRESS__
  osmesa_is_loaded = true;
#endif
  const auto create = look_up<Context (*)(const int*, Context)>(library, "OSMesaCreateContextAttribs");
  make_current_ = look_up<decltype(make_current_)>(library, "OSMesaMakeCurrent");
  destroy_ = look_up<decltype(destroy_)>(library, "OSMesaDestroyContext");
  const auto get_function = look_up<void (*(*)(const char*))()>(library, "OSMesaGetProcAddress");

  const std::array<int, 13> attributes{
      k_format, GL_RGBA, k_depth_bits, 24, k_profile, k_core_profile, k_major, 3, k_minor, 3, 0, 0, 0};
  context_ = create(attributes.data(), nullptr);
  if (context_ == nullptr)
    throw Error(ErrorCode::unsupported,
                "expected an OpenGL 3.3 core context of OSMesa, found that it gives none; "
                "update Mesa (17 or later)");
  try {
    make_current();
    gl_ = load_gl(get_function);
  } catch (...) {
    destroy_(context_);
    throw;
  }
}

OsmesaContext::~OsmesaContext() {
  make_current_(nullptr, nullptr, 0, 0, 0);
  destroy_(context_);
}

void OsmesaContext::make_current() {
  if (make_current_(context_, default_pixel_.data(), GL_UNSIGNED_BYTE, 1, 1) == 0)
    throw Error(ErrorCode::unsupported,
                "expected OSMesa to make its context current, found that it refuses; "
                "update Mesa (17 or later)");
}

}  // namespace argil::view
