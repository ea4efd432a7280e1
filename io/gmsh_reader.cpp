#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <set>

#include "io/gmsh.h"
#include "io/gmsh_mesh.h"
#include "io/gmsh_numbers.h"
#include "io/text_cursor.h"

namespace argil::io {
namespace {

constexpr std::int64_t k_int = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t k_tag = std::int64_t{1} << 62;

class Reader {
 public:
  Reader(std::string_view bytes, std::string_view name) : bytes_(bytes), cursor_(bytes, name), numbers_(cursor_) {}

  VolumeMesh read() {
    read_format();
    while (!cursor_.at_end()) read_section();
    if (mesh_.cell_count() == 0) {
      throw Error(ErrorCode::bad_input,
                  have_elements_ ? "the file has no solid cells; expected tetrahedra, hexahedra, prisms or pyramids"
                                 : "expected $Nodes and $Elements, found the end; was the file cut short?",
                  cursor_.where(cursor_.offset()));
    }
    return mesh_.finish();
  }

 private:
  void read_format() {
    cursor_.keyword("$MeshFormat");
    const std::string_view version = cursor_.word("a version");
    if (version != "2.2" && version != "4.1" && version != "2" && version != "2.1") {
      cursor_.fail(fmt::format("version {} is not held; expected 4.1 or 2.2: save with Mesh.MshFileVersion = 4.1",
                               in_quotes(version)),
                   ErrorCode::unsupported);
    }
    old_ = version != "4.1";
    const bool binary = cursor_.integer("0 (text) or 1 (binary)", 0, 1) == 1;
    if (cursor_.integer("a size of numbers", 1, 64) != 8) cursor_.mismatch("the size 8 of a double");
    if (binary) {
      cursor_.end_of_line();
      const std::string_view one = cursor_.bytes(4, "the number one");
      if (one != std::string_view("\1\0\0\0", 4) && one != std::string_view("\0\0\0\1", 4)) {
        throw Error(ErrorCode::bad_input, "expected the number 1 in 4 bytes, in one of the two byte orders",
                    fmt::format("{}: byte {}", cursor_.file(), cursor_.offset() - 4));
      }
      numbers_.set_binary(one[3] == '\1');
    }
    cursor_.keyword("$EndMeshFormat");
  }

  void read_section() {
    const std::string_view word = cursor_.word("a section");
    if (word.size() < 2 || word[0] != '$') cursor_.mismatch("a section such as $Nodes");
    const std::string_view name = word.substr(1);
    const bool once = name == "PhysicalNames" || name == "Entities" || name == "Nodes" || name == "Elements";
    if (once && !seen_.insert(name).second)
      cursor_.fail(fmt::format("the section ${} stands twice; join them", name));
    if (name == "PhysicalNames") {
      read_names();
    } else if (name == "Entities" && !old_) {
      read_entities();
    } else if (name == "Nodes") {
      old_ ? read_old_nodes() : read_nodes();
      mesh_.number_nodes();
    } else if (name == "Elements") {
      if (!seen_.contains("Nodes")) cursor_.fail("expected $Nodes before $Elements");
      have_elements_ = true;
      old_ ? read_old_elements() : read_elements();
    } else if (name == "NodeData" || name == "ElementData") {
      read_data(name == "NodeData");
    } else if (name == "PartitionedEntities" || name == "ParametricNodes") {
      cursor_.fail(
          fmt::format("the section ${} is not held; save the mesh without partitions and parameters", name),
          ErrorCode::unsupported);
    } else {
      pass_over(name);
    }
    cursor_.keyword(fmt::format("$End{}", name));
  }

  void pass_over(std::string_view name) {
    constexpr std::array<std::string_view, 8> k_known{"Comments",         "Periodic",       "GhostElements",
                                                      "Parametrizations", "NodeStringTags", "InterpolationScheme",
                                                      "ElementNodeData",  "Entities"};
    if (std::find(k_known.begin(), k_known.end(), name) == k_known.end())
      cursor_.mismatch("a section of Gmsh such as $PhysicalNames, $Entities, $Nodes, $Elements, $NodeData");
    const std::size_t end = bytes_.find(fmt::format("$End{}", name), cursor_.offset());
    if (end == std::string_view::npos)
      cursor_.fail(fmt::format("expected $End{} behind it; was the file cut short?", name));
    static_cast<void>(cursor_.bytes(end - cursor_.offset(), "a section"));
  }

