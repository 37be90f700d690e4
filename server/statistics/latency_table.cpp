#include "server/statistics/latency_table.h"

#include <algorithm>
#include <cstddef>

#include "server/text/number_text.h"

namespace herr {
namespace {

constexpr int kNameWidth = 18;
constexpr int kNumberWidth = 10;

std::string readable(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string row(const std::string& name, const LatencyHistogram& times, const LatencyHistogram* whole) {
  std::string line = left_aligned(name, kNameWidth);
  const auto add = [&](double ns) { line += right_aligned(fixed_text(ns * 1e-6, 3), kNumberWidth); };
  add(times.mean_ns());
  for (const double fraction : {0.50, 0.95, 0.99}) add(times.quantile_ns(fraction));
  add(static_cast<double>(times.max_ns()));
  if (whole != nullptr && whole->sum_ns() > 0) {
    const double share = static_cast<double>(times.sum_ns()) / static_cast<double>(whole->sum_ns());
    line += right_aligned(fixed_text(100.0 * share, 1) + " %", kNumberWidth);
  }
  return line + "\n";
}

}  // namespace

std::string latency_table(const RunStatistics& statistics) {
  std::string head = left_aligned("stage", kNameWidth);
  for (const char* name : {"mean ms", "p50 ms", "p95 ms", "p99 ms", "max ms", "share"}) {
    head += right_aligned(name, kNumberWidth);
  }
  const std::string rule(head.size(), '-');
  std::string text = head + "\n" + rule + "\n";
  for (std::size_t i = 0; i < kStageCount; ++i) {
    if (statistics.stages[i].sum_ns() == 0) continue;
    text += row(readable(name_of(static_cast<Stage>(i))), statistics.stages[i], &statistics.frame);
  }
  text += rule + "\n" + row("frame", statistics.frame, &statistics.frame);
  if (statistics.sample.sum_ns() > 0) text += row("sample (before)", statistics.sample, nullptr);
  if (statistics.views.sum_ns() > 0) text += row("views (after)", statistics.views, nullptr);
  if (statistics.outside.sum_ns() > 0) text += row("  outside view", statistics.outside, nullptr);
  if (statistics.write.sum_ns() > 0) text += row("write (after)", statistics.write, nullptr);
  if (statistics.cpu.count() > 0) text += row("CPU, all threads", statistics.cpu, nullptr);
  if (statistics.motion_to_photon.count() > 0) {
    text += row("motion to photon", statistics.motion_to_photon, nullptr);
  }
  return text;
}

}  // namespace herr
