#include "sculpt/document.h"

#include <fmt/format.h>

#include <algorithm>

#include "sculpt/document_loads.h"
#include "sculpt/hash.h"
#include "sculpt/obstacles.h"
#include "subdiv/error.h"

namespace argil::sculpt {

const std::array<FieldInfo, k_field_count>& field_table() {
  // Defaults of a soft modelling clay-like rubber.
  static const std::array<FieldInfo, k_field_count> table{{
      {FieldName::young_modulus, "young_modulus", "Pa", 1e5, 1e-3, 1e13},
      {FieldName::poisson_ratio, "poisson_ratio", "", 0.3, -0.9, 0.4999},
      {FieldName::density, "density", "kg/m^3", 1000, 1e-6, 1e6},
      {FieldName::damping, "damping", "1/s", 0, 0, 1e9},
      {FieldName::mask, "mask", "", 0, 0, 1},
      {FieldName::stiffness_damping, "stiffness_damping", "s", 0, 0, 1e6},
      {FieldName::prestress, "prestress", "Pa", 0, -1e12, 1e12},
  }};
  return table;
}

FieldName field_by_word(const std::string& word) {
  std::string names;
  for (const FieldInfo& field : field_table()) {
    if (word == field.word) return field.name;
    names += (names.empty() ? "" : ", ") + std::string(field.word);
  }
  throw Error(ErrorCode::not_found, fmt::format("'{}' is not a field; fields are {}", word, names));
}

const char* word(ElementType type) {
  switch (type) {
    case ElementType::vertices:
      return "vertices";
    case ElementType::edges:
      return "edges";
    case ElementType::faces:
      return "faces";
    case ElementType::cells:
      return "cells";
    case ElementType::nodes:
      return "nodes";
  }
  return "";
}

const char* word(subdiv::RuleSet rules) {
  return rules == subdiv::RuleSet::multilinear_averaging ? "multilinear" : "maccracken_joy";
}

namespace {

fem::NodalFields nodal_fields(const Fields& f) {
  return {f[FieldName::young_modulus], f[FieldName::poisson_ratio],     f[FieldName::density],
          f[FieldName::damping],       f[FieldName::stiffness_damping], f[FieldName::prestress]};
}

}  // namespace

// Each derived thing keeps what it was made of, so that it is made again exactly when that has changed.
struct Document::Derived {
  std::uint64_t topology = 0;
  int level = -1;
  std::unique_ptr<subdiv::Refinement> refinement;

  std::shared_ptr<const Eigen::Matrix3Xd> rest;
  std::shared_ptr<const Fields> fields;
  fem::Space space = fem::Space::standard;
  int split = -1;
  std::uint64_t columns_stamp = 0;
  std::unique_ptr<fem::Discretization> discretization;
  std::unique_ptr<fem::ShownElements> shown_elements;
  std::shared_ptr<const fem::PlasticFlow> shown_flow;
  double shown_prestress = 1;  // its share
  bool stress_is_known = true;

  fem::ModelChoice model_choice;
  std::unique_ptr<fem::ForceModel> model;
  std::shared_ptr<const fem::PlasticFlow> flow;
  bool keyed_prestress = false;
  std::unique_ptr<fem::ForceModel> flowed_model;  // null where nothing has flowed and no prestress is keyed
  std::shared_ptr<double> prestress_share;        // that of flowed_model; null where none is keyed

  std::shared_ptr<const Pins> integrator_pins;
  std::unique_ptr<fem::Integrator> integrator;

  std::shared_ptr<const Pins> load_pins;
  std::shared_ptr<const AppliedLoads> applied;
  std::unique_ptr<DocumentLoads> load_parts;
  std::unique_ptr<fem::Loads> loads;  // at `load_time`, if that matters
  double load_time = 0;
  Eigen::Matrix3Xd loaded;  // control points that `loads` was made for, if that matters

  std::shared_ptr<const fem::ContactSurface> contact_surface;

