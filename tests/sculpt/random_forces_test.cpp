// Random sessions of force tools at strengths, time steps and materials far beyond what is sensible, over bodies,
// methods and models: none ends with a value that is not finite, a body that is lost, or a step without end, and at
// most one in a hundred is frozen or stands still for the guard at its end. At gentle parameters the end is that of
// a careful implicit run. ARGIL_FUZZ_FORCES asks for more sessions than the few of every run, ARGIL_FUZZ_SEED for
// others.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <mutex>
#include <random>
#include <set>

#include "sessions.h"

namespace argil::sculpt {
namespace {

struct ForceSession {
  std::vector<std::string> body, motion;
  std::string method, model;
  bool gentle = false;
};

class RandomForces {
 public:
  explicit RandomForces(std::uint32_t seed) : engine_(seed) {}

  ForceSession next(bool gentle) {
    ForceSession result;
    result.gentle = gentle;
    // Shapes with a point on the surface where a tool can take hold.
    struct Shape {
      const char *line, *at;
      bool hexahedra;
    };
    static constexpr Shape k_shapes[] = {
        {"new box 3 1 1 size 0.3 0.1 0.1", "0.3 0.05 0.05", true},
        {"new box 2 2 2 size 0.2 0.2 0.2", "0.1 0.1 0.2", true},
        {"new box 4 1 1 size 0.4 0.1 0.05", "0.4 0.05 0.03", true},
        {"new box 2 2 1 size 0.2 0.2 0.1", "0.1 0.1 0.1", true},
        {"new wedge size 0.2 0.2 0.2", "0.1 0.1 0", false},
        {"new pyramid size 0.2 0.2 0.2", "0.1 0.1 0", false},
        {"new tetrahedron size 0.2 0.2 0.2", "0.05 0.05 0", false},
    };
    const Shape& shape = k_shapes[pick(gentle ? 4 : std::size(k_shapes))];
    const int level = shape.hexahedra ? (gentle ? 0 : static_cast<int>(pick(2))) : 1;
    const double young = gentle ? logarithmic(1e4, 1e5) : logarithmic(1e2, 1e10);
    const double poisson = gentle ? number(0, 0.4) : (pick(3) == 0 ? number(0.45, 0.4999) : number(0, 0.45));
    const double density = gentle ? 1000 : logarithmic(10, 5000);
    auto& lines = result.body;
    lines = {shape.line, fmt::format("levels {}", level), fmt::format("set young_modulus {:.4g}", young),
             fmt::format("set poisson_ratio {:.4f}", poisson), fmt::format("set density {:.4g}", density)};
    if (pick(2))
      lines.push_back(fmt::format("paint young_modulus scale {:.4g} where x < {:.3f}",
                                  gentle ? logarithmic(1, 3) : logarithmic(1, std::min(1e4, 9e12 / young)),
                                  number(0.05, 0.2)));
    const auto models = fem::model_table();
    const auto methods = fem::method_table();
    result.model = gentle ? "corotational" : std::string(models[pick(models.size())].name);
    const fem::MethodKind& method = methods[pick(methods.size())];
    result.method = std::string(gentle && method.order == 0 ? methods.front().name : method.name);
    if (gentle) {
      lines.push_back("set damping 30");
    } else {
      if (pick(2)) lines.push_back(fmt::format("set damping {:.4g}", logarithmic(0.1, 100)));
      if (pick(3) == 0) lines.push_back(fmt::format("set stiffness_damping {:.4g}", logarithmic(1e-5, 0.1)));
      if (pick(4) == 0) lines.push_back("space cubic");
    }
    if (gentle || pick(2)) lines.push_back("pin where x < 0.02 or z > 10");
    if (!gentle && pick(2)) lines.push_back("gravity 0 0 -9.81");

    static constexpr const char* k_tools[] = {"pull", "pull", "grab", "inflate", "twist", "pinch", "smooth"};
    const double reach = gentle ? 0.02 : number(0.01, 1);
    // The highest frequency of a gentle body is up to 1000 rad/s. Of the methods that gain energy at any step, its
    // damping of 30/s holds the midpoint rule up to (ωh)⁴/4 < 30 h and forward Euler up to ω² h < 30.
    const double smallest = result.method == "forward_euler" ? 2e-5 : (result.method == "midpoint" ? 2e-4 : 5e-4);
    const double step = gentle ? smallest : logarithmic(2e-4, 1.0 / 20);
    const int ticks = gentle ? 150 : static_cast<int>(std::min(400.0, 30 + 60 * step * 1000));
    lines.push_back(fmt::format("tool {} radius 0.08 strength {:.4g}",
                                gentle ? "pull" : k_tools[pick(std::size(k_tools))],
                                gentle ? 1e-4 * young : logarithmic(1, 1e7)));
    const double x = number(-1, 1), y = number(-1, 1), z = number(-1, 1);
    const double scale = reach / std::max(0.1, std::sqrt(x * x + y * y + z * z));
    double at[3];
    std::sscanf(shape.at, "%lf %lf %lf", &at[0], &at[1], &at[2]);
    result.motion = {fmt::format("step 1 dt {:.6g}", step),
                     fmt::format("stroke from {} to {:.4f} {:.4f} {:.4f} ticks {}{}", shape.at, at[0] + scale * x,
                                 at[1] + scale * y, at[2] + scale * z, ticks, gentle ? " hold 350" : "")};
    if (!gentle) result.motion.push_back("step 20");
    return result;
  }

