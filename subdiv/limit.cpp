#include "subdiv/limit.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cassert>
#include <map>

#include "subdiv/point_rules.h"

namespace argil::subdiv {

namespace {

// After one refinement the points about a vertex v are v's own, then one for each edge, face and cell at v, and
// every face at v is a quadrilateral: these points alone decide the limit, with weights that depend only on how the
// edges, faces and cells lie about v. So a row of the limit is these weights times the rules of the points, and no
// coarse vertex needs quadrilaterals or hexahedra about it.
struct Star {
  std::vector<EdgeId> edges;
  std::vector<FaceId> faces;
  std::vector<CellId> cells;
  std::vector<std::array<std::size_t, 2>> edges_of_face;  // places in `edges`
  std::vector<std::array<std::size_t, 2>> cells_of_face;  // places in `cells`; interior stars only

  std::size_t point_count() const { return 1 + edges.size() + faces.size() + cells.size(); }
};

template <class T>
std::size_t place(const std::vector<T>& list, const T& value) {
  return static_cast<std::size_t>(std::find(list.begin(), list.end(), value) - list.begin());
}

// The whole star of an interior vertex, or what a boundary vertex sees of the boundary.
Star make_star(const Solid& solid, const Incidence& incidence, VertexId v) {
  const bool boundary = incidence.is_boundary(v);
  Star star;
  solid.for_each_edge(v, [&](EdgeId e) {
    if (!boundary || incidence.is_boundary(e)) star.edges.push_back(e);
  });
  for (std::size_t i = 0; i < star.edges.size(); ++i)
    solid.for_each_face(star.edges[i], [&](FaceId f) {
      if (boundary && !solid.is_boundary(f)) return;
      const std::size_t at = place(star.faces, f);
      if (at == star.faces.size()) {
        star.faces.push_back(f);
        star.edges_of_face.push_back({i, i});
      } else {
        star.edges_of_face[at][1] = i;
      }
    });
  if (boundary) return star;
  const auto cells = incidence.cells(v);
  star.cells.assign(cells.begin(), cells.end());
  for (const FaceId f : star.faces)
    star.cells_of_face.push_back(
        {place(star.cells, solid.owner(face_use(f, false))), place(star.cells, solid.owner(face_use(f, true)))});
  return star;
}

// Rows of the refinement matrix that takes the points of a star to those of the next level.
class LocalRefinement {
 public:
  explicit LocalRefinement(const Star& star) : star_(star) {
    const auto n = static_cast<Eigen::Index>(star.point_count());
    face_centroids_ = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(star.faces.size()), n);
    for (std::size_t j = 0; j < star.faces.size(); ++j) {
      auto row = face_centroids_.row(index(j));
      row(0) = row(face(j)) = row(edge(star.edges_of_face[j][0])) = row(edge(star.edges_of_face[j][1])) = 0.25;
    }
    matrix_ = Eigen::MatrixXd::Zero(n, n);
  }

  Eigen::MatrixXd interior() {
    const std::size_t edge_count = star_.edges.size(), face_count = star_.faces.size(),
                      cell_count = star_.cells.size();
    Eigen::MatrixXd cell_centroids = Eigen::MatrixXd::Zero(index(cell_count), matrix_.cols());
    for (std::size_t j = 0; j < face_count; ++j)
      for (const std::size_t k : star_.cells_of_face[j])
        for (const Eigen::Index point : {face(j), edge(star_.edges_of_face[j][0]), edge(star_.edges_of_face[j][1])})
          cell_centroids(index(k), point) = 1;
    for (std::size_t k = 0; k < cell_count; ++k) {
      auto row = cell_centroids.row(index(k));
      row(0) = row(cell(k)) = 1;
      row /= row.sum();
    }
    for (std::size_t k = 0; k < cell_count; ++k) matrix_.row(cell(k)) = cell_centroids.row(index(k));
    for (std::size_t j = 0; j < face_count; ++j) {
      matrix_.row(face(j)) = 0.5 * face_centroids_.row(index(j));
      for (const std::size_t k : star_.cells_of_face[j])
        matrix_.row(face(j)) += 0.25 * cell_centroids.row(index(k));
    }
    for (std::size_t i = 0; i < edge_count; ++i) {
      double n = 0;
      Eigen::RowVectorXd faces = Eigen::RowVectorXd::Zero(matrix_.cols()), cells = faces;
      for (std::size_t j = 0; j < face_count; ++j) {
        if (star_.edges_of_face[j][0] != i && star_.edges_of_face[j][1] != i) continue;
        n += 1;
        faces += face_centroids_.row(index(j));
        for (const std::size_t k : star_.cells_of_face[j]) cells += 0.5 * cell_centroids.row(index(k));
      }
      auto row = matrix_.row(edge(i));
      row = (cells + 2 * faces) / (n * n);
      row(0) += (n - 3) / n / 2;
      row(edge(i)) += (n - 3) / n / 2;
    }
    auto row = matrix_.row(0);
    row = cell_centroids.colwise().mean() / 8 + 3 * face_centroids_.colwise().mean() / 8;
    row(0) += 1.0 / 8 + 3.0 / 16;
    for (std::size_t i = 0; i < edge_count; ++i) row(edge(i)) += 3.0 / 16 / static_cast<double>(edge_count);
    return matrix_;
  }

