#pragma once
// Shapes with semi-sharp creases and corners, and shapes with sharp sheets inside.

#include <functional>
#include <set>

#include "subdiv/radial_edge.h"
#include "tests/shapes/shapes.h"

namespace argil::subdiv::test {

/// The catalogue with sharpness of every size on edges and vertices of the boundary, and creases that change along
/// their length.
inline std::vector<Shape> semi_sharp_shapes() {
  constexpr double k_sizes[] = {0.3, 1, 1.7, 3.5, 0.8, 2, k_infinitely_sharp};
  std::vector<Shape> shapes;
  for (Shape& shape : catalogue()) {
    std::mt19937 random(static_cast<unsigned>(shapes.size()));
    Transaction edit(shape.solid);
    for (const EdgeId e : shape.solid.edges())
      if (shape.solid.is_boundary(e) && random() % 3 == 0) edit.set_sharpness(e, k_sizes[random() % 7]);
    for (const VertexId v : shape.solid.vertices())
      if (shape.solid.is_boundary(v) && random() % 6 == 0) edit.set_sharpness(v, k_sizes[random() % 7]);
    (void)edit.commit();
    shapes.push_back({shape.name + ", semi-sharp", std::move(shape.solid), shape.positions, true});
  }
  for (const double least : {0.0, 0.3, 1.0, 1.7, 3.5}) {
    Built box = box_grid(3, 2, 2, {3, 2, 2});
    Transaction edit(box.solid);
    for (const EdgeId e : box_edges(box.solid)) {
      const auto& ends = box.solid.edge_vertices(e);
      const double x = (box.positions(0, ends[0].value) + box.positions(0, ends[1].value)) / 2;
      edit.set_sharpness(e, least + x / 2);
    }
    (void)edit.commit();
    const Eigen::Matrix3Xd positions = jittered(box.positions, 0.1, 3);
    shapes.push_back({"crease from " + std::to_string(least), std::move(box.solid), positions, true});
  }
  return shapes;
}

using OfPlace = std::function<bool(const Eigen::Vector3d&)>;

/// A sheet: the faces between cells within a region and without, as loops seen from within. Cells and faces are
/// asked at their centroids.
struct Sheet {
  std::vector<FaceId> faces;
  std::vector<std::vector<VertexId>> loops;
};
inline Sheet sheet_about(const Built& built, const OfPlace& region, const OfPlace& kept = nullptr) {
  const auto centroid = [&](const auto& vertices) {
    Eigen::Vector3d sum(0, 0, 0);
    for (const VertexId v : vertices) sum += built.positions.col(v.value) / static_cast<double>(vertices.size());
    return sum;
  };
  const auto within = [&](CellId c) { return c.valid() && region(centroid(cell_vertices(built.solid, c))); };
  Sheet sheet;
  for (const FaceId f : built.solid.faces()) {
    const FaceUseId front = face_use(f, false), back = face_use(f, true);
    if (built.solid.is_boundary(f) || within(built.solid.owner(front)) == within(built.solid.owner(back))) continue;
    if (kept && !kept(centroid(built.solid.face_vertices(f)))) continue;
    sheet.faces.push_back(f);
    sheet.loops.push_back(use_vertices(built.solid, within(built.solid.owner(front)) ? front : back));
  }
  return sheet;
}
inline void sharpen(Solid& solid, const std::vector<FaceId>& faces, double sharpness) {
  Transaction edit(solid);
  for (const FaceId f : faces) edit.set_sharpness(f, sharpness);
  (void)edit.commit();
}

struct SheetShape {
  std::string name;
  Built built;  // not yet sharp, in its own place
  std::vector<Sheet> sheets;
};
inline std::vector<SheetShape> sheet_shapes() {
  std::vector<SheetShape> shapes;
  const auto add = [&](const std::string& name, const Built& built, std::vector<Sheet> sheets) {
    shapes.push_back({name, built, std::move(sheets)});
  };
  const Built box = box_grid(3, 3, 3, {3, 3, 3}), large = box_grid(4, 4, 3, {4, 4, 3});
  const OfPlace left = [](const Eigen::Vector3d& p) { return p[0] < 1; };
  const OfPlace near = [](const Eigen::Vector3d& p) { return p[0] < 2; };
  const OfPlace front = [](const Eigen::Vector3d& p) { return p[1] < 2; };
  add("flat sheet", box, {sheet_about(box, left)});
  add("bent sheet", large, {sheet_about(large, [&](const Eigen::Vector3d& p) { return near(p) && front(p); })});
  add("closed sheet", box,
      {sheet_about(box, [](const Eigen::Vector3d& p) { return (p.array() > 1).all() && (p.array() < 2).all(); })});
  add("crossing sheets", large, {sheet_about(large, near), sheet_about(large, front)});
  add("free rim", large, {sheet_about(large, near, [](const Eigen::Vector3d& p) {
        return p[1] > 1 && p[1] < 3 && p[2] > 1 && p[2] < 2;
      })});
  add("sheet that ends inside", large, {sheet_about(large, near, front)});
  const Built wheel = build(fan(5, 3));
  add("sheet across a fan of 5", wheel, {sheet_about(wheel, [](const Eigen::Vector3d& p) { return p[2] < 1; })});
  return shapes;
}

/// The sheets of sheet_shapes(), infinitely sharp, semi-sharp, and with creases on them.
inline std::vector<Shape> sharp_sheets() {
  std::vector<Shape> shapes;
  for (const SheetShape& shape : sheet_shapes())
    for (const double sharpness : {10.0, 0.4, 1.0, 1.6}) {
      Solid solid = shape.built.solid;
      for (const Sheet& sheet : shape.sheets) sharpen(solid, sheet.faces, sharpness);
      shapes.push_back({shape.name + " of sharpness " + std::to_string(sharpness), std::move(solid),
                        jittered(shape.built.positions, 0.2, 4), true});
    }
  for (const SheetShape& shape : sheet_shapes()) {
    Solid solid = shape.built.solid;
    Transaction edit(solid);
    std::mt19937 random(5);
    for (const Sheet& sheet : shape.sheets)
      for (const FaceId f : sheet.faces) {
        edit.set_sharpness(f, random() % 2 == 0 ? 10 : 0.7);
        edit.set_sharpness(solid.face_edges(f)[random() % 4], 1.3);
        if (random() % 4 == 0) edit.set_sharpness(solid.face_vertices(f)[0], 0.9);
      }
    (void)edit.commit();
    shapes.push_back({shape.name + ", mixed", std::move(solid), jittered(shape.built.positions, 0.2, 6), true});
  }
  return shapes;
}

}  // namespace argil::subdiv::test
