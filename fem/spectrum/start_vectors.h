#pragma once
// Numbers without pattern in (−1, 1), the same ones every time: where iterations for eigenvalues start, so that no
// direction is left out.

#include <cstdint>

namespace argil::fem {

class StartVectors {
 public:
  double next() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(static_cast<std::int64_t>(state_) >> 11) * 0x1p-52;
  }

 private:
  std::uint64_t state_ = 0x9e3779b97f4a7c15ULL;
};

}  // namespace argil::fem
