#pragma once
// Fields that pictures, files and measures can show, per vertex of the finest level: those of deformation and
// motion, and the document's own.

#include <span>
#include <string>
#include <vector>

#include "sculpt/document.h"
#include "sculpt/reference_shape.h"
#include "sculpt/renderer.h"

namespace argil::sculpt {

struct ShownField {
  Eigen::VectorXd values;
  std::string title, unit;
  ColourMap map = ColourMap::viridis;  // by rule: balanced where the field has a sign, cividis for material
};

/// A field of deformation or motion.
struct DerivedField {
  const char *name, *title, *unit;
  bool has_sign;
  bool wants_reference;
  const char* help;  // after "largest …": "equivalent strain"
};
[[nodiscard]] std::span<const DerivedField> derived_fields();

/// `reference` is asked only for `error`.
/// @throws Error (not_found) listing the names; (bad_input) if a reference is wanted and there is none.
[[nodiscard]] ShownField shown_field(const Document& document, const std::string& name,
                                     const ReferenceShape* reference = nullptr);
/// Derived fields, then those of the document.
[[nodiscard]] std::vector<std::string> shown_field_names();

}  // namespace argil::sculpt
