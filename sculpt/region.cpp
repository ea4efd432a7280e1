#include "sculpt/region.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "subdiv/error.h"
#include "subdiv/radial_edge.h"
#include "subdiv/sort_unique.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

enum Slot : std::size_t { k_x, k_px = 3, k_boundary = 6, k_valence, k_fields, k_slots = k_fields + k_field_count };

bool needs_fields(const Expression* where) {
  return where && std::any_of(where->variables().begin(), where->variables().end(),
                              [](std::size_t s) { return s >= k_fields; });
}

// Answers an expression for vertices given by index into the arrays, and for the mean of several.
class Asker {
 public:
  Asker(const Expression& expression, const Eigen::Matrix3Xd& rest, const Eigen::Matrix3Xd& present,
        const Fields* fields, const std::vector<std::uint32_t>* node_from_vertex)
      : expression_(expression), rest_(rest), present_(present), fields_(fields), nodes_(node_from_vertex) {}

  double value(std::span<const VertexId> vertices, bool boundary, std::size_t valence) const {
    std::array<double, k_slots> slots{};
    const double share = 1.0 / static_cast<double>(vertices.size());
    for (const VertexId v : vertices) {
      const auto column = static_cast<Eigen::Index>(v.index());
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        slots[k_x + static_cast<std::size_t>(axis)] += rest_(axis, column) * share;
        slots[k_px + static_cast<std::size_t>(axis)] += present_(axis, column) * share;
      }
      if (fields_) {
        const auto node = static_cast<Eigen::Index>(nodes_ ? (*nodes_)[v.index()] : v.index());
        for (std::size_t f = 0; f < k_field_count; ++f) slots[k_fields + f] += fields_->values[f][node] * share;
      }
    }
    slots[k_boundary] = boundary ? 1 : 0;
    slots[k_valence] = static_cast<double>(valence);
    return expression_.evaluate(slots);
  }

  bool holds(std::span<const VertexId> vertices, bool boundary, std::size_t valence, Asked asked) const {
    if (asked == Asked::centroid || vertices.size() == 1) return value(vertices, boundary, valence) != 0;
    const auto one = [&](VertexId v) { return value({&v, 1}, boundary, valence) != 0; };
    return asked == Asked::any_vertex ? std::any_of(vertices.begin(), vertices.end(), one)
                                      : std::all_of(vertices.begin(), vertices.end(), one);
  }

 private:
  const Expression& expression_;
  const Eigen::Matrix3Xd& rest_;
  const Eigen::Matrix3Xd& present_;
  const Fields* fields_;
  const std::vector<std::uint32_t>* nodes_;
};

std::vector<std::uint32_t> matching_nodes(const Document& document, const Expression* where) {
  const Refinement& refined = document.refinement();
  const Solid& finest = refined.solid();
  std::vector<std::uint32_t> ids;
  if (!where) {
    for (const VertexId v : finest.vertices()) ids.push_back(v.value);
    return ids;
  }
  const Eigen::Matrix3Xd rest = apply(refined.stencils.back(), document.rest());
  const Eigen::Matrix3Xd present = apply(refined.stencils.back(), document.positions());
  const Asker asker(*where, rest, present, document.state().fields.get(), nullptr);
  for (const VertexId v : finest.vertices())
    if (asker.holds({&v, 1}, finest.is_boundary(v), finest.vertex_valence(v), Asked::centroid))
      ids.push_back(v.value);
  return ids;
}

}  // namespace

const VariableTable& variable_table() {
  static const VariableTable table = [] {
    VariableTable made{{"x", "y", "z", "px", "py", "pz", "boundary", "valence"}, {0, 0, 0, 0, 0, 0, 1, 0}};
    for (const FieldInfo& field : field_table()) made.names.emplace_back(field.word);
    return made;
  }();
  return table;
}

std::vector<std::uint32_t> node_from_control_vertex(const Document& document) {
  const Solid& solid = document.solid();
  std::vector<std::uint32_t> node(solid.vertex_capacity(), 0);
  std::uint32_t next = 0;
  for (const VertexId v : solid.vertices()) {
    node[v.index()] = document.state().level == 0 ? v.value : next;
    ++next;
  }
  return node;
}