 private:
  std::size_t pick(std::size_t count) { return engine_() % count; }
  double number(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_()) / 4294967295.0;
  }
  double logarithmic(double low, double high) { return std::exp(number(std::log(low), std::log(high))); }

  std::mt19937 engine_;
};

struct Tally {
  long sessions = 0, refused = 0, too_stiff = 0, gentle = 0, frozen = 0, frozen_at_times = 0, eased_at_end = 0,
       coasting = 0, steps = 0, sessions_with_help = 0;
  std::map<std::string, long> found, helped, frozen_by, help_by_method, sessions_by_method, sessions_by_model;
  std::map<std::string, std::map<std::string, long>> remedies_by_model;  // sessions that needed it
  double worst_gentle = 0;
  long most_iterations = 0;
  std::string worst_gentle_session;

  void add(const Tally& other) {
    sessions += other.sessions;
    refused += other.refused;
    too_stiff += other.too_stiff;
    gentle += other.gentle;
    frozen += other.frozen;
    frozen_at_times += other.frozen_at_times;
    eased_at_end += other.eased_at_end;
    coasting += other.coasting;
    steps += other.steps;
    sessions_with_help += other.sessions_with_help;
    for (const auto& [name, count] : other.found) found[name] += count;
    for (const auto& [name, count] : other.helped) helped[name] += count;
    for (const auto& [name, count] : other.frozen_by) frozen_by[name] += count;
    for (const auto& [name, count] : other.help_by_method) help_by_method[name] += count;
    for (const auto& [name, count] : other.sessions_by_method) sessions_by_method[name] += count;
    for (const auto& [name, count] : other.sessions_by_model) sessions_by_model[name] += count;
    for (const auto& [name, remedies] : other.remedies_by_model)
      for (const auto& [remedy, count] : remedies) remedies_by_model[name][remedy] += count;
    if (other.worst_gentle > worst_gentle) {
      worst_gentle = other.worst_gentle;
      worst_gentle_session = other.worst_gentle_session;
    }
    most_iterations = std::max(most_iterations, other.most_iterations);
  }
};

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += "\n  " + line;
  return text;
}

/// What the guard did, equal steps together: "12 none, 3 restored (inversion), …".
std::string history(const std::vector<StepRecord>& steps) {
  std::string text;
  for (std::size_t begin = 0, end; begin < steps.size(); begin = end) {
    const StepRecord& step = steps[begin];
    for (end = begin; end < steps.size() && steps[end].remedy == step.remedy && steps[end].finding == step.finding;)
      ++end;
    text += fmt::format("{}{} {}", begin == 0 ? "" : ", ", end - begin, fem::word(step.remedy));
    if (step.finding != fem::GuardFinding::none) text += fmt::format(" ({})", fem::word(step.finding));
  }
  return text;
}

