#pragma once
// A stroke of the document's tool while the pointer draws it. The simulation advances with it tick by tick; at its
// end it is one line of the session that repeats it to the bit.

#include <Eigen/Core>
#include <string>

#include "sculpt/session.h"
#include "tools/studio/snapshot.h"

namespace argil::studio {

struct StrokeStart {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // where it takes hold [m]
  bool invert = false, smooth = false;
  double pressure = 1;
};

class StrokeLine {
 public:
  /// @throws Error (bad_input) if the tool touches nothing there; the document is unchanged.
  StrokeLine(sculpt::Session& session, const StrokeStart& start);

  /// One millisecond with the device there. Returns whether a step was taken.
  bool tick(const Eigen::Vector3d& device);
  StrokeNow now() const;
  /// The line that repeats it, which is in the session's journal then; empty if the device never moved.
  std::string finish();
  /// The document as it was before.
  void cancel() {}

 private:
  sculpt::Session* session_;
  Eigen::Vector3d from_, to_;
  long ticks_ = 0;
};

}  // namespace argil::studio
