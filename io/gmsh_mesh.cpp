#include "io/gmsh_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "subdiv/cell_kinds.h"
#include "subdiv/sort_unique.h"

namespace argil::io {
namespace {

constexpr SetKind k_kinds[] = {SetKind::points, SetKind::points, SetKind::faces, SetKind::cells};
constexpr const char* k_dimension_names[] = {"point", "line", "surface", "volume"};

}  // namespace

bool GmshMesh::add_node(std::int64_t tag, const Eigen::Vector3d& position) {
  if (!nodes_.add(tag, static_cast<std::uint32_t>(positions_.size()))) return false;
  node_tags_.push_back(tag);
  positions_.push_back(position);
  return true;
}

void GmshMesh::number_nodes() {
  std::vector<std::uint32_t> order(positions_.size());
  std::iota(order.begin(), order.end(), 0U);
  if (!std::is_sorted(node_tags_.begin(), node_tags_.end())) {
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return node_tags_[a] < node_tags_[b]; });
    nodes_ = {};
    for (std::size_t i = 0; i < order.size(); ++i) nodes_.add(node_tags_[order[i]], static_cast<std::uint32_t>(i));
  }
  mesh_.cells.positions.resize(3, static_cast<Eigen::Index>(order.size()));
  for (std::size_t i = 0; i < order.size(); ++i)
    mesh_.cells.positions.col(static_cast<Eigen::Index>(i)) = positions_[order[i]];
  positions_ = {};
  node_tags_ = {};
}

bool GmshMesh::add_element(std::int64_t tag, const GmshElement& type, std::span<const std::uint32_t> nodes,
                           std::span<const std::int64_t> groups) {
  const bool cell = type.dimension == 3;
  if (!elements_.add(tag, cell ? static_cast<std::uint32_t>(cells_.size()) : k_not_a_cell)) return false;
  std::uint32_t item = 0;
  if (cell) {
    item = static_cast<std::uint32_t>(cells_.size());
    cells_.push_back({tag, static_cast<std::uint32_t>(connectivity_.size()), static_cast<std::uint8_t>(type.type)});
    connectivity_.insert(connectivity_.end(), nodes.begin(), nodes.end());
  } else if (type.dimension == 2 && !groups.empty()) {
    item = static_cast<std::uint32_t>(mesh_.faces.count());
    mesh_.faces.corners.insert(mesh_.faces.corners.end(), nodes.begin(), nodes.end());
    mesh_.faces.offsets.push_back(mesh_.faces.corners.size());
  } else if (type.dimension == 0) {
    item = nodes[0];
  } else {
    ++(type.dimension == 2 ? surfaces_ : lines_);
    return true;
  }
  for (const std::int64_t group : groups) groups_[{type.dimension, group}].push_back(item);
  return true;
}

GmshMesh::Data GmshMesh::begin_data(std::string name, int components, bool at_nodes) const {
  Data data;
  data.at_nodes = at_nodes;
  data.given.assign(item_count(at_nodes), false);
  data.field.name = std::move(name);
  data.field.components = components;
  return data;
}

bool GmshMesh::add_value(Data& data, std::int64_t tag, std::span<const double> values) const {
  const auto item = (data.at_nodes ? nodes_ : elements_).find(tag);
  if (!item) return false;
  if (*item == k_not_a_cell) return true;
  if (data.given[*item]) return false;
  // What comes in the order of the items, as nearly always, needs no room ahead of it.
  const std::size_t begin = *item * values.size();
  if (data.field.values.size() < begin + values.size()) data.field.values.resize(begin + values.size());
  std::copy(values.begin(), values.end(), data.field.values.begin() + static_cast<std::ptrdiff_t>(begin));
  data.given[*item] = true;
  ++data.count;
  return true;
}

std::size_t GmshMesh::end_data(Data data) {
  const std::size_t missing = data.given.size() - data.count;
  if (missing == 0) (data.at_nodes ? mesh_.point_fields : mesh_.cell_fields).push_back(std::move(data.field));
  return missing;
}

