#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>

#include "io/gmsh.h"
#include "io/gmsh_elements.h"
#include "io/text_cursor.h"
#include "subdiv/cell_kinds.h"
#include "subdiv/error.h"

namespace argil::io {
namespace {

using subdiv::CellKind;

// Items that are in the same sets make one entity; 0 is in none.
struct Entities {
  std::vector<std::uint32_t> of_item;
  std::vector<std::vector<int>> groups{{}};  // tags of the physical groups of an entity
};

Entities entities_of(const VolumeMesh& mesh, SetKind kind, std::size_t items) {
  Entities out;
  out.of_item.assign(items, 0);
  int group = 0;
  for (const NamedSet& set : mesh.sets) {
    if (set.kind != kind) continue;
    ++group;
    std::map<std::uint32_t, std::uint32_t> with_group;
    for (const std::uint32_t id : set.ids) {
      const auto [found, added] =
          with_group.emplace(out.of_item[id], static_cast<std::uint32_t>(out.groups.size()));
      if (added) {
        out.groups.push_back(out.groups[found->first]);
        out.groups.back().push_back(group);
      }
      out.of_item[id] = found->second;
    }
  }
  return out;
}

class Writer {
 public:
  Writer(const VolumeMesh& mesh, const WriteOptions& options)
      : mesh_(mesh),
        cells_(mesh.cells),
        points_(static_cast<std::size_t>(mesh.cells.positions.cols())),
        binary_(options.encoding != Encoding::ascii),
        old_(options.version == "2.2") {}

  std::string write() {
    text_ = fmt::format("$MeshFormat\n{} {} 8\n", old_ ? "2.2" : "4.1", binary_ ? 1 : 0);
    if (binary_) {
      integer(1);
      text_ += '\n';
    }
    text_ += "$EndMeshFormat\n";
    write_names();
    of_points_ = entities_of(mesh_, SetKind::points, points_);
    of_faces_ = entities_of(mesh_, SetKind::faces, mesh_.faces.count());
    of_cells_ = entities_of(mesh_, SetKind::cells, cells_.cell_count());
    if (old_) {
      write_old();
    } else {
      write_entities();
      write_nodes();
      write_elements();
    }
    write_fields("NodeData", mesh_.point_fields, points_);
    write_fields("ElementData", mesh_.cell_fields, cells_.cell_count());
    return std::move(text_);
  }

 private:
  void integer(std::int64_t value) { put(static_cast<std::int32_t>(value)); }
  void size(std::size_t value) { put(static_cast<std::uint64_t>(value)); }
  void real(double value) { put(value); }
  template <class T>
  void put(T value) {
    if (binary_) {
      char bytes[sizeof value];
      std::memcpy(bytes, &value, sizeof value);
      text_.append(bytes, sizeof value);
    } else {
      if (!text_.empty() && text_.back() != '\n') text_ += ' ';
      if constexpr (std::is_same_v<T, double>) {
        append_number(text_, value);
      } else {
        fmt::format_to(std::back_inserter(text_), "{}", value);
      }
    }
  }
  void end_line() {
    if (!binary_) text_ += '\n';
  }
  void end_section(std::string_view name) {
    if (binary_) text_ += '\n';
    fmt::format_to(std::back_inserter(text_), "$End{}\n", name);
  }

  void write_names() {
    if (mesh_.sets.empty()) return;
    fmt::format_to(std::back_inserter(text_), "$PhysicalNames\n{}\n", mesh_.sets.size());
    int tags[3] = {0, 0, 0};
    constexpr int k_dimension[] = {0, 2, 3};
    for (const NamedSet& set : mesh_.sets) {
      const auto kind = static_cast<std::size_t>(set.kind);
      fmt::format_to(std::back_inserter(text_), "{} {} \"{}\"\n", k_dimension[kind], ++tags[kind], set.name);
    }
    text_ += "$EndPhysicalNames\n";
  }

  void groups(const std::vector<int>& tags) {
    size(tags.size());
    for (const int tag : tags) integer(tag);
  }

