#pragma once
// The probe: touches without changing, and says how stiff the body feels there (papers/004, Fig. 8b). What it reads
// is the static answer to a small force along the normal, spread over what the brush touches: with the tangent K of
// the body as it stands, pins and soft pins,
//   felt stiffness = 1 / (f · u),  K u = f,  |f| = 1,
// f · u being how far the middle of the touched part moves along the normal. A body that nothing holds is balanced
// by its own inertia: its rigid motion does not count.

#include <memory>
#include <string_view>

#include "sculpt/document.h"

namespace argil::sculpt {

inline constexpr std::string_view k_probe_tool = "probe";

struct ProbeReading {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();       // middle of what is touched [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // outwards
  double stiffness = 0;                               // [N/m]
};

class Probe {
 public:
  /// Takes the body as it stands; what is made for it is kept for all readings. Cost: a tangent and a
  /// preconditioner. The document must stay as it is while the probe is used.
  explicit Probe(const Document& document);
  ~Probe();

  /// Cost: one linear solve. @throws Error (bad_input) if nothing is within the tool's radius.
  [[nodiscard]] ProbeReading read(const Tool& tool, const Eigen::Vector3d& at, bool inside = false) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace argil::sculpt
