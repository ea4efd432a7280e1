#include "random_edits.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "subdiv/edit/rewrite.h"
#include "subdiv/radial_edge.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

Eigen::Vector3d position(const Document& document, VertexId v) {
  return document.rest().col(static_cast<Eigen::Index>(v.index()));
}

Eigen::Vector3d normal_of(const Document& document, FaceId f) {
  const auto loop = use_vertices(document.solid(), document.solid().boundary_use(f));
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < loop.size(); ++i)
    sum += position(document, loop[i]).cross(position(document, loop[(i + 1) % loop.size()]));
  return sum.normalized();
}

double extent(const Document& document) {
  Eigen::AlignedBox3d box;
  for (const VertexId v : document.solid().vertices()) box.extend(position(document, v));
  return box.diagonal().norm();
}

}  // namespace

std::vector<std::string> RandomEdits::tools() {
  return {"extrude", "peak",    "remove", "split",     "cut",  "merge",     "weld", "bridge", "collapse",
          "fill",    "sharpen", "mirror", "duplicate", "join", "transform", "move", "smooth", "project"};
}

std::string RandomEdits::vector(double low, double high) {
  return fmt::format("{:.4f} {:.4f} {:.4f}", number(low, high), number(low, high), number(low, high));
}

std::string RandomEdits::direction() {
  static const char* const axes[] = {"1 0 0", "0 1 0", "0 0 1", "-1 0 0", "0 -1 0", "0 0 -1"};
  return pick(2) ? axes[pick(6)]
                 : fmt::format("{:.3f} {:.3f} {:.3f}", number(-1, 1), number(-1, 1), number(0.1, 1));
}

std::string RandomEdits::point(const Eigen::Vector3d& p) const {
  return fmt::format("{:.12g} {:.12g} {:.12g}", p.x(), p.y(), p.z());
}

// A condition that holds at one place only.
std::string RandomEdits::at(const Eigen::Vector3d& p) const {
  const auto near = [](char axis, double value) {
    return fmt::format("abs({} {} {:.12g}) < 1e-7", axis, value < 0 ? '+' : '-', std::abs(value));
  };
  return fmt::format("({} and {} and {})", near('x', p.x()), near('y', p.y()), near('z', p.z()));
}

Eigen::Vector3d RandomEdits::middle(std::span<const VertexId> vertices) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const VertexId v : vertices) sum += position(*document_, v);
  return sum / static_cast<double>(vertices.size());
}

template <class Range, class Fits>
auto RandomEdits::random_element(const Range& range, Fits fits) {
  using IdType = std::decay_t<decltype(*range.begin())>;
  std::vector<IdType> all;
  for (const IdType id : range)
    if (fits(id)) all.push_back(id);
  return all.empty() ? IdType{} : all[pick(all.size())];
}

std::vector<FaceId> RandomEdits::boundary_faces() const {
  std::vector<FaceId> result;
  for (const FaceId f : document_->solid().faces())
    if (document_->solid().is_boundary(f)) result.push_back(f);
  return result;
}

std::string RandomEdits::faces(const std::vector<FaceId>& chosen) const {
  std::string text = "where ";
  for (std::size_t i = 0; i < chosen.size(); ++i)
    text += (i ? " or " : "") + at(middle(document_->solid().face_vertices(chosen[i])));
  return text;
}

std::string RandomEdits::cells(std::size_t count) {
  std::string text = "where ";
  for (std::size_t i = 0; i < count; ++i) {
    const CellId c = random_element(document_->solid().cells(), [](CellId) { return true; });
    text += (i ? " or " : "") + at(middle(cell_vertices(document_->solid(), c)));
  }
  return text;
}