  // Tag of an entity: its number, of volumes one more, since cells in no set have one too.
  void write_entities() {
    text_ += "$Entities\n";
    size(of_points_.groups.size() - 1);
    size(0);
    size(of_faces_.groups.size() - 1);
    size(of_cells_.groups.size());
    end_line();
    std::vector<std::size_t> first(of_points_.groups.size(), 0);
    for (std::size_t p = points_; p-- > 0;) first[of_points_.of_item[p]] = p;
    for (std::size_t e = 1; e < of_points_.groups.size(); ++e) {
      integer(static_cast<int>(e));
      for (int axis = 0; axis < 3; ++axis) real(cells_.positions(axis, static_cast<Eigen::Index>(first[e])));
      groups(of_points_.groups[e]);
      end_line();
    }
    const Eigen::Vector3d low = cells_.positions.rowwise().minCoeff(), high = cells_.positions.rowwise().maxCoeff();
    const auto box = [&](std::size_t tag, const std::vector<int>& tags) {
      integer(static_cast<int>(tag));
      for (const Eigen::Vector3d& corner : {low, high})
        for (int axis = 0; axis < 3; ++axis) real(corner[axis]);
      groups(tags);
      size(0);
      end_line();
    };
    for (std::size_t e = 1; e < of_faces_.groups.size(); ++e) box(e, of_faces_.groups[e]);
    for (std::size_t e = 0; e < of_cells_.groups.size(); ++e) box(e + 1, of_cells_.groups[e]);
    end_section("Entities");
  }

  void write_nodes() {
    text_ += "$Nodes\n";
    for (const std::size_t number : {std::size_t{1}, points_, std::size_t{1}, points_}) size(number);
    end_line();
    for (const int number : {3, 1, 0}) integer(number);
    size(points_);
    end_line();
    for (std::size_t p = 0; p < points_; ++p) {
      size(p + 1);
      end_line();
    }
    for (std::size_t p = 0; p < points_; ++p) write_position(p);
    end_section("Nodes");
  }

  void write_position(std::size_t p) {
    for (int axis = 0; axis < 3; ++axis) real(cells_.positions(axis, static_cast<Eigen::Index>(p)));
    end_line();
  }

  template <class Put>
  void corners_of_cell(std::size_t c, Put put_corner) {
    const auto& order = gmsh_cell(cells_.kinds[c]).vtk_from_gmsh;
    for (std::size_t i = 0; i < vertex_count(cells_.kinds[c]); ++i)
      put_corner(cells_.connectivity[cells_.offsets[c] + order[i]] + std::size_t{1});
  }
  template <class Put>
  void corners_of_face(std::size_t f, Put put_corner) {
    for (std::size_t i = mesh_.faces.offsets[f]; i < mesh_.faces.offsets[f + 1]; ++i)
      put_corner(mesh_.faces.corners[i] + std::size_t{1});
  }
  int face_type(std::size_t f) const { return mesh_.faces.offsets[f + 1] - mesh_.faces.offsets[f] == 3 ? 2 : 3; }

  struct Block {
    int dimension, entity, type;
    friend auto operator<=>(const Block&, const Block&) = default;
  };

  void write_elements() {
    std::map<Block, std::vector<std::size_t>> blocks;
    for (std::size_t p = 0; p < points_; ++p)
      if (of_points_.of_item[p] > 0) blocks[{0, static_cast<int>(of_points_.of_item[p]), 15}].push_back(p);
    for (std::size_t f = 0; f < mesh_.faces.count(); ++f)
      if (of_faces_.of_item[f] > 0) blocks[{2, static_cast<int>(of_faces_.of_item[f]), face_type(f)}].push_back(f);
    for (std::size_t c = 0; c < cells_.cell_count(); ++c)
      blocks[{3, static_cast<int>(of_cells_.of_item[c]) + 1, gmsh_cell(cells_.kinds[c]).type}].push_back(c);
    std::size_t total = 0, tag = cells_.cell_count();
    for (const auto& [block, items] : blocks) total += items.size();
    text_ += "$Elements\n";
    for (const std::size_t number : {blocks.size(), total, std::size_t{1}, total}) size(number);
    end_line();
    const auto put_corner = [&](std::size_t node) { size(node); };
    for (const auto& [block, items] : blocks) {
      for (const int number : {block.dimension, block.entity, block.type}) integer(number);
      size(items.size());
      end_line();
      for (const std::size_t item : items) {
        size(block.dimension == 3 ? item + 1 : ++tag);  // cells keep their order by their tags
        if (block.dimension == 0) put_corner(item + 1);
        if (block.dimension == 2) corners_of_face(item, put_corner);
        if (block.dimension == 3) corners_of_cell(item, put_corner);
        end_line();
      }
    }
    end_section("Elements");
  }

