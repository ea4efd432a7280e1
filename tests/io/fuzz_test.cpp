// Damaged files for each reader: each must be read or refused with an argil::Error, within a time and with memory
// that its size justifies; and what was read must hold together. Ten thousand a reader, or ARGIL_FUZZ_FILES, from
// file ARGIL_FUZZ_FIRST on; a file depends on its number alone, so a failure comes again.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <functional>

#include "encoders.h"
#include "io/abaqus.h"
#include "io/file_bytes.h"
#include "io/gmsh.h"
#include "io/image.h"
#include "io/medit.h"
#include "io/obj.h"
#include "io/off.h"
#include "io/ovm.h"
#include "io/ply.h"
#include "io/session_text.h"
#include "io/stl.h"
#include "io/vtk.h"
#include "io/vtu.h"
#include "live_bytes.h"
#include "mutations.h"
#include "sample_meshes.h"
#include "subdiv/build.h"
#include "subdiv/error.h"
#include "surface_encoders.h"

#if defined(__SANITIZE_ADDRESS__)
extern "C" void __sanitizer_set_death_callback(void (*callback)());  // not every compiler ships its header
#endif

namespace argil::io {
namespace {

using test::VtuEncoder;
using test::VtuStyle;

using Seeds = std::vector<std::string>;

/// Reads bytes and returns what looks at the result, which says whether all of it is good; throws Error.
using Read = std::function<bool()> (*)(const std::string& bytes);

struct Reader {
  const char* name;
  const char* ending;  // files of tests/io/malformed that end so are seeds too
  Seeds (*seeds)();
  Read read;
  std::size_t bytes_a_byte;  // memory that a byte of a file may take
  std::size_t base = 1024;
};

void PrintTo(const Reader& reader, std::ostream* out) {
  *out << reader.name;
}

void check_fields(const std::vector<NamedField>& fields, std::size_t items) {
  for (const NamedField& field : fields) {
    ASSERT_GT(field.components, 0);
    ASSERT_EQ(field.values.size(), items * static_cast<std::size_t>(field.components));
    for (const double value : field.values) ASSERT_TRUE(std::isfinite(value));
  }
}

void check_structure(const VolumeMesh& mesh) {
  const auto& cells = mesh.cells;
  const auto points = static_cast<std::size_t>(cells.positions.cols());
  ASSERT_TRUE(cells.positions.allFinite());
  ASSERT_EQ(cells.offsets.size(), cells.kinds.size() + 1);
  ASSERT_EQ(cells.offsets.back(), cells.connectivity.size());
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

template <VolumeMesh (*read)(std::string_view, std::string_view)>
std::function<bool()> volume(const std::string& bytes) {
  return [mesh = read(bytes, "fuzz")] {
    check_structure(mesh);
    try {
      (void)subdiv::build(mesh.cells);
      return true;
    } catch (const Error&) {
      return false;
    }
  };
}

template <SurfaceMesh (*read)(std::string_view, std::string_view)>
std::function<bool()> surface(const std::string& bytes) {
  return [mesh = read(bytes, "fuzz")] {
    EXPECT_TRUE(mesh.positions.allFinite());
    EXPECT_GT(mesh.face_count(), 0U);
    EXPECT_EQ(mesh.offsets.back(), mesh.corners.size());
    for (std::size_t f = 0; f < mesh.face_count(); ++f) EXPECT_GE(mesh.offsets[f + 1], mesh.offsets[f] + 3);
    for (const std::uint32_t corner : mesh.corners) EXPECT_LT(corner, mesh.positions.cols());
    EXPECT_LE(weld(mesh, 1e-3).corners.size(), mesh.corners.size());
    const SurfaceReport report = check_surface(mesh);
    EXPECT_EQ(report.findings().empty(), report.closed_manifold());
    return report.closed_manifold();
  };
}

std::function<bool()> picture(const std::string& bytes) {
  return [image = read_png(bytes, "fuzz")] {
    EXPECT_GT(image.width, 0);
    EXPECT_GT(image.height, 0);
    EXPECT_EQ(image.rgba.size(),
              4U * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    return true;
  };
}

std::function<bool()> session(const std::string& bytes) {
  return [lines = parse_session(bytes, "fuzz")] {
    for (const SessionLine& line : lines) {
      EXPECT_FALSE(line.tokens.empty());
      for (const Token& token : line.tokens) EXPECT_LE(token.offset, line.text.size());
    }
    return true;
  };
}

VolumeMesh with_small_fields() {
  VolumeMesh mesh = test::every_kind();
  mesh.point_fields = {{"height", 1, std::vector<double>(17, 0.5)}};
  mesh.cell_fields = {{"stress", 6, std::vector<double>(30, 1)}};
  return mesh;
}

VolumeMesh without_polyhedra() {
  VolumeMesh mesh = test::every_kind();
  mesh.cells.kinds.pop_back();
  mesh.cells.offsets.pop_back();
  mesh.cells.connectivity.resize(mesh.cells.offsets.back());
  return mesh;
}

Seeds medit_seeds() {
  const std::string plain = medit_text(without_polyhedra());
  std::string other = plain;
  other.replace(other.find("Hexahedra"), 0, "Triangles 1 1 2 3 0\nRidges 1\n1\nNormals 1\n0 0 1 # up\n");
  return {plain, other};
}

Seeds vtk_seeds() {
  const VolumeMesh mesh = with_small_fields();
  return {vtk_text(mesh), test::encode_vtk(mesh, false, true), test::encode_vtk(mesh, true, false),
          test::encode_vtk(mesh, true, true)};
}

Seeds vtu_seeds() {
  const VolumeMesh mesh = with_small_fields();
  using Place = VtuStyle::Place;
  return {vtu_bytes(mesh),
          VtuEncoder({Place::ascii}).encode(mesh),
          VtuEncoder({Place::inline_base64}).encode(mesh),
          VtuEncoder({Place::inline_base64, true, true, true}).encode(mesh),
          VtuEncoder({Place::appended_base64, true}).encode(mesh),
          VtuEncoder({Place::appended_raw, true, false, true, true}).encode(mesh)};
}

VolumeMesh with_sets(VolumeMesh mesh) {
  mesh.sets = {{"feet", SetKind::points, {0, 2, 3}}, {"seat", SetKind::cells, {1}}};
  return mesh;
}

Seeds gmsh_seeds() {
  const VolumeMesh mesh = with_sets(without_polyhedra());
  Seeds seeds;
  for (const Encoding encoding : {Encoding::ascii, Encoding::binary})
    for (const char* version : {"2.2", "4.1"}) seeds.push_back(gmsh_bytes(mesh, {encoding, version}));
  return seeds;
}

Seeds abaqus_seeds() {
  return {
      abaqus_text(with_sets(without_polyhedra())),
      "*HEADING\n** a block\n*NODE, NSET=all\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n*ELEMENT, type=C3D4, "
      "ELSET=body\n7, 1, 2,\n 3, 4\n*Nset, nset=feet, generate\n1, 3, 2\n*ELSET, ELSET=two\nbody, 7\n"};
}

Seeds ovm_seeds() {
  VolumeMesh mesh = with_sets(with_small_fields());
  mesh.cell_fields = {{"stress", 3, std::vector<double>(15, 1)}};
  return {ovm_text(mesh), ovm_text(test::every_kind())};
}

Seeds obj_seeds() {
  return {obj_text(test::cube()), test::crowded_obj()};
}

Seeds ply_seeds() {
  const SurfaceMesh cube = test::cube();
  return {ply_bytes(cube), test::crowded_ply(cube, "ascii"), test::crowded_ply(cube, "ascii", true),
          test::crowded_ply(cube, "binary_little_endian"), test::crowded_ply(cube, "binary_big_endian", true)};
}

Seeds stl_seeds() {
  const SurfaceMesh cube = test::cube();
  std::string named = stl_bytes(cube);
  named.replace(0, 10, "solid cube");
  return {stl_bytes(cube), named, test::ascii_stl(cube), test::ascii_stl(cube, true)};
}

Seeds off_seeds() {
  return {off_text(test::cube()), test::coloured_off()};
}

Seeds png_seeds() {
  Seeds seeds;
  const auto path = std::filesystem::path(testing::TempDir()) / ("argil_fuzz_" + std::to_string(getpid()) + ".png");
  for (const int size : {1, 5, 16}) {
    std::vector<std::uint8_t> rgba;
    for (int i = 0; i < 4 * size * size; ++i)
      rgba.push_back(static_cast<std::uint8_t>(size == 16 ? i / 64 : i * 37));
    write_png(path, size, size, rgba);
    seeds.push_back(read_file(path));
  }
  std::filesystem::remove(path);
  return seeds;
}

Seeds session_seeds() {
  return {
      read_file(std::filesystem::path(ARGIL_SAMPLES_DIR) / "armchair.argil"),
      "argil 1\nnew box 2 2 2 size 1/3 50% 1e-3 # a box\nselect faces as \"two \\\"seats\\\" \\\\ é\" where not (x "
      "< .5 or -y^2 >= sqrt(z)) and boundary\r\n\r\nset density 300 + 10*x where z != 0\nsave a.vtu\n"};
}

// Of text, a number of a byte and a blank becomes 8 bytes, and vectors double as they grow; a token of a session
// takes about 100 bytes, and so do a number with its tag, or an edge of two digits with its two sides. Deflate
// packs 1032 bytes into one, which are 8 pixels of a bit each, held four times on the way to 4 bytes.
constexpr std::size_t k_deflate = 1032;
const Reader k_readers[] = {
    {"Medit", ".mesh", medit_seeds, volume<read_medit>, 24},
    {"Vtk", ".vtk", vtk_seeds, volume<read_vtk>, 24},
    {"Vtu", ".vtu", vtu_seeds, volume<read_vtu>, 8 * k_deflate, 256 * 1024},
    {"Gmsh", ".msh", gmsh_seeds, volume<read_gmsh>, 128, 8 * 1024},
    {"Abaqus", ".inp", abaqus_seeds, volume<read_abaqus>, 128, 8 * 1024},
    {"Ovm", ".ovm", ovm_seeds, volume<read_ovm>, 128},
    {"Obj", ".obj", obj_seeds, surface<read_obj>, 24},
    {"Ply", ".ply", ply_seeds, surface<read_ply>, 24},
    {"Stl", ".stl", stl_seeds, surface<read_stl>, 24},
    {"Off", ".off", off_seeds, surface<read_off>, 24},
    {"Png", ".png", png_seeds, picture, 8 * 16 * k_deflate, 64 * 1024},
    {"Session", ".argil", session_seeds, session, 256},
};

std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
  const char* value = std::getenv(name);
  return value ? std::strtoull(value, nullptr, 10) : otherwise;
}

// Names the file that was being read when the program dies or hangs.
char reading[128];
void say_what_was_read() {
  (void)!write(2, reading, std::strlen(reading));
}
void on_signal(int signal) {
  say_what_was_read();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

class Watch {
 public:
  Watch() {
    std::signal(SIGALRM, on_signal);
#if defined(__SANITIZE_ADDRESS__)
    __sanitizer_set_death_callback(say_what_was_read);
#else
    for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS}) std::signal(signal, on_signal);
#endif
  }
  ~Watch() {
    alarm(0);
    for (const int signal : {SIGALRM, SIGSEGV, SIGABRT, SIGFPE, SIGBUS}) std::signal(signal, SIG_DFL);
  }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;
  void begin(const Reader& reader, std::uint64_t file) const {
    constexpr unsigned k_hung = 30;  // [s] of a clock on the wall: the machine may be busy
    std::snprintf(reading, sizeof reading, "reading file %llu of %s; ARGIL_FUZZ_FIRST repeats it\n",
                  static_cast<unsigned long long>(file), reader.name);
    alarm(k_hung);
  }
};

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Tally {
  std::uint64_t read = 0, refused = 0, good = 0;
  double slowest = 0;     // [s] of the processor
  double most_bytes = 0;  // memory beyond the base, a byte of the file
};

void feed(const Reader& reader, const std::string& bytes, Tally& tally) {
  std::function<bool()> look;
  const double began = processor_seconds();
  test::start_counting();
  try {
    look = reader.read(bytes);
    ++tally.read;
  } catch (const Error& error) {
    ++tally.refused;
    ASSERT_NE(std::string(error.what()), "");
    ASSERT_EQ(error.where().rfind("fuzz", 0), 0U) << error.what();
  }
  const std::size_t held = test::peak_bytes();
  tally.slowest = std::max(tally.slowest, processor_seconds() - began);
  if (held > reader.base)
    tally.most_bytes = std::max(tally.most_bytes, static_cast<double>(held - reader.base) /
                                                      static_cast<double>(std::max<std::size_t>(bytes.size(), 1)));
  ASSERT_LE(held, reader.base + reader.bytes_a_byte * bytes.size());
  if (look && look()) ++tally.good;
}

Seeds seeds_of(const Reader& reader) {
  Seeds seeds = reader.seeds();
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(ARGIL_TESTS_DIR) / "io" / "malformed"))
    if (entry.path().extension() == reader.ending) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files) seeds.push_back(read_file(file));
  return seeds;
}

