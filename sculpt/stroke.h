#pragma once
// One stroke of the document's tool: force, paint or probe, advanced tick by tick: by a session command (a path, a
// simulated hand) or by a window (mouse, force device), so that both give the same bits. A tool sees the device
// where simulation steps happen, at the beginning and at the end only, so that those poses are all that a journal
// line needs to repeat a stroke.

#include <optional>
#include <string>
#include <vector>

#include "sculpt/force_tools/force_tool.h"
#include "sculpt/force_tools/painting.h"
#include "sculpt/force_tools/probe.h"
#include "sculpt/haptics/contact_model.h"
#include "sculpt/session.h"

namespace argil::sculpt {

struct StrokeOptions {
  bool invert = false;         // the opposite: deflate for inflate, push for pull, …
  bool smoothing = false;      // smooth with the tool's brush, whatever the tool is
  bool scales_radius = false;  // pressure does, of a tool that goes over the body; else it scales the strength
  bool inside = false;         // hold what is inside the solid, even where its surface is within the radius
  /// Not empty: a curve through these points is held, in place of what the tool touches, and the one of place
  /// `handle` follows the device.
  std::vector<Eigen::Vector3d> curve = {};
  std::size_t handle = 0;
};

/// Adds to `model` the walls of the document's obstacles that a device at its point is in, or nearer to than
/// `reach` [m]: so that a hand meets them before it touches. At most as many as a model holds, the nearest first.
void add_obstacle_walls(ContactModel& model, const Document& document, double reach);

/// What a stroke does to the body now.
struct StrokeForce {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();      // middle of what is touched [m]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // on the body [N]
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // on the body, about `at` [N m]
};

class Stroke {
 public:
  /// Takes hold where `first` is; the present tool of the document is used to the end. One stroke at a time.
  /// @throws Error (bad_input) if nothing is within the radius; the document is unchanged.
  Stroke(Session& session, const StrokePose& first, const StrokeOptions& options = {});
  /// A stroke that was not finished is cancelled.
  ~Stroke();
  Stroke(const Stroke&) = delete;
  Stroke& operator=(const Stroke&) = delete;

  /// One device tick (1 ms): `pose` is the device now; one that is not finite counts as the last one. Takes the
  /// simulation steps that are due, and returns whether there was one. The probe reads where a step were due, and
  /// the body stands still. @throws as simulation_step, and Error (limit_exceeded) where the session has no steps
  /// left; the stroke can then be finished or cancelled.
  bool tick(const StrokePose& pose);
  /// The next tick takes a step.
  [[nodiscard]] bool step_is_due() const;

  /// What the device should feel, for the servo: about the pose of the last tick.
  [[nodiscard]] ContactModel felt(Tick valid_until) const;
  /// Where it holds, and what it does to the body at the pose of the last step: for arrows and status.
  [[nodiscard]] StrokeForce force() const;
  /// Of the probe: how stiff the body felt where a step was due last [N/m].
  const std::optional<ProbeReading>& reading() const { return reading_; }

  /// Makes all since the start one change of the session, and returns the session line that repeats it exactly:
  ///   stroke path 0 x y z 17 x y z … [turns w x y z …] [pressures p … [scales radius]] [invert] …
  ///   curve through x y z … handle I path 0 x y z …
  std::string finish();
  /// The document as it was before the stroke.
  void cancel();

 private:
  struct Station {
    Tick tick;
    StrokePose pose;
  };
  [[nodiscard]] StrokePose acting() const;
  void hold(const StrokePose& first);
  void paint();
  void take_step();
  void read();
  std::string report() const;
  std::string line() const;

  Session& session_;
  StrokeOptions options_;
  Tool tool_;
  int mirror_ = -1;  // axis that a mirror image acts along; −1: none
  double plane_ = 0;
  std::vector<std::unique_ptr<ForceTool>> tools_;  // the device's own first, then its mirror image's
  std::unique_ptr<Painting> painting_;
  std::unique_ptr<Probe> probe_;
  std::optional<ProbeReading> reading_;
  double softest_ = 0, stiffest_ = 0;  // readings so far [N/m]
  std::vector<Station> path_;          // what `line` tells
  StrokePose device_;                  // of the last tick, as it was told
  // As the tool sees it: of the last tick, the last step, the end of what is painted.
  StrokePose pose_, stepped_, painted_;
  Tick tick_ = 0;
  double pending_ = 0;                       // ticks since the last step
  double largest_ = 0, largest_moment_ = 0;  // on the body so far [N], [N m]
  std::size_t first_step_ = 0;
  bool over_ = false;
};

}  // namespace argil::sculpt
