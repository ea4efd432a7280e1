#include "io/vtk_cells.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <string_view>

#include "subdiv/cell_kinds.h"
#include "subdiv/error.h"

namespace argil::io {
namespace {

using subdiv::CellKind;

struct TypeName {
  int type;
  std::string_view name;
};
constexpr int k_polyhedron = 42, k_voxel = 11;
constexpr std::array k_refused{TypeName{1, "vertex"},
                               TypeName{2, "poly-vertex"},
                               TypeName{3, "line"},
                               TypeName{4, "poly-line"},
                               TypeName{5, "triangle"},
                               TypeName{6, "triangle strip"},
                               TypeName{7, "polygon"},
                               TypeName{8, "pixel"},
                               TypeName{9, "quadrilateral"},
                               TypeName{15, "pentagonal prism"},
                               TypeName{16, "hexagonal prism"},
                               TypeName{21, "quadratic edge"},
                               TypeName{22, "quadratic triangle"},
                               TypeName{23, "quadratic quadrilateral"},
                               TypeName{24, "quadratic tetrahedron"},
                               TypeName{25, "quadratic hexahedron"},
                               TypeName{26, "quadratic wedge"},
                               TypeName{27, "quadratic pyramid"},
                               TypeName{28, "biquadratic quadrilateral"},
                               TypeName{29, "triquadratic hexahedron"},
                               TypeName{32, "biquadratic quadratic wedge"},
                               TypeName{33, "biquadratic quadratic hexahedron"},
                               TypeName{37, "triquadratic pyramid"},
                               TypeName{41, "convex point set"},
                               TypeName{68, "Lagrange curve"},
                               TypeName{69, "Lagrange triangle"},
                               TypeName{70, "Lagrange quadrilateral"},
                               TypeName{71, "Lagrange tetrahedron"},
                               TypeName{72, "Lagrange hexahedron"},
                               TypeName{73, "Lagrange wedge"},
                               TypeName{74, "Lagrange pyramid"},
                               TypeName{78, "Bezier tetrahedron"},
                               TypeName{79, "Bezier hexahedron"},
                               TypeName{80, "Bezier wedge"},
                               TypeName{81, "Bezier pyramid"}};

[[noreturn]] void refuse_type(const VtkCells& cells, std::size_t cell) {
  const std::int64_t type = cells.types[cell];
  for (const TypeName& refused : k_refused) {
    if (refused.type != type) continue;
    const bool flat = type < 10 || (type >= 21 && type <= 23) || type == 28 || (type >= 68 && type <= 70);
    throw Error(ErrorCode::unsupported,
                fmt::format("cell {} is a {} (VTK type {}); {}", cell, refused.name, type,
                            flat ? "remove the cells that are not solid before reading the file"
                                 : "convert it to hexahedra, tetrahedra, wedges, pyramids or polyhedra"),
                cells.where_type(cell));
  }
  throw Error(
      ErrorCode::unsupported,
      fmt::format("cell {} has the unknown VTK type {}; expected 10 (tetrahedron), 11 (voxel), 12 (hexahedron), "
                  "13 (wedge), 14 (pyramid) or 42 (polyhedron)",
                  cell, type),
      cells.where_type(cell));
}

CellKind kind_of(const VtkCells& cells, std::size_t cell) {
  switch (cells.types[cell]) {
    case 10:
      return CellKind::tetrahedron;
    case 11:
    case 12:
      return CellKind::hexahedron;
    case 13:
      return CellKind::wedge;
    case 14:
      return CellKind::pyramid;
    case 42:
      return CellKind::polyhedron;
    default:
      refuse_type(cells, cell);
  }
}

// Takes cells one after another and complains with the place of the number that is wrong.
class Appender {
 public:
  Appender(const VtkCells& cells, subdiv::CellLists& lists)
      : cells_(cells), lists_(lists), points_(static_cast<std::size_t>(lists.positions.cols())) {}

