#pragma once
// A panel as SVG: error against time, both logarithmic, the Pareto front drawn and labelled, tooltips on every
// point. Colour stands for the method, marker for the space, dashes for the formulation. It follows the reader's
// light or dark theme and needs nothing outside itself.

#include <map>
#include <string>
#include <vector>

#include "tools/chart/series.h"

namespace argil::chart {

/// Colours that keep their meaning over all panels of a page, in the order of first appearance: a model with the
/// first integrator has that of the model alone. When they are used up they come again with a dot in their markers.
class Colours {
 public:
  explicit Colours(const std::vector<Panel>& panels);
  struct Look {
    const char* colour;
    bool dotted;
  };
  [[nodiscard]] Look of(const std::string& colour_name) const;

 private:
  [[nodiscard]] std::string key(const std::string& colour_name) const;

  std::string usual_;  // ", bdf2"
  std::map<std::string, std::size_t> number_;
};

[[nodiscard]] std::string escaped(const std::string& text);  // for XML

/// A whole SVG document of 1040 x 600 pixels at least (a long legend makes it higher).
[[nodiscard]] std::string picture(const Panel& panel, const Colours& colours);

}  // namespace argil::chart
