#include "io/ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "io/number_type.h"
#include "io/text_cursor.h"

namespace argil::io {
namespace {

using Kind = NumberType::Kind;

struct NamedType {
  std::string_view name;
  NumberType type;
};
constexpr std::array<NamedType, 16> k_types{{{"char", {Kind::signed_integer, 1}},
                                             {"int8", {Kind::signed_integer, 1}},
                                             {"uchar", {Kind::unsigned_integer, 1}},
                                             {"uint8", {Kind::unsigned_integer, 1}},
                                             {"short", {Kind::signed_integer, 2}},
                                             {"int16", {Kind::signed_integer, 2}},
                                             {"ushort", {Kind::unsigned_integer, 2}},
                                             {"uint16", {Kind::unsigned_integer, 2}},
                                             {"int", {Kind::signed_integer, 4}},
                                             {"int32", {Kind::signed_integer, 4}},
                                             {"uint", {Kind::unsigned_integer, 4}},
                                             {"uint32", {Kind::unsigned_integer, 4}},
                                             {"float", {Kind::floating, 4}},
                                             {"float32", {Kind::floating, 4}},
                                             {"double", {Kind::floating, 8}},
                                             {"float64", {Kind::floating, 8}}}};

struct Property {
  std::string_view name;
  NumberType type;
  std::optional<NumberType> count;  // of a list
};
struct Element {
  std::string_view name;
  std::size_t count = 0, count_at = 0;  // and where it stands
  std::vector<Property> properties;
};
enum class Encoding { ascii, little_endian, big_endian };

class Reader {
 public:
  Reader(std::string_view bytes, std::string_view name) : cursor_(bytes, name), name_(name) {}

