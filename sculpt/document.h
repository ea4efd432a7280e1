#pragma once
// The document: one solid with everything that a command may change (SESSION.md, "State"), and what is derived from
// it. State is held in parts that never change once made, so that remembering a state for undo costs a few
// pointers; the topology alone is edited in place, by transactions whose deltas undo keeps.

#include <Eigen/Core>
#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "fem/contact/contact_surface.h"
#include "fem/discretization.h"
#include "fem/dynamics/guard.h"
#include "fem/dynamics/integrator.h"
#include "fem/measure/shown_elements.h"
#include "fem/models/model_table.h"
#include "fem/models/plastic_flow.h"
#include "sculpt/tracks.h"
#include "subdiv/progress.h"
#include "subdiv/refinement.h"
#include "subdiv/transaction.h"

namespace argil::sculpt {

enum class FieldName { young_modulus, poisson_ratio, density, damping, mask, stiffness_damping, prestress };
inline constexpr int k_field_count = 7;
struct FieldInfo {
  FieldName name;
  const char* word;
  const char* unit;
  double initial, low, high;  // low and high are allowed
};
/// The fields, in the order of FieldName.
[[nodiscard]] const std::array<FieldInfo, k_field_count>& field_table();
/// @throws Error (not_found) that lists the names.
[[nodiscard]] FieldName field_by_word(const std::string& word);

/// Values at the vertices of the finest level, by vertex id.
struct Fields {
  std::array<Eigen::VectorXd, k_field_count> values;
  const Eigen::VectorXd& operator[](FieldName name) const { return values[static_cast<std::size_t>(name)]; }
  Eigen::VectorXd& operator[](FieldName name) { return values[static_cast<std::size_t>(name)]; }
};

struct NamedObstacle;  // obstacles.h

/// How the body flows (fem/models/plastic_flow.h); not at all unless on.
struct Plasticity {
  bool on = false;
  fem::FlowLaw law;
};

/// What has left the energy of a body for good [J], since it was made. It acts on nothing and is not hashed; undo
/// takes it back.
struct LostEnergy {
  double friction = 0;  // to obstacles
  double flow = 0;      // plastic
};

enum class ElementType { vertices, edges, faces, cells, nodes };
[[nodiscard]] const char* word(ElementType type);
struct Selection {
  ElementType type = ElementType::vertices;
  std::vector<std::uint32_t> ids;  // ascending; nodes are vertices of the finest level
};

struct SoftPin {
  std::uint32_t node;      // vertex of the finest level
  double stiffness;        // [N/m]
  Eigen::Vector3d target;  // [m]
};
/// Pins that keys lead as one rigid body. It is the differences of the keys that count: points go from where they
/// stand, the targets of soft pins from where they stood at `since`.
struct PinMotion {
  std::string name;   // of the set that was taken
  Selection members;  // vertices or nodes; what is no pin (any more) is passed over
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero();
  double since = 0;  // [s]
  Track track;       // way [m] and rotation vector [rad]
};
struct Pins {
  std::vector<std::uint32_t> control_points;  // ascending; move exactly 0, or as `motions` say
  std::vector<SoftPin> nodes;                 // ascending; by penalty
  std::vector<PinMotion> motions = {};        // by name; no pin is in two
};

/// A force that stays until it is cleared: on boundary faces of the control solid, through cells of it, or at a
/// material point.
struct AppliedForce {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  // [N], in total
  std::vector<std::uint32_t> faces;                 // control faces
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  // rest position, where there are neither faces nor cells
  std::vector<std::uint32_t> cells = {};            // control cells
  std::string name = {};                            // empty: none
  Track track = {};                                 // stands for `force` if it has keys

