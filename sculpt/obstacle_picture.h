#pragma once
// Obstacles as a renderer draws them.

#include "sculpt/document.h"
#include "sculpt/renderer.h"

namespace argil::sculpt {

/// Adds the document's obstacles where they are at its time. Of a plane that is a round patch, wider than the body
/// and fading outwards, about the place on it that is nearest to the body's middle.
void add_obstacles(Scene& scene, const Document& document);

}  // namespace argil::sculpt