// Two boundary faces of as many corners that look at each other, or at least lie near.
std::vector<FaceId> RandomEdits::near_pair() {
  const auto all = boundary_faces();
  std::vector<FaceId> best;
  double least = 1e300;
  for (int i = 0; i < 40; ++i) {
    const FaceId a = all[pick(all.size())], b = all[pick(all.size())];
    const auto loop_a = document_->solid().face_vertices(a), loop_b = document_->solid().face_vertices(b);
    if (a == b || loop_a.size() != loop_b.size()) continue;
    bool apart = true;
    for (const VertexId v : loop_a) apart = apart && std::find(loop_b.begin(), loop_b.end(), v) == loop_b.end();
    const CellId owner_a = document_->solid().owner(document_->solid().boundary_use(a));
    if (!apart || owner_a == document_->solid().owner(document_->solid().boundary_use(b))) continue;
    const double facing = normal_of(*document_, a).dot(normal_of(*document_, b));
    const double distance = (middle(loop_a) - middle(loop_b)).norm() * (2 + facing);
    if (distance >= least) continue;
    least = distance;
    best = {a, b};
  }
  return best;
}

std::string RandomEdits::beginning() {
  switch (pick(8)) {
    case 0:
      return fmt::format("new tetrahedron size {}", vector(0.5, 2));
    case 1:
      return fmt::format("new {} size {}", pick(2) ? "wedge" : "pyramid", vector(0.5, 2));
    case 2:
      return "new cylinder radius 0.5 height 1";
    case 3:
      return "new torus";
    case 4:
      return fmt::format("new {}", pick(2) ? "octahedron" : "dodecahedron");
    case 5:
      return fmt::format("new box {} {} 1 size 5 5 1", 3 + pick(4), 3 + pick(4));
    case 6:
      return fmt::format("new box {} {} {} size {}", 1 + pick(6), 1 + pick(6), 1 + pick(6), vector(1, 3));
    default:
      return fmt::format("new box {} {} {} size {}", 1 + pick(3), 1 + pick(3), 1 + pick(3), vector(1, 3));
  }
}

RandomEdit RandomEdits::extrude() {
  const auto all = boundary_faces();
  std::vector<FaceId> chosen{all[pick(all.size())]};
  if (pick(3) == 0)  // and one beside it
    for (const EdgeId e : document_->solid().face_edges(chosen[0]))
      document_->solid().for_each_face(e, [&](FaceId f) {
        if (chosen.size() < 2 && f != chosen[0] && document_->solid().is_boundary(f)) chosen.push_back(f);
      });
  std::string how = fmt::format("{:.3f}", number(0.1, 0.6));
  if (pick(3) == 0) how += fmt::format(" steps {}", 1 + pick(3));
  switch (pick(6)) {
    case 0:
      how += " normals";
      break;
    case 1:
      how += " along " + direction();
      break;
    case 2: {
      const Eigen::Vector3d from = middle(document_->solid().face_vertices(chosen[0]));
      const Eigen::Vector3d n = normal_of(*document_, chosen[0]);
      how = fmt::format("path {} {}{}", point(from + 0.3 * n), point(from + 0.6 * n + Eigen::Vector3d(0.1, 0.1, 0)),
                        pick(2) ? " curve" : "");
      break;
    }
    case 3:
      how += fmt::format(" twist {:.1f}", number(-60, 60));
      break;
    default:
      break;
  }
  if (pick(3) == 0) how += fmt::format(" scale {:.2f}", number(0.5, 1.3));
  return {"extrude", {}, fmt::format("extrude {} {}", how, faces(chosen))};
}

RandomEdit RandomEdits::remove() {
  const std::size_t count = document_->solid().cell_count();
  if (pick(12) == 0) return {"remove", {}, "remove dangling"};
  if (pick(12) == 0) return {"remove", {}, "remove keep " + cells(1)};
  if (count > 40 && pick(2)) {  // everything on one side
    const Eigen::Vector3d p = middle(
        cell_vertices(document_->solid(), random_element(document_->solid().cells(), [](CellId) { return true; })));
    const char axis = static_cast<char>('x' + pick(3));
    return {"remove", {}, fmt::format("remove where {} {} {:.6g}", axis, pick(2) ? '<' : '>', p[axis - 'x'])};
  }
  return {"remove", {}, "remove " + cells(count > 12 ? 1 + pick(4) : 1)};
}