  [[nodiscard]] bool at_point() const { return faces.empty() && cells.empty(); }
};
/// A pressure on boundary faces of the control solid that stays until it is cleared and follows the surface: along
/// the normal of the moment, on the area of the moment.
struct AppliedPressure {
  double pressure = 0;               // [Pa], positive against the face
  std::vector<std::uint32_t> faces;  // control faces
  std::string name = {};             // empty: none
  Track track = {};                  // of one component; stands for `pressure` if it has keys
};
struct AppliedLoads {
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  // [m/s²]
  std::vector<AppliedForce> forces;
  Track gravity_track = {};  // stands for `gravity` if it has keys
  std::vector<AppliedPressure> pressures = {};
  Track prestress_track = {};  // of one component: the share of the field `prestress` that acts; without keys all
};

struct Tool {
  std::string name = "pull";
  double radius = 0.1;         // [m]
  double strength = 50;        // [N/m]
  double largest_force = 1e6;  // [N]
  std::string falloff = "smooth";
  char symmetry = 0;   // 'x', 'y' or 'z': its mirror image acts as well, in the middle of the rest shape; 0: none
  double amount = 2;   // of paint tools: the value to reach, or the factor to multiply by
  bool scales = true;  // the amount is a factor
};

/// As a session names it.
[[nodiscard]] const char* word(subdiv::RuleSet rules);

/// Everything that undo restores, but for the topology itself.
struct State {
  /// Tells states apart that share an array, since a topology edit adds to it in place (column_changes.h).
  std::uint64_t columns_stamp = 0;
  std::shared_ptr<subdiv::Solid> solid;          // edited in place; replaced by `new` and `open`
  std::shared_ptr<const Eigen::Matrix3Xd> rest;  // P, 3 x vertex capacity [m]
  std::shared_ptr<const fem::BodyState> motion;  // p, v, history, time
  std::shared_ptr<const Fields> fields;
  std::shared_ptr<const Pins> pins;
  std::shared_ptr<const AppliedLoads> loads;
  std::shared_ptr<const std::vector<NamedObstacle>> obstacles;  // null: none
  Plasticity plasticity;
  std::shared_ptr<const fem::PlasticFlow> flow;  // of the points of the discretization; null: none
  LostEnergy lost;
  std::shared_ptr<const Selection> selection;
  std::shared_ptr<const std::map<std::string, Selection>> sets;
  int level = 0;
  subdiv::RuleSet rules = subdiv::RuleSet::maccracken_joy;
  fem::Space space = fem::Space::standard;
  int split = 1;
  fem::ModelChoice model;
  fem::Method method = fem::Method::bdf2;
  int newton_cap = 3;
  double newton_tolerance = 1e-4;
  bool line_search = true;
  double spectral_radius = 0.8;  // of generalised-α
  int substeps = 1;
  bool guard_on = true;
  fem::GuardState guard;
  double time_step = 1.0 / 60;  // [s]
  double tick_carry = 0;  // device ticks since the last step, less than a step: the next stroke goes on from there
  Tool tool;
};

/// Bounds checked before anything is allocated.
struct Limits {
  std::size_t cells = 4'000'000;
  std::size_t steps = 1'000'000;
  std::size_t memory = std::size_t{12} << 30;  // [bytes], estimated
};

class Document {
 public:
  Document();
  ~Document();

  const State& state() const { return state_; }
  /// What a command does: builds the next state from a copy and hands it over. Topology edits come with their
  /// delta, already applied to the solid.
  void assign(State next) { state_ = std::move(next); }
  bool empty() const { return state_.solid->cell_count() == 0; }
  const subdiv::Solid& solid() const { return *state_.solid; }
  const Eigen::Matrix3Xd& rest() const { return *state_.rest; }
  const Eigen::Matrix3Xd& positions() const { return state_.motion->positions; }

  // Derived, made when asked for and kept while what they depend on stays.
  const subdiv::Refinement& refinement() const;
  const fem::Discretization& discretization() const;
  /// Of the body as it has flowed, its prestress as it is now or, where that is keyed, at another time [s]. What
  /// this, system() and integrator() gave before is then of that time too.
  const fem::ForceModel& model() const { return model_at(state_.motion->time); }
  const fem::ForceModel& model_at(double time) const;
  fem::System system() const;
  fem::Integrator& integrator() const { return integrator_at(state_.motion->time); }
  fem::Integrator& integrator_at(double time) const;
  /// Loads that do not come from a tool, in control points, with the soft pins as springs: now, and at another time
  /// [s] where some are keyed. Pressures act on the surface as it stands, or where these control points have it.
  const fem::Loads& loads() const { return loads_at(state_.motion->time); }
  const fem::Loads& loads_at(double time) const { return loads_at(time, positions()); }
  const fem::Loads& loads_at(double time, const Eigen::Matrix3Xd& control_points) const;
  /// The boundary as obstacles meet it. @throws Error (bad_input) at level 0 with faces of other than four corners.
  std::shared_ptr<const fem::ContactSurface> contact_surface() const;
  const fem::ShownElements& shown_elements() const;  // for strain and stress
  /// False if the body has flowed in a space that integrates other elements than those shown.
  bool stress_is_known() const;
  /// Nodes of the finest level as the space shows them (limit positions in cubic space), from control points; 3 x
  /// vertices.
  Eigen::Matrix3Xd surface_nodes(const Eigen::Matrix3Xd& control_points) const;

  /// FNV-1a over the canonical state (SESSION.md, "Promises").
  [[nodiscard]] std::uint64_t state_hash() const;

  Limits limits;
  Progress progress;  // told while something derived is made; what it throws leaves the document as it is

 private:
  fem::System system_as_it_is() const;  // with the model of the time last asked for

  State state_;
  struct Derived;
  mutable std::unique_ptr<Derived> derived_;
};

/// Every field at its initial value.
[[nodiscard]] std::shared_ptr<const Fields> initial_fields(std::size_t node_count);

}  // namespace argil::sculpt
