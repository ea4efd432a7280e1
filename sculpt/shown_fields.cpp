#include "sculpt/shown_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "sculpt/near_names.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

constexpr std::array k_derived{
    DerivedField{"strain", "strain", "%", false, false, "equivalent strain"},
    DerivedField{"strain_1", "largest principal strain", "%", true, false, "first principal strain"},
    DerivedField{"strain_2", "middle principal strain", "%", true, false, "second principal strain"},
    DerivedField{"strain_3", "smallest principal strain", "%", true, false, "third principal strain"},
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
