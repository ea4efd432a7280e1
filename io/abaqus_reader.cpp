#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "io/abaqus.h"
#include "io/abaqus_lines.h"
#include "io/tag_numbers.h"
#include "subdiv/cell_kinds.h"
#include "subdiv/sort_unique.h"

namespace argil::io {
namespace {

using subdiv::CellKind;

constexpr std::uint32_t k_flat = TagNumbers::k_none - 1;  // an element that is passed over

struct ElementType {
  std::size_t nodes = 0;  // 0: flat, passed over
  CellKind kind = CellKind::tetrahedron;
};

constexpr std::array<std::string_view, 24> k_flat_prefixes{
    "CPS", "CPE", "CAX", "CGAX", "M3D", "SFM3D", "R2D2", "R3D", "RAX2", "STRI",   "T2D",     "T3D",
    "B21", "B22", "B31", "B32",  "S3",  "S4",    "S6",   "S8",  "MASS", "SPRING", "DASHPOT", "ROTARYI"};
constexpr std::array<std::string_view, 10> k_refused_keywords{
    "INCLUDE", "NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM", "IMPORT", "SUBSTRUCTURE GENERATE"};

// One *NSET or *ELSET, all blocks of that name together.
struct SetLines {
  std::string name;  // as first written
  SetKind kind;
  std::vector<std::uint32_t> ids;
};

class Reader {
 public:
  Reader(std::string_view text, std::string_view name) : lines_(text, name), size_(text.size()) {}

  VolumeMesh read() {
    bool more = lines_.next();
    if (more && !lines_.is_keyword())
      lines_.fail(lines_.offset(), "expected a keyword such as *HEADING or *NODE at the beginning");
    while (more) more = read_keyword();
    if (elements_.empty())
      lines_.fail(size_,
                  "the file has no solid cells; expected *ELEMENT with a TYPE such as C3D8; was it cut short?");
    number();
    make_cells();
    make_sets();
    if (flat_ > 0) mesh_.notes.push_back(fmt::format("{} elements that are not solid were passed over", flat_));
    return std::move(mesh_);
  }

 private:
  struct Element {
    std::int64_t tag;
    std::size_t first_node, offset;
    CellKind kind;
  };
  struct SetLine {
    SetKind kind;
    std::string name;
    std::size_t offset;
    bool generate;
    std::vector<AbaqusField> fields;
    std::int64_t own_tag = 0;  // > 0: of a node or element that names its set itself
  };

  // Reads a keyword and its data lines; false at the end of the file.
  bool read_keyword() {
    const std::string keyword = lines_.keyword();
    const std::size_t offset = lines_.offset();
    if (std::find(k_refused_keywords.begin(), k_refused_keywords.end(), keyword) != k_refused_keywords.end()) {
      lines_.fail(offset, fmt::format("*{} is not held; write nodes, elements and sets out in one file", keyword),
                  ErrorCode::unsupported);
    }
    if (keyword == "NODE") return read_nodes();
    if (keyword == "ELEMENT") return read_elements();
    if (keyword == "NSET" || keyword == "ELSET") return read_set(keyword);
    if (keyword == "PART" || keyword == "INSTANCE") {
      int& count = keyword == "PART" ? parts_ : instances_;
      if (++count > 1)
        lines_.fail(offset, fmt::format("a second *{} is not held; save each part in a file of its own", keyword),
                    ErrorCode::unsupported);
    }
    while (lines_.next()) {
      if (lines_.is_keyword()) return true;
      if (keyword == "INSTANCE")
        lines_.fail(lines_.offset(), "an *INSTANCE that is moved is not held; move its nodes instead",
                    ErrorCode::unsupported);
    }
    return false;
  }

  void refuse_parameter(std::string_view name, std::string_view why) {
    if (const AbaqusField* field = lines_.parameter(name))
      lines_.fail(field->offset, fmt::format("the parameter {} is not held; {}", name, why),
                  ErrorCode::unsupported);
  }