// The cells in the order of their tags, and the place of each as read. In version 2.2 a cell in several groups
// stands there once for each: those with the same nodes become the first of them.
std::vector<std::uint32_t> GmshMesh::cells_by_tag() {
  const std::size_t count = cells_.size();
  std::vector<std::uint32_t> same(count), order(count), number(count);
  std::iota(same.begin(), same.end(), 0U);
  std::iota(order.begin(), order.end(), 0U);
  const auto by_tag = [&](auto a, auto b) { return cells_[a].tag < cells_[b].tag; };
  if (!std::is_sorted(order.begin(), order.end(), by_tag)) std::sort(order.begin(), order.end(), by_tag);
  std::vector<std::uint32_t> grouped;
  for (const auto& [key, items] : groups_)
    if (key.first == 3) grouped.insert(grouped.end(), items.begin(), items.end());
  subdiv::sort_unique(grouped);
  const auto nodes_before = [&](std::uint32_t a, std::uint32_t b) {
    const auto left = nodes_of(cells_[a]), right = nodes_of(cells_[b]);
    return std::lexicographical_compare(left.begin(), left.end(), right.begin(), right.end());
  };
  std::sort(grouped.begin(), grouped.end(), [&](auto a, auto b) {
    if (nodes_before(a, b)) return true;
    return !nodes_before(b, a) && by_tag(a, b);
  });
  for (std::size_t i = 1; i < grouped.size(); ++i)
    if (!nodes_before(grouped[i - 1], grouped[i]) && cells_[grouped[i - 1]].type == cells_[grouped[i]].type)
      same[grouped[i]] = same[grouped[i - 1]];
  for (const std::uint32_t cell : order) {
    if (same[cell] != cell) continue;
    number[cell] = static_cast<std::uint32_t>(mesh_.cells.kinds.size());
    const auto nodes = nodes_of(cells_[cell]);
    for (const GmshCell& kind : k_gmsh_cells) {
      if (kind.type != cells_[cell].type) continue;
      mesh_.cells.kinds.push_back(kind.kind);
      const std::size_t first = mesh_.cells.connectivity.size();
      mesh_.cells.connectivity.resize(first + nodes.size());
      for (std::size_t i = 0; i < nodes.size(); ++i)
        mesh_.cells.connectivity[first + kind.vtk_from_gmsh[i]] = nodes[i];
      mesh_.cells.offsets.push_back(mesh_.cells.connectivity.size());
    }
  }
  for (std::size_t cell = 0; cell < count; ++cell) number[cell] = number[same[cell]];
  return number;
}

void GmshMesh::make_sets(const std::vector<std::uint32_t>& cell_from_read) {
  std::set<std::pair<SetKind, std::string>> used;
  for (auto& [key, items] : groups_) {
    const auto [dimension, tag] = key;
    const auto named = names_.find(key);
    NamedSet set{named != names_.end() ? named->second : fmt::format("{}_{}", k_dimension_names[dimension], tag),
                 k_kinds[dimension], std::move(items)};
    while (!used.emplace(set.kind, set.name).second) set.name += fmt::format("_{}", tag);
    if (dimension == 3)
      for (std::uint32_t& cell : set.ids) cell = cell_from_read[cell];
    subdiv::sort_unique(set.ids);
    mesh_.sets.push_back(std::move(set));
  }
}

VolumeMesh GmshMesh::finish() {
  const std::vector<std::uint32_t> cell_from_read = cells_by_tag();
  for (NamedField& field : mesh_.cell_fields) {
    const auto width = static_cast<std::size_t>(field.components);
    std::vector<double> values(mesh_.cells.cell_count() * width);
    for (std::size_t c = cells_.size(); c-- > 0;)  // of a repeated cell the first one's
      std::copy_n(field.values.begin() + static_cast<std::ptrdiff_t>(c * width), width,
                  values.begin() + static_cast<std::ptrdiff_t>(cell_from_read[c] * width));
    field.values = std::move(values);
  }
  make_sets(cell_from_read);
  if (surfaces_ + lines_ > 0)
    mesh_.notes.push_back(
        fmt::format("{} surface elements in no physical group and {} lines were passed over", surfaces_, lines_));
  return std::move(mesh_);
}

}  // namespace argil::io
