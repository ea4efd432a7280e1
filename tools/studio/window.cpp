#include "tools/studio/window.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "io/file_bytes.h"
#include "io/image.h"
#include "subdiv/error.h"
#include "tools/studio/studio.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace argil::studio {

namespace {

using ProcedureLookUp = void (*(*)(const char*))();

struct GlfwEnd {
  ~GlfwEnd() { glfwTerminate(); }
};
struct WindowEnd {
  void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};

Input& input_of(GLFWwindow* window) {
  return *static_cast<Input*>(glfwGetWindowUserPointer(window));
}

std::string last_fault() {
  const char* words = nullptr;
  glfwGetError(&words);
  return words != nullptr ? words : "no reason was given";
}

// GLFW gives signs of keys as they lie on an American keyboard; bindings go by what stands on the key.
int key_as_labelled(int key, int scancode) {
  if (key < 39 || key > 96) return key;
  const char* name = glfwGetKeyName(key, scancode);
  if (name == nullptr || name[0] == '\0' || name[1] != '\0') return key;
  const auto letter = static_cast<unsigned char>(name[0]);
  return letter >= 'a' && letter <= 'z' ? letter - 'a' + 'A' : letter;
}

void listen(GLFWwindow* window) {
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int scancode, int action, int) {
    if (action != GLFW_RELEASE && action != GLFW_PRESS) return;
    input_of(w).keys.push_back({key_as_labelled(key, scancode), action == GLFW_PRESS});
  });
  glfwSetCharCallback(window,
                      [](GLFWwindow* w, unsigned character) { input_of(w).characters.push_back(character); });
  glfwSetScrollCallback(window,
                        [](GLFWwindow* w, double, double up) { input_of(w).wheel += static_cast<float>(up); });
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
    for (int i = 0; i < count; ++i) input_of(w).dropped.emplace_back(paths[i]);
  });
}

void read_pointer(GLFWwindow* window, Input& input) {
  int width = 1, height = 1, window_width = 1, window_height = 1;
  glfwGetFramebufferSize(window, &width, &height);
  glfwGetWindowSize(window, &window_width, &window_height);
  input.width = std::max(1, width);
  input.height = std::max(1, height);
  double x = 0, y = 0;
  glfwGetCursorPos(window, &x, &y);
  const bool inside = glfwGetWindowAttrib(window, GLFW_HOVERED) != 0;
  for (int b = 0; b < 3; ++b) input.buttons[b] = glfwGetMouseButton(window, b) == GLFW_PRESS;
  const bool holds = input.buttons[0] || input.buttons[1] || input.buttons[2];
  input.x = inside || holds ? static_cast<float>(x * width / std::max(1, window_width)) : -1.0F;
  input.y = static_cast<float>(y * height / std::max(1, window_height));
}

}  // namespace

void run_window(const WindowOptions& options) {
  glfwSetErrorCallback(nullptr);
  if (glfwInit() == GLFW_FALSE)
    throw Error(
        ErrorCode::unsupported,
        fmt::format("expected a display to open the studio on, found none ({}); set DISPLAY, or drive it off the "
                    "screen with `argil studio --script FILE --out DIR`",
                    last_fault()));
  const GlfwEnd end;
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  const std::unique_ptr<GLFWwindow, WindowEnd> window(glfwCreateWindow(1440, 900, "Argil", nullptr, nullptr));
  if (!window)
    throw Error(ErrorCode::unsupported,
                fmt::format("expected a window with OpenGL 3.3, found that there is none ({}); "
                            "update Mesa or the display driver",
                            last_fault()));
  glfwMakeContextCurrent(window.get());
  glfwSwapInterval(1);
  const view::Gl gl = view::load_gl(reinterpret_cast<ProcedureLookUp>(glfwGetProcAddress));

  Workshop workshop(options.bench, options.devices);
  if (options.file.empty())
    workshop.post([](Bench& bench) { bench.begin_block(); });
  else
    workshop.post([file = options.file](Bench& bench) { bench.open(file); });
  workshop.start();
  if (options.device != "mouse") workshop.use_device(options.device);

  float scale_x = 1, scale_y = 1;
  glfwGetWindowContentScale(window.get(), &scale_x, &scale_y);
  Input input;
  input.scale = std::max(0.75F, std::round(4 * scale_x) / 4);
  // The least that all has room in, in what the system counts windows in: pixels, or units of its own.
  int counted = 0, pixels = 0;
  glfwGetWindowSize(window.get(), &counted, nullptr);
  glfwGetFramebufferSize(window.get(), &pixels, nullptr);
  const float unit = input.scale * static_cast<float>(counted) / static_cast<float>(std::max(1, pixels));
  glfwSetWindowSizeLimits(window.get(), static_cast<int>(std::lround(900 * unit)),
                          static_cast<int>(std::lround(600 * unit)), GLFW_DONT_CARE, GLFW_DONT_CARE);
  std::error_code failure;
  StudioOptions studio_options{
      .scale = input.scale, .virtual_clock = false, .card = true, .keys = {}, .settings = {}};
  const auto kept = [&](const char* name) {
    const std::filesystem::path file = options.bench.settings / name;
    const bool there = !options.bench.settings.empty() && std::filesystem::is_regular_file(file, failure);
    return there ? io::read_file(file) : std::string();
  };
  studio_options.keys = kept("keys");
  studio_options.settings = kept("window");
  Studio studio(gl, workshop, studio_options);
  glfwSetWindowUserPointer(window.get(), &input);
  listen(window.get());

  using Clock = std::chrono::steady_clock;
  Clock::time_point last = Clock::now();
  while (glfwWindowShouldClose(window.get()) == GLFW_FALSE && !studio.quits()) {
    glfwPollEvents();
    read_pointer(window.get(), input);
    if (options.read_pen) options.read_pen(input);
    const Clock::time_point now = Clock::now();
    input.seconds = std::clamp(std::chrono::duration<double>(now - last).count(), 1e-4, 0.25);
    last = now;
    studio.frame(input);
    studio.draw(0);
    input.keys.clear();
    input.characters.clear();
    input.dropped.clear();
    input.wheel = 0;
    if (studio.takes_picture()) {
      std::vector<std::uint8_t> rows(4 * static_cast<std::size_t>(input.width) *
                                     static_cast<std::size_t>(input.height));
      gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
      gl.ReadPixels(0, 0, input.width, input.height, GL_RGBA, GL_UNSIGNED_BYTE, rows.data());
      std::vector<std::uint8_t> rgba(rows.size());
      const std::size_t row = 4 * static_cast<std::size_t>(input.width);
      for (std::size_t y = 0; y < static_cast<std::size_t>(input.height); ++y)
        std::copy_n(rows.data() + row * (static_cast<std::size_t>(input.height) - 1 - y), row,
                    rgba.data() + row * y);
      for (std::size_t i = 3; i < rgba.size(); i += 4) rgba[i] = 255;
      const std::filesystem::path file = options.bench.out / "studio.png";
      workshop.post([file, rgba, width = input.width, height = input.height](Bench& bench) {
        io::write_png(file, width, height, rgba);
        bench.say(MessageKind::note, "the picture is " + file.string());
      });
    }
    glfwSwapBuffers(window.get());
  }
}

}  // namespace argil::studio
