#include "sculpt/force_tools/painting.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sculpt/document_loads.h"
#include "sculpt/force_tools/touched.h"
#include "sculpt/region.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

struct PaintedField {
  std::string_view tool;
  FieldName field;
};
constexpr std::array k_painted{PaintedField{"paint_stiffness", FieldName::young_modulus},
                               PaintedField{"paint_mass", FieldName::density},
                               PaintedField{"paint_damping", FieldName::damping}};
constexpr std::string_view k_pins = "pin_brush";

const FieldInfo& info_of(FieldName field) {
  return field_table()[static_cast<std::size_t>(field)];
}

void hold_still(fem::BodyState& motion, Eigen::Index control_point) {
  motion.velocities.col(control_point).setZero();
  if (motion.previous_positions.cols() > 0) {
    motion.previous_positions.col(control_point) = motion.positions.col(control_point);
    motion.previous_velocities.col(control_point).setZero();
  }
  if (motion.accelerations.cols() > 0) motion.accelerations.col(control_point).setZero();
}

}  // namespace

bool is_painting_tool(std::string_view name) {
  return name == k_pins ||
         std::any_of(k_painted.begin(), k_painted.end(), [&](const PaintedField& p) { return p.tool == name; });
}

Painting::Painting(const Document& document, const Tool& tool, const Eigen::Vector3d& at,
                   const GripOptions& options)
    : tool_(tool), invert_(options.invert), base_(document.state().fields) {
  for (const PaintedField& painted : k_painted)
    if (painted.tool == tool.name) field_ = painted.field;
  if (field_ && !tool.scales) {
    const FieldInfo& info = info_of(*field_);
    if (!(tool.amount >= info.low && tool.amount <= info.high))
      throw Error(ErrorCode::bad_input,
                  fmt::format("{} must lie between {:g} and {:g} {}, and the tool's value is {:g}; "
                              "give another, as in `tool {} value {:g}`",
                              info.word, info.low, info.high, info.unit, tool.amount, tool.name, info.initial));
  }
  static_cast<void>(touch(document, tool, at, options.inside));
  largest_ = Eigen::VectorXd::Zero((*base_)[FieldName::mask].size());
  touched_.assign(document.solid().vertex_capacity(), 0);
}

Eigen::VectorXd Painting::weights_on(const Eigen::Matrix3Xd& places, const StrokePose& from,
                                     const StrokePose& to) const {
  const fem::Falloff falloff = falloff_by_word(tool_.falloff);
  const Eigen::Vector3d way = to.position - from.position;
  const double length_squared = way.squaredNorm();
  Eigen::VectorXd weights(places.cols());
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    const Eigen::Vector3d offset = places.col(i) - from.position;
    const double s = length_squared > 0 ? std::clamp(offset.dot(way) / length_squared, 0.0, 1.0) : 1;
    weights[i] = falloff_weight(falloff, (offset - s * way).norm() / tool_.radius) *
                 ((1 - s) * from.pressure + s * to.pressure);
  }
  return weights;
}

void Painting::paint(Document& document, const StrokePose& from, const StrokePose& to) {
  if (!field_) return paint_pins(document, from, to);
  paint_field(document,
              weights_on(subdiv::apply(document.refinement().stencils.back(), document.positions()), from, to));
}

void Painting::paint_field(Document& document, const Eigen::VectorXd& weights) {
  const FieldInfo& info = info_of(*field_);
  const Eigen::VectorXd& mask = (*base_)[FieldName::mask];
  const Eigen::VectorXd& before = (*base_)[*field_];
  std::shared_ptr<Fields> fields;
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    const double weight = weights[i] * (1 - mask[i]);
    if (!(weight > largest_[i])) continue;
    largest_[i] = weight;
    if (!fields) fields = std::make_shared<Fields>(*document.state().fields);
    const double goal = invert_ ? info.initial : tool_.amount;
    const double painted = tool_.scales ? before[i] * std::pow(tool_.amount, invert_ ? -weight : weight)
                                        : before[i] + weight * (goal - before[i]);
    (*fields)[*field_][i] = std::clamp(painted, info.low, info.high);
  }
  if (!fields) return;
  State next = document.state();
  next.fields = fields;
  document.assign(std::move(next));
}

void Painting::paint_pins(Document& document, const StrokePose& from, const StrokePose& to) {
  const Eigen::Matrix3Xd nodes = subdiv::apply(document.refinement().stencils.back(), document.positions());
  const auto node_of = node_from_control_vertex(document);
  Eigen::Matrix3Xd places(3, static_cast<Eigen::Index>(node_of.size()));
  for (std::size_t v = 0; v < node_of.size(); ++v)
    if (document.solid().is_live(subdiv::VertexId{v}))
      places.col(static_cast<Eigen::Index>(v)) = nodes.col(node_of[v]);
    else
      places.col(static_cast<Eigen::Index>(v)).setConstant(1e300);
  const Eigen::VectorXd weights = weights_on(places, from, to);
  std::vector<std::uint8_t> pinned(touched_.size(), 0);
  for (const std::uint32_t v : document.state().pins->control_points) pinned[v] = 1;
  State next = document.state();
  std::shared_ptr<fem::BodyState> motion;
  bool changed = false;
  for (std::size_t v = 0; v < touched_.size(); ++v) {
    if (!(weights[static_cast<Eigen::Index>(v)] > 0) || (pinned[v] != 0) == !invert_) continue;
    pinned[v] = invert_ ? 0 : 1;
    touched_[v] = 1;
    changed = true;
    if (invert_) continue;
    if (!motion) motion = std::make_shared<fem::BodyState>(*next.motion);
    hold_still(*motion, static_cast<Eigen::Index>(v));
  }
  if (!changed) return;
  auto pins = std::make_shared<Pins>(*next.pins);
  pins->control_points.clear();
  for (std::size_t v = 0; v < pinned.size(); ++v)
    if (pinned[v]) pins->control_points.push_back(static_cast<std::uint32_t>(v));
  next.pins = pins;
  if (motion) next.motion = motion;
  document.assign(std::move(next));
}

std::string Painting::report() const {
  if (!field_)
    return fmt::format(
        "{} {}",
        count_of(static_cast<std::size_t>(std::count(touched_.begin(), touched_.end(), 1)), ElementType::vertices),
        invert_ ? "released" : "pinned");
  std::size_t count = 0;
  for (Eigen::Index i = 0; i < largest_.size(); ++i) count += largest_[i] > 0;
  return fmt::format("{} painted on {}", info_of(*field_).word, count_of(count, ElementType::nodes));
}

}  // namespace argil::sculpt