  // Of a smooth boundary vertex with one sharp edge: Catmull–Clark's, but for that edge's point.
  Eigen::MatrixXd dart(std::size_t sharp_edge) {
    const auto k = static_cast<double>(star_.edges.size());
    for (std::size_t j = 0; j < star_.faces.size(); ++j) {
      matrix_.row(face(j)) = face_centroids_.row(index(j));
      for (const std::size_t i : star_.edges_of_face[j])
        if (i != sharp_edge) matrix_.row(edge(i)) += face_centroids_.row(index(j)) / 4;
    }
    matrix_.row(0) = face_centroids_.colwise().sum() / (k * k);
    matrix_(0, 0) += (k - 3) / k + 1 / k;
    for (std::size_t i = 0; i < star_.edges.size(); ++i) {
      const double half = i == sharp_edge ? 0.5 : 0.25;
      matrix_(edge(i), 0) += half;
      matrix_(edge(i), edge(i)) += half;
      matrix_(0, edge(i)) += 1 / (k * k);
    }
    return matrix_;
  }

 private:
  static Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }
  Eigen::Index edge(std::size_t i) const { return index(1 + i); }
  Eigen::Index face(std::size_t j) const { return index(1 + star_.edges.size() + j); }
  Eigen::Index cell(std::size_t k) const { return index(1 + star_.edges.size() + star_.faces.size() + k); }

  const Star& star_;
  Eigen::MatrixXd face_centroids_, matrix_;
};

// The left eigenvector for eigenvalue 1, of sum one. The columns of Sᵀ − 1 sum to zero, so one row may give way to
// the condition on the sum.
std::vector<double> left_eigenvector(const Eigen::MatrixXd& refinement) {
  const Eigen::Index n = refinement.rows();
  Eigen::MatrixXd system = refinement.transpose() - Eigen::MatrixXd::Identity(n, n);
  system.row(0).setOnes();
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  right(0) = 1;
  const Eigen::VectorXd solution = system.partialPivLu().solve(right);
  return {solution.begin(), solution.end()};
}

bool is_regular(const Solid& solid, VertexId v) {
  bool four = true;
  solid.for_each_edge(v, [&](EdgeId e) { four = four && solid.edge_valence(e) == 4; });
  return four && solid.vertex_valence(v) == 6;
}

// The weights of the star of a vertex: for edges, faces and cells that all count alike four numbers, otherwise one
// for each point of the star.
struct Weights {
  double vertex = 0, edge = 0, face = 0, cell = 0;
  const std::vector<double>* each = nullptr;
};

class WeightTable {
 public:
  const std::vector<double>& interior(const Star& star) {
    std::vector<std::size_t> key{star.edges.size(), star.faces.size(), star.cells.size()};
    for (std::size_t j = 0; j < star.faces.size(); ++j)
      for (const auto& pair : {star.edges_of_face[j], star.cells_of_face[j]})
        key.insert(key.end(), {pair[0], pair[1]});
    return get(std::move(key), [&] { return LocalRefinement(star).interior(); });
  }
  const std::vector<double>& dart(const Star& star, std::size_t sharp_edge) {
    std::vector<std::size_t> key{star.edges.size(), star.faces.size(), 0, sharp_edge};
    for (const auto& pair : star.edges_of_face) key.insert(key.end(), {pair[0], pair[1]});
    return get(std::move(key), [&] { return LocalRefinement(star).dart(sharp_edge); });
  }

