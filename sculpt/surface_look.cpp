#include "sculpt/surface_look.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sculpt/export.h"
#include "sculpt/measures.h"
#include "subdiv/boundary.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

// Matplotlib's viridis at quarters, from sRGB to the linear light of glTF.
Eigen::Vector3f colour_of(double part) {
  static const std::array<std::array<int, 3>, 5> k_colours{
      {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};
  const double at = 4 * std::clamp(part, 0.0, 1.0);
  const auto below = std::min<std::size_t>(3, static_cast<std::size_t>(at));
  Eigen::Vector3f colour;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const double low = k_colours[below][channel], high = k_colours[below + 1][channel];
    const double srgb = (low + (at - static_cast<double>(below)) * (high - low)) / 255;
    colour[static_cast<Eigen::Index>(channel)] =
        static_cast<float>(srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4));
  }
  return colour;
}

}  // namespace

io::SurfaceLook surface_look(const subdiv::Solid& solid) {
  constexpr double k_crease = 1;
  const subdiv::BoundarySurface surface = subdiv::boundary_surface(solid);
  io::SurfaceLook look;
  look.sharp.reserve(surface.corners.size());
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    const auto face = surface.face(f);
    for (std::size_t i = 0; i < face.size(); ++i) {
      const auto edge = solid.find_edge(surface.vertex_from_surface[face[i]],
                                        surface.vertex_from_surface[face[(i + 1) % face.size()]]);
      look.sharp.push_back(edge && solid.edge_sharpness(*edge) >= k_crease ? 1 : 0);
    }
  }
  return look;
}

void save_coloured(const Document& document, const std::filesystem::path& path, const std::string& field) {
  if (path.extension() != ".glb" && path.extension() != ".gltf")
    throw Error(ErrorCode::unsupported,
                "only .glb and .gltf hold colours of one field; leave out field (.vtu and .vtk hold every field)");
  const subdiv::Solid& solid = document.refinement().solid();
  const Eigen::VectorXd values = shown_field(document, field).values;
  const Eigen::Matrix3Xd positions =
      document.state().level > 0 ? document.surface_nodes(document.positions()) : document.positions();
  io::SurfaceLook look = surface_look(solid);
  const auto vertices = subdiv::boundary_surface(solid).vertex_from_surface;
  double low = INFINITY, high = -INFINITY;
  for (const subdiv::VertexId v : vertices) {
    low = std::min(low, values[static_cast<Eigen::Index>(v.index())]);
    high = std::max(high, values[static_cast<Eigen::Index>(v.index())]);
  }
  for (const subdiv::VertexId v : vertices)
    look.colours.push_back(
        colour_of(high > low ? (values[static_cast<Eigen::Index>(v.index())] - low) / (high - low) : 0));
  io::write_surface(path, surface_mesh(solid, positions), look);
}

}  // namespace argil::sculpt
