#include "io/set_fields.h"

#include <algorithm>

namespace argil::io {

std::vector<std::uint8_t> membership(const NamedSet& set, std::size_t count) {
  std::vector<std::uint8_t> values(count, 0);
  for (const std::uint32_t id : set.ids) values[id] = 1;
  return values;
}

NamedSet set_of_membership(std::string_view array, SetKind kind, const std::vector<double>& values) {
  NamedSet set{std::string(array.substr(k_set_prefix.size())), kind, {}};
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] == 1) set.ids.push_back(static_cast<std::uint32_t>(i));
  return set;
}

bool is_membership(std::string_view array, int components, const std::vector<double>& values) {
  return array.starts_with(k_set_prefix) && array.size() > k_set_prefix.size() && components == 1 &&
         std::all_of(values.begin(), values.end(), [](double value) { return value == 0 || value == 1; });
}

void take_sets_from_fields(VolumeMesh& mesh) {
  const auto take = [&](std::vector<NamedField>& fields, SetKind kind) {
    std::erase_if(fields, [&](const NamedField& field) {
      if (!is_membership(field.name, field.components, field.values)) return false;
      mesh.sets.push_back(set_of_membership(field.name, kind, field.values));
      return true;
    });
  };
  take(mesh.point_fields, SetKind::points);
  take(mesh.cell_fields, SetKind::cells);
}

}  // namespace argil::io
