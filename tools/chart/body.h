#pragma once
// A body as a run of the chart sees it: a solid taken through refinement and discretization to a system that
// integrators can step, with the spaces and force models that stand on the chart in two lists of rows.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fem/discretization.h"
#include "fem/loads.h"
#include "fem/models/model_table.h"
#include "fem/system.h"
#include "subdiv/build.h"
#include "subdiv/refinement.h"

namespace argil::chart {

struct Material {
  double young_modulus = 1000;  // [Pa]
  double poisson_ratio = 0.3;
  double density = 1000;  // [kg/m³]
};

/// A discretization and the rest positions of its control points, 3 x columns of A.
struct Discretized {
  fem::Discretization discretization;
  Eigen::Matrix3Xd rest;
};

/// How a solid becomes elements.
struct SpaceRow {
  std::string name, summary;
  int level = 0;  // refinements of the control grid
  std::function<Discretized(const subdiv::Refinement&, const Eigen::Matrix3Xd& control_points,
                            const fem::NodalFields&)>
      discretize;
  bool has_hexahedra = true;         // else their formulations are all one
  bool of_published_method = false;  // as in fem::ModelKind
};
/// default (one refinement), cubic (none), nodes (the control grid as plain elements), the mixed space as
/// published, and quadratic tetrahedra.
[[nodiscard]] std::vector<SpaceRow> spaces();

struct ModelRow {
  fem::ModelChoice choice;
  std::string summary;
  std::function<std::unique_ptr<fem::ForceModel>(std::span<const fem::ElementBlock>, const Eigen::Matrix3Xd&)> make;
  bool of_published_method = false;  // as in fem::ModelKind

  /// "corotational", or "corotational b_bar".
  [[nodiscard]] std::string name() const;
};
/// Every row of fem::model_table() with every formulation that it has.
[[nodiscard]] std::vector<ModelRow> models();

struct Body {
  subdiv::Refinement refinement;
  Eigen::Matrix3Xd rest;  // control points
  fem::Discretization discretization;
  std::unique_ptr<fem::ForceModel> model;
  fem::System system;  // points into this body
  fem::BodyState state;

  Body() = default;
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;

  [[nodiscard]] std::size_t element_count() const;
  /// Control points that may move, times three.
  [[nodiscard]] std::size_t unknowns() const;
};

/// The body at rest; `held` (by rest position) are the control points that do not move by themselves.
/// @throws what discretize() and the model's make() throw.
[[nodiscard]] std::unique_ptr<Body> make_body(const subdiv::Built& solid, const SpaceRow& space,
                                              const ModelRow& model, const Material& material,
                                              const std::function<bool(const Eigen::Vector3d&)>& held);

/// Boundary faces of the finest level all of whose vertices lie, at rest, where `where` says.
[[nodiscard]] fem::SurfacePatch patch_where(const Body& body,
                                            const std::function<bool(const Eigen::Vector3d&)>& where);
/// Of the material point that is at `rest_point` [m].
[[nodiscard]] Eigen::Vector3d displacement(const Body& body, const Eigen::Vector3d& rest_point);

/// Hexahedra (i, j, k) of a grid of nx × ny × nz that `keep` wants, edges of more than 30 degrees infinitely sharp.
[[nodiscard]] subdiv::Built sharp_grid(const std::array<int, 3>& cells, const Eigen::Vector3d& size,
                                       const std::function<bool(int, int, int)>& keep = {});

}  // namespace argil::chart
