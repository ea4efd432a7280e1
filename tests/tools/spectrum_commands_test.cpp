// `argil modes` and `argil export-matrices`, run as a user runs them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "io/volume_mesh.h"
#include "tests/io/matrix_market_reader.h"
#include "tests/tools/mesh_files.h"
#include "tests/tools/process.h"

namespace argil::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;

// The bar of REFERENCES §6; a folder that it would write to is not made.
constexpr const char* k_bar =
    "argil 1\nnew box 16 2 2 size 1 0.08 0.12\nselect edges angle 30\nsharpen 10\nlevels 1\nset young_modulus 1e6\n"
    "pin where x < 1e-6\nsave bar.vtu\nexpect volume 17\nsample bar.csv from 0.1 0.04 0.06 to 0.9 0.04 0.06\n";

class SpectrumCommands : public ArgilCalls {};

TEST_F(SpectrumCommands, ModesOfASessionAreThoseOfItsEndAndNothingElseIsWritten) {
  folder_.write("bar.argil", k_bar);
  const json found = answer({"modes", "bar.argil", "--count", "4", "--space", "cubic", "--json"});
  ASSERT_EQ(found["modes"].size(), 4U);
  EXPECT_EQ(found["unknowns"], 3 * 17 * 9 - 3 * 9);
  EXPECT_EQ(found["linearised_at"], "present");
  // Converged: .40872 .60863 2.4886 3.5863; this mesh is 1.1, 1.0, 1.4 and 1.5 % off (tests/fem/spectrum).
  const double expected[] = {.40872, .60863, 2.4886, 3.5863};
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(found["modes"][i]["frequency"].get<double>(), expected[i], 0.02 * expected[i]);
  EXPECT_DOUBLE_EQ(found["largest_explicit_step"].get<double>(), 2 / found["omega_max"].get<double>());
  EXPECT_EQ(folder_.files(), std::vector<std::string>{"bar.argil"});

  // Four times the stiffness doubles every frequency.
  const json stiff = answer(
      {"modes", "bar.argil", "--count", "4", "--space", "cubic", "--with", "set young_modulus 4e6", "--json"});
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(stiff["modes"][i]["frequency"].get<double>(), 2 * found["modes"][i]["frequency"].get<double>(),
                1e-6);
}

TEST_F(SpectrumCommands, ModesSayWhatTheyLeaveOut) {
  folder_.write("bar.argil", k_bar);
  const std::vector<std::string> line{"modes", "bar.argil", "--count", "1"};
  EXPECT_THAT(run_argil(line, folder_.path()).out, testing::Not(HasSubstr("without")));
  std::vector<std::string> more = line;
  for (const char* with : {"obstacle floor plane at 0 0 -1", "pressure 5 as wind where x > 0.9"})
    more.insert(more.end(), {"--with", with});
  EXPECT_THAT(run_argil(more, folder_.path()).out, HasSubstr("without obstacle floor, pressure wind"));
  more.emplace_back("--json");
  EXPECT_EQ(answer(more)["left_out"], (std::vector<std::string>{"obstacle floor", "pressure wind"}));
}

TEST_F(SpectrumCommands, ShapesHaveOneFieldAModeAndKeepWhatIsPinned) {
  folder_.write("box.mesh", cube_grid(2, 2, 2, 0.5));
  const Finished finished = argil(
      {"modes", "box.mesh", "--count", "3", "--pin", "x < 0.01", "--pin", "x > 0.99 and z > 0.9", "--out", "m"});
  ASSERT_EQ(finished.status, 0) << finished.err;
  EXPECT_THAT(finished.out, HasSubstr("largest"));
  const io::VolumeMesh mesh = io::read_volume_mesh(folder_ / "m/modes.vtu");
  ASSERT_EQ(mesh.point_fields.size(), 3U);
  for (const io::NamedField& field : mesh.point_fields) {
    EXPECT_EQ(field.components, 3);
    double largest = 0;
    for (const double value : field.values) largest = std::max(largest, std::abs(value));
    EXPECT_GT(largest, 0.01);
    EXPECT_LT(largest, 0.2);  // a tenth of the diagonal
  }
  EXPECT_EQ(mesh.point_fields[0].name, "mode_1");
  // Free: six zeros.
  const json free = answer({"modes", "box.mesh", "--count", "7", "--json"});
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(free["modes"][i]["frequency"], 0) << i;
  EXPECT_GT(free["modes"][6]["frequency"], 1);
}

