#include "sculpt/measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fem/measure/energy.h"
#include "sculpt/document_loads.h"
#include "sculpt/near_names.h"
#include "sculpt/region.h"
#include "subdiv/boundary.h"
#include "subdiv/error.h"
#include "subdiv/radial_edge.h"

namespace argil::sculpt {

namespace {

Eigen::Matrix3Xd present_nodes(const Document& document) {
  return subdiv::apply(document.discretization().nodes.rows, document.positions());
}

Eigen::VectorXd strain(const Document& document) {
  return document.shown_elements().equivalent_strain(document.surface_nodes(document.positions()));
}
Eigen::VectorXd stress(const Document& document) {
  return document.shown_elements().von_mises_stress(document.surface_nodes(document.positions()));
}

double axis_of(const std::string& name, const Eigen::Vector3d& v) {
  switch (name.back()) {
    case 'x':
      return v.x();
    case 'y':
      return v.y();
    case 'z':
      return v.z();
    default:
      return v.norm();
  }
}

double over_nodes(const Document& document, const MeasureQuery& query, const Eigen::VectorXd& values, bool mean) {
  const auto nodes = matching(document, ElementType::nodes, query.where);
  if (nodes.empty()) throw Error(ErrorCode::bad_input, "no node fits the condition");
  double largest = -1e300, sum = 0;
  for (const std::uint32_t node : nodes) {
    largest = std::max(largest, values[node]);
    sum += values[node];
  }
  return mean ? sum / static_cast<double>(nodes.size()) : largest;
}

Eigen::Vector3d total_reaction(const Document& document, const Expression* where) {
  const Eigen::Matrix3Xd all = fem::reactions(document.system(), document.loads(), document.positions());
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::uint32_t v : matching(document, ElementType::vertices, where)) sum += all.col(v);
  if (where) return sum;  // springs hold nodes, not control vertices
  for (const SoftPin& pin : document.state().pins->nodes)
    sum += pin.stiffness * (pin.target - document.surface_nodes(document.positions()).col(pin.node));
  return sum;
}

}  // namespace

const std::vector<MeasureInfo>& measure_table() {
  static const std::vector<MeasureInfo> table = [] {
    std::vector<MeasureInfo> all{
        {"volume", "m^3", "present volume"},
        {"mass", "kg", "mass of the rest shape"},
        {"energy", "J", "elastic and kinetic energy"},
        {"elastic_energy", "J", "energy of deformation"},
        {"kinetic_energy", "J", "energy of motion"},
        {"time", "s", "simulated time"},
        {"cells", "", "cells at the finest level"},
        {"control_cells", "", "cells of the control solid"},
        {"elements", "", "elements integrated"},
        {"pyramids", "", "pyramidal elements among them"},
        {"components", "", "parts of the control solid that share no face"},
        {"genus", "", "handles of the boundary of the control solid"},
        {"unknowns", "", "free coordinates of control points"},
        {"max_displacement", "m", "largest distance of a node from rest", false, true},
        {"max_speed", "m/s", "largest speed of a node", false, true},
        {"pin_motion", "m", "largest distance of a pinned control point from rest"},
        {"strain_max", "", "largest equivalent strain", false, true},
        {"strain_mean", "", "mean equivalent strain of the nodes", false, true},
        {"stress_max", "Pa", "largest von Mises stress", false, true},
        {"stress_mean", "Pa", "mean von Mises stress of the nodes", false, true},
        {"displacement", "m", "of a material point", true},
        {"reaction", "N", "what the pins apply", false, true},
    };
    for (const char* axis : {"x", "y", "z"}) {
      all.push_back(
          {fmt::format("displacement_{}", axis), "m", fmt::format("along {}, of a material point", axis), true});
      all.push_back(
          {fmt::format("position_{}", axis), "m", fmt::format("present {} of a material point", axis), true});
      all.push_back(
          {fmt::format("reaction_{}", axis), "N", fmt::format("along {}, what the pins apply", axis), false, true});
      all.push_back({fmt::format("momentum_{}", axis), "kg m/s", fmt::format("along {}", axis)});
    }
    std::sort(all.begin(), all.end(), [](const MeasureInfo& a, const MeasureInfo& b) { return a.name < b.name; });
    return all;
  }();
  return table;
}

