#pragma once
// The subcommands of the program, one source file each. They throw argil::Error for what a user can mend; main()
// turns that into a message and an exit status (SESSION.md): 0 all well, 1 an expectation failed, 2 bad input, 3
// our own bug.

#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "sculpt/document.h"
#include "subdiv/progress.h"
#include "tools/argil/body.h"

namespace argil::tools {

inline constexpr int k_well = 0, k_expectation_failed = 1, k_bad_input = 2, k_own_bug = 3;

struct ReplayArguments {
  std::filesystem::path session, out, hash_trace, trace;
  std::filesystem::path files;  // names in the session are read beneath it; empty: beneath the session's folder
  int threads = 0;              // 0: all
  long until = -1;
  std::vector<std::string> overrides;  // "space=cubic"
  sculpt::Limits limits;
  bool json = false, quiet = false, pictures = true;
  bool journal = false;  // of a program that was killed: its last line may be half written, and is left out then
};
int replay(const ReplayArguments& arguments);

int diff(const std::filesystem::path& a, const std::filesystem::path& b, bool json);

int info(const std::filesystem::path& mesh, bool json);
int refine(const std::filesystem::path& in, const std::filesystem::path& out, int levels, bool limit,
           std::size_t max_cells);
int elements(const std::filesystem::path& mesh, int levels, const std::string& space, int split, bool json,
             std::size_t max_cells);

struct ConvertArguments {
  std::filesystem::path in, out;
  std::string encoding, version;  // empty: the usual ones of the format
  bool repair = false;
};
int convert(const ConvertArguments& arguments);
int formats(bool markdown);

struct RenderArguments {
  std::filesystem::path mesh, out;
  int levels = 0;
  std::string options;  // of the session command `render`
  std::size_t max_cells = sculpt::Limits{}.cells;
};
int render(const RenderArguments& arguments);

struct BenchArguments {
  std::filesystem::path folder = "samples/models", out = "out/bench_models";
  std::map<std::string, std::string> overrides;  // space, model, integrator
  std::string description;                       // of them; made
  long steps = 30;
  int threads = 0;  // 0: all
  bool json = false;
};
/// Every session of the folder, simulated under gravity after its end, beside the table of papers/004 where the
/// name is one of its models.
int bench_models(BenchArguments arguments);

struct StudioBenchArguments {
  std::filesystem::path folder = "samples/models", out = "out/bench_studio";
  int frames = 240;  // that are timed
};
int bench_studio(const StudioBenchArguments& arguments);
struct ChartArguments {
  std::filesystem::path session, out = "out/chart";                // no session: the problems of the chart
  std::vector<std::string> problems, models, spaces, integrators;  // empty: all
  bool quick = false, every = false, list = false, quiet = false;
  int threads = 0;   // 0: all
  double limit = 0;  // seconds a run; 0: as the breadth says
};
int chart(const ChartArguments& arguments);
struct DevicesArguments {
  bool bench = false, json = false;
  std::string serve, address = "127.0.0.1";  // a device's name; empty: none is served
  std::uint16_t port = 7171;
  double seconds = 0;  // of serving (0: for ever) or of the bench (0: 2 s)
};
int devices_command(const DevicesArguments& arguments);
struct ModesArguments {
  BodyArguments body;
  int count = 6;
  std::string at = "present";  // or rest: where the stiffness is taken
  std::filesystem::path out;   // for modes.vtu; empty: none
  bool json = false;
};
int modes(const ModesArguments& arguments);

struct MatricesArguments {
  BodyArguments body;
  std::string at = "present";
  std::filesystem::path out;
  bool json = false;
};
int export_matrices(const MatricesArguments& arguments);

struct AtlasArguments {
  std::filesystem::path session;  // a body of the user's; empty: none
  std::filesystem::path out = "out/atlas";
  std::vector<std::string> sweeps, models, integrators;  // empty: all
  int threads = 0;                                       // 0: all
  bool quick = false, list = false, quiet = false;
};
int stability_atlas(const AtlasArguments& arguments);

struct MovieArguments {
  std::filesystem::path session, out;
  std::string file;     // beneath `out`: .mp4, .gif or .png; empty: the session's name, .mp4 where there is ffmpeg
  std::string options;  // of the session command `render`
  double rate = 30;     // pictures a second of simulated time
  bool turntable = false;
  double seconds = 6;               // of a turn
  std::filesystem::path read_root;  // of what the session reads; empty: its folder
  sculpt::Limits limits;
  bool quiet = false;
};
struct Movie {
  std::filesystem::path file;
  std::size_t pictures = 0;
  bool without_ffmpeg = false;  // that was not there: pictures are numbered
};
/// Makes a film of what a session's file holds, without printing. `progress` hears shares of all of it, 0 … 1 and
/// never falling; what it throws ends the film, of which nothing stays then.
Movie make_movie(const MovieArguments& arguments, const std::string& session, const Progress::Listener& progress);
/// The same for a user at a terminal.
int movie(const MovieArguments& arguments);

struct StudioArguments {
  std::filesystem::path file;                // a session or a volume mesh; empty: a new block
  std::filesystem::path script;              // runs off the screen; empty: a window
  std::filesystem::path out = "out/studio";  // journal, results, pictures of a script
  std::string device = "mouse";              // to sculpt with in a window
  sculpt::Limits limits;
};
int studio(const StudioArguments& arguments);

int help(const std::string& command);
int help_document();

}  // namespace argil::tools