  void drop_models() {
    integrator.reset();
    flowed_model.reset();
    flow.reset();
    keyed_prestress = false;
    prestress_share.reset();
    model.reset();
  }
  void drop_from_discretization() {
    drop_models();
    load_parts.reset();
    contact_surface.reset();
    shown_elements.reset();
    discretization.reset();
  }
};

Document::Document() : derived_(std::make_unique<Derived>()) {
  state_.solid = std::make_shared<subdiv::Solid>();
  state_.rest = std::make_shared<Eigen::Matrix3Xd>(3, 0);
  auto motion = std::make_shared<fem::BodyState>();
  motion->positions.resize(3, 0);
  motion->velocities.resize(3, 0);
  state_.motion = motion;
  state_.fields = initial_fields(0);
  state_.pins = std::make_shared<Pins>();
  state_.loads = std::make_shared<AppliedLoads>();
  state_.selection = std::make_shared<Selection>();
  state_.sets = std::make_shared<std::map<std::string, Selection>>();
}

Document::~Document() = default;

const subdiv::Refinement& Document::refinement() const {
  Derived& d = *derived_;
  const std::uint64_t topology = solid().topology_hash();
  if (!d.refinement || d.topology != topology || d.level != state_.level || d.refinement->rules != state_.rules) {
    d.drop_from_discretization();
    d.refinement = std::make_unique<subdiv::Refinement>(
        subdiv::refine_to_level(solid(), state_.level, state_.rules, progress.of("refining")));
    d.topology = topology;
    d.level = state_.level;
  }
  return *d.refinement;
}

const fem::Discretization& Document::discretization() const {
  Derived& d = *derived_;
  const subdiv::Refinement& refined = refinement();
  const bool same_shape = d.discretization && d.rest == state_.rest && d.columns_stamp == state_.columns_stamp &&
                          d.space == state_.space && d.split == state_.split;
  if (same_shape && d.fields == state_.fields) return *d.discretization;
  const fem::NodalFields nodal = nodal_fields(*state_.fields);
  d.drop_models();
  d.load_parts.reset();
  d.contact_surface.reset();
  d.shown_elements.reset();
  d.fields.reset();  // in case what follows throws half way
  if (!same_shape || !fem::update_fields(*d.discretization, refined, nodal, progress.of("taking materials"))) {
    d.drop_from_discretization();
    d.discretization = std::make_unique<fem::Discretization>(fem::discretize(
        refined, rest(), nodal, {.space = state_.space, .split = state_.split}, progress.of("making elements")));
  }
  d.rest = state_.rest;
  d.columns_stamp = state_.columns_stamp;
  d.fields = state_.fields;
  d.space = state_.space;
  d.split = state_.split;
  return *d.discretization;
}

const fem::ForceModel& Document::model_at(double time) const {
  Derived& d = *derived_;
  const fem::Discretization& discretized = discretization();
  if (!d.model || d.model_choice != state_.model) {
    d.drop_models();
    progress.of("making the force model").at(0);
    d.model = fem::make_model(state_.model, discretized.blocks, discretized.rest_nodes);
    d.model_choice = state_.model;
  }
  const bool keyed = !state_.loads->prestress_track.empty();
  const double share = prestress_share_at(*state_.loads, time);
  const auto take = [&](std::unique_ptr<fem::ForceModel> flowed) {
    if (d.integrator) d.integrator->set_model(flowed ? *flowed : *d.model);
    d.flowed_model = std::move(flowed);
  };
  if (d.flow != state_.flow || d.keyed_prestress != keyed) {
    const auto shared = keyed ? std::make_shared<double>(share) : nullptr;
    std::unique_ptr<fem::ForceModel> flowed;
    if (state_.flow && fem::fits(*state_.flow, discretized.blocks))
      flowed =
          fem::make_flowed_model(state_.model, discretized.blocks, discretized.rest_nodes, *state_.flow, shared);
    else if (keyed)
      flowed = fem::make_model(state_.model, discretized.blocks, discretized.rest_nodes, shared);
    take(std::move(flowed));
    d.flow = state_.flow;
    d.keyed_prestress = keyed;
    d.prestress_share = shared;
  } else if (keyed && *d.prestress_share != share) {
    *d.prestress_share = share;
    if (d.integrator) d.integrator->set_model(*d.flowed_model);  // forgets the values of the other share
  }
  return d.flowed_model ? *d.flowed_model : *d.model;
}

fem::System Document::system() const {
  (void)model();
  return system_as_it_is();
}

fem::System Document::system_as_it_is() const {
  const Derived& d = *derived_;
  const fem::ForceModel& force_model = d.flowed_model ? *d.flowed_model : *d.model;
  fem::System system;
  system.rows = &d.discretization->nodes.rows;
  system.rows_transposed = &d.discretization->rows_transposed;
  system.model = &force_model;
  system.rest_model = d.model.get();
  system.rest_nodes = &d.discretization->rest_nodes;
  system.mass = &d.discretization->mass;
  system.damping = &d.discretization->damping;
  system.blocks = d.discretization->blocks;
  system.fixed.assign(solid().vertex_capacity(), 0);
  for (const std::uint32_t v : state_.pins->control_points) system.fixed[v] = 1;
  // Ids whose element was removed carry no mass and no row: they stay where they are.
  for (std::size_t v = 0; v < system.fixed.size(); ++v)
    if (!solid().is_live(subdiv::VertexId{v})) system.fixed[v] = 1;
  return system;
}

fem::Integrator& Document::integrator_at(double time) const {
  Derived& d = *derived_;
  (void)model_at(time);
  if (!d.integrator || d.integrator_pins != state_.pins) {
    d.integrator = std::make_unique<fem::Integrator>(system_as_it_is());
    d.integrator_pins = state_.pins;
  }
  return *d.integrator;
}

const fem::Loads& Document::loads_at(double time, const Eigen::Matrix3Xd& control_points) const {
  Derived& d = *derived_;
  (void)discretization();
  bool same = d.load_parts && d.load_pins == state_.pins && d.applied == state_.loads;
  if (!same) {
    d.load_parts = std::make_unique<DocumentLoads>(document_loads(*this));
    d.load_pins = state_.pins;
    d.applied = state_.loads;
    d.loads.reset();
  }
  same = d.loads && (d.load_time == time || !d.load_parts->change()) &&
         (!d.load_parts->follow() || (d.loaded.cols() == control_points.cols() && d.loaded == control_points));
  if (!same) {
    d.loads = std::make_unique<fem::Loads>(d.load_parts->at(time, *d.discretization, control_points));
    d.load_time = time;
    if (d.load_parts->follow()) d.loaded = control_points;
  }
  return *d.loads;
}

bool Document::stress_is_known() const {
  (void)shown_elements();
  return derived_->stress_is_known;
}

std::shared_ptr<const fem::ContactSurface> Document::contact_surface() const {
  const fem::Discretization& discretized = discretization();
  if (!derived_->contact_surface)
    derived_->contact_surface = std::make_shared<fem::ContactSurface>(
        fem::contact_surface(discretized, refinement().solid(), (*state_.fields)[FieldName::young_modulus]));
  return derived_->contact_surface;
}

const fem::ShownElements& Document::shown_elements() const {
  (void)discretization();
  const double share = prestress_share_at(*state_.loads, state_.motion->time);
  if (derived_->shown_elements && (derived_->shown_flow != state_.flow || derived_->shown_prestress != share))
    derived_->shown_elements.reset();
  if (!derived_->shown_elements) {
    fem::NodalFields fields = nodal_fields(*state_.fields);
    if (share != 1) fields.prestress *= share;
    derived_->shown_prestress = share;
    derived_->shown_elements =
        std::make_unique<fem::ShownElements>(refinement().solid(), surface_nodes(rest()), fields);
    derived_->stress_is_known = !state_.flow || derived_->shown_elements->take_flow(*state_.flow);
    derived_->shown_flow = state_.flow;
  }
  return *derived_->shown_elements;
}

Eigen::Matrix3Xd Document::surface_nodes(const Eigen::Matrix3Xd& control_points) const {
  const fem::Discretization& discretized = discretization();
  const Eigen::Matrix3Xd nodes = subdiv::apply(discretized.nodes.rows, control_points);
  Eigen::Matrix3Xd shown(3, discretized.surface_node_from_vertex.size());
  for (Eigen::Index v = 0; v < shown.cols(); ++v)
    shown.col(v) = nodes.col(discretized.surface_node_from_vertex[static_cast<std::size_t>(v)]);
  return shown;
}

std::uint64_t Document::state_hash() const {
  const State& s = state_;
  Hash hash;
  const auto add_matrix = [&](const auto& m) {
    hash.add(std::span<const double>(m.data(), static_cast<std::size_t>(m.size())));
  };
  hash.add(solid().topology_hash());
  add_matrix(*s.rest);
  const fem::BodyState& motion = *s.motion;
  add_matrix(motion.positions);
  add_matrix(motion.velocities);
  add_matrix(motion.previous_positions);
  add_matrix(motion.previous_velocities);
  hash.add(motion.previous_step);
  hash.add(motion.time);
  if (motion.accelerations.cols() > 0) add_matrix(motion.accelerations);
  for (const auto& values : s.fields->values) add_matrix(values);
  const auto add_selection = [&](const Selection& selection) {
    hash.add(static_cast<std::uint64_t>(selection.type));
    hash.add(std::uint64_t{selection.ids.size()});
    for (const std::uint32_t id : selection.ids) hash.add(std::uint64_t{id});
  };
  hash.add(std::uint64_t{s.pins->control_points.size()});
  for (const std::uint32_t v : s.pins->control_points) hash.add(std::uint64_t{v});
  hash.add(std::uint64_t{s.pins->nodes.size()});
  for (const SoftPin& pin : s.pins->nodes) {
    hash.add(std::uint64_t{pin.node});
    hash.add(pin.stiffness);
    add_matrix(pin.target);
  }
  for (const PinMotion& motion_of_pins : s.pins->motions) {
    hash.add(std::string_view(motion_of_pins.name));
    add_selection(motion_of_pins.members);
    add_matrix(motion_of_pins.pivot);
    hash.add(motion_of_pins.since);
    add_to_hash(motion_of_pins.track, hash);
  }
  add_matrix(s.loads->gravity);
  if (!s.loads->gravity_track.empty()) add_to_hash(s.loads->gravity_track, hash);
  hash.add(std::uint64_t{s.loads->forces.size()});
  for (const AppliedForce& force : s.loads->forces) {
    add_matrix(force.force);
    add_matrix(force.point);
    hash.add(std::uint64_t{force.faces.size()});
    for (const std::uint32_t f : force.faces) hash.add(std::uint64_t{f});
    if (!force.cells.empty()) hash.add(std::span<const std::uint32_t>(force.cells));
    if (!force.name.empty()) hash.add(std::string_view(force.name));
    if (!force.track.empty()) add_to_hash(force.track, hash);
  }
  for (const AppliedPressure& pressure : s.loads->pressures) {
    hash.add(std::string_view("pressure"));
    hash.add(pressure.pressure);
    hash.add(std::span<const std::uint32_t>(pressure.faces));
    hash.add(std::string_view(pressure.name));
    if (!pressure.track.empty()) add_to_hash(pressure.track, hash);
  }
  if (!s.loads->prestress_track.empty()) {
    hash.add(std::string_view("prestress over time"));
    add_to_hash(s.loads->prestress_track, hash);
  }
  add_selection(*s.selection);
  hash.add(std::uint64_t{s.sets->size()});
  for (const auto& [name, set] : *s.sets) {
    hash.add(std::string_view(name));
    add_selection(set);
  }
  hash.add(static_cast<std::uint64_t>(s.level));
  hash.add(static_cast<std::uint64_t>(s.space));
  hash.add(static_cast<std::uint64_t>(s.split));
  hash.add(std::string_view(s.model.name));
  hash.add(static_cast<std::uint64_t>(s.method));
  hash.add(static_cast<std::uint64_t>(s.newton_cap));
  hash.add(s.time_step);
  hash.add(s.tick_carry);
  hash.add(std::string_view(s.tool.name));
  hash.add(s.tool.radius);
  hash.add(s.tool.strength);
  hash.add(s.tool.largest_force);
  hash.add(std::string_view(s.tool.falloff));
  if (s.rules != subdiv::RuleSet::maccracken_joy) hash.add(std::string_view(word(s.rules)));
  if (s.model.formulation != fem::Formulation::plain) hash.add(fem::word(s.model.formulation));
  const State initial;
  if (s.newton_tolerance != initial.newton_tolerance || !s.line_search ||
      s.spectral_radius != initial.spectral_radius || s.substeps != 1) {
    hash.add(std::string_view("integrator"));
    hash.add(s.newton_tolerance);
    hash.add(std::uint64_t{s.line_search});
    hash.add(s.spectral_radius);
    hash.add(static_cast<std::uint64_t>(s.substeps));
  }
  if (s.tool.symmetry != 0) hash.add(fmt::format("symmetry {}", s.tool.symmetry));
  if (s.tool.amount != initial.tool.amount || !s.tool.scales) {
    hash.add(std::string_view(s.tool.scales ? "scale" : "value"));
    hash.add(s.tool.amount);
  }
  if (!s.guard_on) hash.add(std::string_view("guard off"));
  if (s.guard != fem::GuardState{}) {
    hash.add(std::string_view("guard"));
    hash.add(s.guard.surplus);
    hash.add(static_cast<std::uint64_t>(s.guard.failures));
    hash.add(std::uint64_t{s.guard.frozen});
    hash.add(static_cast<std::uint64_t>(s.guard.cause));
    if (s.guard.dead_load != 0 || s.guard.pull != 0) {
      hash.add(s.guard.dead_load);
      hash.add(s.guard.pull);
    }
  }
  for (const fem::ContactGrip& grip : motion.grips) {
    hash.add(std::uint64_t{grip.obstacle});
    hash.add(std::uint64_t{grip.point});
    add_matrix(grip.anchor);
    if (grip.came_in_fast()) {
      add_matrix(grip.entry);
      add_matrix(grip.entry_normal);
    }
    if (grip.allowed > 0) {
      hash.add(grip.allowed);
      hash.add(grip.allowed_rate);
    }
  }
  if (s.obstacles) hash_obstacles(*s.obstacles, hash);
  if (s.plasticity.on) {
    hash.add(std::string_view("plasticity"));
    hash.add(s.plasticity.law.yield);
    hash.add(s.plasticity.law.relaxation);
  }
  if (s.flow)
    for (const auto& block : s.flow->inverse)
      for (const Eigen::Matrix3d& inverse : block) add_matrix(inverse);
  return hash.value();
}

std::shared_ptr<const Fields> initial_fields(std::size_t node_count) {
  auto fields = std::make_shared<Fields>();
  for (const FieldInfo& info : field_table())
    (*fields)[info.name] = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(node_count), info.initial);
  return fields;
}

}  // namespace argil::sculpt
