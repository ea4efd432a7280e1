#pragma once
// The force models by name, in one table that sessions, charts, tests and help read.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "fem/models/force_model.h"
#include "fem/models/formulation.h"
#include "fem/models/mass_spring.h"

namespace argil::fem {

struct ModelChoice {
  std::string name = "corotational";
  Formulation formulation = Formulation::plain;
  bool operator==(const ModelChoice&) const = default;
};

struct ModelKind {
  std::string_view name;
  std::string_view summary;  // what it is and where it fails, without a full stop
  std::unique_ptr<ForceModel> (*make)(std::span<const ElementBlock>, const Eigen::Matrix3Xd& rest_nodes,
                                      Formulation);
  bool has_b_bar = false, has_incompatible_modes = false;
  bool takes_prestress = true;
  std::optional<DiagonalSprings> springs{};  // of a model that is made of springs: which diagonals its cubes have
  bool can_flow = false;                     // plastic_flow.h
  bool of_published_method = false;          // with the integrator of that mark it makes up papers/004's method
};

/// The default first.
[[nodiscard]] std::span<const ModelKind> model_table();
/// @throws Error (not_found) that lists the names.
[[nodiscard]] const ModelKind& model_by_name(std::string_view name);
/// @throws Error (not_found) for the name, (unsupported) where the model lacks the formulation.
void check_model(const ModelChoice& choice);

/// The blocks must outlive the model; as in force_model.h. Prestress that a block has now is added to the model,
/// the share of it that acts as in prestress.h.
/// @throws what check_model() throws, and (unsupported) naming an element kind that the model has no forces for, or
/// prestress that it cannot take.
[[nodiscard]] std::unique_ptr<ForceModel> make_model(const ModelChoice& choice,
                                                     std::span<const ElementBlock> blocks,
                                                     const Eigen::Matrix3Xd& rest_nodes,
                                                     std::shared_ptr<const double> prestress_share = nullptr);

}  // namespace argil::fem
