// Of viewport.h: what is laid over the clay: the mask's veil, what is selected and pointed at, the ghost of an
// edit, the curve with its handles.

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>

#include "tools/studio/viewport.h"

namespace argil::studio {

namespace {

using sculpt::ElementType;
using view::Colour;
using view::Overlay;

Colour with_alpha(Colour colour, float alpha) {
  colour.alpha = alpha;
  return colour;
}

// A face as it is drawn: a fan about its middle, with a tint for each corner.
template <class TintOf>
void add_face(std::vector<view::TintedVertex>& to, const sculpt::SceneSurface& surface, std::size_t face,
              const TintOf& tint_of) {
  const std::size_t first = surface.offsets[face], size = surface.offsets[face + 1] - first;
  if (size < 3) return;
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();
  Colour mean{0, 0, 0, 0};
  for (std::size_t i = 0; i < size; ++i) {
    middle += surface.positions[surface.corners[first + i]] / static_cast<float>(size);
    const Colour tint = tint_of(surface.corners[first + i]);
    mean = {tint.red, tint.green, tint.blue, mean.alpha + tint.alpha / static_cast<float>(size)};
  }
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint32_t a = surface.corners[first + i], b = surface.corners[first + (i + 1) % size];
    const Eigen::Vector3f normal =
        (surface.positions[b] - surface.positions[a]).cross(middle - surface.positions[a]).normalized();
    to.push_back({surface.positions[a], normal, tint_of(a)});
    to.push_back({surface.positions[b], normal, tint_of(b)});
    to.push_back({middle, normal, mean});
  }
}

void add_even_face(std::vector<view::TintedVertex>& to, const sculpt::SceneSurface& surface, std::size_t face,
                   const Colour& tint) {
  add_face(to, surface, face, [&](std::uint32_t) { return tint; });
}

void add_mask(Overlay& overlay, const Snapshot& now) {
  const sculpt::SceneSurface& surface = now.scene->surface;
  if (now.mask.size() != surface.positions.size()) return;
  constexpr Colour k_veil{0.05F, 0.055F, 0.07F, 0.66F};
  for (std::size_t f = 0; f + 1 < surface.offsets.size(); ++f) {
    bool any = false;
    for (std::size_t c = surface.offsets[f]; c < surface.offsets[f + 1]; ++c)
      any = any || now.mask[surface.corners[c]] > 0;
    if (any)
      add_face(overlay.veil, surface, f,
               [&](std::uint32_t v) { return with_alpha(k_veil, k_veil.alpha * now.mask[v]); });
  }
}

// Faces and cells are tinted where they show; edges and vertices are drawn as lines and dots.
void add_elements(Overlay& overlay, const Snapshot& now, ElementType type, const std::vector<std::uint32_t>& ids,
                  const Colour& tint, float alpha, const Colour& ring) {
  if (ids.empty()) return;
  const sculpt::SceneSurface& surface = now.scene->surface;
  const Selectable& on = *now.selectable;
  const auto chosen = [&](std::uint32_t id) {
    return id != Selectable::k_none && std::binary_search(ids.begin(), ids.end(), id);
  };
  if (type == ElementType::faces || type == ElementType::cells) {
    const auto& owners = type == ElementType::faces ? on.face_from_face : on.cell_from_face;
    for (std::size_t f = 0; f < owners.size() && f + 1 < surface.offsets.size(); ++f)
      if (chosen(owners[f])) add_even_face(overlay.veil, surface, f, with_alpha(tint, alpha));
  } else if (type == ElementType::edges) {
    Overlay::Lines lines{.tint = tint, .half_width = alpha > 0.4F ? 1.9F : 1.3F, .through = true};
    for (const Selectable::Line& line : on.lines)
      if (chosen(line.edge))
        lines.ends.push_back({surface.positions[line.ends[0]], surface.positions[line.ends[1]]});
    overlay.lines.push_back(std::move(lines));
  } else if (type == ElementType::vertices) {
    Overlay::Dots dots{.tint = tint, .ring = ring, .radius = alpha > 0.4F ? 5.0F : 4.0F, .through = true};
    for (const Selectable::Point& point : on.points)
      if (chosen(point.vertex)) dots.at.push_back(surface.positions[point.at]);
    overlay.dots.push_back(std::move(dots));
  }
}

void add_ghost(Overlay& overlay, const Snapshot& now, const Colour& made, const Colour& gone) {
  const Ghost& ghost = *now.ghost;
  for (std::size_t i = 0; i + 2 < ghost.corners.size(); i += 3) {
    const Eigen::Vector3f normal =
        (ghost.corners[i + 1] - ghost.corners[i]).cross(ghost.corners[i + 2] - ghost.corners[i]).normalized();
    for (std::size_t k = 0; k < 3; ++k)
      overlay.ghost.push_back({ghost.corners[i + k], normal, with_alpha(made, 0.55F * ghost.shares[i + k])});
  }
  overlay.lines.push_back(
      {.ends = ghost.wire, .tint = with_alpha(made, 0.9F), .half_width = 0.7F, .through = true});
  const sculpt::SceneSurface& surface = now.scene->surface;
  if (ghost.layout != now.layout || ghost.gone.size() != surface.positions.size()) return;
  for (std::size_t f = 0; f + 1 < surface.offsets.size(); ++f) {
    float most = 0;
    for (std::size_t c = surface.offsets[f]; c < surface.offsets[f + 1]; ++c)
      most = std::max(most, ghost.gone[surface.corners[c]]);
    if (most > 0)
      add_face(overlay.veil, surface, f, [&](std::uint32_t v) { return with_alpha(gone, 0.55F * ghost.gone[v]); });
  }
}

void add_curve(Overlay& overlay, const CurveOnSurface& curve, const Eigen::Vector3d& way, std::size_t handle,
               bool finished, const Colour& tint, const Colour& quiet, const Colour& ring) {
  Overlay::Lines lines{.tint = tint, .half_width = 1.6F, .through = true};
  std::vector<Eigen::Vector3f> places;
  for (std::size_t i = 0; i < curve.line.size(); ++i)
    places.push_back(
        (curve.line[i] + (way.isZero(0) ? 0.0 : curve.influences[i][static_cast<Eigen::Index>(handle)]) * way)
            .cast<float>());
  for (std::size_t i = 0; i + 1 < places.size(); ++i) lines.ends.push_back({places[i], places[i + 1]});
  overlay.lines.push_back(std::move(lines));
  Overlay::Dots dots{.tint = finished ? tint : quiet, .ring = ring, .radius = 6, .through = true};
  for (std::size_t i = 0; i < curve.handles.size(); ++i)
    dots.at.push_back(
        (curve.handles[i] + (i == handle ? way : Eigen::Vector3d(Eigen::Vector3d::Zero()))).cast<float>());
  overlay.dots.push_back(std::move(dots));
}

std::uint64_t number_of(const void* pointer) {
  return reinterpret_cast<std::uintptr_t>(pointer);
}

}  // namespace

