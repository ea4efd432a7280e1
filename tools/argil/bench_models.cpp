#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "io/file_bytes.h"
#include "sculpt/picture.h"
#include "sculpt/session.h"
#include "subdiv/error.h"
#include "tools/argil/program.h"
#include "tools/view/offscreen_renderer.h"

namespace argil::tools {

namespace {

/// A row of papers/004, Table 1 (Pentium 4 at 2.8 GHz). Shares are in per cent of the elements.
struct PublishedRow {
  const char* session;
  const char* name;
  int control_cells, elements;
  double frames_per_second, milliseconds;
  int cubic, linear, pyramid;
};
constexpr std::array<PublishedRow, 8> k_table_1{{{"soccer_player", "Soccer player", 24, 1536, 7.4, 135, 24, 76, 0},
                                                 {"sea_monster", "Sea monster", 38, 320, 21.3, 47, 94, 3, 4},
                                                 {"block_3", "3³ block", 27, 1728, 3.2, 310, 58, 42, 0},
                                                 {"chair", "Chair", 76, 984, 11.1, 90, 68, 3, 29},
                                                 {"block_4", "4³ block", 64, 296, 11.9, 84, 58, 33, 0},
                                                 {"head", "Head", 123, 1241, 9.1, 110, 82, 1, 17},
                                                 {"bridge", "Bridge", 150, 1200, 4.7, 213, 95, 5, 0},
                                                 {"nozzle", "Nozzle", 99, 792, 13.3, 75, 100, 0, 0}}};

struct Row {
  std::string name;
  const PublishedRow* published = nullptr;
  std::size_t control_cells = 0, elements = 0, unknowns = 0;
  double cubic = 0, linear = 0, pyramid = 0;  // shares of the elements
  double milliseconds = 0, frames_per_second = 0;
};

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// What holds a model whose session pins nothing: its lowest twentieth.
void hold(sculpt::Session& session) {
  const sculpt::Document& document = session.document();
  if (!document.state().pins->control_points.empty() || !document.state().pins->nodes.empty()) return;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const subdiv::VertexId v : document.solid().vertices()) {
    low = std::min(low, document.rest()(2, v.value));
    high = std::max(high, document.rest()(2, v.value));
  }
  session.run_line(fmt::format("pin where z < {:.17g}", low + 0.05 * (high - low)));
}

Row measure_model(const std::filesystem::path& file, const BenchArguments& arguments, sculpt::Renderer* renderer) {
  sculpt::SessionOptions options;
  options.read_root = file.parent_path();
  options.out = arguments.out / file.stem();
  options.write_journal = false;
  options.clock = seconds;
  options.overrides = arguments.overrides;
  sculpt::Session session(options);
  session.run_text(io::read_file(file), file.string());
  hold(session);
  session.run_line("gravity 3 0 -9.81");
  session.run_line("step 5 dt 1/60");  // what is made once: not counted
  const std::size_t before = session.steps().size();
  session.run_line(fmt::format("step {} dt 1/60", arguments.steps));
  std::vector<double> step_ms, picture_ms;
  for (std::size_t i = before; i < session.steps().size(); ++i) step_ms.push_back(session.steps()[i].ms);

  const sculpt::Document& document = session.document();
  const fem::Discretization& d = document.discretization();
  Row row;
  row.name = file.stem().string();
  for (const PublishedRow& published : k_table_1)
    if (row.name == published.session) row.published = &published;
  row.control_cells = document.solid().cell_count();
  row.elements = d.elements.cubic + d.elements.linear + d.elements.pyramid;
  row.unknowns = 3 * document.solid().vertex_count();
  const double n = std::max<double>(1, static_cast<double>(row.elements));
  row.cubic = static_cast<double>(d.elements.cubic) / n;
  row.linear = static_cast<double>(d.elements.linear) / n;
  row.pyramid = static_cast<double>(d.elements.pyramid) / n;
  row.milliseconds = median(step_ms);
  if (renderer != nullptr) {
    sculpt::PictureOptions picture;
    picture.width = 640;
    picture.height = 480;
    picture.samples = 1;
    for (int i = 0; i < 5; ++i) {
      const double start = seconds();
      (void)renderer->render(sculpt::make_scene(document, {}), picture);
      picture_ms.push_back(1e3 * (seconds() - start));
    }
    row.frames_per_second = 1e3 / (row.milliseconds + median(picture_ms));
  }
  return row;
}

std::string share(double ours, std::optional<int> published) {
  return fmt::format("{:>3.0f} {:>3}", 100 * ours, published ? fmt::format("{}", *published) : "");
}

void print_table(const std::vector<Row>& rows, const BenchArguments& arguments) {
  std::printf(
      "papers/004, Table 1: ours | the paper's (Pentium 4, 2.8 GHz). %s; median of %ld steps at 1/60 s, %d "
      "threads.\n",
      arguments.description.c_str(), arguments.steps, arguments.threads);
  std::printf("%-15s %-11s %-11s %-13s %-15s %-8s %-8s %-8s %s\n", "model", "#CC", "#FE", "FPS", "MSPI", "%BE",
              "%LE", "%PE", "unknowns");
  for (const Row& row : rows) {
    const PublishedRow* p = row.published;
    const auto of = [&](auto member) { return p ? std::optional<int>(p->*member) : std::nullopt; };
    std::printf("%s",
                fmt::format("{:<15} {:>5} {:>5} {:>5} {:>5} {:>6.1f} {:>6} {:>7.2f} {:>7} {:<8} {:<8} {:<8} {}\n",
                            row.name, row.control_cells, p ? fmt::format("{}", p->control_cells) : "", row.elements,
                            p ? fmt::format("{}", p->elements) : "", row.frames_per_second,
                            p ? fmt::format("{}", p->frames_per_second) : "", row.milliseconds,
                            p ? fmt::format("{}", p->milliseconds) : "", share(row.cubic, of(&PublishedRow::cubic)),
                            share(row.linear, of(&PublishedRow::linear)),
                            share(row.pyramid, of(&PublishedRow::pyramid)), row.unknowns)
                    .c_str());
  }
  std::printf(
      "%%BE, %%LE, %%PE count what is integrated in the space that was chosen; METHODS says which printed "
      "shares to trust.\n");
}

void print_json(const std::vector<Row>& rows) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Row& row : rows) {
    nlohmann::ordered_json entry = {{"model", row.name},
                                    {"control_cells", row.control_cells},
                                    {"elements", row.elements},
                                    {"unknowns", row.unknowns},
                                    {"frames_per_second", row.frames_per_second},
                                    {"ms_per_step", row.milliseconds},
                                    {"cubic_share", row.cubic},
                                    {"linear_share", row.linear},
                                    {"pyramid_share", row.pyramid}};
    if (const PublishedRow* p = row.published)
      entry["published"] = {{"control_cells", p->control_cells},         {"elements", p->elements},
                            {"frames_per_second", p->frames_per_second}, {"ms_per_step", p->milliseconds},
                            {"cubic_share", p->cubic / 100.0},           {"linear_share", p->linear / 100.0},
                            {"pyramid_share", p->pyramid / 100.0}};
    json.push_back(entry);
  }
  std::printf("%s\n", json.dump(2).c_str());
}

}  // namespace