  std::optional<std::string> set_name(std::string_view parameter) {
    const AbaqusField* field = lines_.parameter(parameter);
    if (!field) return std::nullopt;
    std::string_view name = field->text;
    if (name.size() >= 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
    if (name.empty() || name.size() > 80)
      lines_.fail(field->offset,
                  fmt::format("expected a name of a set of 1 to 80 characters, found {}", in_quotes(name)));
    return std::string(name);
  }

  bool read_nodes() {
    refuse_parameter("INPUT", "write the nodes into this file");
    if (const AbaqusField* system = lines_.parameter("SYSTEM"); system && in_capitals(system->text) != "R")
      refuse_parameter("SYSTEM", "write rectangular coordinates");
    const auto set = set_name("NSET");
    const std::size_t head = lines_.offset();
    while (lines_.next()) {
      if (lines_.is_keyword()) return true;
      const auto& fields = lines_.fields();
      const std::int64_t tag = lines_.integer(fields[0], "a number of a node");
      if (node_tags_.size() >= k_flat)
        lines_.fail(lines_.offset(), "more nodes than 32 bits can number; split the mesh",
                    ErrorCode::limit_exceeded);
      if (!nodes_.add(tag, static_cast<std::uint32_t>(node_tags_.size())))
        lines_.fail(fields[0].offset, fmt::format("node {} stands twice; remove one", tag));
      node_tags_.push_back(tag);
      Eigen::Vector3d at = Eigen::Vector3d::Zero();
      for (std::size_t axis = 0; axis < 3 && axis + 1 < fields.size(); ++axis)
        at[static_cast<Eigen::Index>(axis)] = lines_.number(fields[axis + 1], "a coordinate");
      positions_.push_back(at);
      if (set) set_lines_.push_back({SetKind::points, *set, head, false, {}, tag});
    }
    return false;
  }

  ElementType element_type() {
    const AbaqusField* field = lines_.parameter("TYPE");
    if (!field || field->text.empty())
      lines_.fail(lines_.offset(), "expected a TYPE for *ELEMENT, such as TYPE=C3D8, found none");
    const std::string type = in_capitals(field->text);
    for (const std::string_view prefix : k_flat_prefixes)
      if (type.starts_with(prefix)) return {};
    std::string_view rest = type;
    if (rest.starts_with("C3D")) {
      rest = rest.substr(3);
      const std::size_t digits = std::min(rest.find_first_not_of("0123456789"), rest.size());
      const std::string_view count = rest.substr(0, digits), variant = rest.substr(digits);
      if (variant.find_first_not_of("RHITSPEV") == std::string_view::npos) {
        if (count == "4") return {4, CellKind::tetrahedron};
        if (count == "5") return {5, CellKind::pyramid};
        if (count == "6") return {6, CellKind::wedge};
        if (count == "8") return {8, CellKind::hexahedron};
        if (count == "10" || count == "13" || count == "15" || count == "20" || count == "27")
          lines_.fail(
              field->offset,
              fmt::format("the curved element {} is not held; convert it to C3D4, C3D5, C3D6 or C3D8", type),
              ErrorCode::unsupported);
      }
    }
    lines_.fail(field->offset,
                fmt::format("the element type {} is unknown; expected C3D4, C3D5, C3D6, C3D8 or a variant of them",
                            in_quotes(field->text)),
                ErrorCode::unsupported);
  }

  bool read_elements() {
    refuse_parameter("INPUT", "write the elements into this file");
    refuse_parameter("FILE", "write the elements into this file");
    const ElementType type = element_type();
    const auto set = set_name("ELSET");
    const std::size_t head = lines_.offset();
    bool more = lines_.next();
    while (more && !lines_.is_keyword()) {
      const AbaqusField first = lines_.fields()[0];
      const std::int64_t tag = lines_.integer(first, "a number of an element");
      const auto number = type.nodes == 0 ? k_flat : static_cast<std::uint32_t>(elements_.size());
      if (!cells_.add(tag, number))
        lines_.fail(first.offset, fmt::format("element {} stands twice; remove one", tag));
      if (set) set_lines_.push_back({SetKind::cells, *set, head, false, {}, tag});
      if (type.nodes == 0) {
        ++flat_;
        bool goes_on = lines_.ends_with_comma();
        for (more = lines_.next(); more && !lines_.is_keyword() && goes_on; more = lines_.next())
          goes_on = lines_.ends_with_comma();
        continue;
      }
      elements_.push_back({tag, connectivity_.size(), first.offset, type.kind});
      more = read_corners(type.nodes, tag);
    }
    return more;
  }

  // The corners of an element go on from line to line until there are enough.
  bool read_corners(std::size_t count, std::int64_t tag) {
    std::size_t read = 0;
    for (std::size_t at = 1;; at = 0) {
      const auto& fields = lines_.fields();
      for (; at < fields.size(); ++at, ++read) {
        if (read == count)
          lines_.fail(fields[at].offset, fmt::format("element {} has {} corners, found one more", tag, count));
        connectivity_.push_back(lines_.integer(fields[at], "a number of a node"));
      }
      const bool more = lines_.next();
      if (read == count) return more;
      if (!more || lines_.is_keyword())
        lines_.fail(lines_.offset(), fmt::format("expected {} corners for element {}, found {}", count, tag, read));
    }
  }

  bool read_set(const std::string& keyword) {
    const SetKind kind = keyword == "NSET" ? SetKind::points : SetKind::cells;
    const std::size_t offset = lines_.offset();
    const auto name = set_name(keyword);
    if (!name) lines_.fail(offset, fmt::format("expected a name for *{}: {}=NAME, found none", keyword, keyword));
    if (kind == SetKind::points) refuse_parameter("ELSET", "list the nodes of the set");
    const bool generate = lines_.parameter("GENERATE") != nullptr;
    set_lines_.push_back({kind, *name, offset, generate, {}});  // empty sets too
    while (lines_.next()) {
      if (lines_.is_keyword()) return true;
      set_lines_.push_back({kind, *name, lines_.offset(), generate, lines_.fields()});
    }
    return false;
  }

  // Points and cells are numbered in the order of their tags.
  void number() {
    std::vector<std::uint32_t> order(node_tags_.size());
    std::iota(order.begin(), order.end(), 0U);
    if (!std::is_sorted(node_tags_.begin(), node_tags_.end())) {
      std::sort(order.begin(), order.end(), [&](auto a, auto b) { return node_tags_[a] < node_tags_[b]; });
      nodes_ = {};
      for (std::size_t i = 0; i < order.size(); ++i)
        nodes_.add(node_tags_[order[i]], static_cast<std::uint32_t>(i));
    }
    mesh_.cells.positions.resize(3, static_cast<Eigen::Index>(order.size()));
    for (std::size_t i = 0; i < order.size(); ++i)
      mesh_.cells.positions.col(static_cast<Eigen::Index>(i)) = positions_[order[i]];
    const auto by_tag = [](const Element& a, const Element& b) { return a.tag < b.tag; };
    cell_from_read_.resize(elements_.size());
    std::vector<std::uint32_t> read(elements_.size());
    std::iota(read.begin(), read.end(), 0U);
    if (!std::is_sorted(elements_.begin(), elements_.end(), by_tag))
      std::sort(read.begin(), read.end(), [&](auto a, auto b) { return elements_[a].tag < elements_[b].tag; });
    for (std::size_t c = 0; c < read.size(); ++c) cell_from_read_[read[c]] = static_cast<std::uint32_t>(c);
    std::vector<Element> sorted;
    sorted.reserve(read.size());
    for (const std::uint32_t e : read) sorted.push_back(elements_[e]);
    elements_ = std::move(sorted);
  }

  void make_cells() {
    auto& cells = mesh_.cells;
    for (const Element& element : elements_) {
      const std::size_t count = vertex_count(element.kind), first = cells.connectivity.size();
      cells.connectivity.resize(first + count);
      for (std::size_t i = 0; i < count; ++i) {
        const std::int64_t tag = connectivity_[element.first_node + i];
        const auto node = nodes_.find(tag);
        if (!node) lines_.fail(element.offset, fmt::format("element {}: there is no node {}", element.tag, tag));
        constexpr std::array<std::size_t, 6> k_vtk_wedge{0, 2, 1, 3, 5, 4};
        cells.connectivity[first + (element.kind == CellKind::wedge ? k_vtk_wedge[i] : i)] = *node;
      }
      cells.kinds.push_back(element.kind);
      cells.offsets.push_back(cells.connectivity.size());
    }
  }

  void add_member(std::vector<std::uint32_t>& ids, SetKind kind, std::int64_t tag, std::size_t offset) {
    const auto number = (kind == SetKind::points ? nodes_ : cells_).find(tag);
    if (!number)
      lines_.fail(offset, fmt::format("there is no {} {}", kind == SetKind::points ? "node" : "element", tag));
    if (*number == k_flat) return;
    ids.push_back(kind == SetKind::points ? *number : cell_from_read_[*number]);
  }

  // Lists that a small file blows up are refused.
  void check_members(std::size_t more, std::size_t offset) {
    members_ += more;
    if (members_ > (std::size_t{1} << 20) + 8 * size_)
      lines_.fail(offset, "the sets have more members than a file of this size should need; write fewer sets",
                  ErrorCode::limit_exceeded);
  }

  void add_range(SetLines& set, const SetLine& line) {
    const auto& fields = line.fields;
    if (fields.size() < 2 || fields.size() > 3)
      lines_.fail(line.offset, "expected first, last and step of a range (GENERATE)");
    const std::int64_t first = lines_.integer(fields[0], "a number"), last = lines_.integer(fields[1], "a number"),
                       step = fields.size() == 3 ? lines_.integer(fields[2], "a step") : 1;
    if (last < first) lines_.fail(fields[1].offset, fmt::format("expected a last number of at least {}", first));
    const auto steps = static_cast<std::uint64_t>((last - first) / step);
    if (steps >= (set.kind == SetKind::points ? nodes_ : cells_).size())
      lines_.fail(fields[0].offset, fmt::format("the range has {} numbers, more than there are", steps + 1));
    check_members(steps + 1, line.offset);
    for (std::int64_t tag = first; tag <= last; tag += step) add_member(set.ids, set.kind, tag, fields[0].offset);
  }

  void add_line(SetLines& set, const SetLine& line,
                const std::map<std::pair<SetKind, std::string>, std::size_t>& known,
                const std::vector<SetLines>& sets) {
    if (line.own_tag > 0) return add_member(set.ids, set.kind, line.own_tag, line.offset);
    if (line.generate && !line.fields.empty()) return add_range(set, line);
    check_members(line.fields.size(), line.offset);
    for (const AbaqusField& field : line.fields) {
      const bool number = !field.text.empty() && field.text[0] >= '0' && field.text[0] <= '9';
      if (number) {
        add_member(set.ids, set.kind, lines_.integer(field, "a number"), field.offset);
        continue;
      }
      const auto other = known.find({set.kind, in_capitals(field.text)});
      if (other == known.end() || &sets[other->second] == &set)
        lines_.fail(field.offset, fmt::format("expected a number or the name of a set before this one, found {}",
                                              in_quotes(field.text)));
      const auto& ids = sets[other->second].ids;
      check_members(ids.size(), field.offset);
      set.ids.insert(set.ids.end(), ids.begin(), ids.end());
    }
  }

  void make_sets() {
    std::map<std::pair<SetKind, std::string>, std::size_t> known;
    std::vector<SetLines> sets;
    const SetLine* before = nullptr;
    std::size_t at = 0;
    for (const SetLine& line : set_lines_) {
      if (!before || before->kind != line.kind || before->name != line.name) {
        const auto [found, added] = known.try_emplace({line.kind, in_capitals(line.name)}, sets.size());
        if (added) sets.push_back({line.name, line.kind, {}});
        at = found->second;
      }
      before = &line;
      add_line(sets[at], line, known, sets);
    }
    for (SetLines& set : sets) {
      subdiv::sort_unique(set.ids);
      mesh_.sets.push_back({set.name, set.kind, std::move(set.ids)});
    }
  }

  AbaqusLines lines_;
  std::size_t size_, flat_ = 0, members_ = 0;
  int parts_ = 0, instances_ = 0;
  TagNumbers nodes_, cells_;
  std::vector<std::int64_t> node_tags_, connectivity_;
  std::vector<Eigen::Vector3d> positions_;
  std::vector<Element> elements_;
  std::vector<std::uint32_t> cell_from_read_;
  std::vector<SetLine> set_lines_;
  VolumeMesh mesh_;
};

}  // namespace

VolumeMesh read_abaqus(std::string_view text, std::string_view name) {
  return Reader(text, name).read();
}

}  // namespace argil::io
