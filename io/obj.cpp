#include "io/obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "io/text_cursor.h"

namespace argil::io {
namespace {

constexpr std::array<std::string_view, 18> k_passed_over{
    "vt", "vn",  "g",     "o",      "s",      "mg",       "usemtl",   "mtllib",     "p",
    "l",  "lod", "bevel", "usemap", "maplib", "c_interp", "d_interp", "shadow_obj", "trace_obj"};
constexpr std::array<std::string_view, 26> k_free_form{
    "vp",  "cstype", "deg",   "bmat",  "step", "curv", "curv2", "surf", "parm", "trim", "hole", "scrv", "sp",
    "end", "con",    "ctech", "stech", "cdc",  "cdp",  "bzp",   "bsp",  "res",  "call", "csh",  "scmp", "rscmp"};

template <class Table>
bool holds(const Table& table, std::string_view word) {
  return std::find(table.begin(), table.end(), word) != table.end();
}

class Reader {
 public:
  Reader(std::string_view text, std::string_view name) : text_(text), name_(name) {}

  SurfaceMesh read() {
    join_lines();
    for (std::size_t begin = 0; begin < text_.size();) {
      const std::size_t end = end_of_line(begin);
      read_line(begin, begin + std::min(end - begin, text_.substr(begin, end - begin).find('#')));
      begin = end + 1;
    }
    const std::size_t vertices = coordinates_.size() / 3;
    if (highest_ > vertices) {
      TextCursor at(text_, name_, highest_at_, text_.size());
      at.word("a vertex");
      at.fail(fmt::format("expected a vertex from 1 to {}, found {}; was the file cut short?", vertices, highest_));
    }
    mesh_.positions =
        Eigen::Map<const Eigen::Matrix3Xd>(coordinates_.data(), 3, static_cast<Eigen::Index>(vertices));
    if (mesh_.corners.empty()) {
      TextCursor at(text_, name_, text_.size(), text_.size());
      at.fail("expected faces (lines that begin with f), found none; was the file cut short?");
    }
    return std::move(mesh_);
  }

 private:
  // A backslash before a line's end joins it to the next; blanked in a copy of the same length, so that places
  // stay.
  void join_lines() {
    if (text_.find("\\\n") == std::string_view::npos && text_.find("\\\r\n") == std::string_view::npos) return;
    joined_ = text_;
    for (std::size_t i = joined_.find('\\'); i != std::string::npos; i = joined_.find('\\', i + 1)) {
      const std::size_t next = i + 1 < joined_.size() && joined_[i + 1] == '\r' ? i + 2 : i + 1;
      if (next < joined_.size() && joined_[next] == '\n') {
        joined_[i] = ' ';
        continued_.push_back(next);
      }
    }
    text_ = joined_;
  }

  std::size_t end_of_line(std::size_t begin) {
    for (;;) {
      const std::size_t end = std::min(text_.find('\n', begin), text_.size());
      while (next_continued_ < continued_.size() && continued_[next_continued_] < end) ++next_continued_;
      if (next_continued_ == continued_.size() || continued_[next_continued_] != end) return end;
      begin = end + 1;
    }
  }

  void read_line(std::size_t begin, std::size_t end) {
    TextCursor line(text_, name_, begin, end);
    if (line.at_end()) return;
    const std::string_view keyword = line.word("a keyword");
    if (keyword == "v") {
      read_vertex(line);
    } else if (keyword == "f") {
      read_face(line);
    } else if (holds(k_free_form, keyword)) {
      line.fail(fmt::format("free-form geometry ({}) is not held; convert it to polygons", keyword),
                ErrorCode::unsupported);
    } else if (!holds(k_passed_over, keyword)) {
      line.mismatch("v, f or another keyword of OBJ at the beginning of a line");
    }
  }

  void read_vertex(TextCursor& line) {
    for (int axis = 0; axis < 3; ++axis) {
      if (line.at_end()) line.fail("expected three coordinates after v, found the end of the line");
      coordinates_.push_back(line.number("a coordinate"));
    }
    if (coordinates_.size() / 3 > std::numeric_limits<std::uint32_t>::max())
      line.fail("more vertices than 32 bits can number", ErrorCode::limit_exceeded);
    // A weight, a colour, or both.
    for (int more = 0; !line.at_end(); ++more) {
      line.number("a weight or a colour");
      if (more == 4) line.mismatch("the end of the line");
    }
  }

  void read_face(TextCursor& line) {
    const std::size_t first = mesh_.corners.size();
    while (!line.at_end()) mesh_.corners.push_back(read_corner(line));
    if (mesh_.corners.size() - first < 3)
      line.fail(fmt::format("expected at least three corners of a face, found {}", mesh_.corners.size() - first));
    mesh_.offsets.push_back(mesh_.corners.size());
  }

  // v, v/vt, v//vn or v/vt/vn; only v is held.
  std::uint32_t read_corner(TextCursor& line) {
    constexpr std::string_view k_corner = "a corner as in 7, 7/1, 7//1 or 7/1/1 with numbers other than 0";
    const std::string_view word = line.word(k_corner);
    const std::size_t begin = line.word_offset();
    std::int64_t vertex = 0;
    std::size_t at = 0;
    for (int part = 0;; ++part) {
      const std::size_t stop = std::min(word.find('/', at), word.size());
      const bool may_miss = part == 1 && stop < word.size();
      if (part > 2 || (stop == at && !may_miss)) line.mismatch(k_corner);
      if (stop > at) {
        TextCursor number(text_, name_, begin + at, begin + stop);
        const std::int64_t index = number.integer(k_corner, -k_most, k_most);
        if (index == 0) number.fail("vertices are counted from 1 (or back from −1), found 0");
        if (part == 0) vertex = index;
      }
      if (stop == word.size()) break;
      at = stop + 1;
    }
    const auto known = static_cast<std::int64_t>(coordinates_.size() / 3);
    if (vertex < -known)
      line.fail(fmt::format("{} counts back beyond the {} vertices so far; is a part missing?", vertex, known));
    if (vertex < 0) vertex += known + 1;
    if (static_cast<std::uint64_t>(vertex) > highest_) {
      highest_ = static_cast<std::uint64_t>(vertex);
      highest_at_ = begin;
    }
    return static_cast<std::uint32_t>(vertex - 1);
  }

  static constexpr std::int64_t k_most = std::numeric_limits<std::uint32_t>::max();

  std::string_view text_, name_;
  std::string joined_;
  std::vector<std::size_t> continued_;  // ends of lines that go on
  std::size_t next_continued_ = 0;
  std::vector<double> coordinates_;
  SurfaceMesh mesh_;
  std::uint64_t highest_ = 0;  // vertex of any face, from 1, and where it stands
  std::size_t highest_at_ = 0;
};

}  // namespace

SurfaceMesh read_obj(std::string_view text, std::string_view name) {
  return Reader(text, name).read();
}

std::string obj_text(const SurfaceMesh& mesh) {
  std::string text = "# Argil\n";
  for (Eigen::Index v = 0; v < mesh.positions.cols(); ++v) {
    text += 'v';
    for (int axis = 0; axis < 3; ++axis) {
      text += ' ';
      append_number(text, mesh.positions(axis, v));
    }
    text += '\n';
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    text += 'f';
    for (const std::uint32_t v : mesh.face(f))
      fmt::format_to(std::back_inserter(text), " {}", std::uint64_t{v} + 1);
    text += '\n';
  }
  return text;
}

}  // namespace argil::io
