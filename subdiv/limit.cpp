#include "subdiv/limit.h"

#include <Eigen/LU>
#include <map>
#include <optional>

#include "subdiv/local_star.h"
#include "subdiv/point_rules.h"

namespace argil::subdiv {

namespace {

// Two words of progress.
constexpr std::size_t k_vertices_between = 512, k_semi_sharp_between = 256;

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
  explicit WeightTable(const Scheme& scheme) : scheme_(scheme) {}

  const std::vector<double>& interior(const Star& star) {
    std::vector<std::size_t> key{star.edges.size(), star.faces.size(), star.cells.size()};
    for (std::size_t j = 0; j < star.faces.size(); ++j)
      for (const auto& pair : {star.edges_of_face[j], star.cells_of_face[j]})
        key.insert(key.end(), {pair[0], pair[1]});
    return get(std::move(key), [&] { return scheme_.interior_refinement(star); });
  }
  const std::vector<double>& skin(const Star& star, std::optional<std::size_t> sharp_edge) {
    std::vector<std::size_t> key{star.edges.size(), star.faces.size(), 0, sharp_edge.value_or(star.edges.size())};
    for (const auto& pair : star.edges_of_face) key.insert(key.end(), {pair[0], pair[1]});
    return get(std::move(key), [&] { return scheme_.skin_refinement(star, sharp_edge); });
  }

 private:
  template <class Make>
  const std::vector<double>& get(std::vector<std::size_t> key, const Make& make) {
    const auto [at, added] = table_.try_emplace(std::move(key));
    if (added) at->second = left_eigenvector(make());
    return at->second;
  }
  const Scheme& scheme_;
  std::map<std::vector<std::size_t>, std::vector<double>> table_;
};

Weights weights_of(const Solid& solid, const PointRules& rules, VertexId v, WeightTable& table) {
  const Incidence& incidence = rules.incidence();
  switch (rules.rule(v)) {
    case VertexRule::interior:
      if (is_regular(solid, v)) return {64.0 / 216, 16.0 / 216, 4.0 / 216, 1.0 / 216, nullptr};
      return {0, 0, 0, 0, &table.interior(make_star(solid, incidence, v))};
    case VertexRule::corner:
      return {1, 0, 0, 0, nullptr};
    case VertexRule::crease:
      return {4.0 / 6, 1.0 / 6, 0, 0, nullptr};
    case VertexRule::smooth:
      break;
  }
  double k = 0;
  EdgeId sharp;
  solid.for_each_edge(v, [&](EdgeId e) {
    if (!incidence.on_skin(e)) return;
    k += 1;
    if (rules.is_crease(e)) sharp = e;
  });
  if (!sharp.valid())
    if (const auto known = rules.scheme().skin_limit(k)) return {(*known)[0], (*known)[1], (*known)[2], 0, nullptr};
  const Star star = make_star(solid, incidence, v);
  std::optional<std::size_t> sharp_edge;
  for (std::size_t i = 0; i < star.edges.size(); ++i)
    if (star.edges[i] == sharp) sharp_edge = i;
  return {0, 0, 0, 0, &table.skin(star, sharp_edge)};
}

// All edges alike (of a crease its two sharp ones), all faces and all cells.
void add_alike(const Solid& solid, const PointRules& rules, VertexId v, const Weights& weights, RowBuilder& row) {
  const Incidence& incidence = rules.incidence();
  const bool skin = incidence.on_skin(v);
  const bool crease = rules.rule(v) == VertexRule::crease;
  rules.add_vertex_point(v, weights.vertex, row);
  if (weights.edge != 0)
    solid.for_each_edge(v, [&](EdgeId e) {
      if (skin && !incidence.on_skin(e)) return;
      if (!crease || rules.is_crease(e)) rules.add_edge_point(e, weights.edge, row);
      if (weights.face == 0) return;
      solid.for_each_face(e, [&](FaceId f) {  // every face has two edges at v
        if (!skin || incidence.on_skin(f)) rules.add_face_point(f, weights.face / 2, row);
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

// The limit of a vertex where something is semi-sharp, in the columns of its star.
struct SemiSharpLimit {
  Stencils row;
  std::vector<VertexId> vertex_from_column;
};

SemiSharpLimit semi_sharp_limit(const Solid& solid, VertexId v, RuleSet rule_set) {
  LocalStar star = cut_out_star(solid, v);
  while (Skin(star.solid).is_semi_sharp_at(star.centre)) star = refined(star, rule_set);
  const PointRules rules(star.solid, rule_set);
  WeightTable table(rules.scheme());
  const Weights weights = weights_of(star.solid, rules, star.centre, table);
  const Stencils limit = assemble_rows(1, star.solid.vertex_capacity(), [&](std::size_t, RowBuilder& row) {
    add_limit(star.solid, rules, star.centre, weights, row);
  });
  return {compose(limit, star.rows), std::move(star.vertex_from_column)};
}

}  // namespace

Stencils limit_stencils(const Solid& solid, RuleSet rule_set, const Progress& progress) {
  const PointRules rules(solid, rule_set);
  WeightTable table(rules.scheme());
  std::vector<Weights> weights(solid.vertex_capacity());
  std::vector<VertexId> semi_sharp;
  constexpr std::size_t k_not_semi_sharp = static_cast<std::size_t>(-1);
  std::vector<std::size_t> place(solid.vertex_capacity(), k_not_semi_sharp);  // in semi_sharp
  const auto count = static_cast<double>(solid.vertex_capacity());
  for (const VertexId v : solid.vertices()) {
    if (v.index() % k_vertices_between == 0) progress.at(0.5 * static_cast<double>(v.index()) / count);
    if (rules.is_semi_sharp_at(v)) {
      place[v.index()] = semi_sharp.size();
      semi_sharp.push_back(v);
    } else {
      weights[v.index()] = weights_of(solid, rules, v, table);
    }
  }
  std::vector<SemiSharpLimit> limits(semi_sharp.size());
  for (std::size_t begin = 0; begin < limits.size(); begin += k_semi_sharp_between) {
    progress.at(0.5 + 0.2 * static_cast<double>(begin) / static_cast<double>(limits.size()));
    parallel_for(std::min(k_semi_sharp_between, limits.size() - begin), 1, [&](std::size_t i) {
      limits[begin + i] = semi_sharp_limit(solid, semi_sharp[begin + i], rule_set);
    });
  }
  return assemble_rows(
      solid.vertex_capacity(), solid.vertex_capacity(),
      [&](std::size_t i, RowBuilder& row) {
        if (!solid.is_live(VertexId{i})) return;
        if (place[i] == k_not_semi_sharp) {
          add_limit(solid, rules, VertexId{i}, weights[i], row);
          return;
        }
        const SemiSharpLimit& limit = limits[place[i]];
        const StencilRow from = limit.row.row(0);
        for (std::size_t j = 0; j < from.columns.size(); ++j)
          row.add(limit.vertex_from_column[from.columns[j]], from.weights[j]);
      },
      progress.part(0.7, 1));
}

}  // namespace argil::subdiv