RandomEdit RandomEdits::cut() {
  const Solid& solid = document_->solid();
  switch (pick(3)) {
    case 0: {
      const CellId c = random_element(solid.cells(), [](CellId) { return true; });
      const Eigen::Vector3d p =
          middle(cell_vertices(solid, c)) + Eigen::Vector3d(number(-0.02, 0.02), number(-0.02, 0.02), 0);
      return {"cut",
              {},
              fmt::format("cut plane {} at {}{}", direction(), point(p),
                          pick(2) ? " where " + at(middle(cell_vertices(solid, c))) : "")};
    }
    case 1: {
      const FaceId f = random_element(solid.faces(), [&](FaceId g) { return solid.face_vertices(g).size() > 3; });
      if (!f.valid()) return extrude();
      const auto loop = solid.face_vertices(f);
      const std::size_t i = pick(loop.size()), j = (i + 2 + pick(loop.size() - 3)) % loop.size();
      return {"cut",
              {fmt::format("select faces interior where {}", at(middle(loop)))},
              fmt::format("cut face between {} {}", loop[i].value, loop[j].value)};
    }
    default: {
      const EdgeId e = random_element(solid.edges(), [](EdgeId) { return true; });
      return {
          "cut",
          {},
          fmt::format("cut ring fraction {:.2f} where {}", number(0.3, 0.7), at(middle(solid.edge_vertices(e))))};
    }
  }
}

RandomEdit RandomEdits::collapse() {
  const Solid& solid = document_->solid();
  switch (pick(4)) {
    case 0: {
      const FaceId f = random_element(solid.faces(), [](FaceId) { return true; });
      return {"collapse",
              {fmt::format("select faces interior where {}", at(middle(solid.face_vertices(f))))},
              "collapse"};
    }
    case 1:
      return {"collapse", {"select cells " + cells(1)}, "collapse"};
    default: {
      const EdgeId e = random_element(solid.edges(), [](EdgeId) { return true; });
      return {"collapse", {}, "collapse where " + at(middle(solid.edge_vertices(e)))};
    }
  }
}

// A reflex edge of the boundary: the two faces at it look at each other.
RandomEdit RandomEdits::fill() {
  const Solid& solid = document_->solid();
  std::vector<FaceId> pair;
  const EdgeId edge = random_element(solid.edges(), [&](EdgeId e) {
    std::vector<FaceId> at_edge;
    solid.for_each_face(e, [&](FaceId f) {
      if (solid.is_boundary(f)) at_edge.push_back(f);
    });
    if (at_edge.size() != 2) return false;
    const Eigen::Vector3d across =
        middle(solid.face_vertices(at_edge[1])) - middle(solid.face_vertices(at_edge[0]));
    return normal_of(*document_, at_edge[0]).dot(across) > 1e-6;
  });
  if (!edge.valid()) return extrude();
  solid.for_each_face(edge, [&](FaceId f) {
    if (solid.is_boundary(f)) pair.push_back(f);
  });
  return {"fill", {}, "fill " + faces(pair)};
}

RandomEdit RandomEdits::sharpen() {
  const Solid& solid = document_->solid();
  static const char* const values[] = {"10", "10", "0", "1", "2.5", "0.4"};
  const std::string line = fmt::format("sharpen {}", values[pick(6)]);
  switch (pick(4)) {
    case 0: {
      const VertexId v = random_element(solid.vertices(), [&](VertexId w) { return solid.is_boundary(w); });
      return {"sharpen", {"select vertices where " + at(position(*document_, v))}, line};
    }
    case 1: {
      const FaceId f = random_element(solid.faces(), [&](FaceId g) { return !solid.is_boundary(g); });
      if (!f.valid()) return extrude();
      return {"sharpen", {fmt::format("select faces interior where {}", at(middle(solid.face_vertices(f))))}, line};
    }
    case 2:
      return {"sharpen", {fmt::format("select edges angle {:.0f}", number(10, 60))}, line};
    default: {
      const EdgeId e = random_element(solid.edges(), [&](EdgeId g) { return solid.is_boundary(g); });
      return {"sharpen", {"select edges where " + at(middle(solid.edge_vertices(e)))}, line};
    }
  }
}

