// Ten thousand damaged files for each reader: each must be read or refused with an argil::Error, and what was read
// must hold together and be built, or be refused by `build`. The generator is fixed, so a failure comes again.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "encoders.h"
#include "io/medit.h"
#include "io/vtk.h"
#include "io/vtu.h"
#include "sample_meshes.h"
#include "subdiv/build.h"
#include "subdiv/error.h"

namespace argil::io {
namespace {

using test::VtuEncoder;
using test::VtuStyle;

class Random {  // SplitMix64
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t bits = state_;
    bits = (bits ^ bits >> 30U) * 0xBF58476D1CE4E5B9U;
    bits = (bits ^ bits >> 27U) * 0x94D049BB133111EBU;
    return bits ^ bits >> 31U;
  }
  std::size_t below(std::size_t bound) { return bound == 0 ? 0 : static_cast<std::size_t>(next() % bound); }

 private:
  std::uint64_t state_;
};

bool in_word(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '.' ||
         c == '+';
}

void replace_word(std::string& text, Random& random) {
  constexpr std::array<std::string_view, 22> k_words{"-1",
                                                     "0",
                                                     "1",
                                                     "2",
                                                     "42",
                                                     "1000000000000",
                                                     "18446744073709551615",
                                                     "9223372036854775807",
                                                     "-9223372036854775808",
                                                     "4294967296",
                                                     "4294967295",
                                                     "2147483648",
                                                     "nan",
                                                     "inf",
                                                     "-inf",
                                                     "1e999",
                                                     "1e-999",
                                                     "0x10",
                                                     "1.5",
                                                     "",
                                                     "<",
                                                     "&#0;"};
  std::size_t begin = random.below(text.size());
  while (begin < text.size() && !in_word(text[begin])) ++begin;
  std::size_t end = begin;
  while (begin > 0 && in_word(text[begin - 1])) --begin;
  while (end < text.size() && in_word(text[end])) ++end;
  text.replace(begin, end - begin, k_words[random.below(k_words.size())]);
}

void change_lines(std::string& text, Random& random) {
  const std::size_t at = random.below(text.size());
  const std::size_t begin = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
  std::size_t end = text.find('\n', at);
  end = end == std::string::npos ? text.size() : end + 1;
  if (end <= begin) return;
  if (random.below(2) == 0) {
    text.erase(begin, end - begin);
  } else {
    text.insert(begin, text.substr(begin, end - begin));
  }
}

std::string mutated(const std::string& seed, const std::string& other, Random& random) {
  std::string text = seed;
  const std::size_t changes = 1 + random.below(3);
  for (std::size_t i = 0; i < changes && !text.empty(); ++i) {
    switch (random.below(7)) {
      case 0:
        text[random.below(text.size())] ^= static_cast<char>(1U << random.below(8));
        break;
      case 1:
        text[random.below(text.size())] = static_cast<char>(random.below(256));
        break;
      case 2:
        if (random.below(4) == 0) text.resize(random.below(text.size()));
        break;
      case 3:
      case 4:
        replace_word(text, random);
        break;
      case 5:
        change_lines(text, random);
        break;
      default: {  // a piece of another file, or of this one, put in or written over
        const std::size_t from = random.below(other.size()), size = random.below(64),
                          at = random.below(text.size());
        text.replace(at, random.below(2) == 0 ? 0 : size, other.substr(from, size));
      }
    }
  }
  return text;
}

void check_fields(const std::vector<NamedField>& fields, std::size_t items) {
  for (const NamedField& field : fields) {
    ASSERT_GT(field.components, 0);
    ASSERT_EQ(field.values.size(), items * static_cast<std::size_t>(field.components));
    for (const double value : field.values) ASSERT_TRUE(std::isfinite(value));
  }
}

void check_structure(const VolumeMesh& mesh, std::size_t file_size) {
  const auto& cells = mesh.cells;
  const auto points = static_cast<std::size_t>(cells.positions.cols());
  ASSERT_TRUE(cells.positions.allFinite());
  ASSERT_EQ(cells.offsets.size(), cells.kinds.size() + 1);
  ASSERT_EQ(cells.offsets.back(), cells.connectivity.size());
  // A number takes a byte and a blank at least; deflate packs 1032 bytes into one.
  ASSERT_LE(3 * points + cells.connectivity.size(), 1032 * file_size);
  for (std::size_t c = 0; c < cells.cell_count(); ++c) {
    ASSERT_LE(cells.offsets[c], cells.offsets[c + 1]);
    const std::uint32_t* at = cells.connectivity.data() + cells.offsets[c];
    const std::uint32_t* const end = cells.connectivity.data() + cells.offsets[c + 1];
    if (cells.kinds[c] != subdiv::CellKind::polyhedron) {
      constexpr std::ptrdiff_t k_vertices[] = {4, 5, 6, 8};
      ASSERT_EQ(end - at, k_vertices[static_cast<int>(cells.kinds[c])]);
      for (; at != end; ++at) ASSERT_LT(*at, points);
      continue;
    }
    ASSERT_LT(at, end);
    for (std::uint32_t faces = *at++; faces > 0; --faces) {
      ASSERT_LT(at, end);
      const std::uint32_t corners = *at++;
      ASSERT_GE(corners, 3U);
      ASSERT_LE(corners, end - at);
      for (std::uint32_t i = 0; i < corners; ++i) ASSERT_LT(*at++, points);
    }
    ASSERT_EQ(at, end);
  }
  check_fields(mesh.point_fields, points);
  check_fields(mesh.cell_fields, cells.cell_count());
}

struct Outcome {
  int read = 0, refused = 0, built = 0;
};

void feed(VolumeMesh (*reader)(std::string_view, std::string_view), const std::string& bytes, Outcome& outcome) {
  VolumeMesh mesh;
  try {
    mesh = reader(bytes, "fuzz");
    ++outcome.read;
  } catch (const Error& error) {
    ++outcome.refused;
    ASSERT_NE(std::string(error.what()), "");
    ASSERT_EQ(error.where().rfind("fuzz", 0), 0U) << error.what();
    return;
  }
  check_structure(mesh, bytes.size());
  try {
    (void)subdiv::build(mesh.cells);
    ++outcome.built;
  } catch (const Error&) {
  }
}

void fuzz(VolumeMesh (*reader)(std::string_view, std::string_view), const std::vector<std::string>& seeds) {
  constexpr int k_mutations = 10000;
  Random random(2026);
  Outcome outcome;
  for (int i = 0; i < k_mutations; ++i) {
    const std::string& seed = seeds[static_cast<std::size_t>(i) % seeds.size()];
    const std::string bytes = mutated(seed, seeds[random.below(seeds.size())], random);
    ASSERT_NO_FATAL_FAILURE(feed(reader, bytes, outcome)) << "mutation " << i << ":\n" << bytes;
  }
  // Neither a reader that refuses everything nor one that takes everything was tested.
  EXPECT_GT(outcome.built, k_mutations / 100);
  EXPECT_GT(outcome.refused, k_mutations / 4);
  std::printf("read %d, of these built %d, refused %d\n", outcome.read, outcome.built, outcome.refused);
}

VolumeMesh with_small_fields() {
  VolumeMesh mesh = test::every_kind();
  mesh.point_fields = {{"height", 1, std::vector<double>(17, 0.5)}};
  mesh.cell_fields = {{"stress", 6, std::vector<double>(30, 1)}};
  return mesh;
}

TEST(Fuzz, MeditIsReadOrRefused) {
  VolumeMesh mesh = test::every_kind();
  mesh.cells.kinds.pop_back();  // the polyhedron
  mesh.cells.offsets.pop_back();
  mesh.cells.connectivity.resize(mesh.cells.offsets.back());
  std::string other = medit_text(mesh);
  other.replace(other.find("Hexahedra"), 0, "Triangles 1 1 2 3 0\nRidges 1\n1\nNormals 1\n0 0 1 # up\n");
  fuzz(read_medit, {medit_text(mesh), other});
}

TEST(Fuzz, VtkIsReadOrRefused) {
  const VolumeMesh mesh = with_small_fields();
  fuzz(read_vtk, {vtk_text(mesh), test::encode_vtk(mesh, false, true), test::encode_vtk(mesh, true, false),
                  test::encode_vtk(mesh, true, true)});
}

TEST(Fuzz, VtuIsReadOrRefused) {
  const VolumeMesh mesh = with_small_fields();
  using Place = VtuStyle::Place;
  fuzz(read_vtu,
       {vtu_bytes(mesh), VtuEncoder({Place::ascii}).encode(mesh), VtuEncoder({Place::inline_base64}).encode(mesh),
        VtuEncoder({Place::inline_base64, true, true, true}).encode(mesh),
        VtuEncoder({Place::appended_base64, true}).encode(mesh),
        VtuEncoder({Place::appended_raw, true, false, true, true}).encode(mesh)});
}

}  // namespace
}  // namespace argil::io
