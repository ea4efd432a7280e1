#include "sculpt/measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "fem/measure/energy.h"
#include "fem/measure/quality.h"
#include "sculpt/document_loads.h"
#include "sculpt/force_tools/probe.h"
#include "sculpt/near_names.h"
#include "sculpt/obstacles.h"
#include "sculpt/region.h"
#include "subdiv/boundary.h"
#include "subdiv/error.h"
#include "subdiv/radial_edge.h"

namespace argil::sculpt {

namespace {

Eigen::Matrix3Xd present_nodes(const Document& document) {
  return subdiv::apply(document.discretization().nodes.rows, document.positions());
}

/// What the obstacles apply, and how deep the body is in them.
fem::Wrench total_contact(const Document& document) {
  const fem::BodyState& motion = *document.state().motion;
  const auto contact = contact_at(document, motion.time);
  return contact ? fem::contact_wrench(*contact, motion) : fem::Wrench{};
}

double largest_contact_depth(const Document& document) {
  const fem::BodyState& motion = *document.state().motion;
  const auto contact = contact_at(document, motion.time);
  if (!contact) return 0;
  fem::ContactStep step(*contact, motion, motion.time);
  step.set_state(motion.positions);
  double largest = 0;
  for (const fem::Touch& touch : step.touches()) largest = std::max(largest, touch.depth);
  return largest;
}

double largest_plastic_strain(const Document& document) {
  double largest = 0;
  if (document.state().flow)
    for (const auto& block : fem::plastic_strain(*document.state().flow))
      for (const double strain : block) largest = std::max(largest, strain);
  return largest;
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

enum class Kind { max, min, mean };

double over_nodes(const Document& document, const MeasureQuery& query, const Eigen::VectorXd& values, Kind kind) {
  const auto nodes = matching(document, ElementType::nodes, query.where);
  if (nodes.empty()) throw Error(ErrorCode::bad_input, "no node fits the condition");
  double largest = -1e300, smallest = 1e300, sum = 0;
  for (const std::uint32_t node : nodes) {
    largest = std::max(largest, values[node]);
    smallest = std::min(smallest, values[node]);
    sum += values[node];
  }
  switch (kind) {
    case Kind::max:
      return largest;
    case Kind::min:
      return smallest;
    case Kind::mean:
      break;
  }
  return sum / static_cast<double>(nodes.size());
}

fem::Wrench total_reaction(const Document& document, const Expression* where) {
  const Eigen::Matrix3Xd all = fem::reactions(document.system(), standing_loads(document), document.positions());
  fem::Wrench sum = fem::wrench(all, document.positions(), matching(document, ElementType::vertices, where));
  if (where) return sum;  // springs hold nodes, not control vertices
  const fem::Wrench soft = fem::wrench(document.loads().springs, document.positions());
  sum.force += soft.force;
  sum.moment += soft.moment;
  return sum;
}

// A derived field has measures of its own name with these endings; the older names of three of them stay.
struct FieldMeasure {
  const DerivedField* field = nullptr;
  Kind kind = Kind::max;
};
constexpr std::array<std::pair<Kind, const char*>, 3> k_kinds{
    {{Kind::max, "max"}, {Kind::min, "min"}, {Kind::mean, "mean"}}};

bool has_measures(const DerivedField& field) {
  return !std::string_view(field.name).starts_with("displacement") && std::string_view(field.name) != "speed";
}

FieldMeasure field_measure(const std::string& name) {
  for (const DerivedField& field : derived_fields())
    for (const auto& [kind, ending] : k_kinds)
      if (has_measures(field) && name == fmt::format("{}_{}", field.name, ending)) return {&field, kind};
  return {};
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
        {"load_energy", "J", "potential of gravity and applied forces, 0 at rest"},
        {"spring_energy", "J", "energy of soft pins"},
        {"min_volume_ratio", "", "smallest present over rest volume (det F) at a quadrature point"},
        {"displacement", "m", "of a material point", true},
        {"felt_stiffness", "N/m", "of the body under the tool's brush at a material point, as the probe reads it",
         true},
        {"contact_force", "N", "what the obstacles apply"},
        {"contact_energy", "J", "stored in contact with obstacles, at depth and in the springs of friction"},
        {"friction_loss", "J", "what friction at obstacles has taken since the body was made"},
        {"flow_loss", "J", "what plastic flow has taken since the body was made"},
        {"contact_depth", "m", "largest depth of a point of the boundary in an obstacle"},
        {"max_plastic_strain", "", "largest equivalent strain to which a quadrature point has flowed"},
        {"reaction", "N", "what the pins apply", false, true},
        {"tool_force", "N",
         "size of the force of the last stroke or curve at its end, of a probe what a device feels at the depth "
         "where it "
         "is; 0 after any other change"},
    };
    for (const DerivedField& field : derived_fields())
      for (const auto& [kind, ending] : k_kinds)
        if (has_measures(field))
          all.push_back({fmt::format("{}_{}", field.name, ending),
                         std::string_view(field.unit) == "%" ? "" : field.unit,
                         fmt::format("{} {}{}",
                                     kind == Kind::max   ? "largest"
                                     : kind == Kind::min ? "smallest"
                                                         : "mean",
                                     field.help, kind == Kind::mean ? " of the nodes" : ""),
                         false, true, field.wants_reference});
    for (const char* axis : {"x", "y", "z"}) {
      all.push_back(
          {fmt::format("displacement_{}", axis), "m", fmt::format("along {}, of a material point", axis), true});
      all.push_back(
          {fmt::format("position_{}", axis), "m", fmt::format("present {} of a material point", axis), true});
      all.push_back(
          {fmt::format("reaction_{}", axis), "N", fmt::format("along {}, what the pins apply", axis), false, true});
      all.push_back({fmt::format("reaction_moment_{}", axis), "N m",
                     fmt::format("about {} through the origin, what the pins apply", axis), false, true});
      all.push_back(
          {fmt::format("contact_force_{}", axis), "N", fmt::format("along {}, what the obstacles apply", axis)});
      all.push_back({fmt::format("momentum_{}", axis), "kg m/s", fmt::format("along {}", axis)});
      all.push_back(
          {fmt::format("angular_momentum_{}", axis), "kg m^2/s", fmt::format("about {} through the origin", axis)});
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
  if (!found->against_reference && query.reference)
    throw Error(ErrorCode::bad_input, fmt::format("{} needs no reference; leave it out", name));
  const fem::BodyState& motion = *document.state().motion;
  const auto elastic = [&] { return document.model().energy(present_nodes(document)); };
  const auto kinetic = [&] { return fem::energy(document.system(), motion).kinetic; };

  if (name == "tool_force") return query.tool_force;
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
        Kind::max);
  if (name == "max_speed")
    return over_nodes(document, query, document.surface_nodes(motion.velocities).colwise().norm(), Kind::max);
  if (name == "pin_motion") {
    double largest = 0;
    for (const std::uint32_t v : document.state().pins->control_points)
      largest = std::max(largest, (document.positions().col(v) - document.rest().col(v)).norm());
    return largest;
  }
  if (const FieldMeasure asked = field_measure(name); asked.field)
    return over_nodes(document, query, shown_field(document, asked.field->name, query.reference).values,
                      asked.kind);
  if (name == "load_energy") return fem::load_potential(document.loads(), document.rest(), document.positions());
  if (name == "spring_energy") return fem::spring_energy(document.loads().springs, document.positions());
  if (name == "contact_energy") {
    const auto contact = contact_at(document, motion.time);
    return contact ? fem::stored_energy(*contact, motion) : 0;
  }
  if (name == "friction_loss") return document.state().lost.friction;
  if (name == "flow_loss") return document.state().lost.flow;
  if (name == "contact_depth") return largest_contact_depth(document);
  if (name.starts_with("contact_force")) return axis_of(name, total_contact(document).force);
  if (name == "max_plastic_strain") return largest_plastic_strain(document);
  if (name == "min_volume_ratio")
    return fem::min_volume_ratio(document.discretization().blocks, present_nodes(document));
  if (name.starts_with("reaction_moment")) return axis_of(name, total_reaction(document, query.where).moment);
  if (name.starts_with("reaction")) return axis_of(name, total_reaction(document, query.where).force);
  if (name.starts_with("angular_momentum")) return axis_of(name, fem::momentum(document.system(), motion).angular);
  if (name.starts_with("momentum")) return axis_of(name, fem::momentum(document.system(), motion).linear);
  const fem::MaterialPoint point = material_point(document, *query.at);
  const Eigen::Vector3d now = fem::position(point.stencil, document.positions());
  if (name == "felt_stiffness") return Probe(document).read(document.state().tool, now).stiffness;
  if (name.starts_with("position")) return axis_of(name, now);
  return axis_of(name, now - fem::position(point.stencil, document.rest()));
}

}  // namespace argil::sculpt
