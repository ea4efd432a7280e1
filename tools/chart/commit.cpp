#include "tools/chart/commit.h"

#include <argil_commit.h>  // made by tools/commit.cmake at every build

namespace argil::chart {

std::string_view commit() {
  return ARGIL_COMMIT;
}

}  // namespace argil::chart