TEST_F(SpectrumCommands, MatricesFitTogether) {
  folder_.write("bar.argil", k_bar);
  for (const std::string space : {"default", "cubic"}) {
    const json list = answer({"export-matrices", "bar.argil", "--space", space, "--out", space, "--json"});
    const auto read = [&](const std::string& name) {
      return read_matrix_market(read_bytes(folder_ / (space + "/" + name)));
    };
    const Eigen::MatrixXd a = read("A.mtx").matrix;
    const auto mass = read("mass.mtx"), node_mass = read("mass_nodes.mtx"), stiffness = read("stiffness.mtx"),
               node_stiffness = read("stiffness_nodes.mtx");
    for (const auto* matrix : {&mass, &node_mass, &stiffness, &node_stiffness}) EXPECT_TRUE(matrix->symmetric);
    // Sums of some hundred products, in other orders.
    const Eigen::MatrixXd points = read("control_points.mtx").matrix, nodes = read("nodes.mtx").matrix;
    EXPECT_LT((a * points - nodes).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_LT((a.transpose() * node_mass.matrix * a - Eigen::MatrixXd(mass.matrix)).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_NEAR(mass.matrix.sum(), 9.6, 1e-10);  // 1000 kg/m³ in 1 × 0.08 × 0.12 m³
    EXPECT_NEAR(node_mass.matrix.sum(), 9.6, 1e-10);
    Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(3 * a.rows(), 3 * a.cols());
    for (Eigen::Index i = 0; i < a.rows(); ++i)
      for (Eigen::Index j = 0; j < a.cols(); ++j)
        for (Eigen::Index axis = 0; axis < 3; ++axis) spread(3 * i + axis, 3 * j + axis) = a(i, j);
    const Eigen::MatrixXd reduced = spread.transpose() * (node_stiffness.matrix * spread);
    const Eigen::MatrixXd given = stiffness.matrix;
    EXPECT_LT((reduced - given).cwiseAbs().maxCoeff(), 1e-12 * given.cwiseAbs().maxCoeff());
    // Translations and rotations take no force: A reproduces them.
    Eigen::VectorXd rotation(3 * points.rows());
    for (Eigen::Index i = 0; i < points.rows(); ++i) rotation.segment<3>(3 * i) << -points(i, 1), points(i, 0), 0;
    EXPECT_LT((given * rotation).cwiseAbs().maxCoeff(), 1e-11 * given.cwiseAbs().maxCoeff());
    EXPECT_EQ(read("fixed.mtx").matrix.sum(), 9);
    EXPECT_EQ(read("damping.mtx").matrix.nonZeros(), 0);
    EXPECT_EQ(list["matrices"].size(), 9U);
  }
}

TEST_F(SpectrumCommands, SayWhatIsWrong) {
  folder_.write("bar.argil", k_bar);
  folder_.write("cube.mesh", cube_grid(1, 1, 1));
  const auto message = [&](const std::vector<std::string>& arguments) {
    const Finished finished = argil(arguments);
    EXPECT_EQ(finished.status, 2) << finished.out;
    return finished.err;
  };
  EXPECT_THAT(message({"modes", "none.mesh"}), HasSubstr("no such file"));
  EXPECT_THAT(message({"modes", "bar.argil", "--pin", "x <"}), HasSubstr("--pin"));
  EXPECT_THAT(message({"modes", "bar.argil", "--pin", "x < 9"}), HasSubstr("every control point is pinned"));
  EXPECT_THAT(message({"modes", "bar.argil", "--model", "jelly"}), HasSubstr("corotational"));
  EXPECT_THAT(message({"modes", "cube.mesh"}), HasSubstr("split the control solid once"));
  EXPECT_THAT(message({"export-matrices", "bar.argil"}), HasSubstr("--out"));
  EXPECT_THAT(message({"export-matrices", "bar.argil", "--out", "m", "--max-memory", "20000000"}),
              HasSubstr("--max-memory"));
  EXPECT_EQ(folder_.files(), (std::vector<std::string>{"bar.argil", "cube.mesh"}));
}

}  // namespace
}  // namespace argil::tests
