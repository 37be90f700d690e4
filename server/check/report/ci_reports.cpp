#include "server/check/report/ci_reports.h"

#include <algorithm>
#include <vector>

#include "server/text/number_text.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

constexpr std::size_t kMostAnnotations = 10;

// Counters and times that decide, alike.
struct Finding {
  std::string name;
  Verdict verdict = Verdict::inconclusive;
  std::string baseline, candidate, change, limit, text;
};

std::vector<Finding> findings_of(const CheckReport& report) {
  std::vector<Finding> findings;
  for (const CheckedTime& time : report.times) {
    if (!time.decides) continue;
    Finding finding{"frame time, " + time.title, time.verdict, "", "", "", "", time.reason};
    if (report.baseline_ms) finding.baseline = fixed_text(*report.baseline_ms, 2) + " ms";
    if (report.candidate_ms) finding.candidate = fixed_text(*report.candidate_ms, 2) + " ms";
    finding.limit = "+" + fixed_text(100 * time.rule.limit, 0) + " %";
    if (time.verdict != Verdict::not_comparable) finding.change = change_text(time.shift.estimate);
    if (finding.text.empty()) {
      finding.text = slower_text(time.shift.estimate) + " (bounds " + bounds_text(time.shift) + ", p " +
                     p_text(time.shift.p) + "), limit " + finding.limit;
    }
    finding.text = with_remarks(finding.text, report, time.verdict, true);
    findings.push_back(finding);
  }
  for (const CounterJudgement& counter : report.counters) {
    Finding finding{counter.name,
                    counter.verdict,
                    fixed_text(counter.baseline, 1),
                    fixed_text(counter.candidate, 1),
                    counter_change_text(counter),
                    "+" + fixed_text(100 * kCounterLimit, 1) + " %",
                    counter.reason};
    if (finding.text.empty()) {
      finding.text = finding.candidate + " per frame, before " + finding.baseline + " (" + finding.change +
                     "), limit " + finding.limit;
    }
    finding.text = with_remarks(finding.text, report, counter.verdict, false);
    findings.push_back(finding);
  }
  return findings;
}

// Where a check has no findings of its own: it broke off, nothing compares, or runs were stored.
Finding whole_check(const CheckReport& report) {
  return {"check", report.verdict, "", "", "", "", report.error.empty() ? report.reason : report.error};
}

std::string xml(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        // XML 1.0 has no place for control characters, not even escaped.
        escaped += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return escaped;
}