  // A name in quotation marks on the rest of the line.
  std::string quoted(std::string_view expected) {
    const std::string_view text = cursor_.rest_of_line();
    if (text.size() < 2 || text.front() != '"' || text.back() != '"' ||
        text.substr(1, text.size() - 2).find('"') != std::string_view::npos || text.size() > 1000)
      cursor_.mismatch(expected);
    return std::string(text.substr(1, text.size() - 2));
  }

  void read_names() {
    const std::size_t count = cursor_.count("a number of physical names", 7);
    for (std::size_t i = 0; i < count; ++i) {
      const auto dimension = static_cast<int>(cursor_.integer("a dimension", 0, 3));
      const std::int64_t tag = cursor_.integer("a tag of a physical group", 1, k_int);
      std::string name = quoted("a name in quotation marks");
      if (!name.empty()) mesh_.name_group(dimension, tag, std::move(name));
    }
  }

  // Only the physical groups of the entities matter; the sign of a tag is a direction.
  void read_entities() {
    numbers_.begin_block();
    std::array<std::size_t, 4> counts{};
    for (int d = 0; d < 4; ++d)
      counts[static_cast<std::size_t>(d)] =
          numbers_.count("a number of entities", d == 0 ? 36 : 68, d == 0 ? 5 : 9);
    for (int d = 0; d < 4; ++d) {
      for (std::size_t i = 0; i < counts[static_cast<std::size_t>(d)]; ++i) {
        const std::int64_t tag = numbers_.integer("a tag of an entity", -k_int, k_int);
        for (int k = 0; k < (d == 0 ? 3 : 6); ++k) numbers_.real("a coordinate");
        std::vector<std::int64_t> groups = integers("a number of physical groups");
        for (std::int64_t& group : groups) group = std::abs(group);
        if (d > 0) static_cast<void>(integers("a number of bounding entities"));
        entities_[{d, tag}] = std::move(groups);
      }
    }
  }

  std::vector<std::int64_t> integers(std::string_view expected) {
    std::vector<std::int64_t> values(numbers_.count(expected, 4, 1));
    for (std::int64_t& value : values) value = numbers_.integer("a tag", -k_int, k_int);
    return values;
  }

  Eigen::Vector3d position() {
    Eigen::Vector3d at;
    for (int axis = 0; axis < 3; ++axis) at[axis] = numbers_.real("a coordinate");
    return at;
  }

  void add_node(std::int64_t tag, const Eigen::Vector3d& at) {
    if (!mesh_.add_node(tag, at)) numbers_.fail(fmt::format("two nodes have the tag {}; renumber one", tag));
  }

  void check_node_count(std::size_t count) const {
    if (count >= TagNumbers::k_none - 1)
      numbers_.fail("more nodes than 32 bits can number; split the mesh", ErrorCode::limit_exceeded);
  }

  void read_old_nodes() {
    const std::size_t count = numbers_.text_count("a number of nodes", 28, 4);
    check_node_count(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t tag = numbers_.integer("a tag of a node", 1, k_int);
      add_node(tag, position());
    }
  }

  void read_nodes() {
    numbers_.begin_block();
    const std::size_t blocks = numbers_.count("a number of blocks of nodes", 20, 4);
    const std::size_t total = numbers_.count("a number of nodes", 32, 4);
    check_node_count(total);
    numbers_.long_integer("a smallest tag", 0, k_tag);
    numbers_.long_integer("a largest tag", 0, k_tag);
    std::size_t left = total;
    std::vector<std::int64_t> tags;
    for (std::size_t b = 0; b < blocks; ++b) {
      numbers_.integer("a dimension", 0, 3);
      numbers_.integer("a tag of an entity", -k_int, k_int);
      if (numbers_.integer("0 (no parameters) or 1", 0, 1) == 1)
        numbers_.fail("nodes with parameters are not held; save with Mesh.SaveParametric = 0",
                      ErrorCode::unsupported);
      const std::size_t count = numbers_.count("a number of nodes of the block", 32, 4);
      take_from(left, count, "nodes");
      tags.clear();
      for (std::size_t i = 0; i < count; ++i) tags.push_back(numbers_.long_integer("a tag of a node", 1, k_tag));
      for (std::size_t i = 0; i < count; ++i) add_node(tags[i], position());
    }
    if (left > 0) numbers_.fail(fmt::format("the blocks have {} nodes fewer than the section says", left));
  }