class Fuzz : public testing::TestWithParam<Reader> {};

TEST_P(Fuzz, DamagedFilesAreReadOrRefused) {
  const Reader& reader = GetParam();
  const std::uint64_t count = from_environment("ARGIL_FUZZ_FILES", 10'000),
                      first = from_environment("ARGIL_FUZZ_FIRST", 0);
  const std::size_t whole = reader.seeds().size();
  const Seeds seeds = seeds_of(reader);
  const Watch watch;
  Tally tally;
  for (std::uint64_t file = first; file < first + count; ++file) {
    test::Random random(2026 + file);
    // Most from seeds that are whole: what is refused at once tests little.
    const std::string& seed = seeds[random.below(4) > 0 ? random.below(whole) : random.below(seeds.size())];
    const std::string bytes = test::mutated(seed, seeds[random.below(seeds.size())], random);
    watch.begin(reader, file);
    ASSERT_NO_FATAL_FAILURE(feed(reader, bytes, tally)) << "file " << file << ":\n" << bytes;
    ASSERT_FALSE(HasNonfatalFailure()) << "file " << file << ":\n" << bytes;
  }
  std::printf(
      "%s: %llu files: read %llu, of these good %llu, refused %llu; slowest %.3f s; at most %zu KiB + %.1f "
      "bytes a byte\n",
      reader.name, static_cast<unsigned long long>(count), static_cast<unsigned long long>(tally.read),
      static_cast<unsigned long long>(tally.good), static_cast<unsigned long long>(tally.refused), tally.slowest,
      reader.base / 1024, tally.most_bytes);
  // Neither a reader that refuses everything nor one that takes everything was tested.
  if (count >= 10'000) {
    EXPECT_GT(tally.good, count / 100);
    EXPECT_GT(tally.refused, count / 10);
  }
  if (count > 100'000) {
    EXPECT_LT(tally.slowest, 1.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Readers, Fuzz, testing::ValuesIn(k_readers),
                         [](const auto& reader) { return std::string(reader.param.name); });

}  // namespace
}  // namespace argil::io
