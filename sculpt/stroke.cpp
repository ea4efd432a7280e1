#include "sculpt/stroke.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sculpt/force_tools/curve.h"
#include "sculpt/force_tools/touched.h"
#include "sculpt/obstacles.h"
#include "sculpt/simulation.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

bool finite(const StrokePose& pose) {
  return pose.position.allFinite() && pose.orientation.coeffs().allFinite() && std::isfinite(pose.pressure);
}

// What a line can repeat: a device says position, turn and pressure.
StrokePose told(StrokePose pose) {
  pose.pressure = std::clamp(pose.pressure, 0.0, 1.0);
  pose.size = 1;
  return pose;
}

}  // namespace

Stroke::Stroke(Session& session, const StrokePose& first, const StrokeOptions& options)
    : session_(session),
      options_(options),
      path_{{0, told(first)}},
      device_(told(first)),
      pose_(acting()),
      stepped_(pose_),
      painted_(pose_) {
  require_simulation(session);
  const Document& document = session.document();
  tool_ = document.state().tool;
  if (options.smoothing) tool_.name = "smooth";
  if (!options.curve.empty()) tool_.name = "curve";
  if (tool_.symmetry != 0) {
    mirror_ = tool_.symmetry - 'x';
    plane_ = mirror_plane(document, mirror_);
  }
  hold(pose_);
  if (mirror_ >= 0 && !probe_) {
    try {
      hold(mirrored(pose_, mirror_, plane_));
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("the mirror image: {}; or work without, `tool {} symmetry none`",
                                            error.what(), tool_.name));
    }
  }
  session.begin_change();
  pending_ = document.state().tick_carry;
  first_step_ = session.steps().size();
  paint();
  read();
}

StrokePose Stroke::acting() const {
  StrokePose pose = device_;
  if (!options_.scales_radius) return pose;
  pose.size = pose.pressure;
  pose.pressure = 1;
  return pose;
}

void Stroke::hold(const StrokePose& first) {
  const Document& document = session_.document();
  GripOptions grip{options_.invert, options_.inside, tools_.empty() ? -1 : mirror_};
  if (!options_.curve.empty()) {
    HandleCurve curve(options_.curve);
    if (!tools_.empty()) {
      std::vector<Eigen::Vector3d> image;
      for (const Eigen::Vector3d& point : options_.curve)
        image.push_back(mirrored({point}, mirror_, plane_).position);
      curve = HandleCurve(std::move(image));
    }
    tools_.push_back(take_curve(document, tool_, curve, options_.handle, first));
  } else if (tool_.name == k_probe_tool) {
    probe_ = std::make_unique<Probe>(document);
    static_cast<void>(touch(document, tool_, first.position, options_.inside, Masks::ignored));
  } else if (is_painting_tool(tool_.name)) {
    if (painting_)  // one paints for both images
      static_cast<void>(touch(document, tool_, first.position, options_.inside, masks_of(tool_.name)));
    else
      painting_ = std::make_unique<Painting>(document, tool_, first.position, grip);
  } else {
    tools_.push_back(take_hold(document, tool_, first, grip));
  }
}

Stroke::~Stroke() {
  if (!over_) cancel();
}

bool Stroke::step_is_due() const {
  const double step_ticks = session_.document().state().time_step / k_tick_seconds;
  return pending_ + 1 >= step_ticks * (1 - 1e-12);
}

bool Stroke::tick(const StrokePose& pose) {
  assert(!over_);
  Document& document = session_.document();
  const double step_ticks = document.state().time_step / k_tick_seconds;
  if (finite(pose)) device_ = told(pose);  // else the device has lost itself: it stays where it was
  pose_ = acting();
  ++tick_;
  pending_ += 1;
  bool stepped = false;
  while (pending_ >= step_ticks * (1 - 1e-12) && !session_.stop_requested()) {
    if (!stepped) path_.push_back({tick_, device_});
    stepped = true;
    pending_ -= step_ticks;
    stepped_ = pose_;
    if (probe_) continue;
    paint();
    // The carry is part of every step's state: a stroke that is stopped midway ends as its trace says.
    State now = document.state();
    now.tick_carry = std::max(0.0, pending_);
    document.assign(std::move(now));
    take_step();
  }
  if (stepped) read();
  return stepped;
}

void Stroke::take_step() {
  session_.require_steps(1);
  const Document& document = session_.document();
  fem::Loads loads;
  for (std::size_t i = 0; i < tools_.size(); ++i) {
    ForceTool& tool = *tools_[i];
    const StrokePose pose = i == 0 ? stepped_ : mirrored(stepped_, mirror_, plane_);
    tool.follow(pose, document);
    if (i == 0) {
      largest_ = std::max(largest_, tool.force(pose, document.positions()).norm());
      largest_moment_ = std::max(largest_moment_, force().moment.norm());
    }
    add_loads(loads, tool.loads(pose, document.positions()));
  }
  simulation_step(session_, loads, document.state().time_step);
}

void Stroke::paint() {
  if (!painting_) return;
  painting_->note(session_.document(), painted_, pose_);
  if (mirror_ >= 0)
    painting_->note(session_.document(), mirrored(painted_, mirror_, plane_), mirrored(pose_, mirror_, plane_));
  painting_->apply(session_.document(), pose_.position);
  painted_ = pose_;
}

void Stroke::read() {
  if (!probe_) return;
  reading_.reset();
  if (touched(session_.document(), tool_, pose_.position, options_.inside, Masks::ignored).empty()) return;
  reading_ = probe_->read(tool_, pose_.position, options_.inside);
  softest_ = softest_ > 0 ? std::min(softest_, reading_->stiffness) : reading_->stiffness;
  stiffest_ = std::max(stiffest_, reading_->stiffness);
}