  void take_from(std::size_t& left, std::size_t count, std::string_view what) const {
    if (count > left)
      numbers_.fail(fmt::format("expected at most {} {} more, as the section says, found {}", left, what, count));
    left -= count;
  }

  const GmshElement& element_type() {
    const std::int64_t type = numbers_.integer("a type of element", 1, k_int);
    const GmshElement* known = find_gmsh_element(type);
    if (!known)
      numbers_.fail(fmt::format("the element type {} is unknown; expected 4 (tetrahedron), 5 (hexahedron), 6 "
                                "(prism), 7 (pyramid) or a surface, line or point",
                                type),
                    ErrorCode::unsupported);
    if (known->order != 1)
      numbers_.fail(fmt::format("a {} (Gmsh type {}) is not held; save the mesh with {}", known->name, type,
                                known->order > 1 ? "Mesh.ElementOrder = 1" : "plain cells, or polyhedra as .ovm"),
                    ErrorCode::unsupported);
    return *known;
  }

  void add_element(const GmshElement& type, std::int64_t tag, bool tags_are_long,
                   std::span<const std::int64_t> groups) {
    nodes_.clear();
    for (std::size_t i = 0; i < type.nodes; ++i) {
      const std::int64_t node =
          tags_are_long ? numbers_.long_integer("a node", 1, k_tag) : numbers_.integer("a node", 1, k_int);
      const auto number = mesh_.node(node);
      if (!number) numbers_.fail(fmt::format("expected a node of $Nodes, found {}", node));
      nodes_.push_back(*number);
    }
    // An entity in many groups, with many elements, would make much of a small file.
    members_ += groups.size();
    if (members_ > (std::size_t{1} << 20) + 8 * bytes_.size())
      numbers_.fail("the physical groups have more members than a file of this size should need; save fewer groups",
                    ErrorCode::limit_exceeded);
    if (!mesh_.add_element(tag, type, nodes_, groups))
      numbers_.fail(fmt::format("two elements have the tag {}; renumber one", tag));
  }

  // Binary: blocks of one type and number of tags. Text: each element says its own.
  void read_old_elements() {
    std::size_t left = numbers_.text_count("a number of elements", 12, 4);
    while (left > 0) {
      std::int64_t tag = 0;
      if (!numbers_.binary()) tag = numbers_.integer("a tag of an element", 1, k_int);
      const GmshElement& type = element_type();
      std::size_t count = 1;
      if (numbers_.binary()) count = static_cast<std::size_t>(numbers_.integer("a number of elements", 1, k_int));
      take_from(left, count, "elements");
      const std::int64_t tags = numbers_.integer("a number of tags", 0, 1 << 20);
      for (std::size_t i = 0; i < count; ++i) {
        if (numbers_.binary()) tag = numbers_.integer("a tag of an element", 1, k_int);
        std::int64_t group = 0;
        for (std::int64_t t = 0; t < tags; ++t) {
          const std::int64_t value = numbers_.integer("a tag", -k_int, k_int);
          if (t == 0) group = std::abs(value);
        }
        add_element(type, tag, false, {&group, group == 0 ? std::size_t{0} : std::size_t{1}});
      }
    }
  }

