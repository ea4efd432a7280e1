#include "sculpt/surface_look.h"

#include "subdiv/boundary.h"

namespace argil::sculpt {

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

}  // namespace argil::sculpt