RandomEdit RandomEdits::mirror() {
  Eigen::AlignedBox3d box;
  for (const VertexId v : document_->solid().vertices()) box.extend(position(*document_, v));
  if (pick(4) == 0) return {"mirror", {"select cells"}, "mirror normal 1 0 0 flip"};
  const std::size_t axis = pick(3);
  const bool high = pick(2) == 0;
  static const char* const normals[] = {"1 0 0", "0 1 0", "0 0 1"};
  Eigen::Vector3d p = high ? box.max() : box.min();
  if (pick(3) == 0) p[static_cast<Eigen::Index>(axis)] += high ? 0.2 : -0.2;
  return {
      "mirror", {}, fmt::format("mirror normal {} at {}{}", normals[axis], point(p), pick(4) == 0 ? " keep" : "")};
}

RandomEdit RandomEdits::next(const Document& document) {
  document_ = &document;
  const Solid& solid = document.solid();
  const std::size_t count = solid.cell_count();
  if (count > 420) return pick(3) ? remove() : collapse();
  const double size = extent(document);
  switch (pick(30)) {
    case 0:
    case 1:
    case 2:
    case 3:
      return extrude();
    case 4: {
      const auto all = boundary_faces();
      return {"peak", {}, fmt::format("peak {:.3f} {}", number(0.05, 0.4), faces({all[pick(all.size())]}))};
    }
    case 5:
    case 6:
      return remove();
    case 7:
    case 8:
      return {"split", {}, "split " + cells(1 + pick(2))};
    case 9:
    case 10:
    case 11:
      return cut();
    case 12:
    case 13:
    case 14:
    case 15: {
      const auto pair = near_pair();
      if (pair.empty()) return extrude();
      if (pick(2)) return {"merge", {}, fmt::format("merge at {} {}", pick(2) ? "middle" : "first", faces(pair))};
      return {"bridge", {}, fmt::format("bridge steps {}{} {}", 1 + pick(2), pick(3) ? "" : " arc", faces(pair))};
    }
    case 16: {
      if (pick(2)) return {"weld", {}, fmt::format("weld tolerance {:.4f}", number(0, 0.1) * size)};
      const VertexId a = random_element(solid.vertices(), [&](VertexId v) { return solid.is_boundary(v); });
      const VertexId b =
          random_element(solid.vertices(), [&](VertexId v) { return solid.is_boundary(v) && v != a; });
      if (!b.valid()) return extrude();
      return {"weld",
              {},
              fmt::format("weld tolerance {:.4f} where {} or {}",
                          (position(document, a) - position(document, b)).norm() * 1.01, at(position(document, a)),
                          at(position(document, b)))};
    }
    case 17:
    case 18:
      return collapse();
    case 19:
    case 20:
      return fill();
    case 21:
    case 22:
      return sharpen();
    case 23:
      return count > 80 ? remove() : mirror();
    case 24:
      if (count > 120) return remove();
      return {"duplicate", {}, fmt::format("duplicate by {} {}", vector(0.5, 2), cells(1 + pick(3)))};
    case 25:
      return {"join", {}, fmt::format("join box {} 1 1 at {}", 1 + pick(2), vector(-2, 2))};
    case 26:
      return {"transform",
              {"select vertices"},
              fmt::format("transform scale {:.3f} rotate {:.2f} axis {}", number(0.9, 1.1), number(-90, 90),
                          direction())};
    case 27:
      return {"move",
              {},
              fmt::format("move {} where {}", vector(-0.05, 0.05),
                          at(position(document, random_element(solid.vertices(), [](VertexId) { return true; }))))};
    case 28:
      return {"smooth",
              {"select vertices"},
              fmt::format("smooth times {} amount {:.2f}", 1 + pick(3), number(0.1, 0.6))};
    default:
      return {"project",
              {"select vertices"},
              fmt::format("project ball {:.3f} at {} amount {:.2f}", size, vector(-0.5, 0.5), number(0.05, 0.5))};
  }
}

}  // namespace argil::sculpt
