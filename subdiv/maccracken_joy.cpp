#include "subdiv/maccracken_joy.h"

namespace argil::subdiv {

namespace {

// Rows of the refinement matrix of a star.
class StarMatrix {
 public:
  explicit StarMatrix(const Star& star) : star_(star) {
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

  Eigen::MatrixXd skin(std::optional<std::size_t> sharp_edge) {
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
  Eigen::Index edge(std::size_t i) const { return index(star_.edge_point(i)); }
  Eigen::Index face(std::size_t j) const { return index(star_.face_point(j)); }
  Eigen::Index cell(std::size_t k) const { return index(star_.cell_point(k)); }

  const Star& star_;
  Eigen::MatrixXd face_centroids_, matrix_;
};

class MacCrackenJoy final : public Scheme {
 public:
  MacCrackenJoy(const Solid& solid, const Incidence& incidence)
      : solid_(solid), incidence_(incidence), skin_(solid) {}

  void add_cell_point(CellId c, double weight, RowBuilder& row) const override {
    row.add_mean(incidence_.vertices(c), weight);
  }

  void add_interior_point(FaceId f, double weight, RowBuilder& row) const override {
    row.add_mean(solid_.face_vertices(f), weight / 2);
    row.add_mean(incidence_.vertices(solid_.owner(face_use(f, false))), weight / 4);
    row.add_mean(incidence_.vertices(solid_.owner(face_use(f, true))), weight / 4);
  }

  void add_interior_point(EdgeId e, double weight, RowBuilder& row) const override {
    const auto n = static_cast<double>(solid_.edge_valence(e));
    if (n != 3) row.add_mean(solid_.edge_vertices(e), weight * (n - 3) / n);
    solid_.for_each_face(e, [&](FaceId f) {
      row.add_mean(solid_.face_vertices(f), 2 * weight / (n * n));
      // About an interior edge every cell has two faces, so each is met twice.
      row.add_mean(incidence_.vertices(solid_.owner(face_use(f, false))), weight / (2 * n * n));
      row.add_mean(incidence_.vertices(solid_.owner(face_use(f, true))), weight / (2 * n * n));
    });
  }

  void add_interior_point(VertexId v, double weight, RowBuilder& row) const override {
    // Every face at v has two edges there, so the loop over edges meets it twice.
    const auto edge_count = static_cast<double>(solid_.vertex_valence(v));
    std::size_t face_twice = 0;
    solid_.for_each_edge(v, [&](EdgeId e) { face_twice += solid_.edge_valence(e); });
    row.add(v, weight / 8);
    solid_.for_each_edge(v, [&](EdgeId e) {
      row.add_mean(solid_.edge_vertices(e), weight * 3 / (8 * edge_count));
      solid_.for_each_face(e, [&](FaceId f) {
        row.add_mean(solid_.face_vertices(f), weight * 3 / (8 * static_cast<double>(face_twice)));
      });
    });
    const auto cells = incidence_.cells(v);
    for (const CellId c : cells)
      row.add_mean(incidence_.vertices(c), weight / (8 * static_cast<double>(cells.size())));
  }

  void add_skin_point(FaceId f, double weight, RowBuilder& row) const override {
    row.add_mean(solid_.face_vertices(f), weight);
  }

  void add_skin_point(EdgeId e, Phase phase, double weight, RowBuilder& row) const override {
    row.add_mean(solid_.edge_vertices(e), weight / 2);
    solid_.for_each_face(e, [&](FaceId f) {
      if (skin_.holds(f, phase)) row.add_mean(solid_.face_vertices(f), weight / 4);
    });
  }

  void add_skin_point(VertexId v, Phase phase, double weight, RowBuilder& row) const override {
    const auto k = static_cast<double>(skin_.edge_count(v, phase));
    if (k != 3) row.add(v, weight * (k - 3) / k);
    solid_.for_each_edge(v, [&](EdgeId e) {
      bool on_skin = false;
      solid_.for_each_face(e, [&](FaceId f) {  // met twice, as above
        if (!skin_.holds(f, phase)) return;
        if (!on_skin) row.add_mean(solid_.edge_vertices(e), weight * 2 / (k * k));
        on_skin = true;
        row.add_mean(solid_.face_vertices(f), weight / (2 * k * k));
      });
    });
  }

  Eigen::MatrixXd interior_refinement(const Star& star) const override { return StarMatrix(star).interior(); }
  Eigen::MatrixXd skin_refinement(const Star& star, std::optional<std::size_t> sharp_edge) const override {
    return StarMatrix(star).skin(sharp_edge);
  }
  std::optional<std::array<double, 3>> skin_limit(double k) const override {
    return std::array{k / (k + 5), 4 / (k * (k + 5)), 1 / (k * (k + 5))};
  }

 private:
  const Solid& solid_;
  const Incidence& incidence_;
  Skin skin_;
};

}  // namespace

std::unique_ptr<Scheme> make_maccracken_joy(const Solid& solid, const Incidence& incidence) {
  return std::make_unique<MacCrackenJoy>(solid, incidence);
}

}  // namespace argil::subdiv