void run_session(std::uint32_t seed, Tally& tally) {
  RandomForces random(seed);
  const ForceSession session = random.next(seed % 5 == 0);
  const std::string place = fmt::format("seed {}, {} by {}{}{}", seed, session.model, session.method,
                                        joined(session.body), joined(session.motion));
  SessionOptions options;
  options.write_journal = false;
  TestSession test({}, options);
  test.run(session.body);
  try {
    test.run({fmt::format("model {}", session.model), fmt::format("integrator {}", session.method)});
    static_cast<void>(test.document().model());
  } catch (const Error&) {
    ++tally.refused;  // a model that has no forces for these elements
    return;
  }
  ++tally.sessions;
  ++tally.sessions_by_method[session.method];
  ++tally.sessions_by_model[session.model];
  try {
    test.run(session.motion);
  } catch (const Error& error) {
    // The published method says that the body is too stiff for it; what was is still there.
    EXPECT_EQ(error.code(), ErrorCode::limit_exceeded) << error.what() << "\n" << place;
    EXPECT_EQ(session.method, "published") << error.what() << "\n" << place;
    EXPECT_TRUE(test.document().positions().allFinite()) << place;
    ++tally.too_stiff;
    return;
  }
  const Eigen::Matrix3Xd& p = test.document().positions();
  ASSERT_TRUE(p.allFinite()) << place;
  ASSERT_TRUE(test.state().motion->velocities.allFinite()) << place;
  // Half a second of free fall is 1.2 m, a tool goes 1 m, and what it throws may go as far again.
  // Pressure does not end where the device does: what it blows away is anywhere.
  const bool blown = joined(session.body).find("tool inflate") != std::string::npos;
  EXPECT_TRUE(blown || p.cwiseAbs().maxCoeff() <= 20) << p.cwiseAbs().maxCoeff() << " m, " << place;
  std::set<fem::GuardRemedy> remedies;
  for (const StepRecord& step : test->steps()) {
    ++tally.steps;
    tally.most_iterations = std::max(tally.most_iterations, static_cast<long>(step.linear_iterations));
    if (step.remedy == fem::GuardRemedy::none) continue;
    remedies.insert(step.remedy);
    tally.coasting += step.remedy == fem::GuardRemedy::implicit_euler && !step.converged && step.residual > 0.5;
    ++tally.found[std::string(fem::word(step.finding))];
    ++tally.helped[std::string(fem::word(step.remedy))];
  }
  const bool helped = !remedies.empty();
  tally.sessions_with_help += helped;
  tally.help_by_method[session.method] += helped;
  tally.frozen_at_times += remedies.contains(fem::GuardRemedy::frozen);
  for (const fem::GuardRemedy remedy : remedies)
    ++tally.remedies_by_model[session.model][std::string(fem::word(remedy))];
  const bool stands = test->steps().back().remedy >= fem::GuardRemedy::restored;
  tally.frozen += stands;
  tally.eased_at_end += !stands && test->steps().back().remedy >= fem::GuardRemedy::eased;
  if (stands) ++tally.frozen_by[session.model + " by " + session.method];
  if (std::getenv("ARGIL_FUZZ_PRINT") && remedies.size() > 0 && *remedies.rbegin() >= fem::GuardRemedy::eased)
    fmt::print("{}: {}\n  {}\n", stands ? "frozen" : "eased", place, history(test->steps()));
  if (!session.gentle) return;
  ++tally.gentle;
  EXPECT_FALSE(helped) << "the guard acted where nothing was wrong: " << place;
  TestSession careful({}, options);
  careful.run(session.body);
  careful.run({"integrator bdf2 newton 30 tolerance 1e-8"});
  careful.run(session.motion);
  const double moved = (careful.document().positions() - careful.document().rest()).norm();
  const double away = (careful.document().positions() - p).norm() / moved;
  EXPECT_LE(away, 0.05) << place;
  if (away > tally.worst_gentle) {
    tally.worst_gentle = away;
    tally.worst_gentle_session = place;
  }
}

long asked(const char* name, long otherwise) {
  const char* text = std::getenv(name);
  return text ? std::atol(text) : otherwise;
}

std::string counts(const std::map<std::string, long>& of) {
  std::string text;
  for (const auto& [name, count] : of) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name);
  return text.empty() ? "none" : text;
}

TEST(RandomForcesSlow, LoseNoBody) {
  const long sessions = asked("ARGIL_FUZZ_FORCES", 40);
  const auto first_seed = static_cast<std::uint32_t>(asked("ARGIL_FUZZ_SEED", 1));
  Tally tally;
  std::mutex mutex;
  tbb::parallel_for(0L, sessions, [&](long i) {
    Tally one;
    run_session(first_seed + static_cast<std::uint32_t>(i), one);
    const std::lock_guard lock(mutex);
    tally.add(one);
  });
  fmt::print(
      "{} sessions, {} refused beforehand, {} too stiff for their method, {} steps, at most {} linear iterations "
      "in one\n",
      tally.sessions, tally.refused, tally.too_stiff, tally.steps, tally.most_iterations);
  fmt::print("guard acted in {} sessions; found: {}; steps: {}\n", tally.sessions_with_help, counts(tally.found),
             counts(tally.helped));
  fmt::print("of the steps by implicit Euler {} left more than half of the residual\n", tally.coasting);
  for (const auto& [method, count] : tally.sessions_by_method)
    fmt::print("  {:<20} {:>4} sessions, helped in {:>4}\n", method, count, tally.help_by_method[method]);
  for (const auto& [model, count] : tally.sessions_by_model)
    fmt::print("  {:<22} {:>4} sessions, of them {}\n", model, count, counts(tally.remedies_by_model[model]));
  fmt::print("frozen at times: {}; eased to the end: {}; frozen at the end: {} ({})\n", tally.frozen_at_times,
             tally.eased_at_end, tally.frozen, counts(tally.frozen_by));
  fmt::print("{} gentle sessions, at most {:.2g} from the careful run\n", tally.gentle, tally.worst_gentle);
  if (std::getenv("ARGIL_FUZZ_PRINT")) fmt::print("worst: {}\n", tally.worst_gentle_session);
  EXPECT_GT(tally.sessions, sessions / 2);
  EXPECT_GT(tally.sessions_with_help, 0);  // else it would try little
  EXPECT_LE(tally.frozen, std::max(1L, sessions / 100));
  // A step has at most 154 substeps, each of at most 50 Newton iterations.
  EXPECT_LE(tally.most_iterations, 200000);
}

}  // namespace
}  // namespace argil::sculpt
