#pragma once
// One sweep as a picture: a panel a method, coloured by outcome, as SVG. Colours can be told apart by the
// colour-blind and by their lightness, and inaccurate and diverged are hatched besides. 2/ω_max of the model's
// pencil, the limit of the explicit methods (METHODS §5), is drawn in.

#include <string>

#include "tools/atlas/atlas.h"

namespace argil::atlas {

[[nodiscard]] std::string map_svg(const Sweep& sweep, const AtlasOptions& options,
                                  const std::vector<Panel>& panels);

/// Where the step of a line's probes passes 2/ω_max, as a share of the searched axis; negative where it does not,
/// or where no limit is known.
[[nodiscard]] double limit_share(const Sweep& sweep, const MapLine& line);

}  // namespace argil::atlas