void Viewport::update_overlay(const Desk& desk) {
  const Snapshot& now = *desk.now;
  const auto pointing = desk.pointing();
  const bool drawn_by_handle = drag_ == Drag::handle;
  const Eigen::Vector3d way = drawn_by_handle ? Eigen::Vector3d(device_ - grip_) : Eigen::Vector3d::Zero();
  std::vector<std::uint64_t> all{number_of(now.scene.get()),
                                 number_of(now.selectable.get()),
                                 number_of(now.state.selection.get()),
                                 number_of(now.ghost.get()),
                                 number_of(now.curve.get()),
                                 now.layout,
                                 pointing ? 1U + static_cast<std::uint64_t>(*pointing) : 0U,
                                 desk.settings.choosing ? 1U : 0U,
                                 desk.pointed ? 1U + std::uint64_t{*desk.pointed} : 0U,
                                 desk.pending.tool != nullptr ? 1U : 0U,
                                 desk.curve.finished ? 1U : 0U,
                                 desk.settings.light ? 1U : 0U,
                                 std::bit_cast<std::uint64_t>(place_.radius),
                                 std::bit_cast<std::uint64_t>(place_.middle.sum())};
  for (const double d : way) all.push_back(std::bit_cast<std::uint64_t>(d));
  if (now.version != overlaid_version_ && !now.mask.empty()) all.push_back(now.version);
  if (all == overlaid_) return;
  overlaid_ = std::move(all);
  overlaid_version_ = now.version;
  overlay_changed_ = true;
  Overlay overlay;
  const Tokens& t = desk.ui->tokens();
  const Colour accent = colour_of(t.accent), mark = colour_of(t.mark), warning = colour_of(t.warning),
               ring = with_alpha(colour_of(t.panel), 0.9F);
  if (now.scene) {
    add_mask(overlay, now);
    if (now.selectable && pointing) {
      if (*pointing == ElementType::vertices) {
        Overlay::Dots dots{.tint = colour_of(t.quiet), .ring = ring, .radius = 2.6F, .through = false};
        for (const Selectable::Point& point : now.selectable->points)
          dots.at.push_back(now.scene->surface.positions[point.at]);
        overlay.dots.push_back(std::move(dots));
      }
      const bool pends = desk.pending.tool != nullptr;
      if (desk.settings.choosing)
        add_elements(overlay, now, now.state.selection->type, now.state.selection->ids, accent,
                     pends ? 0.41F : 0.55F, ring);
      if (desk.pointed && !pends)
        add_elements(overlay, now, *pointing, {*desk.pointed}, with_alpha(colour_of(t.text), 1), 0.3F, ring);
    }
    if (now.ghost && desk.pending.tool != nullptr) add_ghost(overlay, now, mark, warning);
    if (now.curve)
      add_curve(overlay, *now.curve, way, handle_, desk.curve.finished, accent, colour_of(t.text), ring);
  }
  overlay_.set(overlay, place_);
}

}  // namespace argil::studio