int bench_models(BenchArguments arguments) {
  std::error_code failure;
  if (!std::filesystem::is_directory(arguments.folder, failure))
    throw Error(ErrorCode::not_found,
                fmt::format("there is no folder '{}'; name one that holds sessions, such as samples/models",
                            arguments.folder.string()));
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(arguments.folder))
    if (entry.path().extension() == ".argil") files.push_back(entry.path());
  if (files.empty())
    throw Error(ErrorCode::not_found,
                fmt::format("the folder '{}' holds no session (*.argil); name another", arguments.folder.string()));
  const auto place = [](const std::filesystem::path& file) {  // the paper's order, then by name
    std::size_t i = 0;
    while (i < k_table_1.size() && file.stem() != k_table_1[i].session) ++i;
    return std::pair(i, file.stem().string());
  };
  std::sort(files.begin(), files.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
  if (arguments.threads <= 0) arguments.threads = static_cast<int>(std::thread::hardware_concurrency());
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(arguments.threads));
  std::unique_ptr<sculpt::Renderer> renderer;
  try {
    renderer = view::make_offscreen_renderer();
  } catch (const Error& error) {
    std::fprintf(stderr, "argil: no frames are counted: %s\n", error.what());
  }
  for (const auto& [name, value] : arguments.overrides)
    arguments.description += (arguments.description.empty() ? "" : ", ") + name + " " + value;
  if (arguments.description.empty()) arguments.description = "each session's own space, model and integrator";
  std::vector<Row> rows;
  for (const std::filesystem::path& file : files) {
    std::fprintf(stderr, "  %s\n", file.stem().string().c_str());
    rows.push_back(measure_model(file, arguments, renderer.get()));
  }
  if (arguments.json)
    print_json(rows);
  else
    print_table(rows, arguments);
  return k_well;
}

}  // namespace argil::tools
