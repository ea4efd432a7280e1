// Of bench.h: a stroke under way.

#include <fmt/format.h>

#include "subdiv/error.h"
#include "tools/studio/bench.h"

namespace argil::studio {

std::string tool_line(const sculpt::Tool& now, const sculpt::Tool& wanted) {
  std::string line;
  if (wanted.radius != now.radius) line += fmt::format(" radius {}", wanted.radius);
  if (wanted.strength != now.strength) line += fmt::format(" strength {}", wanted.strength);
  if (wanted.largest_force != now.largest_force) line += fmt::format(" limit {}", wanted.largest_force);
  if (wanted.falloff != now.falloff) line += " falloff " + wanted.falloff;
  if (wanted.symmetry != now.symmetry)
    line += wanted.symmetry == 0 ? " symmetry none" : fmt::format(" symmetry {}", wanted.symmetry);
  if (wanted.amount != now.amount || wanted.scales != now.scales)
    line += fmt::format(" {} {}", wanted.scales ? "scale" : "value", wanted.amount);
  return line.empty() && wanted.name == now.name ? std::string{} : "tool " + wanted.name + line;
}

void Bench::begin_stroke(const StrokeStart& start) {
  if (stroke_) return;
  preview({});
  set_playing(false);
  played_last_ = false;
  stroke_depth_ = session().undo_depth();
  stroke_from_.reset();
  stroke_ticks_ = 0;
  try {
    const std::string tool = tool_line(session().document().state().tool, start.tool);
    if (!tool.empty()) {
      run_one(tool);
      --sitting_.tool_lines;
    }
    stroke_ = std::make_unique<sculpt::Stroke>(session(), start.pose, start.options);
  } catch (const Error& error) {
    say(MessageKind::error, error.what());
    drop_stroke();
  }
  changed_ = true;
}

// Of a stroke that is not to be nothing stays, its choice of tool included.
void Bench::drop_stroke() {
  stroke_.reset();
  const std::size_t depth = session().undo_depth();
  if (depth > stroke_depth_) run_one(fmt::format("undo {}", depth - stroke_depth_));
  show_all_anew();
}

void Bench::tick_stroke(const sculpt::StrokePose& device) {
  if (!stroke_) return;
  ++stroke_ticks_;
  try {
    if (!stroke_->tick(device)) return;
  } catch (const Error& error) {
    say(MessageKind::error, error.what());
    cancel_stroke();
  }
  changed_ = true;
}

StrokeNow Bench::stroke_now() const {
  const sculpt::StrokeForce force = stroke_->force();
  const sculpt::Tool& tool = session().document().state().tool;
  StrokeNow now{force.at, force.force};
  now.at_limit = force.force.norm() >= 0.999 * tool.largest_force;
  if (stroke_->reading()) {
    now.felt = stroke_->reading()->stiffness;
  } else if (stroke_from_) {
    const double way = (force.at - *stroke_from_).norm();
    if (way > 0.01 * tool.radius) now.felt = force.force.norm() / way;
  }
  return now;
}

sculpt::ContactModel Bench::felt_at(const Eigen::Vector3d& at, sculpt::Tick valid_until) const {
  sculpt::ContactModel nothing;
  nothing.point = at;
  nothing.valid_until = valid_until;
  sculpt::add_obstacle_walls(nothing, session().document(), session().document().state().tool.radius);
  return nothing;
}

void Bench::end_stroke(bool keep) {
  if (!stroke_) return;
  try {
    if (on_line) on_line();
    const std::size_t depth = session().undo_depth();
    if (stroke_ticks_ == 0) {  // pressed and let go at once
      stroke_->cancel();
      drop_stroke();
      return;
    }
    const std::string line = stroke_->finish();
    stroke_.reset();
    session().adopt_line(line);
    const double time = session().document().state().motion->time;
    sitting_.remember(line, depth, false);
    history_changed_ = true;
    sitting_.history.back().stroke_end = time;
    const bool moved =
        session().undo_depth() > depth && session().document().state().motion->velocities.squaredNorm() > 0;
    if (keep && moved) run_one("commit");
  } catch (const Error& error) {
    stroke_.reset();
    say(MessageKind::warning, error.what());
  }
  sitting_.mark_change(stroke_depth_, false);
  show_all_anew();
}

void Bench::cancel_stroke() {
  if (!stroke_) return;
  stroke_->cancel();
  drop_stroke();
  say(MessageKind::note, "the stroke was taken back");
}

}  // namespace argil::studio
