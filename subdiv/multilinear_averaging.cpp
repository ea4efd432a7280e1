#include "subdiv/multilinear_averaging.h"

#include <vector>

namespace argil::subdiv {

namespace {

using Row = Eigen::RowVectorXd;

// The centroids of what one more split makes in a star, in the points of the star.
class StarMatrix {
 public:
  explicit StarMatrix(const Star& star) : star_(star), n_(static_cast<Eigen::Index>(star.point_count())) {}

  Eigen::MatrixXd interior() const {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n_, n_);
    std::vector<double> cells_at_edge(star_.edges.size(), 0);
    for (std::size_t k = 0; k < star_.cells.size(); ++k) {
      const FineCells fine = split(k);
      matrix.row(0) += fine.at_vertex / static_cast<double>(star_.cells.size());
      Row sum = fine.at_vertex + fine.at_cell;
      for (const auto& [i, at_edge] : fine.at_edges) {
        matrix.row(index(star_.edge_point(i))) += (fine.at_vertex + at_edge) / 2;
        cells_at_edge[i] += 1;
        sum += at_edge;
      }
      for (const auto& [j, at_face] : fine.at_faces) {
        Row about = fine.at_vertex + at_face;
        for (const auto& [i, at_edge] : fine.at_edges)
          if (star_.edges_of_face[j][0] == i || star_.edges_of_face[j][1] == i) about += at_edge;
        matrix.row(index(star_.face_point(j))) += about / 8;  // four corners in each of two cells
        sum += at_face;
      }
      matrix.row(index(star_.cell_point(k))) =
          sum / static_cast<double>(2 + fine.at_edges.size() + fine.at_faces.size());
    }
    for (std::size_t i = 0; i < star_.edges.size(); ++i) matrix.row(index(star_.edge_point(i))) /= cells_at_edge[i];
    return matrix;
  }

  Eigen::MatrixXd skin(std::optional<std::size_t> sharp_edge) const {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n_, n_);
    for (std::size_t j = 0; j < star_.faces.size(); ++j) {
      const Row face = point(star_.face_point(j)), centre = face_centroid(j);
      matrix.row(index(star_.face_point(j))) = centre;
      const auto& ends = star_.edges_of_face[j];
      const Row at_vertex =
          (point(0) + centre + middle(0, star_.edge_point(ends[0])) + middle(0, star_.edge_point(ends[1]))) / 4;
      matrix.row(0) += at_vertex / static_cast<double>(star_.faces.size());
      for (const std::size_t i : ends) {
        const std::size_t e = star_.edge_point(i);
        const Row at_edge = (point(e) + centre + middle(0, e) + middle(e, star_.face_point(j))) / 4;
        if (i != sharp_edge) matrix.row(index(e)) += (at_vertex + at_edge) / 4;
      }
    }
    if (sharp_edge) matrix.row(index(star_.edge_point(*sharp_edge))) = middle(0, star_.edge_point(*sharp_edge));
    return matrix;
  }

 private:
  // Centroids of the fine cells of a cell, at each of its corners.
  struct FineCells {
    Row at_vertex, at_cell;
    std::vector<std::pair<std::size_t, Row>> at_edges, at_faces;  // by places in the star
  };

  static Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }
  Row point(std::size_t i) const { return Row::Unit(n_, index(i)); }
  Row middle(std::size_t a, std::size_t b) const { return (point(a) + point(b)) / 2; }
  Row face_centroid(std::size_t j) const {
    const auto& ends = star_.edges_of_face[j];
    return (point(0) + point(star_.edge_point(ends[0])) + point(star_.edge_point(ends[1])) +
            point(star_.face_point(j))) /
           4;
  }

  // The cell has the star's vertex, its points of edges and faces, and its own, opposite: faces through the vertex,
  // and one about each edge, of the edge's point, its two faces' and the cell's.
  FineCells split(std::size_t k) const {
    FineCells fine;
    std::vector<std::size_t> faces, edges;
    for (std::size_t j = 0; j < star_.faces.size(); ++j) {
      if (star_.cells_of_face[j][0] != k && star_.cells_of_face[j][1] != k) continue;
      faces.push_back(j);
      for (const std::size_t i : star_.edges_of_face[j])
        if (std::find(edges.begin(), edges.end(), i) == edges.end()) edges.push_back(i);
    }
    const std::size_t cell_point = star_.cell_point(k);
    const double corner_size = static_cast<double>(2 * faces.size() + 2);
    Row centre = point(0) + point(cell_point);
    for (const std::size_t i : edges) centre += point(star_.edge_point(i));
    for (const std::size_t j : faces) centre += point(star_.face_point(j));
    centre /= corner_size;

    fine.at_vertex = point(0) + centre;
    fine.at_cell = point(cell_point) + centre;
    std::vector<Row> far_face(star_.faces.size(), Row::Zero(n_));  // sums over the two far faces of a face's point
    for (const std::size_t i : edges) {
      const std::size_t e = star_.edge_point(i);
      Row far = point(e) + point(cell_point), at_edge = point(e) + middle(0, e) + centre;
      for (const std::size_t j : faces) {
        if (star_.edges_of_face[j][0] != i && star_.edges_of_face[j][1] != i) continue;
        far += point(star_.face_point(j));
        at_edge += middle(e, star_.face_point(j)) + face_centroid(j);
      }
      far /= 4;
      for (const std::size_t j : faces)
        if (star_.edges_of_face[j][0] == i || star_.edges_of_face[j][1] == i) far_face[j] += far;
      fine.at_edges.push_back({i, (at_edge + far) / 8});
      fine.at_vertex += middle(0, e);
      fine.at_cell += far;
    }
    for (const std::size_t j : faces) {
      const std::size_t f = star_.face_point(j);
      const auto& ends = star_.edges_of_face[j];
      const Row at_face = point(f) + centre + face_centroid(j) + far_face[j] + middle(f, cell_point) +
                          middle(f, star_.edge_point(ends[0])) + middle(f, star_.edge_point(ends[1]));
      fine.at_faces.push_back({j, at_face / 8});
      fine.at_vertex += face_centroid(j);
      fine.at_cell += middle(f, cell_point);
    }
    fine.at_vertex /= corner_size;
    fine.at_cell /= corner_size;
    return fine;
  }

  const Star& star_;
  Eigen::Index n_;
};

