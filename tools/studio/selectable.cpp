#include "tools/studio/selectable.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "sculpt/control_elements.h"

namespace argil::studio {

namespace {

using sculpt::ElementType;
using sculpt::SceneSurface;

Eigen::Vector3d at(const SceneSurface& surface, std::uint32_t v) {
  return surface.positions[v].cast<double>();
}

Eigen::Vector3d middle_of(const SceneSurface& surface, std::size_t face) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t c = surface.offsets[face]; c < surface.offsets[face + 1]; ++c)
    sum += at(surface, surface.corners[c]);
  return sum / static_cast<double>(surface.offsets[face + 1] - surface.offsets[face]);
}

// As long as twice its area.
Eigen::Vector3d area_normal(const SceneSurface& surface, std::size_t face) {
  const std::size_t first = surface.offsets[face], size = surface.offsets[face + 1] - first;
  const Eigen::Vector3d base = at(surface, surface.corners[first]);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < size; ++i)
    sum +=
        (at(surface, surface.corners[first + i]) - base).cross(at(surface, surface.corners[first + i + 1]) - base);
  return sum;
}

double distance_to_line(const SceneSurface& surface, const Selectable::Line& line, const Eigen::Vector3d& place) {
  const Eigen::Vector3d a = at(surface, line.ends[0]), way = at(surface, line.ends[1]) - a;
  const double length_squared = way.squaredNorm();
  const double share = length_squared > 0 ? std::clamp((place - a).dot(way) / length_squared, 0.0, 1.0) : 0.0;
  return (a + share * way - place).norm();
}

// One place of the surface for each element: the middle of the piece nearest to the mean of its pieces.
std::map<std::uint32_t, Eigen::Vector3d> places_of(const Selectable& on, const SceneSurface& surface,
                                                   ElementType type) {
  std::map<std::uint32_t, Eigen::Vector3d> places;
  if (type == ElementType::vertices) {
    for (const Selectable::Point& point : on.points) places[point.vertex] = at(surface, point.at);
    return places;
  }
  std::vector<std::pair<std::uint32_t, Eigen::Vector3d>> pieces;
  if (type == ElementType::edges) {
    for (const Selectable::Line& line : on.lines)
      pieces.emplace_back(line.edge, 0.5 * (at(surface, line.ends[0]) + at(surface, line.ends[1])));
  } else {
    const auto& owners = type == ElementType::faces ? on.face_from_face : on.cell_from_face;
    for (std::size_t f = 0; f < owners.size(); ++f)
      if (owners[f] != Selectable::k_none) pieces.emplace_back(owners[f], middle_of(surface, f));
  }
  std::map<std::uint32_t, std::pair<Eigen::Vector3d, double>> means;
  for (const auto& [id, place] : pieces) {
    auto& [sum, count] = means.try_emplace(id, Eigen::Vector3d::Zero(), 0.0).first->second;
    sum += place;
    count += 1;
  }
  std::map<std::uint32_t, double> nearest;
  for (const auto& [id, place] : pieces) {
    const auto& [sum, count] = means.at(id);
    const double distance = (place - sum / count).norm();
    const auto [found, is_new] = nearest.try_emplace(id, distance);
    if (!is_new && found->second <= distance) continue;
    found->second = distance;
    places[id] = place;
  }
  return places;
}

}  // namespace

