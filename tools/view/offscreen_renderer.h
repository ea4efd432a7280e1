#pragma once
// Pictures without a display: fills the Renderer seam of sculpt/ with OpenGL through OSMesa.

#include <memory>
#include <span>

#include "sculpt/renderer.h"
#include "tools/view/osmesa_context.h"

namespace argil::view {

/// The context and its shaders are made at once and kept between pictures.
/// @throws Error (unsupported) with a remedy where OSMesa is not there or too old.
[[nodiscard]] std::unique_ptr<sculpt::Renderer> make_offscreen_renderer(
    std::span<const char* const> library_names = k_osmesa_names);

}  // namespace argil::view
