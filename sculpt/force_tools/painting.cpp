#include "sculpt/force_tools/painting.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sculpt/document_loads.h"
#include "sculpt/region.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

struct PaintedField {
  std::string_view tool;
  FieldName field;
};
constexpr std::array k_painted{
    PaintedField{"paint_stiffness", FieldName::young_modulus}, PaintedField{"paint_mass", FieldName::density},
    PaintedField{"paint_damping", FieldName::damping}, PaintedField{"paint_mask", FieldName::mask}};
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

// Where on a way a brush whose size changes comes nearest, by its size: the least (offset − s way)² / size(s)² is
// at an end or where the derivative, linear in s but for a factor, is zero.
double nearest_by_size(const Eigen::Vector3d& offset, const Eigen::Vector3d& way, double from, double to) {
  const double along = offset.dot(way), length_squared = way.squaredNorm(), growth = to - from;
  const double inner = (along * from + growth * offset.squaredNorm()) / (length_squared * from + along * growth);
  double best = 1, least = std::numeric_limits<double>::infinity();
  for (const double s : {1.0, 0.0, inner}) {
    const double size = (1 - s) * from + s * to;
    if (!(s >= 0 && s <= 1 && size > 0)) continue;
    const double distance = (offset - s * way).norm() / size;
    if (distance < least) {
      least = distance;
      best = s;
    }
  }
  return best;
}

}  // namespace

bool is_painting_tool(std::string_view name) {
  return name == k_pins ||
         std::any_of(k_painted.begin(), k_painted.end(), [&](const PaintedField& p) { return p.tool == name; });
}

Masks masks_of(std::string_view tool) {
  return tool == "paint_mask" ? Masks::ignored : Masks::protect;
}

Painting::Painting(const Document& document, const Tool& tool, const Eigen::Vector3d& at,
                   const GripOptions& options)
    : tool_(tool), invert_(options.invert), base_(document.state().fields) {
  for (const PaintedField& painted : k_painted)
    if (painted.tool == tool.name) field_ = painted.field;
  if (field_ == FieldName::mask && tool_.scales) {  // a factor of none is none
    tool_.scales = false;
    tool_.amount = 1;
  }
  if (field_ && !tool_.scales) {
    const FieldInfo& info = info_of(*field_);
    if (!(tool_.amount >= info.low && tool_.amount <= info.high))
      throw Error(ErrorCode::bad_input,
                  fmt::format("{} must lie between {:g} and {:g} {}, and the tool's value is {:g}; "
                              "give another, as in `tool {} value {:g}`",
                              info.word, info.low, info.high, info.unit, tool.amount, tool.name, info.initial));
  }
  static_cast<void>(touch(document, tool, at, options.inside, masks_of(tool.name)));
  largest_ = Eigen::VectorXd::Zero(field_ ? (*base_)[*field_].size()
                                          : static_cast<Eigen::Index>(document.solid().vertex_capacity()));
  pinned_.assign(document.solid().vertex_capacity(), 0);
  for (const std::uint32_t v : document.state().pins->control_points) pinned_[v] = 1;
}

void Painting::note(const Document& document, const StrokePose& from, const StrokePose& to) {
  const fem::Falloff falloff = falloff_by_word(tool_.falloff);
  const Eigen::Vector3d way = to.position - from.position;
  const double length_squared = way.squaredNorm();
  const auto note = [&](Eigen::Index i, const Eigen::Vector3d& place, double share) {
    const Eigen::Vector3d offset = place - from.position;
    double s = length_squared > 0 ? std::clamp(offset.dot(way) / length_squared, 0.0, 1.0) : 1;
    if (from.size != to.size) s = nearest_by_size(offset, way, from.size, to.size);
    const double size = (1 - s) * from.size + s * to.size;
    if (!(size > 0)) return;
    const double weight = share * falloff_weight(falloff, (offset - s * way).norm() / (tool_.radius * size)) *
                          ((1 - s) * from.pressure + s * to.pressure);
    if (!(weight > largest_[i])) return;
    largest_[i] = weight;
    noted_ = true;
  };
  const Eigen::Matrix3Xd nodes = subdiv::apply(document.refinement().stencils.back(), document.positions());
  const Eigen::VectorXd& mask = (*base_)[FieldName::mask];
  if (field_) {
    const bool masks = field_ == FieldName::mask;
    for (Eigen::Index i = 0; i < nodes.cols(); ++i) note(i, nodes.col(i), masks ? 1 : 1 - mask[i]);
  } else {
    const auto node_of = node_from_control_vertex(document);
    for (const subdiv::VertexId v : document.solid().vertices())
      note(static_cast<Eigen::Index>(v.index()), nodes.col(node_of[v.index()]), 1 - mask[node_of[v.index()]]);
  }
}

void Painting::apply(Document& document, const std::optional<Eigen::Vector3d>& at) {
  if (!noted_) return;
  if (at && applied_at_ && (*at - *applied_at_).norm() <= tool_.radius / 4) return;
  if (at) applied_at_ = at;
  noted_ = false;
  if (field_)
    apply_field(document);
  else
    apply_pins(document);
}

void Painting::apply_field(Document& document) const {
  const FieldInfo& info = info_of(*field_);
  const Eigen::VectorXd& before = (*base_)[*field_];
  const double goal = invert_ ? info.initial : tool_.amount;
  auto fields = std::make_shared<Fields>(*base_);
  for (Eigen::Index i = 0; i < before.size(); ++i) {
    const double weight = largest_[i];
    if (!(weight > 0)) continue;
    const double painted = tool_.scales ? before[i] * std::pow(tool_.amount, invert_ ? -weight : weight)
                                        : before[i] + weight * (goal - before[i]);
    (*fields)[*field_][i] = std::clamp(painted, info.low, info.high);
  }
  State next = document.state();
  next.fields = fields;
  document.assign(std::move(next));
}

void Painting::apply_pins(Document& document) const {
  State next = document.state();
  auto pins = std::make_shared<Pins>(*next.pins);
  std::vector<std::uint8_t> held(pinned_.size(), 0);
  for (const std::uint32_t v : pins->control_points) held[v] = 1;
  auto motion = std::make_shared<fem::BodyState>(*next.motion);
  pins->control_points.clear();
  for (std::size_t v = 0; v < pinned_.size(); ++v) {
    const bool touched = largest_[static_cast<Eigen::Index>(v)] > 0;
    if (touched ? invert_ : !pinned_[v]) continue;
    pins->control_points.push_back(static_cast<std::uint32_t>(v));
    if (!held[v]) hold_still(*motion, static_cast<Eigen::Index>(v));
  }
  if (pins->control_points == next.pins->control_points) return;
  next.pins = pins;
  next.motion = motion;
  document.assign(std::move(next));
}

std::string Painting::report() const {
  std::size_t count = 0;
  for (Eigen::Index i = 0; i < largest_.size(); ++i)
    count += largest_[i] > 0 && (field_ || (pinned_[static_cast<std::size_t>(i)] != 0) == invert_);
  if (field_) return fmt::format("{} painted on {}", info_of(*field_).word, count_of(count, ElementType::nodes));
  return fmt::format("{} {}", count_of(count, ElementType::vertices), invert_ ? "released" : "pinned");
}

}  // namespace argil::sculpt
