#include "io/stl.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "io/number_type.h"
#include "io/text_cursor.h"

namespace argil::io {
namespace {

constexpr std::size_t k_header = 80, k_start = k_header + 4, k_triangle = 50, k_normal = 12;

std::uint64_t declared_size(std::string_view bytes) {
  return k_start + k_triangle * decode_unsigned(bytes.data() + k_header, 4, false);
}

// Three vertices a triangle, in order, as a mesh with equal ones joined.
SurfaceMesh joined(std::vector<double> coordinates) {
  SurfaceMesh soup;
  const std::size_t vertices = coordinates.size() / 3;
  soup.positions = Eigen::Map<const Eigen::Matrix3Xd>(coordinates.data(), 3, static_cast<Eigen::Index>(vertices));
  coordinates = {};
  soup.corners.resize(vertices);
  std::iota(soup.corners.begin(), soup.corners.end(), 0U);
  soup.offsets.resize(vertices / 3 + 1);
  for (std::size_t f = 0; f < soup.offsets.size(); ++f) soup.offsets[f] = 3 * f;
  return weld(soup);
}

SurfaceMesh read_binary(std::string_view bytes, std::string_view name) {
  const std::size_t triangles = (bytes.size() - k_start) / k_triangle;
  std::vector<double> coordinates;
  coordinates.reserve(9 * triangles);
  for (std::size_t t = 0; t < triangles; ++t) {
    const std::size_t first = k_start + k_triangle * t + k_normal;
    for (std::size_t i = 0; i < 9; ++i) {
      const std::size_t at = first + 4 * i;
      const double value =
          std::bit_cast<float>(static_cast<std::uint32_t>(decode_unsigned(bytes.data() + at, 4, false)));
      if (!std::isfinite(value)) {
        throw Error(ErrorCode::bad_input,
                    fmt::format("expected a finite coordinate of triangle {}, found {}; repair the file", t, value),
                    fmt::format("{}: byte {}", name, at));
      }
      coordinates.push_back(value);
    }
  }
  return joined(std::move(coordinates));
}

class TextReader {
 public:
  TextReader(std::string_view text, std::string_view name) : cursor_(text, name) {}

  SurfaceMesh read() {
    do {
      keyword("solid");
      cursor_.rest_of_line();  // its name
      while (is(cursor_.peek(), "facet")) read_triangle();
      keyword("endsolid");
      cursor_.rest_of_line();
    } while (!cursor_.at_end());
    if (coordinates_.empty()) cursor_.fail("expected triangles (facet …), found none");
    return joined(std::move(coordinates_));
  }

 private:
  // Some programs write the keywords in capitals.
  static bool is(std::string_view word, std::string_view keyword) {
    if (word.size() != keyword.size()) return false;
    for (std::size_t i = 0; i < word.size(); ++i) {
      const char lower = word[i] >= 'A' && word[i] <= 'Z' ? static_cast<char>(word[i] - 'A' + 'a') : word[i];
      if (lower != keyword[i]) return false;
    }
    return true;
  }
  void keyword(std::string_view expected) {
    if (!is(cursor_.word(expected), expected)) cursor_.mismatch(expected);
  }
  void read_triangle() {
    keyword("facet");
    keyword("normal");
    for (int axis = 0; axis < 3; ++axis) cursor_.word("a number");  // of a triangle without area it may be nan
    keyword("outer");
    keyword("loop");
    for (int corner = 0; corner < 3; ++corner) {
      keyword("vertex");
      for (int axis = 0; axis < 3; ++axis) coordinates_.push_back(cursor_.number("a coordinate"));
    }
    keyword("endloop");
    keyword("endfacet");
  }

  TextCursor cursor_;
  std::vector<double> coordinates_;
};

template <class Bits>
void append_little_endian(std::string& bytes, Bits bits) {
  for (std::size_t i = 0; i < sizeof bits; ++i) bytes += static_cast<char>(bits >> (8 * i) & 0xFFU);
}

void append_single(std::string& bytes, const Eigen::Vector3d& vector) {
  for (int axis = 0; axis < 3; ++axis)
    append_little_endian(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(vector[axis])));
}

}  // namespace

SurfaceMesh read_stl(std::string_view bytes, std::string_view name) {
  const bool counted = bytes.size() >= k_start;
  if (counted && bytes.size() > k_start && bytes.size() == declared_size(bytes)) return read_binary(bytes, name);
  const std::size_t begin = bytes.find_first_not_of(" \t\r\n\v\f");
  const std::string_view first = begin == std::string_view::npos ? "" : bytes.substr(begin, 5);
  if (first == "solid" || first == "SOLID" || first == "Solid") return TextReader(bytes, name).read();
  if (!counted) {
    throw Error(
        ErrorCode::bad_input,
        fmt::format("expected an STL file, \"solid\" or at least 84 bytes of header, found {} bytes; was it "
                    "cut short?",
                    bytes.size()),
        fmt::format("{}: byte 0", name));
  }
  throw Error(ErrorCode::bad_input,
              declared_size(bytes) == k_start
                  ? std::string("expected triangles, found a count of 0; is this an STL file?")
                  : fmt::format("expected {} bytes for the {} triangles that a binary STL file counts here, found "
                                "{}; was it cut short, or is it another format?",
                                declared_size(bytes), (declared_size(bytes) - k_start) / k_triangle, bytes.size()),
              fmt::format("{}: byte {}", name, k_header));
}

std::string stl_bytes(const SurfaceMesh& mesh) {
  const double largest = mesh.positions.size() == 0 ? 0 : mesh.positions.cwiseAbs().maxCoeff();
  if (largest > double{std::numeric_limits<float>::max()}) {
    throw Error(ErrorCode::unsupported,
                fmt::format("STL holds single precision, which does not reach {}; write .ply", largest));
  }
  std::size_t triangles = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) triangles += mesh.face(f).size() - 2;
  if (triangles > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::unsupported, fmt::format("STL cannot count {} triangles; write .ply", triangles));
  }
  std::string bytes = "Argil, single precision";
  bytes.resize(k_header, ' ');
  append_little_endian(bytes, static_cast<std::uint32_t>(triangles));
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto corners = mesh.face(f);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
      const Eigen::Vector3d a = mesh.positions.col(corners[0]), b = mesh.positions.col(corners[i]),
                            c = mesh.positions.col(corners[i + 1]);
      const Eigen::Vector3d normal = (b - a).cross(c - a);
      const double length = normal.norm();
      append_single(bytes, length > 0 ? Eigen::Vector3d(normal / length) : Eigen::Vector3d(0, 0, 0));
      for (const Eigen::Vector3d& corner : {a, b, c}) append_single(bytes, corner);
      bytes.append(2, '\0');
    }
  }
  return bytes;
}

}  // namespace argil::io
