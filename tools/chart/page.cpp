#include "tools/chart/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "io/file_bytes.h"
#include "io/xml_text.h"
#include "tools/chart/findings.h"

namespace argil::chart {

namespace {

const char* const k_head = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"/><meta name="viewport" content="width=device-width"/>
<title>Speed against accuracy</title>
<style>
:root{color-scheme:light dark;--ground:#f1efec;--panel:#fbfaf8;--ink:#2b2f36;--quiet:#686e78;--line:#d5d8dd;--accent:#a86a10;--warning:#c8431c}
@media (prefers-color-scheme:dark){:root{--ground:#171a1e;--panel:#1e2126;--ink:#e3e5e8;--quiet:#9aa0aa;--line:#3a4049;--accent:#e8a33d;--warning:#f08a6b}}
body{margin:0 auto;max-width:1088px;padding:24px;background:var(--ground);color:var(--ink);
font:15px/1.5 Inter,"DejaVu Sans",system-ui,sans-serif}
h1{font-size:26px;margin:8px 0}h2{font-size:19px;margin:44px 0 8px}
p{max-width:76ch}.quiet{color:var(--quiet)}a{color:var(--accent)}
nav{display:flex;flex-wrap:wrap;gap:4px 16px;margin:16px 0}
figure{margin:12px 0;overflow-x:auto}svg{display:block;max-width:100%;height:auto}
table{border-collapse:collapse;margin:8px 0;font-variant-numeric:tabular-nums}
td,th{padding:3px 16px 3px 0;text-align:left;border-bottom:1px solid var(--line)}td.n,th.n{text-align:right}
th{font-weight:500;color:var(--quiet)}
summary{cursor:pointer;color:var(--warning)}summary.plain{color:var(--quiet)}li{margin:2px 0}
</style></head><body>
)";

std::string front_table(const Panel& panel) {
  std::string html = fmt::format(
      "<details><summary class=\"plain\">The front in "
      "figures</summary><table><tr><th>method</th><th>space</th>{}<th "
      "class=\"n\">unknowns</th><th class=\"n\">error</th><th class=\"n\">{}</th><th "
      "class=\"n\">memory</th></tr>\n",
      panel.in_motion ? "<th class=\"n\">time step</th>" : "", panel.in_motion ? "a simulated second" : "a solve");
  for (const std::size_t i : pareto_front(panel)) {
    const Row& row = panel.rows[i];
    html += fmt::format(
        "<tr><td>{}</td><td>{} {}</td>{}<td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td "
        "class=\"n\">{}</td></tr>\n",
        io::xml_text(row.method()), io::xml_text(row.space), row.resolution,
        panel.in_motion ? fmt::format("<td class=\"n\">{}</td>",
                                      std::isfinite(row.time_step) ? time_step_text(row.time_step) : "")
                        : "",
        row.unknowns, percent_text(row.error), time_text(panel.time(row)),
        std::isfinite(row.peak_bytes) ? fmt::format("{:.1f} MB", row.peak_bytes / 1e6) : "");
  }
  return html + "</table></details>\n";
}

std::string about(const std::vector<Panel>& panels) {
  std::size_t runs = 0, good = 0;
  std::set<int> threads;
  std::set<std::string> versions;
  for (const Panel& panel : panels)
    for (const Row& row : panel.rows) {
      ++runs;
      good += row.status == Status::ok ? 1 : 0;
      threads.insert(row.threads);
      versions.insert(row.version + " (" + row.commit + ")");
    }
  std::string on;
  for (const int t : threads) on += (on.empty() ? "" : " and ") + fmt::format("{} thread{}", t, t == 1 ? "" : "s");
  std::string by;
  for (const std::string& v : versions) by += (by.empty() ? "" : ", ") + v;
  return fmt::format(
      "<p>{} runs of {} problems on {}, argil {}; {} ended well. Lower and further left is better; on the amber "
      "line no "
      "run is both faster and more accurate. Times are the least of short repetitions on this machine: compare "
      "them "
      "within this page only. A solve begins with the discretized body and includes factorisations. Memory is the "
      "growth "
      "of the peak of resident memory during a run. Every row is in <a href=\"chart.csv\">chart.csv</a>.</p>\n",
      runs, panels.size(), on, io::xml_text(by), good);
}

}  // namespace

std::string page(const std::vector<Panel>& panels, const Colours& colours) {
  std::string html = k_head;
  html += "<h1>Speed against accuracy</h1>\n" + about(panels) + "<nav>";
  for (const Panel& panel : panels)
    html += fmt::format("<a href=\"#{}\">{}</a>", panel.name, io::xml_text(panel.title));
  html += "</nav>\n";
  for (const Panel& panel : panels) {
    const Findings found = findings(panel);
    html += fmt::format("<h2 id=\"{}\">{}</h2>\n<p>", panel.name, io::xml_text(panel.title));
    for (const std::string& sentence : found.choice) html += io::xml_text(sentence) + " ";
    html += "</p>\n<figure>" + picture(panel, colours) + "</figure>\n" + front_table(panel);
    if (found.failures.empty()) continue;
    html += fmt::format("<details><summary>What failed, and why ({})</summary><ul>\n", found.failures.size());
    for (const std::string& failure : found.failures) html += "<li>" + io::xml_text(failure) + "</li>\n";
    html += "</ul></details>\n";
  }
  return html + "</body></html>\n";
}

void write_results(const std::filesystem::path& folder, const std::vector<Panel>& panels) {
  const Colours colours(panels);
  for (const Panel& panel : panels) io::write_file(folder / (panel.name + ".svg"), picture(panel, colours));
  io::write_file(folder / "chart.html", page(panels, colours));
}

}  // namespace argil::chart
