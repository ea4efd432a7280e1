#include "tools/chart/memory.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace argil::chart {

namespace {

double status_bytes(const std::string& name) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(name + ":")) return 1024.0 * std::strtod(line.c_str() + name.size() + 1, nullptr);
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

PeakMemory::PeakMemory() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
  std::ofstream("/proc/self/clear_refs") << "5";
  start_ = status_bytes("VmRSS");
}

double PeakMemory::growth() const {
  const double growth = status_bytes("VmHWM") - start_;
  return growth > 0 ? growth : (growth <= 0 ? 0.0 : growth);
}

}  // namespace argil::chart