  void read_elements() {
    numbers_.begin_block();
    const std::size_t blocks = numbers_.count("a number of blocks of elements", 20, 4);
    std::size_t left = numbers_.count("a number of elements", 16, 2);
    numbers_.long_integer("a smallest tag", 0, k_tag);
    numbers_.long_integer("a largest tag", 0, k_tag);
    for (std::size_t b = 0; b < blocks; ++b) {
      const auto dimension = static_cast<int>(numbers_.integer("a dimension", 0, 3));
      const std::int64_t entity = numbers_.integer("a tag of an entity", -k_int, k_int);
      const GmshElement& type = element_type();
      if (type.dimension != dimension)
        numbers_.fail(fmt::format("expected a type of element of dimension {}, found a {}", dimension, type.name));
      const std::size_t count =
          numbers_.count("a number of elements of the block", 8 * (1 + type.nodes), 1 + type.nodes);
      take_from(left, count, "elements");
      const auto groups = entities_.find({dimension, entity});
      static const std::vector<std::int64_t> k_no_groups;
      for (std::size_t i = 0; i < count; ++i) {
        const std::int64_t tag = numbers_.long_integer("a tag of an element", 1, k_tag);
        add_element(type, tag, true, groups == entities_.end() ? k_no_groups : groups->second);
      }
    }
    if (left > 0) numbers_.fail(fmt::format("the blocks have {} elements fewer than the section says", left));
  }

  void read_data(bool at_nodes) {
    if (at_nodes ? !seen_.contains("Nodes") : !have_elements_)
      cursor_.fail("expected $Nodes and $Elements before their data");
    const std::size_t strings = cursor_.count("a number of string tags", 1);
    cursor_.end_of_line();
    std::string name;
    for (std::size_t i = 0; i < strings; ++i) {
      std::string text = quoted("a string in quotation marks");
      if (i == 0) name = std::move(text);
    }
    if (name.empty()) cursor_.fail("expected a name of the data as its first string tag, found none");
    const std::size_t reals = cursor_.count("a number of real tags", 2);
    for (std::size_t i = 0; i < reals; ++i) cursor_.number("a real tag");
    const std::size_t integers = cursor_.count("a number of integer tags", 2);
    if (integers < 3) cursor_.fail("expected at least 3 integer tags: time step, components, number of values");
    cursor_.integer("a time step", -k_int, k_int);
    const auto components = static_cast<int>(cursor_.integer("a number of components", 1, 1 << 16));
    const std::size_t width = static_cast<std::size_t>(components);
    std::size_t count = cursor_.count("a number of values", numbers_.binary() ? 4 + 8 * width : 2 + 2 * width);
    for (std::size_t i = 3; i < integers; ++i) cursor_.integer("an integer tag", -k_int, k_int);
    if (!data_names_.emplace(at_nodes, name).second) {
      cursor_.fail(fmt::format("the data {} stands twice; leave one time step, or rename it", in_quotes(name)),
                   ErrorCode::unsupported);
    }
    // Room is made for all of them, so that many must stand there.
    if (count < mesh_.item_count(at_nodes)) fail_incomplete(name, mesh_.item_count(at_nodes) - count, at_nodes);
    numbers_.begin_block();
    GmshMesh::Data data = mesh_.begin_data(name, components, at_nodes);
    std::vector<double> values(width);
    for (; count > 0; --count) {
      const std::int64_t tag = numbers_.integer("a tag", 1, k_int);
      for (double& value : values) value = numbers_.real("a value");
      if (!mesh_.add_value(data, tag, values))
        numbers_.fail(
            fmt::format("there is no {} {}, or it has a value already", at_nodes ? "node" : "element", tag));
    }
    if (const std::size_t missing = mesh_.end_data(std::move(data)); missing > 0)
      fail_incomplete(name, missing, at_nodes);
  }

  [[noreturn]] void fail_incomplete(std::string_view name, std::size_t missing, bool at_nodes) const {
    numbers_.fail(fmt::format("the data {} lack {} of the {}; give each a value, or remove the section",
                              in_quotes(name), missing, at_nodes ? "nodes" : "cells"));
  }

  std::string_view bytes_;
  TextCursor cursor_;
  GmshNumbers numbers_;
  GmshMesh mesh_;
  std::map<std::pair<int, std::int64_t>, std::vector<std::int64_t>> entities_;
  std::set<std::string_view> seen_;
  std::set<std::pair<bool, std::string>> data_names_;
  std::vector<std::uint32_t> nodes_;
  std::size_t members_ = 0;
  bool old_ = false, have_elements_ = false;
};

}  // namespace

VolumeMesh read_gmsh(std::string_view bytes, std::string_view name) {
  return Reader(bytes, name).read();
}

}  // namespace argil::io