Selectable selectable(const sculpt::Document& document, const SceneSurface& surface) {
  using namespace subdiv;
  const Solid& fine = document.refinement().solid();
  const sculpt::ControlElements control = sculpt::control_elements(document.refinement());
  Selectable on;
  std::vector<VertexId> loop;
  for (std::size_t f = 0; f + 1 < surface.offsets.size(); ++f) {
    loop.clear();
    for (std::size_t c = surface.offsets[f]; c < surface.offsets[f + 1]; ++c)
      loop.emplace_back(surface.vertex_from_surface[surface.corners[c]]);
    const auto face = fine.find_face(loop);
    const bool shows = face && fine.is_boundary(*face) && control.face[*face].valid();
    on.face_from_face.push_back(shows ? control.face[*face].value : Selectable::k_none);
    on.cell_from_face.push_back(control.cell[CellId{surface.cell_from_face[f]}].value);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::size_t next = (i + 1) % loop.size();
      const auto edge = fine.find_edge(loop[i], loop[next]);
      if (!edge || !control.edge[*edge].valid()) continue;
      std::array<std::uint32_t, 2> ends{surface.corners[surface.offsets[f] + i],
                                        surface.corners[surface.offsets[f] + next]};
      if (ends[0] > ends[1]) std::swap(ends[0], ends[1]);
      on.lines.push_back({control.edge[*edge].value, ends});
    }
  }
  std::sort(on.lines.begin(), on.lines.end());
  on.lines.erase(std::unique(on.lines.begin(), on.lines.end()), on.lines.end());
  for (std::size_t v = 0; v < surface.vertex_from_surface.size(); ++v)
    if (const VertexId vertex = control.vertex[VertexId{surface.vertex_from_surface[v]}]; vertex.valid())
      on.points.push_back({vertex.value, static_cast<std::uint32_t>(v)});
  return on;
}

std::optional<std::uint32_t> element_at(const Selectable& on, const SceneSurface& surface, ElementType type,
                                        const Hit& hit) {
  if (hit.face >= on.face_from_face.size()) return std::nullopt;
  if (type == ElementType::faces || type == ElementType::cells) {
    const std::uint32_t id = (type == ElementType::faces ? on.face_from_face : on.cell_from_face)[hit.face];
    return id == Selectable::k_none ? std::nullopt : std::optional(id);
  }
  std::optional<std::uint32_t> best;
  double nearest = HUGE_VAL;
  const auto offer = [&](std::uint32_t id, double distance) {
    if (distance >= nearest) return;
    nearest = distance;
    best = id;
  };
  if (type == ElementType::edges)
    for (const Selectable::Line& line : on.lines) offer(line.edge, distance_to_line(surface, line, hit.at));
  else
    for (const Selectable::Point& point : on.points) offer(point.vertex, (at(surface, point.at) - hit.at).norm());
  return best;
}

std::vector<std::uint32_t> elements_in(const Selectable& on, const SceneSurface& surface, ElementType type,
                                       const OrbitCamera& camera, const ScreenBox& box, bool through) {
  std::vector<std::uint32_t> found;
  const Eigen::Vector3d eye = camera.eye();
  for (const auto& [id, place] : places_of(on, surface, type)) {
    if (!box.contains(camera.pixel(place))) continue;
    if (!through) {
      const Eigen::Vector3d way = place - eye;
      const auto hit = pick(surface, {eye, way.normalized()});
      // On a silhouette a ray may pass by; what it meets well before the place hides it.
      if (hit && hit->distance < way.norm() * (1 - 1e-3)) continue;
    }
    found.push_back(id);
  }
  return found;
}

Patch patch_of(const Selectable& on, const SceneSurface& surface, const sculpt::Selection& selection) {
  const auto chosen = [&](std::uint32_t id) {
    return id != Selectable::k_none && std::binary_search(selection.ids.begin(), selection.ids.end(), id);
  };
  Patch patch;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), normal = sum;
  double weight = 0;
  const auto add = [&](const Eigen::Vector3d& place, double share) {
    sum += share * place;
    weight += share;
  };
  if (selection.type == ElementType::edges) {
    for (const Selectable::Line& line : on.lines)
      if (chosen(line.edge))
        add(0.5 * (at(surface, line.ends[0]) + at(surface, line.ends[1])),
            (at(surface, line.ends[0]) - at(surface, line.ends[1])).norm());
  } else if (selection.type == ElementType::faces || selection.type == ElementType::cells) {
    const auto& owners = selection.type == ElementType::faces ? on.face_from_face : on.cell_from_face;
    for (std::size_t f = 0; f < owners.size(); ++f) {
      if (!chosen(owners[f])) continue;
      const Eigen::Vector3d area = area_normal(surface, f);
      add(middle_of(surface, f), area.norm());
      normal += area;
    }
  } else {
    for (const Selectable::Point& point : on.points)
      if (chosen(point.vertex)) add(at(surface, point.at), 1);
  }
  if (!(weight > 0)) return patch;
  patch.empty = false;
  patch.middle = sum / weight;
  if (normal.norm() > 0) patch.normal = normal.normalized();
  return patch;
}

}  // namespace argil::studio