double measure(const Document& document, const MeasureQuery& query) {
  const auto& table = measure_table();
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const MeasureInfo& m) { return m.name == query.name; });
  if (found == table.end()) {
    std::vector<std::string> names;
    for (const MeasureInfo& info : table) names.push_back(info.name);
    throw Error(ErrorCode::not_found, fmt::format("'{}' cannot be measured{}; what can: {}", query.name,
                                                  near_names_hint(query.name, names), fmt::join(names, ", ")));
  }
  const std::string& name = query.name;
  if (found->at_point && !query.at)
    throw Error(ErrorCode::bad_input, fmt::format("{} wants a material point: `at X Y Z`", name));
  if (!found->at_point && query.at)
    throw Error(ErrorCode::bad_input, fmt::format("{} is not measured at a point; leave out `at`", name));
  if (!found->over_nodes && query.where)
    throw Error(ErrorCode::bad_input, fmt::format("{} is of the whole solid; leave out `where`", name));
  const fem::BodyState& motion = *document.state().motion;
  const auto elastic = [&] { return document.model().energy(present_nodes(document)); };
  const auto kinetic = [&] { return fem::energy(document.system(), motion).kinetic; };

  if (name == "volume") return fem::volume(document.discretization(), present_nodes(document));
  if (name == "mass") return document.discretization().total_mass;
  if (name == "energy") return elastic() + kinetic();
  if (name == "elastic_energy") return elastic();
  if (name == "kinetic_energy") return kinetic();
  if (name == "time") return motion.time;
  if (name == "cells") return static_cast<double>(document.refinement().solid().cell_count());
  if (name == "control_cells") return static_cast<double>(document.solid().cell_count());
  if (name == "elements") {
    const auto& e = document.discretization().elements;
    return static_cast<double>(e.cubic + e.linear + e.pyramid);
  }
  if (name == "pyramids") return static_cast<double>(document.discretization().elements.pyramid);
  if (name == "components") return subdiv::components(document.solid()).count;
  if (name == "genus") return subdiv::boundary_surface(document.solid()).genus;
  if (name == "unknowns")
    return 3.0 *
           static_cast<double>(document.solid().vertex_count() - document.state().pins->control_points.size());
  if (name == "max_displacement")
    return over_nodes(
        document, query,
        (document.surface_nodes(document.positions()) - document.surface_nodes(document.rest())).colwise().norm(),
        false);
  if (name == "max_speed")
    return over_nodes(document, query, document.surface_nodes(motion.velocities).colwise().norm(), false);
  if (name == "pin_motion") {
    double largest = 0;
    for (const std::uint32_t v : document.state().pins->control_points)
      largest = std::max(largest, (document.positions().col(v) - document.rest().col(v)).norm());
    return largest;
  }
  if (name.starts_with("strain")) return over_nodes(document, query, strain(document), name == "strain_mean");
  if (name.starts_with("stress")) return over_nodes(document, query, stress(document), name == "stress_mean");
  if (name.starts_with("reaction")) return axis_of(name, total_reaction(document, query.where));
  if (name.starts_with("momentum")) return axis_of(name, fem::momentum(document.system(), motion).linear);
  const fem::MaterialPoint point = material_point(document, *query.at);
  const Eigen::Vector3d now = fem::position(point.stencil, document.positions());
  if (name.starts_with("position")) return axis_of(name, now);
  return axis_of(name, now - fem::position(point.stencil, document.rest()));
}

std::vector<std::string> shown_field_names() {
  std::vector<std::string> names{"strain", "stress", "displacement", "speed"};
  for (const FieldInfo& info : field_table()) names.emplace_back(info.word);
  return names;
}

ShownField shown_field(const Document& document, const std::string& name) {
  if (name == "strain") return {strain(document), "strain", "%"};
  if (name == "stress") return {stress(document), "von Mises stress", "Pa"};
  if (name == "displacement")
    return {
        (document.surface_nodes(document.positions()) - document.surface_nodes(document.rest())).colwise().norm(),
        "displacement", "m"};
  if (name == "speed")
    return {document.surface_nodes(document.state().motion->velocities).colwise().norm(), "speed", "m/s"};
  for (const FieldInfo& info : field_table())
    if (name == info.word) {
      std::string title = name;
      std::replace(title.begin(), title.end(), '_', ' ');
      return {(*document.state().fields)[info.name], title, info.unit};
    }
  const auto names = shown_field_names();
  throw Error(ErrorCode::not_found, fmt::format("'{}' is not a field to show{}; there are {}", name,
                                                near_names_hint(name, names), fmt::join(names, ", ")));
}

}  // namespace argil::sculpt