  // Version 2.2: an element names one physical group, so it stands once for each.
  void write_old() {
    fmt::format_to(std::back_inserter(text_), "$Nodes\n{}\n", points_);
    for (std::size_t p = 0; p < points_; ++p) {
      integer(static_cast<std::int64_t>(p + 1));
      write_position(p);
    }
    end_section("Nodes");
    std::size_t total = cells_.cell_count();
    for (const NamedSet& set : mesh_.sets) total += set.kind == SetKind::cells ? 0 : set.ids.size();
    for (std::size_t c = 0; c < cells_.cell_count(); ++c) {
      const std::size_t in = of_cells_.groups[of_cells_.of_item[c]].size();
      total += in > 1 ? in - 1 : 0;
    }
    fmt::format_to(std::back_inserter(text_), "$Elements\n{}\n", total);
    std::int64_t tag = 0;
    const auto put_corner = [&](std::size_t node) { integer(static_cast<std::int64_t>(node)); };
    const auto head = [&](int type, int group, int entity) {
      if (binary_) {
        for (const int number : {type, 1, 2}) integer(number);
        integer(++tag);
      } else {
        integer(++tag);
        integer(type);
        integer(2);
      }
      integer(group);
      integer(entity);
    };
    const auto put_cell = [&](std::size_t c, int group) {
      head(gmsh_cell(cells_.kinds[c]).type, group, static_cast<int>(of_cells_.of_item[c]) + 1);
      corners_of_cell(c, put_corner);
      end_line();
    };
    for (std::size_t c = 0; c < cells_.cell_count(); ++c) {
      const auto& in = of_cells_.groups[of_cells_.of_item[c]];
      put_cell(c, in.empty() ? 0 : in[0]);
    }
    for (std::size_t c = 0; c < cells_.cell_count(); ++c) {
      const auto& in = of_cells_.groups[of_cells_.of_item[c]];
      for (std::size_t i = 1; i < in.size(); ++i) {
        put_cell(c, in[i]);
        repeated_.push_back(c);
      }
    }
    for (std::size_t f = 0; f < mesh_.faces.count(); ++f)
      for (const int group : of_faces_.groups[of_faces_.of_item[f]]) {
        head(face_type(f), group, static_cast<int>(of_faces_.of_item[f]));
        corners_of_face(f, put_corner);
        end_line();
      }
    for (std::size_t p = 0; p < points_; ++p)
      for (const int group : of_points_.groups[of_points_.of_item[p]]) {
        head(15, group, static_cast<int>(of_points_.of_item[p]));
        put_corner(p + 1);
        end_line();
      }
    end_section("Elements");
  }

  void write_fields(std::string_view section, const std::vector<NamedField>& fields, std::size_t items) {
    const bool cells = section == "ElementData";
    for (const NamedField& field : fields) {
      fmt::format_to(std::back_inserter(text_), "${}\n1\n\"{}\"\n1\n0\n3\n0\n{}\n{}\n", section, field.name,
                     field.components, items + (cells ? repeated_.size() : 0));
      const auto put_values = [&, width = static_cast<std::size_t>(field.components)](std::size_t tag,
                                                                                      std::size_t item) {
        integer(static_cast<std::int64_t>(tag));
        for (std::size_t k = 0; k < width; ++k) real(field.values[item * width + k]);
        end_line();
      };
      for (std::size_t i = 0; i < items; ++i) put_values(i + 1, i);
      for (std::size_t i = 0; cells && i < repeated_.size(); ++i) put_values(items + i + 1, repeated_[i]);
      end_section(section);
    }
  }

  const VolumeMesh& mesh_;
  const subdiv::CellLists& cells_;
  std::size_t points_;
  bool binary_, old_;
  Entities of_points_, of_faces_, of_cells_;
  std::vector<std::size_t> repeated_;  // cells that stand once more in version 2.2, in the order of their tags
  std::string text_;
};

}  // namespace

bool gmsh_holds_field(const NamedField& field) {
  return (field.components == 1 || field.components == 3 || field.components == 9) &&
         field.name.find_first_of("\"\n\r") == std::string::npos;
}

std::string gmsh_bytes(const VolumeMesh& mesh, const WriteOptions& options) {
  const auto& kinds = mesh.cells.kinds;
  const auto polyhedron = std::find(kinds.begin(), kinds.end(), CellKind::polyhedron);
  if (polyhedron != kinds.end())
    throw Error(ErrorCode::unsupported, "Gmsh cannot hold polyhedra; write .vtu, .vtk or .ovm",
                fmt::format("cell {}", polyhedron - kinds.begin()));
  for (const auto* fields : {&mesh.point_fields, &mesh.cell_fields})
    for (const NamedField& field : *fields)
      if (!gmsh_holds_field(field))
        throw Error(ErrorCode::unsupported,
                    fmt::format("Gmsh cannot hold the field {} of {} components, only 1, 3 or 9 and a name without "
                                "quotation marks; write .vtu, or leave the field out",
                                in_quotes(field.name), field.components));
  // Version 2.2, fields and binary tags count with 32 bits.
  if (mesh.cells.positions.cols() > 2'000'000'000 || mesh.cells.cell_count() > 2'000'000'000)
    throw Error(ErrorCode::limit_exceeded, "more points or cells than Gmsh's 32 bits can number; split the mesh");
  return Writer(mesh, options).write();
}

}  // namespace argil::io