 private:
  template <class Make>
  const std::vector<double>& get(std::vector<std::size_t> key, const Make& make) {
    const auto [at, added] = table_.try_emplace(std::move(key));
    if (added) at->second = left_eigenvector(make());
    return at->second;
  }
  std::map<std::vector<std::size_t>, std::vector<double>> table_;
};

Weights weights_of(const Solid& solid, const PointRules& rules, VertexId v, WeightTable& table) {
  const Incidence& incidence = rules.incidence();
  if (!incidence.is_boundary(v)) {
    if (is_regular(solid, v)) return {64.0 / 216, 16.0 / 216, 4.0 / 216, 1.0 / 216, nullptr};
    return {0, 0, 0, 0, &table.interior(make_star(solid, incidence, v))};
  }
  if (rules.rule(v) == BoundaryVertexRule::corner) return {1, 0, 0, 0, nullptr};
  if (rules.rule(v) == BoundaryVertexRule::crease) return {4.0 / 6, 1.0 / 6, 0, 0, nullptr};
  double k = 0;
  EdgeId sharp;
  solid.for_each_edge(v, [&](EdgeId e) {
    if (!incidence.is_boundary(e)) return;
    k += 1;
    if (is_sharp(solid, e)) sharp = e;
  });
  if (!sharp.valid()) return {k / (k + 5), 4 / (k * (k + 5)), 1 / (k * (k + 5)), 0, nullptr};
  const Star star = make_star(solid, incidence, v);
  return {0, 0, 0, 0, &table.dart(star, place(star.edges, sharp))};
}

// All edges alike (of a crease its two sharp ones), all faces and all cells.
void add_alike(const Solid& solid, const PointRules& rules, VertexId v, const Weights& weights, RowBuilder& row) {
  const Incidence& incidence = rules.incidence();
  const bool boundary = incidence.is_boundary(v);
  const bool crease = boundary && rules.rule(v) == BoundaryVertexRule::crease;
  rules.add_vertex_point(v, weights.vertex, row);
  if (weights.edge != 0)
    solid.for_each_edge(v, [&](EdgeId e) {
      if (boundary && !incidence.is_boundary(e)) return;
      if (!crease || is_sharp(solid, e)) rules.add_edge_point(e, weights.edge, row);
      if (weights.face == 0) return;
      solid.for_each_face(e, [&](FaceId f) {  // every face has two edges at v
        if (!boundary || solid.is_boundary(f)) rules.add_face_point(f, weights.face / 2, row);
      });
    });
  if (weights.cell == 0) return;
  for (const CellId c : incidence.cells(v)) rules.add_cell_point(c, weights.cell, row);
}

void add_limit(const Solid& solid, const PointRules& rules, VertexId v, const Weights& weights, RowBuilder& row) {
  if (!weights.each) {
    add_alike(solid, rules, v, weights, row);
    return;
  }
  const Star star = make_star(solid, rules.incidence(), v);
  const double* weight = weights.each->data();
  rules.add_vertex_point(v, *weight++, row);
  for (const EdgeId e : star.edges) rules.add_edge_point(e, *weight++, row);
  for (const FaceId f : star.faces) rules.add_face_point(f, *weight++, row);
  for (const CellId c : star.cells) rules.add_cell_point(c, *weight++, row);
}

}  // namespace

Stencils limit_stencils(const Solid& solid) {
  const PointRules rules(solid);
  WeightTable table;
  std::vector<Weights> weights(solid.vertex_capacity());
  for (const VertexId v : solid.vertices()) weights[v.index()] = weights_of(solid, rules, v, table);
  return assemble_rows(solid.vertex_capacity(), solid.vertex_capacity(), [&](std::size_t i, RowBuilder& row) {
    if (solid.is_live(VertexId{i})) add_limit(solid, rules, VertexId{i}, weights[i], row);
  });
}

}  // namespace argil::subdiv
