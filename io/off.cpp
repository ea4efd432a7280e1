#include "io/off.h"

#include <fmt/format.h>

#include <limits>

#include "io/text_cursor.h"

namespace argil::io {
namespace {

class Reader {
 public:
  Reader(std::string_view text, std::string_view name) : text_(text), name_(name), cursor_(text, name, '#') {}

  SurfaceMesh read() {
    read_header();
    const std::size_t vertices = cursor_.count("a number of vertices", 6);
    if (vertices > std::numeric_limits<std::uint32_t>::max())
      cursor_.fail("more vertices than 32 bits can number", ErrorCode::limit_exceeded);
    const std::size_t faces = cursor_.count("a number of faces", 8);
    if (faces == 0) cursor_.fail("expected faces, found a number of faces of 0; a surface has some");
    cursor_.integer("a number of edges", 0, INT64_MAX);
    SurfaceMesh mesh;
    mesh.positions.resize(3, static_cast<Eigen::Index>(vertices));
    for (Eigen::Index v = 0; v < mesh.positions.cols(); ++v) {
      for (int axis = 0; axis < 3; ++axis) mesh.positions(axis, v) = cursor_.number("a coordinate");
      if (more_a_vertex_ > 0) pass_over_line(more_a_vertex_);
    }
    mesh.offsets.reserve(faces + 1);
    for (std::size_t f = 0; f < faces; ++f) {
      const std::size_t corners = cursor_.count("a number of corners", 2);
      if (corners < 3) cursor_.mismatch("at least three corners of a face");
      for (std::size_t i = 0; i < corners; ++i) {
        const auto vertex = cursor_.integer("a vertex", 0, static_cast<std::int64_t>(vertices) - 1);
        mesh.corners.push_back(static_cast<std::uint32_t>(vertex));
      }
      mesh.offsets.push_back(mesh.corners.size());
      pass_over_line(4);  // a colour
    }
    cursor_.finish();
    return mesh;
  }

 private:
  // [ST][C][N][4][n]OFF [BINARY]
  void read_header() {
    std::string_view word = cursor_.word("OFF at the beginning");
    const auto take = [&](std::string_view prefix) {
      if (!word.starts_with(prefix)) return false;
      word.remove_prefix(prefix.size());
      return true;
    };
    if (take("ST")) more_a_vertex_ += 2;
    if (take("C")) more_a_vertex_ += 4;
    if (take("N")) more_a_vertex_ += 3;
    const bool flat = take("4") || take("n");
    if (word != "OFF") cursor_.mismatch("OFF, COFF, NOFF, CNOFF or STOFF at the beginning");
    if (flat) cursor_.fail("only three dimensions are held; convert 4OFF and nOFF to OFF", ErrorCode::unsupported);
    if (cursor_.peek() == "BINARY") {
      cursor_.word("BINARY");
      cursor_.fail("binary OFF is not held; write it as text, or as .ply", ErrorCode::unsupported);
    }
  }

  // At most `most` numbers that follow on the line.
  void pass_over_line(std::size_t most) {
    const std::string_view rest = cursor_.rest_of_line();
    const std::size_t begin = cursor_.word_offset();
    TextCursor line(text_, name_, begin, begin + std::min(rest.find('#'), rest.size()));
    for (std::size_t i = 0; !line.at_end(); ++i) {
      line.number("a number of a colour, a normal or a texture");
      if (i == most) line.mismatch("the end of the line");
    }
  }

  std::string_view text_, name_;
  TextCursor cursor_;
  std::size_t more_a_vertex_ = 0;
};

}  // namespace

SurfaceMesh read_off(std::string_view text, std::string_view name) {
  return Reader(text, name).read();
}

std::string off_text(const SurfaceMesh& mesh) {
  std::string text = fmt::format("OFF\n# Argil\n{} {} 0\n", mesh.positions.cols(), mesh.face_count());
  for (Eigen::Index v = 0; v < mesh.positions.cols(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      if (axis > 0) text += ' ';
      append_number(text, mesh.positions(axis, v));
    }
    text += '\n';
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    fmt::format_to(std::back_inserter(text), "{}", mesh.face(f).size());
    for (const std::uint32_t v : mesh.face(f)) fmt::format_to(std::back_inserter(text), " {}", v);
    text += '\n';
  }
  return text;
}

}  // namespace argil::io