std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|' || c == '\\' || c == '<' || c == '*' || c == '_' || c == '`') escaped += '\\';
    escaped += c == '\n' ? ' ' : c;
  }
  return escaped;
}

// Of a workflow command: properties end at a comma or colon too.
std::string command(const std::string& text, bool property) {
  std::string escaped;
  for (const char c : text) {
    if (c == '%') {
      escaped += "%25";
    } else if (c == '\n') {
      escaped += "%0A";
    } else if (c == '\r') {
      escaped += "%0D";
    } else if (property && c == ':') {
      escaped += "%3A";
    } else if (property && c == ',') {
      escaped += "%2C";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

std::string junit_time(double seconds) {
  return "\" time=\"" + fixed_text(seconds, 3) + "\"";
}

std::string junit_case(const CheckReport& report, const Finding& finding, double seconds) {
  std::string text = "    <testcase classname=\"herr.check." + xml(report.session) + "\" name=\"" +
                     xml(finding.name) + junit_time(seconds) + ">\n";
  const std::string message = "message=\"" + xml(finding.text) + "\"/>\n";
  if (!report.error.empty()) {
    text += "      <error " + message;
  } else if (finding.verdict == Verdict::not_comparable) {
    text += "      <error type=\"not comparable\" " + message;
  } else if (finding.verdict == Verdict::regression) {
    text += "      <failure type=\"regression\" " + message;
  } else if (finding.verdict != Verdict::ok) {
    text += "      <skipped " + message;
  }
  if (!finding.text.empty()) text += "      <system-out>" + xml(finding.text) + "</system-out>\n";
  return text + "    </testcase>\n";
}

}  // namespace

std::string check_markdown(const CheckReport& report) {
  std::string text = "### herr check: " + cell(report.session) + "\n\n**" + cell(headline(report)) + "**\n\n";
  if (!report.candidate.empty()) {
    text += cell(report.candidate) + " against " + cell(report.baseline) + "; " + cell(report.settings) +
            "; " + counted(report.runs, "run", "runs") + " of " + counted(report.frames, "frame", "frames") +
            ".\n\n";
  }
  for (const AllowedDifference& part : differences_by_part(report)) {
    text += "Differs, as allowed: " + cell(part.part + ": " + part.text) + ".\n\n";
  }
  const std::vector<Finding> findings = findings_of(report);
  if (findings.empty()) return text;
  text += "| | baseline | candidate | change | limit | verdict |\n|---|---:|---:|---:|---:|---|\n";
  for (const Finding& finding : findings) {
    text += "| " + cell(finding.name) + " | " + finding.baseline + " | " + finding.candidate + " | " +
            finding.change + " | " + finding.limit + " | " + name_of(finding.verdict) + " |\n";
  }
  return text + "\n";
}

std::string check_junit(const CheckReport& report) {
  std::vector<Finding> findings = findings_of(report);
  if (findings.empty() || !report.error.empty()) findings.push_back(whole_check(report));
  const auto count_of = [&](Verdict verdict) {
    return std::count_if(findings.begin(), findings.end(),
                         [verdict](const Finding& finding) { return finding.verdict == verdict; });
  };
  const bool broken = !report.error.empty();
  const std::string total = std::to_string(findings.size());
  const auto failures = count_of(Verdict::regression);
  const auto skipped = count_of(Verdict::noisy) + count_of(Verdict::inconclusive);
  const std::string errors = broken ? total : std::to_string(count_of(Verdict::not_comparable));
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n  <testsuite name=\"herr check\" tests=\"" +
      total + "\" failures=\"" + std::to_string(broken ? 0 : failures) + "\" errors=\"" + errors +
      "\" skipped=\"" + std::to_string(broken ? 0 : skipped) + junit_time(report.seconds) + ">\n" +
      "    <properties>\n";
  const auto property = [&](const std::string& name, const std::string& value) {
    text += "      <property name=\"" + name + "\" value=\"" + xml(value) + "\"/>\n";
  };
  property("candidate", report.candidate);
  property("baseline", report.baseline);
  property("settings", report.settings);
  property("runs", std::to_string(report.runs));
  property("frames per run", std::to_string(report.frames));
  if (!report.ended_early.empty()) property("ended early", report.ended_early);
  if (!report.advice.empty()) property("advice", report.advice);
  for (const AllowedDifference& part : differences_by_part(report)) {
    property("differs, as allowed: " + part.part, part.text);
  }
  for (const CheckedTime& time : report.times) {
    if (time.verdict == Verdict::not_comparable) continue;
    property("frame time, " + time.title,
             change_text(time.shift.estimate) + " (bounds " + bounds_text(time.shift) + ")");
  }
  text += "    </properties>\n";
  const double share = report.seconds / static_cast<double>(findings.size());
  for (const Finding& finding : findings) text += junit_case(report, finding, share);
  return text + "  </testsuite>\n</testsuites>\n";
}

std::string check_annotations(const CheckReport& report) {
  std::vector<Finding> findings = findings_of(report);
  if (findings.empty() || !report.error.empty()) findings = {whole_check(report)};
  std::string text;
  std::size_t shown = 0;
  for (const bool errors : {true, false}) {
    for (const Finding& finding : findings) {
      const bool failed = finding.verdict == Verdict::regression ||
                          finding.verdict == Verdict::not_comparable || !report.error.empty();
      if (failed != errors || (finding.verdict == Verdict::ok && !failed)) continue;
      if (++shown > kMostAnnotations) return text;
      text += std::string(failed ? "::error" : "::warning") +
              " title=" + command("herr check, " + report.session + ": " + finding.name, true) +
              "::" + command(finding.text, false) + "\n";
    }
  }
  return text;
}

}  // namespace herr
