#include "server/serve/prometheus_text.h"

#include <array>
#include <cmath>

#include "server/text/number_text.h"

namespace herr {
namespace {

constexpr std::array kBucketBounds{0.002,  0.004, 0.00556, 0.00833, 0.0111, 0.0139, 0.0167, 0.0222,
                                   0.0333, 0.05,  0.1,     0.25,    0.5,    1.0,    2.5};

std::string number(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0 ? "+Inf" : "-Inf";
  return shortest_text(value);
}

std::string escaped(const std::string& text, bool quotes) {
  std::string result;
  for (const char c : text) {
    if (c == '\\') {
      result += "\\\\";
    } else if (c == '\n') {
      result += "\\n";
    } else if (c == '"' && quotes) {
      result += "\\\"";
    } else {
      result += c;
    }
  }
  return result;
}

}  // namespace

void PrometheusText::family(const std::string& name, const std::string& type, const std::string& help) {
  family_ = name;
  text_ += "# HELP " + name + " " + escaped(help, false) + "\n# TYPE " + name + " " + type + "\n";
}

void PrometheusText::line(const std::string& suffix, const Labels& labels, const std::string& value) {
  text_ += family_ + suffix;
  const char* before = "{";
  for (const auto& [name, label] : labels) {
    text_ += before + name + "=\"" + escaped(label, true) + "\"";
    before = ",";
  }
  if (!labels.empty()) text_ += "}";
  text_ += " " + value + "\n";
}

void PrometheusText::sample(double value, const Labels& labels) {
  line("", labels, number(value));
}

void PrometheusText::sample(std::int64_t value, const Labels& labels) {
  line("", labels, std::to_string(value));
}

void PrometheusText::histogram(const LatencyHistogram& durations, const Labels& labels) {
  Labels with_bound = labels;
  with_bound.emplace_back("le", "");
  for (const double bound : kBucketBounds) {
    with_bound.back().second = number(bound);
    line("_bucket", with_bound, std::to_string(durations.count_up_to_ns(std::llround(bound * 1e9))));
  }
  with_bound.back().second = "+Inf";
  line("_bucket", with_bound, std::to_string(durations.count()));
  line("_sum", labels, number(static_cast<double>(durations.sum_ns()) * 1e-9));
  line("_count", labels, std::to_string(durations.count()));
}

}  // namespace herr
