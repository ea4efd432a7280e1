#include "sculpt/shown_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "sculpt/near_names.h"
#include "subdiv/error.h"
#include "subdiv/radial_edge.h"

namespace argil::sculpt {

namespace {

constexpr std::array k_derived{
    DerivedField{"strain", "strain", "%", false, false, "equivalent strain"},
    DerivedField{"strain_1", "largest principal strain", "%", true, false, "first principal strain"},
    DerivedField{"strain_2", "middle principal strain", "%", true, false, "second principal strain"},
    DerivedField{"strain_3", "smallest principal strain", "%", true, false, "third principal strain"},
    DerivedField{"plastic_strain", "plastic strain", "%", false, false, "equivalent strain to which it has flowed"},
    DerivedField{"stress", "von Mises stress", "Pa", false, false, "von Mises stress"},
    DerivedField{"stress_1", "largest principal stress", "Pa", true, false, "first principal stress"},
    DerivedField{"stress_2", "middle principal stress", "Pa", true, false, "second principal stress"},
    DerivedField{"stress_3", "smallest principal stress", "Pa", true, false, "third principal stress"},
    DerivedField{"pressure", "pressure", "Pa", true, false, "pressure, minus the mean principal stress"},
    DerivedField{"distortion", "change of volume", "%", true, false, "change of volume, as a share"},
    DerivedField{"displacement", "displacement", "m", false, false, "distance from rest"},
    DerivedField{"displacement_x", "displacement along x", "m", true, false, "displacement along x"},
    DerivedField{"displacement_y", "displacement along y", "m", true, false, "displacement along y"},
    DerivedField{"displacement_z", "displacement along z", "m", true, false, "displacement along z"},
    DerivedField{"speed", "speed", "m/s", false, false, "speed"},
    DerivedField{"error", "distance to the reference", "m", false, true, "distance to the reference"},
};

Eigen::VectorXd lengths(const Eigen::Matrix3Xd& vectors) {
  Eigen::VectorXd result(vectors.cols());
  for (Eigen::Index i = 0; i < result.size(); ++i) result[i] = vectors.col(i).norm();
  return result;
}

// Of the vertices that are there: where cells have been removed, ids without a place stay behind.
Eigen::VectorXd errors(const Document& document, const ReferenceShape& reference, const Eigen::Matrix3Xd& rest,
                       const Eigen::Matrix3Xd& now) {
  const subdiv::Solid& solid = document.refinement().solid();
  std::vector<Eigen::Index> live;
  for (const subdiv::VertexId v : solid.vertices()) live.push_back(static_cast<Eigen::Index>(v.index()));
  const Eigen::VectorXd distances = reference.distances(rest(Eigen::all, live), now(Eigen::all, live));
  Eigen::VectorXd result = Eigen::VectorXd::Zero(now.cols());
  for (std::size_t i = 0; i < live.size(); ++i) result[live[i]] = distances[static_cast<Eigen::Index>(i)];
  return result;
}

/// Where the space integrates other elements than those shown a vertex takes the mean of the elements about it, by
/// volume: those of its cells, or of the cells that these came from or were refined to.
Eigen::VectorXd plastic_strain_by_cells(const Document& document) {
  const fem::Discretization& d = document.discretization();
  const std::vector<std::vector<double>> strains = fem::plastic_strain(*document.state().flow);
  std::size_t deepest = static_cast<std::size_t>(document.refinement().finest());
  const std::size_t finest = deepest;
  for (const fem::ElementBlock& block : d.blocks)
    for (const fem::ElementOrigin& origin : block.origins) deepest = std::max<std::size_t>(deepest, origin.level);
  std::optional<subdiv::Refinement> finer;
  if (deepest > finest)
    finer = subdiv::refine_to_level(document.solid(), static_cast<int>(deepest), document.state().rules);
  const subdiv::Refinement& refinement = finer ? *finer : document.refinement();
  // Sums by cell of every level: from fine to coarse as far as the finest level, then from coarse to fine.
  struct Sum {
    double strain = 0, volume = 0;
  };
  std::vector<std::vector<Sum>> sums;
  for (std::size_t level = 0; level <= deepest; ++level)
    sums.emplace_back(refinement.levels[level].cell_capacity());
  for (std::size_t b = 0; b < d.blocks.size(); ++b) {
    const fem::ElementBlock& block = d.blocks[b];
    for (std::size_t e = 0; e < block.element_count(); ++e) {
      Sum& sum = sums[block.origins[e].level][block.origins[e].cell];
      for (int q = 0; q < block.kind->point_count; ++q) {
        const std::size_t i = block.point_index(e, q);
        sum.strain += block.volumes[i] * strains[b][i];
        sum.volume += block.volumes[i];
      }
    }
  }
  const auto add = [](Sum& to, const Sum& more) {
    to.strain += more.strain;
    to.volume += more.volume;
  };
  for (std::size_t level = deepest; level > finest; --level)
    for (const subdiv::CellId c : refinement.levels[level].cells())
      add(sums[level - 1][refinement.parent[level][c].index()], sums[level][c.index()]);
  for (std::size_t level = 1; level <= finest; ++level)
    for (const subdiv::CellId c : refinement.levels[level].cells())
      add(sums[level][c.index()], sums[level - 1][refinement.parent[level][c].index()]);
  const subdiv::Solid& solid = document.refinement().solid();
  std::vector<Sum> at_vertices(solid.vertex_capacity());
  for (const subdiv::CellId c : solid.cells())
    for (const subdiv::VertexId v : subdiv::cell_vertices(solid, c))
      add(at_vertices[v.index()], sums[finest][c.index()]);
  Eigen::VectorXd result(static_cast<Eigen::Index>(at_vertices.size()));
  for (std::size_t v = 0; v < at_vertices.size(); ++v)
    result[static_cast<Eigen::Index>(v)] =
        at_vertices[v].volume > 0 ? at_vertices[v].strain / at_vertices[v].volume : 0;
  return result;
}

Eigen::VectorXd plastic_strain(const Document& document) {
  if (document.stress_is_known()) return document.shown_elements().plastic_strain();
  return plastic_strain_by_cells(document);
}

Eigen::VectorXd values_of(const Document& document, std::string_view name, const ReferenceShape* reference) {
  const Eigen::Matrix3Xd now = document.surface_nodes(document.positions());
  const auto& shown = document.shown_elements();
  const fem::StressLaw law = fem::stress_law(document.state().model.name);
  const int order = name.back() - '1';
  if ((name.starts_with("stress") || name == "pressure") && !document.stress_is_known())
    throw Error(
        ErrorCode::unsupported,
        fmt::format("the {} of a body that has flowed is known in the default space only; show its strain, or "
                    "`commit` the shape, which leaves it without stress",
                    name));
  if (name == "plastic_strain") return plastic_strain(document);
  if (name == "strain") return shown.equivalent_strain(now);
  if (name.starts_with("strain_")) return shown.principal_strain(now, order);
  if (name == "stress") return shown.von_mises_stress(now, law);
  if (name.starts_with("stress_")) return shown.principal_stress(now, order, law);
  if (name == "pressure") return shown.pressure(now, law);
  if (name == "distortion") return shown.distortion(now);
  if (name == "speed") return lengths(document.surface_nodes(document.state().motion->velocities));
  const Eigen::Matrix3Xd rest = document.surface_nodes(document.rest());
  if (name == "error") return errors(document, *reference, rest, now);
  if (name == "displacement") return lengths(now - rest);
  return (now - rest).row(name.back() - 'x').transpose();
}

}  // namespace

std::span<const DerivedField> derived_fields() {
  return k_derived;
}

std::vector<std::string> shown_field_names() {
  std::vector<std::string> names;
  for (const DerivedField& field : k_derived) names.emplace_back(field.name);
  for (const FieldInfo& info : field_table()) names.emplace_back(info.word);
  return names;
}

ShownField shown_field(const Document& document, const std::string& name, const ReferenceShape* reference) {
  for (const DerivedField& field : k_derived) {
    if (name != field.name) continue;
    if (field.wants_reference && !reference)
      throw Error(ErrorCode::bad_input,
                  fmt::format("{} is against another solution; add `reference FILE`, such as a .vtu that `save` "
                              "wrote, beneath the session's own folder",
                              name));
    return {values_of(document, name, reference), field.title, field.unit,
            field.has_sign ? ColourMap::balanced : ColourMap::viridis};
  }
  for (const FieldInfo& info : field_table())
    if (name == info.word) {
      std::string title = name;
      std::replace(title.begin(), title.end(), '_', ' ');
      return {(*document.state().fields)[info.name], title, info.unit,
              info.name == FieldName::prestress ? ColourMap::balanced : ColourMap::cividis};
    }
  const auto names = shown_field_names();
  throw Error(ErrorCode::not_found, fmt::format("'{}' is not a field to show{}; there are {}", name,
                                                near_names_hint(name, names), fmt::join(names, ", ")));
}

}  // namespace argil::sculpt
