#pragma once
// Rays through a field that is linear in tetrahedra (papers/004, Fig. 13). Each tetrahedron is projected onto the
// pixels that it covers; there its entry and exit along the pixel's ray, and the values at both, are exact, so
// integrals along the ray are too. In double precision on the processor, in parallel by rows: the same bits for any
// number of threads.

#include <cstdint>
#include <vector>

#include "sculpt/renderer.h"
#include "tools/view/camera.h"

namespace argil::view {

/// ∫ value ds along the ray through the middle of each pixel, top row first; ds in metres. Where tetrahedra overlap
/// each counts.
[[nodiscard]] std::vector<double> line_integrals(const sculpt::SceneVolume& volume, const Place& place,
                                                 const Camera& camera, int width, int height);

/// The volume rendering of renderer.h: emission and absorption from front to back over the segments of each ray,
/// in the order of their middles; a segment is cut where the map or the extinction has a kink, and the optical
/// depth of each piece is exact. Colours are multiplied by their opacity; four channels a pixel, top row first.
/// Cost O(pixels covered by tetrahedra); memory for a few rows of segments a thread.
[[nodiscard]] std::vector<float> volume_picture(const sculpt::SceneVolume& volume,
                                                const sculpt::SceneLegend& legend, const Place& place,
                                                const Camera& camera, int width, int height);

/// Extinction at a value's place t on the legend, 0 … 1, for opacity 1 [1 / radius of the scene].
[[nodiscard]] double extinction(sculpt::ColourMap map, double t);

}  // namespace argil::view