void add_obstacle_walls(ContactModel& model, const Document& document, double reach) {
  constexpr double k_stiffness = 1000;  // [N/m], of a wall that a device can show
  const double time = document.state().motion->time;
  std::vector<std::pair<double, ContactPlane>> walls;
  for (const fem::Obstacle& obstacle : moving_obstacles(document.state(), time)) {
    const fem::ObstaclePose pose = fem::pose_at(obstacle, time);
    const fem::SignedDistance near = fem::signed_distance(obstacle, pose.own(model.point));
    if (near.distance > reach) continue;
    const Eigen::Vector3d normal = pose.rotation * near.normal;
    walls.push_back({near.distance, {normal, normal.dot(model.point) - near.distance, k_stiffness}});
  }
  std::sort(walls.begin(), walls.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& wall : walls) {
    if (model.plane_count == ContactModel::k_max_planes) return;
    model.planes[model.plane_count++] = wall.second;
  }
}

ContactModel Stroke::felt(Tick valid_until) const {
  ContactModel model;
  model.point = pose_.position;
  if (!tools_.empty()) {
    const Felt felt = tools_.front()->felt(pose_, session_.document().positions());
    model.force = felt.force;
    model.derivative = felt.derivative;
  }
  if (reading_) {
    model.planes[0] = {reading_->normal, reading_->normal.dot(reading_->at), reading_->stiffness};
    model.plane_count = 1;
  }
  add_obstacle_walls(model, session_.document(), tool_.radius);
  model.valid_until = valid_until;
  return model;
}

StrokeForce Stroke::force() const {
  const Eigen::Matrix3Xd& positions = session_.document().positions();
  if (tools_.empty()) return {reading_ ? reading_->at : pose_.position, {0, 0, 0}, {0, 0, 0}};
  const ForceTool& tool = *tools_.front();
  const fem::Wrench wrench = tool.wrench(stepped_, positions);
  StrokeForce result{tool.held(positions), tool.force(stepped_, positions), {0, 0, 0}};
  result.moment = wrench.moment - result.at.cross(wrench.force);
  return result;
}

std::string Stroke::report() const {
  if (painting_) return painting_->report();
  if (probe_)
    return reading_ ? fmt::format("felt {:.4g} N/m at the end, from {:.4g} to {:.4g} N/m on the way",
                                  reading_->stiffness, softest_, stiffest_)
                    : std::string("the probe touches nothing at the end");
  if (tool_.name == "pull") return fmt::format("pulled with up to {:.3g} N", largest_);
  // What is left of rounding is none.
  const double none = 1e-9 * tool_.strength * tool_.radius;
  return fmt::format("{}: net force up to {:.3g} N, net moment up to {:.3g} N m", tool_.name,
                     largest_ > none ? largest_ : 0, largest_moment_ > none * tool_.radius ? largest_moment_ : 0);
}

std::string Stroke::finish() {
  assert(!over_);
  if (path_.back().tick != tick_) path_.push_back({tick_, device_});
  over_ = true;
  if (probe_) {  // changes nothing, so that there is nothing to undo
    read();
    session_.print(report());
    if (reading_) {
      session_.measured("felt_stiffness", reading_->stiffness);
      // As a device feels it: the plane that it was sent, as deep as it presses.
      const double depth = std::max(0.0, reading_->normal.dot(reading_->at - pose_.position));
      const double felt = depth > 0 ? std::min(depth * reading_->stiffness, tool_.largest_force) : 0;
      session_.show_tool_force({reading_->at, -felt * reading_->normal});
    }
    return line();
  }
  paint();
  if (painting_) painting_->apply(session_.document());
  State next = session_.document().state();
  next.tick_carry = std::max(0.0, pending_);
  report_guard(session_, first_step_);
  session_.print(report());
  const StrokeForce now = force();
  session_.change(std::move(next));
  if (!tools_.empty()) {
    ToolForce shown{now.at, now.force, options_.curve};
    if (!shown.curve_handles.empty()) {
      Eigen::Vector3d& moved = shown.curve_handles[options_.handle];
      moved += pose_.position - path_.front().pose.position;
      shown.at = moved;
    }
    session_.show_tool_force(shown);
  }
  return line();
}

void Stroke::cancel() {
  over_ = true;
  session_.abandon_change(first_step_);
}

std::string Stroke::line() const {
  std::string text = "stroke path";
  if (!options_.curve.empty()) {
    text = "curve through";
    for (const Eigen::Vector3d& point : options_.curve)
      text += fmt::format(" {} {} {}", point.x(), point.y(), point.z());
    text += fmt::format(" handle {} path", options_.handle + 1);
  }
  bool turned = false, pressed = false;
  for (const auto& [tick, pose] : path_) {
    text += fmt::format(" {} {} {} {}", tick, pose.position.x(), pose.position.y(), pose.position.z());
    turned = turned || pose.orientation.coeffs() != Eigen::Quaterniond::Identity().coeffs();
    pressed = pressed || pose.pressure != 1;
  }
  if (turned) {
    text += " turns";
    for (const auto& [tick, pose] : path_)
      text += fmt::format(" {} {} {} {}", pose.orientation.w(), pose.orientation.x(), pose.orientation.y(),
                          pose.orientation.z());
  }
  if (pressed) {
    text += " pressures";
    for (const auto& [tick, pose] : path_) text += fmt::format(" {}", pose.pressure);
    if (options_.scales_radius) text += " scales radius";
  }
  if (options_.invert) text += " invert";
  if (options_.smoothing) text += " smoothing";
  if (options_.inside) text += " inside";
  return text;
}

}  // namespace argil::sculpt
