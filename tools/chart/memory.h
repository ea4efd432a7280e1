#pragma once
// Peak of the resident memory of this process, where the system tells (Linux).

#include <cstddef>

namespace argil::chart {

/// Counts from its making: freed memory is given back first and the system's peak set anew.
class PeakMemory {
 public:
  PeakMemory();
  /// Growth of the peak since then [bytes]; NaN where it is not known.
  [[nodiscard]] double growth() const;

 private:
  double start_;
};

}  // namespace argil::chart