  void append(std::size_t cell) {
    const CellKind kind = kind_of(cells_, cell);
    const std::size_t begin = cells_.offsets[cell], end = cells_.offsets[cell + 1];
    if (kind == CellKind::polyhedron) {
      append_stream(cell, begin, end);
    } else {
      const std::size_t expected = vertex_count(kind);
      if (end - begin != expected) {
        fail(begin, fmt::format("cell {} (VTK type {}) needs {} vertices, found {}", cell, cells_.types[cell],
                                expected, end - begin));
      }
      const std::size_t first = lists_.connectivity.size();
      for (std::size_t i = begin; i < end; ++i) append_vertex(i);
      if (cells_.types[cell] == k_voxel) {
        std::swap(lists_.connectivity[first + 2], lists_.connectivity[first + 3]);
        std::swap(lists_.connectivity[first + 6], lists_.connectivity[first + 7]);
      }
    }
    lists_.kinds.push_back(kind);
    lists_.offsets.push_back(lists_.connectivity.size());
  }

 private:
  void append_stream(std::size_t cell, std::size_t begin, std::size_t end) {
    std::size_t at = begin;
    const std::size_t faces = stream_count(cell, at, end, 4, "faces");
    for (std::size_t f = 0; f < faces; ++f) {
      const std::size_t corners = stream_count(cell, at, end, 3, "vertices of a face");
      if (corners > end - at) stream_fault(cell, at - 1, "a face is longer than what is left of the cell");
      for (std::size_t i = 0; i < corners; ++i) append_vertex(at++);
    }
    if (at != end) stream_fault(cell, at, "numbers are left after the last face");
  }

  std::size_t stream_count(std::size_t cell, std::size_t& at, std::size_t end, std::int64_t least,
                           std::string_view what) {
    if (at == end) stream_fault(cell, at, "the face stream ends early");
    const std::int64_t value = cells_.connectivity[at];
    if (value < least || value > std::int64_t{std::numeric_limits<std::int32_t>::max()}) {
      fail(at, fmt::format("polyhedron {}: expected a number of {} of at least {}, found {}", cell, what, least,
                           value));
    }
    lists_.connectivity.push_back(static_cast<std::uint32_t>(value));
    ++at;
    return static_cast<std::size_t>(value);
  }

  void append_vertex(std::size_t at) {
    const std::int64_t vertex = cells_.connectivity[at];
    if (vertex < 0 || static_cast<std::size_t>(vertex) >= points_) {
      fail(at, fmt::format("expected a vertex below {} (the number of points), found {}", points_, vertex));
    }
    lists_.connectivity.push_back(static_cast<std::uint32_t>(vertex));
  }

  [[noreturn]] void stream_fault(std::size_t cell, std::size_t at, std::string_view why) const {
    fail(at, fmt::format("polyhedron {}: {}; expected the number of faces, then for each its size and vertices",
                         cell, why));
  }
  [[noreturn]] void fail(std::size_t at, const std::string& message) const {
    throw Error(ErrorCode::bad_input, message, cells_.where_number(at));
  }

  const VtkCells& cells_;
  subdiv::CellLists& lists_;
  std::size_t points_;
};

}  // namespace

void append_vtk_cells(const VtkCells& cells, subdiv::CellLists& lists) {
  if (lists.positions.cols() > std::int64_t{std::numeric_limits<std::uint32_t>::max()}) {
    throw Error(ErrorCode::limit_exceeded, "more points than 32 bits can number; split the mesh");
  }
  Appender appender(cells, lists);
  lists.kinds.reserve(lists.kinds.size() + cells.types.size());
  lists.offsets.reserve(lists.offsets.size() + cells.types.size());
  lists.connectivity.reserve(lists.connectivity.size() + cells.connectivity.size());
  for (std::size_t c = 0; c < cells.types.size(); ++c) appender.append(c);
}

int vtk_type(CellKind kind) {
  switch (kind) {
    case CellKind::tetrahedron:
      return 10;
    case CellKind::hexahedron:
      return 12;
    case CellKind::wedge:
      return 13;
    case CellKind::pyramid:
      return 14;
    case CellKind::polyhedron:
      break;
  }
  return k_polyhedron;
}

std::string plural_name(CellKind kind) {
  switch (kind) {
    case CellKind::tetrahedron:
      return "tetrahedra";
    case CellKind::hexahedron:
      return "hexahedra";
    case CellKind::wedge:
      return "wedges";
    case CellKind::pyramid:
      return "pyramids";
    case CellKind::polyhedron:
      break;
  }
  return "polyhedra";
}

}  // namespace argil::io
