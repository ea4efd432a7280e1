#pragma once
// What a solver or integrator sees of a body: unknowns are control points p (3 x N), nodes x = A p, forces come
// back as Aᵀ f. Pins are taken out by dimension reduction; soft pins and tools are springs between a stencil of
// control points and a target.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "fem/models/force_model.h"
#include "subdiv/stencils.h"

namespace argil::fem {

/// Energy stiffness/2 · |Σ weight · p − target|²: a tool's spring, or a pin by penalty. Implicit in every
/// integrator.
struct AnchorSpring {
  std::vector<std::uint32_t> control_points;  // ascending
  std::vector<double> weights;
  Eigen::Vector3d target = Eigen::Vector3d::Zero();  // [m]
  double stiffness = 0;                              // [N/m]
};

/// Fixed control points that are led: where they stand at `time`, and how fast they are there. A step that ends
/// earlier takes them a part of the straight way.
struct LedPoints {
  std::vector<std::uint32_t> control_points;  // ascending
  Eigen::Matrix3Xd positions, velocities;     // 3 x as many [m], [m/s]
  double time = 0;                            // [s]
};

struct Contact;  // fem/contact/contact.h

/// What a point of the surface (its number in ContactSurface) and an obstacle keep of each other from step to step,
/// in the obstacle's own frame [m].
struct ContactGrip {
  std::uint32_t obstacle = 0, point = 0;             // the obstacle by its id
  Eigen::Vector3d anchor = Eigen::Vector3d::Zero();  // where friction holds the point
  /// Of a point that came in too fast to be met on its way: where, and the outward normal there, along which it is
  /// sent back. No normal: the nearest side of the obstacle counts.
  Eigen::Vector3d entry = Eigen::Vector3d::Zero(), entry_normal = Eigen::Vector3d::Zero();

  /// Of a point over which the obstacle was put: so deep it may be at the state's time [m], less by `allowed_rate`
  /// [m/s] from then on; it counts as that much less deep.
  double allowed = 0, allowed_rate = 0;

  [[nodiscard]] bool came_in_fast() const { return entry_normal != Eigen::Vector3d::Zero(); }
};

struct Loads {
  Eigen::Matrix3Xd forces;  // generalised, on control points [N]; empty means none
  std::vector<AnchorSpring> springs = {};
  std::shared_ptr<const Contact> contact = nullptr;  // obstacles and the surface that meets them; null: none
  LedPoints led = {};                                // statics leaves them where they are
};

struct System {
  const subdiv::Stencils* rows = nullptr;             // A: nodes in control points
  const subdiv::Stencils* rows_transposed = nullptr;  // Aᵀ
  const ForceModel* model = nullptr;
  const Eigen::Matrix3Xd* rest_nodes = nullptr;  // 3 x nodes: where the preconditioner takes its tangent
  const Eigen::SparseMatrix<double>* mass = nullptr;
  const Eigen::SparseMatrix<double>* damping = nullptr;
  std::vector<std::uint8_t> fixed;  // per control point: 1 = moves exactly 0, or as it is led
  /// What the model is made of, for damping in proportion to stiffness and for counting inverted cells; empty:
  /// none.
  std::span<const ElementBlock> blocks = {};
  /// The model whose tangent at rest preconditioners are made of, where it is not `model`: that of the body before
  /// it flowed, so that they do not depend on when they were made. Null: `model`.
  const ForceModel* rest_model = nullptr;
};

/// History of the integrator. `previous_step` 0 means that there is none (the next step of a method of two steps is
/// one of a method of one).
struct BodyState {
  Eigen::Matrix3Xd positions, velocities;                    // control points, 3 x N
  Eigen::Matrix3Xd previous_positions, previous_velocities;  // one step back; empty without history
  double previous_step = 0;                                  // [s]
  Eigen::Matrix3Xd accelerations;                            // of generalised-α; empty without
  double time = 0;                                           // [s]
  std::vector<ContactGrip> grips = {};                       // by obstacle, then point, ascending
};

/// Nodes x = A p, and generalised forces Aᵀ f. Cost O(entries of A), in parallel by rows.
[[nodiscard]] Eigen::Matrix3Xd nodes(const System& system, const Eigen::Matrix3Xd& positions);
[[nodiscard]] Eigen::Matrix3Xd generalised_forces(const System& system, const Eigen::Matrix3Xd& node_forces);

/// Adds the forces of the springs, stiffness · (target − Σ weight · p) spread by the weights [N], to `forces`.
void add_spring_forces(const std::vector<AnchorSpring>& springs, const Eigen::Matrix3Xd& positions,
                       Eigen::Matrix3Xd& forces);
/// Σ weight · p: where the spring holds the body [m].
[[nodiscard]] Eigen::Vector3d held_point(const AnchorSpring& spring, const Eigen::Matrix3Xd& positions);

/// Reactions of the fixed control points [N], 3 x N (zero elsewhere): what the pin applies to the body, at rest
/// −(internal + external) force.
[[nodiscard]] Eigen::Matrix3Xd reactions(const System& system, const Loads& loads,
                                         const Eigen::Matrix3Xd& positions);

/// Elastic energy plus that of the springs [J].
[[nodiscard]] double potential_energy(const System& system, const Loads& loads, const Eigen::Matrix3Xd& positions);

}  // namespace argil::fem