class MultilinearAveraging final : public Scheme {
 public:
  MultilinearAveraging(const Solid& solid, const Incidence& incidence)
      : solid_(solid), incidence_(incidence), skin_(solid) {}

  void add_cell_point(CellId c, double weight, RowBuilder& row) const override {
    const auto vertices = incidence_.vertices(c);
    for (const VertexId v : vertices) add_fine_cell(c, v, weight / static_cast<double>(vertices.size()), row);
  }

  void add_interior_point(FaceId f, double weight, RowBuilder& row) const override {
    const auto loop = solid_.face_vertices(f);
    const double each = weight / static_cast<double>(2 * loop.size());
    for (const bool back : {false, true})
      for (const VertexId v : loop) add_fine_cell(solid_.owner(face_use(f, back)), v, each, row);
  }

  void add_interior_point(EdgeId e, double weight, RowBuilder& row) const override {
    // Every cell at the edge has two faces there, so each is met twice.
    const double each = weight / static_cast<double>(4 * solid_.edge_valence(e));
    solid_.for_each_face(e, [&](FaceId f) {
      for (const bool back : {false, true})
        for (const VertexId v : solid_.edge_vertices(e))
          add_fine_cell(solid_.owner(face_use(f, back)), v, each, row);
    });
  }

  void add_interior_point(VertexId v, double weight, RowBuilder& row) const override {
    const auto cells = incidence_.cells(v);
    for (const CellId c : cells) add_fine_cell(c, v, weight / static_cast<double>(cells.size()), row);
  }

  void add_skin_point(FaceId f, double weight, RowBuilder& row) const override {
    row.add_mean(solid_.face_vertices(f), weight);  // the mean of all its quarters' centroids
  }

  void add_skin_point(EdgeId e, Phase phase, double weight, RowBuilder& row) const override {
    solid_.for_each_face(e, [&](FaceId f) {
      if (!skin_.holds(f, phase)) return;
      for (const VertexId v : solid_.edge_vertices(e)) add_fine_face(f, v, weight / 4, row);
    });
  }

  void add_skin_point(VertexId v, Phase phase, double weight, RowBuilder& row) const override {
    const double each = weight / static_cast<double>(2 * skin_.edge_count(v, phase));
    solid_.for_each_edge(v, [&](EdgeId e) {
      solid_.for_each_face(e, [&](FaceId f) {  // met twice
        if (skin_.holds(f, phase)) add_fine_face(f, v, each, row);
      });
    });
  }

  Eigen::MatrixXd interior_refinement(const Star& star) const override { return StarMatrix(star).interior(); }
  Eigen::MatrixXd skin_refinement(const Star& star, std::optional<std::size_t> sharp_edge) const override {
    return StarMatrix(star).skin(sharp_edge);
  }

 private:
  // weight * (v + its neighbours' midpoints + centroid)/4.
  void add_fine_face(FaceId f, VertexId v, double weight, RowBuilder& row) const {
    const auto loop = solid_.face_vertices(f);
    row.add_mean(loop, weight / 4);
    row.add(v, weight / 2);
    for_each_neighbour(loop, v, [&](VertexId w) { row.add(w, weight / 8); });
  }

  void add_fine_cell(CellId c, VertexId v, double weight, RowBuilder& row) const {
    std::size_t face_count = 0;
    const auto uses = solid_.cell_face_uses(c);
    for (const FaceUseId use : uses)
      for (const VertexId w : solid_.face_vertices(face_of(use))) face_count += w == v ? 1 : 0;
    const double each = weight / static_cast<double>(2 * face_count + 2);
    row.add(v, each);
    row.add_mean(incidence_.vertices(c), each);
    for (const FaceUseId use : uses) {
      const auto loop = solid_.face_vertices(face_of(use));
      // The midpoint of an edge is met in two faces.
      const bool here = for_each_neighbour(loop, v, [&](VertexId w) {
        row.add(v, each / 4);
        row.add(w, each / 4);
      });
      if (here) row.add_mean(loop, each);
    }
  }

  template <class Visit>
  static bool for_each_neighbour(std::span<const VertexId> loop, VertexId v, const Visit& visit) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      if (loop[i] != v) continue;
      visit(loop[(i + 1) % loop.size()]);
      visit(loop[(i + loop.size() - 1) % loop.size()]);
      return true;
    }
    return false;
  }

  const Solid& solid_;
  const Incidence& incidence_;
  Skin skin_;
};

}  // namespace

std::unique_ptr<Scheme> make_multilinear_averaging(const Solid& solid, const Incidence& incidence) {
  return std::make_unique<MultilinearAveraging>(solid, incidence);
}

}  // namespace argil::subdiv