  SurfaceMesh read() {
    read_header();
    for (const Element& element : elements_) {
      check_count(element);
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else {
        for (std::size_t i = 0; i < element.count && !element.properties.empty(); ++i)
          for (const Property& property : element.properties) pass_over(property);
      }
    }
    if (encoding_ == Encoding::ascii) {
      cursor_.finish();
    } else if (cursor_.remaining() > 0) {
      fault(cursor_.offset(),
            fmt::format("expected the end of the file, found {} more bytes; do the counts and the "
                        "types in the header fit?",
                        cursor_.remaining()));
    }
    if (mesh_.corners.empty()) fault(cursor_.offset(), "expected faces, found none; a surface has some");
    if (highest_ >= mesh_.positions.cols()) check_vertex(highest_, highest_at_);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fault(std::size_t at, const std::string& message) const {
    throw Error(ErrorCode::bad_input, message,
                encoding_ == Encoding::ascii ? cursor_.where(at) : fmt::format("{}: byte {}", name_, at));
  }

  void read_header() {
    cursor_.keyword("ply");
    cursor_.end_of_line();
    cursor_.keyword("format");
    const std::string_view format = cursor_.word("ascii, binary_little_endian or binary_big_endian");
    if (format == "binary_little_endian") {
      encoding_ = Encoding::little_endian;
    } else if (format == "binary_big_endian") {
      encoding_ = Encoding::big_endian;
    } else if (format != "ascii") {
      cursor_.mismatch("ascii, binary_little_endian or binary_big_endian");
    }
    cursor_.keyword("1.0");
    cursor_.end_of_line();
    const Encoding found = encoding_;
    encoding_ = Encoding::ascii;  // as the header is
    while (read_header_line()) {
    }
    for (const std::string_view needed : {"vertex", "face"}) {
      const auto same = [&](const Element& e) { return e.name == needed; };
      const auto count = std::count_if(elements_.begin(), elements_.end(), same);
      if (count == 1) continue;
      const bool strips =
          std::any_of(elements_.begin(), elements_.end(), [](const Element& e) { return e.name == "tristrips"; });
      if (strips) cursor_.fail("triangle strips are not held; convert them to faces", ErrorCode::unsupported);
      cursor_.fail(fmt::format("expected one element {} in the header, found {}", needed, count));
    }
    encoding_ = found;
  }

  bool read_header_line() {
    const std::string_view keyword = cursor_.word("element, property, comment or end_header");
    if (keyword == "comment" || keyword == "obj_info") {
      cursor_.rest_of_line();
      return true;
    }
    if (keyword == "element") {
      Element& element = elements_.emplace_back();
      element.name = cursor_.word("the name of an element");
      element.count = static_cast<std::size_t>(cursor_.integer("a number of items", 0, INT64_MAX));
      element.count_at = cursor_.word_offset();
    } else if (keyword == "property") {
      if (elements_.empty()) cursor_.fail("expected an element before its properties");
      Property property;
      if (cursor_.peek() == "list") {
        cursor_.word("list");
        property.count = read_type();
        if (property.count->kind == Kind::floating) cursor_.mismatch("an integer type for the length of a list");
      }
      property.type = read_type();
      property.name = cursor_.word("the name of a property");
      elements_.back().properties.push_back(property);
    } else if (keyword != "end_header") {
      cursor_.mismatch("element, property, comment or end_header");
    }
    cursor_.end_of_line();
    return keyword != "end_header";
  }

  NumberType read_type() {
    const std::string_view word = cursor_.word("a number type");
    for (const NamedType& named : k_types)
      if (named.name == word) return named.type;
    cursor_.mismatch("a number type (char uchar short ushort int uint float double)");
  }

  // So that the count can be trusted for an allocation and a loop.
  void check_count(const Element& element) {
    std::size_t least = 0;
    for (const Property& property : element.properties)
      least += encoding_ == Encoding::ascii ? 2 : property.count ? property.count->bytes : property.type.bytes;
    // The last number of a text needs no blank after it.
    if (least == 0 || element.count <= (cursor_.remaining() + 1) / least) return;
    throw Error(
        ErrorCode::bad_input,
        fmt::format("expected items of the element {} that the {} bytes after the header can hold, found {}; "
                    "was the file cut short?",
                    in_quotes(element.name), cursor_.remaining(), element.count),
        cursor_.where(element.count_at));
  }

  double number(NumberType type, std::string_view expected) {
    if (encoding_ == Encoding::ascii) return cursor_.number(expected);
    if (type.kind != Kind::floating) return static_cast<double>(integer(type, expected));
    const std::size_t at = cursor_.offset();
    const std::string_view taken = cursor_.bytes(type.bytes, expected);
    const std::uint64_t bits = decode_unsigned(taken.data(), type.bytes, encoding_ == Encoding::big_endian);
    const double value =
        type.bytes == 4 ? std::bit_cast<float>(static_cast<std::uint32_t>(bits)) : std::bit_cast<double>(bits);
    if (!std::isfinite(value)) fault(at, fmt::format("expected {} that is finite, found {}", expected, value));
    return value;
  }

  std::int64_t integer(NumberType type, std::string_view expected) {
    if (encoding_ == Encoding::ascii) {
      const std::int64_t value = cursor_.integer(expected, -k_most, k_most);
      number_at_ = cursor_.word_offset();
      return value;
    }
    number_at_ = cursor_.offset();
    const std::string_view taken = cursor_.bytes(type.bytes, expected);
    const std::uint64_t bits = decode_unsigned(taken.data(), type.bytes, encoding_ == Encoding::big_endian);
    if (type.kind == Kind::unsigned_integer) return static_cast<std::int64_t>(bits);
    const auto unused = static_cast<unsigned>(64 - 8 * type.bytes);
    return static_cast<std::int64_t>(bits << unused) >> unused;
  }

  std::size_t list_length(const Property& property) {
    const std::int64_t length = integer(*property.count, "the length of a list");
    const std::size_t each = encoding_ == Encoding::ascii ? 2 : property.type.bytes;
    if (length < 0 || static_cast<std::size_t>(length) > (cursor_.remaining() + 1) / each)
      fault(number_at_, fmt::format("expected the length of a list that the {} bytes left can hold, found {}; was "
                                    "the file cut short?",
                                    cursor_.remaining(), length));
    return static_cast<std::size_t>(length);
  }

  void pass_over(const Property& property) {
    const std::size_t count = property.count ? list_length(property) : 1;
    if (encoding_ == Encoding::ascii) {
      for (std::size_t i = 0; i < count; ++i) cursor_.word("a number");
    } else {
      cursor_.bytes(count * property.type.bytes, property.name);
    }
  }

  void read_vertices(const Element& element) {
    if (element.count > static_cast<std::size_t>(k_most))
      throw Error(ErrorCode::limit_exceeded, "more vertices than 32 bits can number",
                  cursor_.where(element.count_at));
    int found = 0;
    std::vector<int> axis_of_property;
    for (const Property& property : element.properties) {
      const bool axis =
          !property.count && property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z';
      axis_of_property.push_back(axis ? property.name[0] - 'x' : -1);
      if (axis) found += 1 << 4 * (property.name[0] - 'x');
    }
    if (found != 0x111)
      throw Error(ErrorCode::bad_input, "expected one property each of x, y and z of the vertices; write them so",
                  cursor_.where(element.count_at));
    mesh_.positions.resize(3, static_cast<Eigen::Index>(element.count));
    for (Eigen::Index v = 0; v < mesh_.positions.cols(); ++v)
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        if (axis_of_property[p] < 0)
          pass_over(element.properties[p]);
        else
          mesh_.positions(axis_of_property[p], v) = number(element.properties[p].type, "a coordinate");
      }
  }

