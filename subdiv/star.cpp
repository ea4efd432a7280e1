#include "subdiv/star.h"

#include <algorithm>

namespace argil::subdiv {

namespace {

template <class T>
std::size_t place(const std::vector<T>& list, const T& value) {
  return static_cast<std::size_t>(std::find(list.begin(), list.end(), value) - list.begin());
}

}  // namespace

Star make_star(const Solid& solid, const Incidence& incidence, VertexId v) {
  const bool skin = incidence.on_skin(v);
  Star star;
  solid.for_each_edge(v, [&](EdgeId e) {
    if (!skin || incidence.on_skin(e)) star.edges.push_back(e);
  });
  for (std::size_t i = 0; i < star.edges.size(); ++i)
    solid.for_each_face(star.edges[i], [&](FaceId f) {
      if (skin && !incidence.on_skin(f)) return;
      const std::size_t at = place(star.faces, f);
      if (at == star.faces.size()) {
        star.faces.push_back(f);
        star.edges_of_face.push_back({i, i});
      } else {
        star.edges_of_face[at][1] = i;
      }
    });
  if (skin) return star;
  const auto cells = incidence.cells(v);
  star.cells.assign(cells.begin(), cells.end());
  for (const FaceId f : star.faces)
    star.cells_of_face.push_back(
        {place(star.cells, solid.owner(face_use(f, false))), place(star.cells, solid.owner(face_use(f, true)))});
  return star;
}

}  // namespace argil::subdiv
