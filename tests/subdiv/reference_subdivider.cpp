#include "tests/subdiv/reference_subdivider.h"

#include <algorithm>

namespace argil::subdiv::test {

namespace {

PointSet set_of(const std::vector<int>& loop) {
  return {loop.begin(), loop.end()};
}

PointSet set_of(const std::vector<std::vector<int>>& cell) {
  PointSet all;
  for (const auto& loop : cell) all.insert(loop.begin(), loop.end());
  return all;
}

std::set<PointSet> edges_of(const std::vector<int>& loop) {
  std::set<PointSet> edges;
  for (std::size_t i = 0; i < loop.size(); ++i) edges.insert({loop[i], loop[(i + 1) % loop.size()]});
  return edges;
}

bool holds(const PointSet& outer, const PointSet& inner) {
  return std::includes(outer.begin(), outer.end(), inner.begin(), inner.end());
}

Eigen::Vector3d centroid(const Points& points, const PointSet& of) {
  Eigen::Vector3d sum(0, 0, 0);
  for (const int v : of) sum += points[static_cast<std::size_t>(v)];
  return sum / static_cast<double>(of.size());
}

Eigen::Vector3d mean(const Points& points) {
  Eigen::Vector3d sum(0, 0, 0);
  for (const auto& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

// Faces at a vertex, joined where they share an edge of the given set: how many groups.
int group_count(const std::vector<std::vector<int>>& faces, const std::set<PointSet>& joining) {
  std::vector<std::set<PointSet>> groups;
  for (const auto& face : faces) {
    std::set<PointSet> merged;
    for (const PointSet& e : edges_of(face))
      if (joining.count(e)) merged.insert(e);
    std::vector<std::set<PointSet>> kept;
    for (const auto& group : groups) {
      const bool touches =
          std::any_of(merged.begin(), merged.end(), [&](const PointSet& e) { return group.count(e) > 0; });
      if (touches)
        merged.insert(group.begin(), group.end());
      else
        kept.push_back(group);
    }
    kept.push_back(merged);
    groups = kept;
  }
  return static_cast<int>(groups.size());
}

}  // namespace

std::map<PointSet, Eigen::Vector3d> catmull_clark(const Points& points, const std::vector<std::vector<int>>& faces,
                                                  const std::set<PointSet>& sharp_edges,
                                                  const std::set<int>& corners) {
  std::map<PointSet, Eigen::Vector3d> result;
  std::map<PointSet, std::vector<PointSet>> faces_of_edge;
  std::map<int, std::vector<std::vector<int>>> faces_of_vertex;
  for (const auto& face : faces) {
    result[set_of(face)] = centroid(points, set_of(face));
    for (const PointSet& e : edges_of(face)) faces_of_edge[e].push_back(set_of(face));
    for (const int v : face) faces_of_vertex[v].push_back(face);
  }
  const auto is_sharp = [&](const PointSet& e) { return sharp_edges.count(e) > 0 || faces_of_edge[e].size() != 2; };
  for (const auto& [e, its_faces] : faces_of_edge) {
    result[e] = centroid(points, e);
    if (!is_sharp(e)) result[e] = 0.5 * result[e] + 0.25 * (result[its_faces[0]] + result[its_faces[1]]);
  }
  for (const auto& [v, its_faces] : faces_of_vertex) {
    const Eigen::Vector3d& old = points[static_cast<std::size_t>(v)];
    Points midpoints, centroids, across_sharp;
    std::set<PointSet> edges;
    int branching = 0, rims = 0;
    for (const auto& [e, around] : faces_of_edge) {
      if (!e.count(v)) continue;
      edges.insert(e);
      midpoints.push_back(centroid(points, e));
      if (is_sharp(e)) across_sharp.push_back(2 * centroid(points, e) - old);
      branching += around.size() > 2 ? 1 : 0;
      rims += around.size() == 1 ? 1 : 0;
    }
    for (const auto& face : its_faces) centroids.push_back(centroid(points, set_of(face)));
    const bool open_branch = branching + rims != 0 && ((branching != 2 && rims != 2) || across_sharp.size() != 2);
    if (corners.count(v) || across_sharp.size() > 2 || open_branch || group_count(its_faces, edges) > 1) {
      result[{v}] = old;
    } else if (across_sharp.size() == 2) {
      result[{v}] = 0.75 * old + 0.25 * mean(across_sharp);
    } else {
      const auto k = static_cast<double>(midpoints.size());
      result[{v}] = (mean(centroids) + 2 * mean(midpoints) + (k - 3) * old) / k;
    }
  }
  return result;
}

namespace {

struct Face {
  std::vector<int> loop;
  std::vector<std::size_t> cells;
};

// The new points if all that is sharper than `least` were so for ever, and nothing else were.
std::map<PointSet, Eigen::Vector3d> points_at(const ReferenceSolid& coarse, const std::map<PointSet, Face>& faces,
                                              const std::set<PointSet>& edges,
                                              const std::vector<PointSet>& cell_sets, double least) {
  std::vector<std::vector<int>> skin;
  std::set<PointSet> sharp_edges;
  std::set<int> corners;
  const auto is_sharp = [&](const PointSet& name) {
    const auto found = coarse.sharpness.find(name);
    return found != coarse.sharpness.end() && found->second > least;
  };
  for (const auto& [name, face] : faces)
    if (face.cells.size() == 1 || is_sharp(name)) skin.push_back(face.loop);
  for (const auto& [name, sharpness] : coarse.sharpness) {
    if (name.size() == 2 && is_sharp(name)) sharp_edges.insert(name);
    if (name.size() == 1 && is_sharp(name)) corners.insert(*name.begin());
  }
  std::map<PointSet, Eigen::Vector3d> points = catmull_clark(coarse.points, skin, sharp_edges, corners);

  for (const PointSet& cell : cell_sets) points[cell] = centroid(coarse.points, cell);
  for (const auto& [name, face] : faces)
    if (!points.count(name))
      points[name] = 0.25 * (points[cell_sets[face.cells[0]]] + points[cell_sets[face.cells[1]]]) +
                     0.5 * centroid(coarse.points, name);
  const auto means_about = [&](const PointSet& element) {
    Points c, a, m;
    for (const PointSet& cell : cell_sets)
      if (holds(cell, element)) c.push_back(centroid(coarse.points, cell));
    for (const auto& [name, face] : faces)
      if (holds(name, element)) a.push_back(centroid(coarse.points, name));
    for (const PointSet& e : edges)
      if (holds(e, element)) m.push_back(centroid(coarse.points, e));
    return std::tuple(mean(c), mean(a), mean(m), static_cast<double>(a.size()));
  };
  for (const PointSet& e : edges) {
    if (points.count(e)) continue;
    const auto [c, a, m, n] = means_about(e);
    points[e] = (c + 2 * a + (n - 3) * m) / n;
  }
  for (int v = 0; v < static_cast<int>(coarse.points.size()); ++v) {
    if (points.count({v})) continue;
    const auto [c, a, m, n] = means_about({v});
    points[{v}] = (c + 3 * a + 3 * m + coarse.points[static_cast<std::size_t>(v)]) / 8;
  }

  return points;
}

// No sharper than the sharpest face of the skin about it.
ReferenceSolid clamped(const ReferenceSolid& solid, const std::map<PointSet, Face>& faces) {
  ReferenceSolid result = solid;
  for (auto& [name, sharpness] : result.sharpness) {
    if (name.size() > 2) continue;
    double most = 0;
    for (const auto& [face_name, face] : faces) {
      if (!holds(face_name, name)) continue;
      const auto found = solid.sharpness.find(face_name);
      const double inside = found == solid.sharpness.end() ? 0 : found->second;
      most = std::max(most, face.cells.size() == 1 ? 10 : inside);
    }
    sharpness = std::min(sharpness, most);
  }
  return result;
}

}  // namespace

ReferenceStep refine(const ReferenceSolid& unclamped) {
  std::map<PointSet, Face> faces;
  std::set<PointSet> edges;
  std::vector<PointSet> cell_sets;
  for (std::size_t c = 0; c < unclamped.cells.size(); ++c) {
    cell_sets.push_back(set_of(unclamped.cells[c]));
    for (const auto& loop : unclamped.cells[c]) {
      Face& face = faces[set_of(loop)];
      face.loop = loop;
      face.cells.push_back(c);
      for (const PointSet& e : edges_of(loop)) edges.insert(e);
    }
  }
  const ReferenceSolid coarse = clamped(unclamped, faces);
  std::map<PointSet, Eigen::Vector3d> points = points_at(coarse, faces, edges, cell_sets, 0);
  const auto child_points = points_at(coarse, faces, edges, cell_sets, 1);
  for (auto& [name, point] : points) {
    std::vector<double> ending;
    for (const auto& [other, sharpness] : coarse.sharpness)
      if (sharpness > 0 && sharpness <= 1 && holds(other, name)) ending.push_back(sharpness);
    if (ending.empty()) continue;
    double weight = 0;
    for (const double sharpness : ending) weight += sharpness / static_cast<double>(ending.size());
    point = weight * point + (1 - weight) * child_points.at(name);
  }

  ReferenceStep step;
  for (const auto& [name, point] : points) {
    step.fine_from_coarse[name] = static_cast<int>(step.fine.points.size());
    step.fine.points.push_back(point);
  }
  const auto fine = [&](const PointSet& name) { return step.fine_from_coarse.at(name); };
  for (const auto& [name, sharpness] : coarse.sharpness) {
    const double left = sharpness >= 10 ? 10 : sharpness - 1;
    if (left <= 0) continue;
    if (name.size() == 1) step.fine.sharpness[{fine(name)}] = left;
    if (name.size() == 2)
      for (const int v : name) step.fine.sharpness[{fine({v}), fine(name)}] = left;
    if (name.size() < 3) continue;
    const auto& loop = faces.at(name).loop;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int v = loop[i], next = loop[(i + 1) % loop.size()], before = loop[(i + loop.size() - 1) % loop.size()];
      step.fine.sharpness[{fine({v}), fine({v, next}), fine(name), fine({v, before})}] = left;
    }
  }

  for (std::size_t c = 0; c < coarse.cells.size(); ++c)
    for (const int v : cell_sets[c]) {
      std::vector<std::vector<int>> cell;
      for (const auto& loop : coarse.cells[c]) {
        const auto n = loop.size();
        for (std::size_t i = 0; i < n; ++i) {
          if (loop[i] != v) continue;
          const int next = loop[(i + 1) % n], before = loop[(i + n - 1) % n];
          cell.push_back({fine({v}), fine({v, next}), fine(set_of(loop)), fine({v, before})});
          // About the edge to `next`: seen from that edge's far end, this loop lies on the left of the edge and the
          // cell's other loop at the edge, where the edge runs back, on the right.
          for (const auto& other : coarse.cells[c])
            for (std::size_t j = 0; j < other.size(); ++j)
              if (other[j] == next && other[(j + 1) % other.size()] == v)
                cell.push_back({fine({v, next}), fine(set_of(other)), fine(cell_sets[c]), fine(set_of(loop))});
        }
      }
      step.fine.cells.push_back(cell);
    }
  return step;
}

}  // namespace argil::subdiv::test