  static bool holds_corners(const Property& property) {
    return property.count && (property.name == "vertex_indices" || property.name == "vertex_index");
  }

  void read_faces(const Element& element) {
    const auto lists = std::count_if(element.properties.begin(), element.properties.end(), holds_corners);
    const bool whole = std::all_of(element.properties.begin(), element.properties.end(), [](const Property& p) {
      return !holds_corners(p) || p.type.kind != Kind::floating;
    });
    if (lists != 1 || !whole)
      throw Error(ErrorCode::bad_input,
                  "expected one list of integers vertex_indices (or vertex_index) of the faces; write it so",
                  cursor_.where(element.count_at));
    for (std::size_t f = 0; f < element.count; ++f)
      for (const Property& property : element.properties) {
        if (holds_corners(property))
          read_corners(property);
        else
          pass_over(property);
      }
  }

  void read_corners(const Property& property) {
    const std::size_t corners = list_length(property);
    if (corners < 3) fault(number_at_, fmt::format("expected at least three corners of a face, found {}", corners));
    for (std::size_t i = 0; i < corners; ++i) {
      const std::int64_t vertex = integer(property.type, "a vertex");
      if (vertex < 0 || vertex >= k_most) check_vertex(vertex, number_at_);
      if (vertex > highest_) {
        highest_ = vertex;
        highest_at_ = number_at_;
      }
      mesh_.corners.push_back(static_cast<std::uint32_t>(vertex));
    }
    mesh_.offsets.push_back(mesh_.corners.size());
  }

  [[noreturn]] void check_vertex(std::int64_t vertex, std::size_t at) const {
    fault(at, fmt::format("expected a vertex from 0 to {}, found {}", mesh_.positions.cols() - 1, vertex));
  }

  static constexpr std::int64_t k_most = std::numeric_limits<std::uint32_t>::max();

  TextCursor cursor_;
  std::string_view name_;
  Encoding encoding_ = Encoding::ascii;
  std::vector<Element> elements_;
  std::size_t number_at_ = 0;  // where the integer last read stands
  SurfaceMesh mesh_;
  std::int64_t highest_ = -1;  // vertex of any face, and where it stands: faces may come before the vertices
  std::size_t highest_at_ = 0;
};

template <class Bits>
void append_little_endian(std::string& bytes, Bits bits) {
  for (std::size_t i = 0; i < sizeof bits; ++i) bytes += static_cast<char>(bits >> (8 * i) & 0xFFU);
}

}  // namespace

SurfaceMesh read_ply(std::string_view bytes, std::string_view name) {
  return Reader(bytes, name).read();
}

std::string ply_bytes(const SurfaceMesh& mesh) {
  std::size_t largest = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) largest = std::max(largest, mesh.face(f).size());
  const bool small = largest <= std::numeric_limits<std::uint8_t>::max();
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment Argil\nelement vertex {}\nproperty double x\nproperty double "
      "y\n"
      "property double z\nelement face {}\nproperty list {} uint vertex_indices\nend_header\n",
      mesh.positions.cols(), mesh.face_count(), small ? "uchar" : "uint");
  for (Eigen::Index v = 0; v < mesh.positions.cols(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      append_little_endian(bytes, std::bit_cast<std::uint64_t>(double{mesh.positions(axis, v)}));
    }
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto corners = mesh.face(f);
    if (small) {
      bytes += static_cast<char>(corners.size());
    } else {
      append_little_endian(bytes, static_cast<std::uint32_t>(corners.size()));
    }
    for (const std::uint32_t v : corners) append_little_endian(bytes, v);
  }
  return bytes;
}

}  // namespace argil::io
