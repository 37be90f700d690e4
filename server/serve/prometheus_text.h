// Metrics as text, format 0.0.4 of Prometheus: families in one piece, help and type first, labels escaped,
// numbers in any locale the same. Source: prometheus/docs, exposition_formats.md.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "server/statistics/latency_histogram.h"

namespace herr {

class PrometheusText {
 public:
  using Labels = std::vector<std::pair<std::string, std::string>>;
  static constexpr const char* kContentType = "text/plain; version=0.0.4; charset=utf-8";

  // `type`: "counter", "gauge" or "histogram". The samples that follow belong to this family.
  void family(const std::string& name, const std::string& type, const std::string& help);
  void sample(double value, const Labels& labels = {});
  void sample(std::int64_t value, const Labels& labels = {});
  // In seconds, buckets around the periods of displays (180, 120, 90, 72, 60, 45, 30 Hz).
  void histogram(const LatencyHistogram& durations, const Labels& labels = {});

  const std::string& text() const { return text_; }

 private:
  void line(const std::string& suffix, const Labels& labels, const std::string& value);

  std::string family_, text_;
};

}  // namespace herr