std::vector<std::uint32_t> matching(const Document& document, ElementType type, const Expression* where,
                                    bool interior, Asked asked) {
  if (type == ElementType::nodes) return matching_nodes(document, where);
  const Solid& solid = document.solid();
  std::vector<std::uint32_t> nodes;
  if (needs_fields(where)) nodes = node_from_control_vertex(document);
  std::optional<Asker> asker;
  if (where)
    asker.emplace(*where, document.rest(), document.positions(),
                  needs_fields(where) ? document.state().fields.get() : nullptr, nodes.empty() ? nullptr : &nodes);
  std::vector<std::uint32_t> ids;
  const auto take = [&](std::uint32_t id, std::span<const VertexId> vertices, bool boundary, std::size_t valence) {
    if (!asker || asker->holds(vertices, boundary, valence, asked)) ids.push_back(id);
  };
  switch (type) {
    case ElementType::vertices:
      for (const VertexId v : solid.vertices())
        take(v.value, {&v, 1}, solid.is_boundary(v), solid.vertex_valence(v));
      break;
    case ElementType::edges:
      for (const EdgeId e : solid.edges())
        take(e.value, solid.edge_vertices(e), solid.is_boundary(e), solid.edge_valence(e));
      break;
    case ElementType::faces:
      for (const FaceId f : solid.faces())
        if (interior || solid.is_boundary(f))
          take(f.value, solid.face_vertices(f), solid.is_boundary(f), solid.face_vertices(f).size());
      break;
    case ElementType::cells:
      for (const CellId c : solid.cells()) {
        const auto vertices = cell_vertices(solid, c);
        const auto uses = solid.cell_face_uses(c);
        const bool boundary =
            std::any_of(uses.begin(), uses.end(), [&](FaceUseId u) { return solid.is_boundary(face_of(u)); });
        take(c.value, vertices, boundary, uses.size());
      }
      break;
    case ElementType::nodes:
      break;
  }
  return ids;
}

Eigen::VectorXd values_at_nodes(const Document& document, const Expression& formula,
                                const std::vector<std::uint32_t>& nodes) {
  const Refinement& refined = document.refinement();
  const Solid& finest = refined.solid();
  const Eigen::Matrix3Xd rest = apply(refined.stencils.back(), document.rest());
  const Eigen::Matrix3Xd present = apply(refined.stencils.back(), document.positions());
  const Asker asker(formula, rest, present, document.state().fields.get(), nullptr);
  Eigen::VectorXd values(static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const VertexId v{nodes[i]};
    const double value = asker.value({&v, 1}, finest.is_boundary(v), finest.vertex_valence(v));
    if (!std::isfinite(value)) {
      const auto at = rest.col(static_cast<Eigen::Index>(v.index()));
      throw Error(ErrorCode::bad_input,
                  fmt::format("the formula is not finite at ({:g}, {:g}, {:g}); keep it away from "
                              "divisions by zero there",
                              at[0], at[1], at[2]));
    }
    values[static_cast<Eigen::Index>(i)] = value;
  }
  return values;
}

std::vector<std::uint32_t> vertices_of(const Document& document, const Selection& selection) {
  const Solid& solid = document.solid();
  std::vector<std::uint32_t> ids;
  for (const std::uint32_t id : selection.ids) {
    switch (selection.type) {
      case ElementType::vertices:
        ids.push_back(id);
        break;
      case ElementType::edges:
        for (const VertexId v : solid.edge_vertices(EdgeId{id})) ids.push_back(v.value);
        break;
      case ElementType::faces:
        for (const VertexId v : solid.face_vertices(FaceId{id})) ids.push_back(v.value);
        break;
      case ElementType::cells:
        for (const VertexId v : cell_vertices(solid, CellId{id})) ids.push_back(v.value);
        break;
      case ElementType::nodes:
        break;
    }
  }
  subdiv::sort_unique(ids);
  return ids;
}

std::string count_of(std::size_t count, ElementType type) {
  static const char* const singular[] = {"vertex", "edge", "face", "cell", "node"};
  return fmt::format("{} {}", count, count == 1 ? singular[static_cast<std::size_t>(type)] : word(type));
}

}  // namespace argil::sculpt
