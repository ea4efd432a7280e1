#pragma once
// What a Gmsh file lists, by its own tags, before it becomes a volume mesh: cells, named surfaces and points in the
// order of their tags, with the physical groups that they are in.

#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/gmsh_elements.h"
#include "io/tag_numbers.h"
#include "io/volume_mesh.h"

namespace argil::io {

class GmshMesh {
 public:
  /// A node; false if its tag is there already.
  bool add_node(std::int64_t tag, const Eigen::Vector3d& position);
  /// All nodes are there: they get numbers in the order of their tags.
  void number_nodes();
  std::optional<std::uint32_t> node(std::int64_t tag) const { return nodes_.find(tag); }

  /// An element of a type that is known and of first order, in these physical groups of its dimension. False if its
  /// tag is there already.
  bool add_element(std::int64_t tag, const GmshElement& type, std::span<const std::uint32_t> nodes,
                   std::span<const std::int64_t> groups);
  void name_group(int dimension, std::int64_t tag, std::string name) { names_[{dimension, tag}] = std::move(name); }

  /// Values by tags of nodes or elements. False if there is none of that tag, or if it has a value already.
  struct Data {
    NamedField field;
    bool at_nodes = true;
    std::vector<bool> given;
    std::size_t count = 0;
  };
  Data begin_data(std::string name, int components, bool at_nodes) const;
  bool add_value(Data& data, std::int64_t tag, std::span<const double> values) const;
  /// How many values are missing.
  std::size_t end_data(Data data);

  std::size_t cell_count() const { return cells_.size(); }
  std::size_t item_count(bool at_nodes) const {
    return at_nodes ? static_cast<std::size_t>(mesh_.cells.positions.cols()) : cells_.size();
  }
  /// Puts everything together.
  VolumeMesh finish();

 private:
  static constexpr std::uint32_t k_not_a_cell = TagNumbers::k_none - 1;
  struct Element {
    std::int64_t tag;
    std::uint32_t first_node;
    std::uint8_t type;
  };
  std::span<const std::uint32_t> nodes_of(const Element& element) const {
    return {connectivity_.data() + element.first_node, find_gmsh_element(element.type)->nodes};
  }
  std::vector<std::uint32_t> cells_by_tag();
  void make_sets(const std::vector<std::uint32_t>& cell_from_read);

  std::vector<Eigen::Vector3d> positions_;
  std::vector<std::int64_t> node_tags_;
  TagNumbers nodes_, elements_;
  std::vector<Element> cells_;
  std::vector<std::uint32_t> connectivity_;
  std::map<std::pair<int, std::int64_t>, std::vector<std::uint32_t>> groups_;  // cells as read, faces, points
  std::map<std::pair<int, std::int64_t>, std::string> names_;
  std::size_t surfaces_ = 0, lines_ = 0;
  VolumeMesh mesh_;
};

}  // namespace argil::io
