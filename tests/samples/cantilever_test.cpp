// The cantilever sessions against REFERENCES.md §1: converged tip deflection 0.04910 m, known to 0.00001.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/tools/process.h"

namespace argil::tests {
namespace {

constexpr double k_limit = 0.04910;
struct Mesh {
  const char* session;
  double eight_node;  // tip deflection of plain 8-node hexahedra on this mesh [m]
};
constexpr std::array<Mesh, 3> k_meshes = {
    {{"cantilever_8x2x2", 0.042414}, {"cantilever_16x4x4", 0.046966}, {"cantilever_32x8x8", 0.048453}}};

struct Tip {
  double error = 0;  // relative
  int unknowns = 0;
};

Tip tip(const std::string& session, const std::string& space) {
  const TemporaryFolder folder;
  const std::string path = (std::filesystem::path(ARGIL_SAMPLES_DIR) / (session + ".argil")).string();
  const Finished finished = run_argil(
      {"replay", path, "--out", "out", "--quiet", "--no-pictures", "--set", "space=" + space}, folder.path());
  EXPECT_EQ(finished.status, 0) << finished.err;
  const nlohmann::json summary = read_json(folder / "out/summary.json");
  EXPECT_EQ(summary["space"], space);
  for (const nlohmann::json& record : summary["measures"])
    if (record["name"] == "displacement_z")
      return {std::abs(-record["value"].get<double>() - k_limit) / k_limit, summary["unknowns"]};
  ADD_FAILURE() << "no tip was measured";
  return {};
}

TEST(Cantilever, DefaultSpaceBeatsPlainHexahedraAndConverges) {
  std::array<double, k_meshes.size()> errors{};
  for (std::size_t i = 0; i < k_meshes.size(); ++i) {
    errors[i] = tip(k_meshes[i].session, "default").error;
    EXPECT_LE(errors[i], (k_limit - k_meshes[i].eight_node) / k_limit) << k_meshes[i].session;
  }
  for (std::size_t i = 0; i + 1 < errors.size(); ++i)
    EXPECT_GE(std::log2(errors[i] / errors[i + 1]), 1.5) << errors[i] << " to " << errors[i + 1];
}

TEST(Cantilever, CubicSpaceIsBetterAtEqualUnknowns) {
  for (const Mesh& mesh : k_meshes) {
    const Tip standard = tip(mesh.session, "default"), cubic = tip(mesh.session, "cubic");
    EXPECT_EQ(cubic.unknowns, standard.unknowns);
    EXPECT_LT(cubic.error, standard.error) << mesh.session;
  }
}

}  // namespace
}  // namespace argil::tests
