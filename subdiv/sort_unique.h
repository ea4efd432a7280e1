#pragma once
// A list of ids as a set: ascending, each once.

#include <algorithm>
#include <vector>

namespace argil::subdiv {

template <class Element>
void sort_unique(std::vector<Element>& elements) {
  std::sort(elements.begin(), elements.end());
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
}

}  // namespace argil::subdiv
