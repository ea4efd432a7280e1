#include "tools/view/wires.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace argil::view {

namespace {

constexpr float k_full_length = 22, k_faded_length = 0.07F * k_full_length;  // [pixels]
constexpr float k_invisible = 1.0F / 510;                                    // opacity
constexpr float k_faint = 0.1F;  // of the tint's opacity, for a moment not missed
constexpr float k_aside = 1.5F;  // away from the middle of the picture a line may be longer by this factor

}  // namespace

void Wires::load(const sculpt::SceneSurface& surface, const std::vector<Eigen::Vector3f>& positions) {
  std::vector<float> squared;
  squared.reserve(surface.wire.size());
  for (const auto& ends : surface.wire) squared.push_back((positions[ends[1]] - positions[ends[0]]).squaredNorm());
  order_.resize(surface.wire.size());
  std::iota(order_.begin(), order_.end(), 0U);
  std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return squared[a] != squared[b] ? squared[a] > squared[b] : a < b;
  });
  move(surface, positions);
}

void Wires::move(const sculpt::SceneSurface& surface, const std::vector<Eigen::Vector3f>& positions) {
  std::vector<std::array<Eigen::Vector3f, 2>> lines;
  lines.reserve(order_.size());
  lengths_.clear();
  for (const std::uint32_t edge : order_) {
    const auto& ends = surface.wire[edge];
    lines.push_back({positions[ends[0]], positions[ends[1]]});
    lengths_.push_back((positions[ends[1]] - positions[ends[0]]).norm());
  }
  lines_.set(lines, k_line_attributes, 1);
}

GLsizei Wires::visible(const Camera& camera, const Sampling& sampling, float opacity) const {
  // The strength that rounds to nothing, at the foot of the smooth step that fades (3 t^2), and the length with it.
  const float strength = sampling.hurried ? k_faint : k_invisible / std::max(opacity, k_invisible);
  const float t = std::sqrt(strength / 3);
  const float pixels = (k_faded_length + t * (k_full_length - k_faded_length)) * sampling.pixel;
  const float shortest = pixels * camera.pixel_at_unit_distance * camera.nearest / (sampling.hurried ? 1 : k_aside);
  std::size_t count = lengths_.size();
  while (count > 0 && lengths_[count - 1] < shortest) --count;
  return static_cast<GLsizei>(count);
}

void Wires::draw(const ShapePainter& painter, const Camera& camera, const Sampling& sampling,
                 const Colour& tint) const {
  painter.lines(lines_, camera, sampling, {tint, 0.5F, k_full_length, k_faded_length},
                visible(camera, sampling, tint.alpha));
}

}  // namespace argil::view
