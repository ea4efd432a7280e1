#include "tools/studio/stroke_line.h"

#include <fmt/format.h>

#include "sculpt/force_tools/pull.h"

namespace argil::studio {

StrokeLine::StrokeLine(sculpt::Session& session, const StrokeStart& start)
    : session_(&session), from_(start.at), to_(start.at) {
  (void)sculpt::PullGrip(session.document(), session.document().state().tool, start.at);
}

bool StrokeLine::tick(const Eigen::Vector3d& device) {
  to_ = device;
  ++ticks_;
  return false;
}

StrokeNow StrokeLine::now() const {
  const sculpt::Tool& tool = session_->document().state().tool;
  StrokeNow result{from_, tool.strength * (to_ - from_)};
  result.at_limit = result.force.norm() > tool.largest_force;
  return result;
}

std::string StrokeLine::finish() {
  if (ticks_ == 0) return {};
  const std::string line = fmt::format("stroke from {} {} {} to {} {} {} ticks {}", from_.x(), from_.y(), from_.z(),
                                       to_.x(), to_.y(), to_.z(), ticks_);
  session_->run_line(line);
  return line;
}

}  // namespace argil::studio
