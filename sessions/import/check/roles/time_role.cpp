#include "sessions/import/check/roles/time_role.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "sessions/import/check/roles/column_names.h"
#include "sessions/import/text/date_text.h"
#include "sessions/text/fixed_text.h"

namespace herr {
namespace {

constexpr double kUsualRows = 0.9;
constexpr double kSlowestHz = 4, kFastestHz = 2500;  // of logs of heads and eyes

struct UnitGuess {
  TimeUnit unit;
  double seconds;
  const char* key;
  const char* word;
};
constexpr std::array<UnitGuess, 4> kClockUnits{{{TimeUnit::s, 1, "s", "seconds"},
                                                {TimeUnit::ms, 1e-3, "ms", "milliseconds"},
                                                {TimeUnit::us, 1e-6, "us", "microseconds"},
                                                {TimeUnit::ns, 1e-9, "ns", "nanoseconds"}}};
constexpr UnitGuess kTicks{TimeUnit::dotnet_ticks, 1e-7, "", ".NET's ticks of 100 ns"};
constexpr UnitGuess kFileTime{TimeUnit::filetime, 1e-7, "", "Windows' FILETIME of 100 ns"};

bool usual_rate(double hz) {
  return hz >= kSlowestHz && hz <= kFastestHz;
}

// Clocks with an epoch tell their unit by their size, others by the rate that they give.
std::optional<UnitGuess> guessed_unit(double value, double step) {
  if (value > 6.2e17 && value < 6.6e17) return kTicks;
  if (value > 1.25e17 && value < 1.4e17) return kFileTime;
  for (const UnitGuess& guess : kClockUnits)
    if (value * guess.seconds > 9e8 && value * guess.seconds < 4e9) return guess;
  for (const UnitGuess& guess : kClockUnits)
    if (usual_rate(1 / (step * guess.seconds))) return guess;
  return std::nullopt;
}

std::optional<UnitGuess> named_unit(const NameWords& name) {
  for (const UnitGuess& guess : kClockUnits)
    if (name.unit == guess.key) return guess;
  return std::nullopt;
}

// The usual step between neighbours; none where fewer than nine in ten grow.
std::optional<double> growing_step(const std::vector<double>& values) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (values[i] > values[i - 1]) steps.push_back(values[i] - values[i - 1]);
  if (steps.empty() ||
      static_cast<double>(steps.size()) < kUsualRows * static_cast<double>(values.size() - 1))
    return std::nullopt;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

bool counts_rows(const std::vector<double>& values) {
  std::size_t ones = 0;
  for (std::size_t i = 1; i < values.size(); ++i) ones += values[i] - values[i - 1] == 1 ? 1 : 0;
  return static_cast<double>(ones) >= kUsualRows * static_cast<double>(values.size() - 1);
}

// How much a name speaks of time; below 0: of something else.
int time_score(const NameWords& name) {
  if (name.has(
          {"frame", "index", "idx", "id", "count", "row", "seq", "sequence", "number", "video", "playback"}))
    return -1;
  int score = 0;
  if (name.has_start({"timestamp", "stamp", "unix", "time", "clock", "epoch"})) score = 3;
  if (name.has({"t", "ts"})) score = 2;
  return score == 0 && !name.unit.empty() && named_unit(name) ? 1 : score;
}

struct ClockColumn {
  std::size_t column = 0;
  double step = 0;
  std::optional<UnitGuess> unit;
  bool against_name = false;  // the unit in the name gives no usual rate
  int score = -1;
};

std::optional<ClockColumn> clock_column(const SniffedTable& table, std::size_t column) {
  const std::vector<double>* values = table.numbers(column);
  const auto step = values ? growing_step(*values) : std::nullopt;
  if (!step) return std::nullopt;
  ClockColumn clock{column, *step, {}, false, 0};
  const bool named = !table.names.empty();
  const NameWords name = words_of(named ? table.names[column] : "");
  clock.score = named ? time_score(name) : column == 0 ? 3 : -1;
  // A name that says nothing is believed in the first column alone.
  if (clock.score < 0 || (clock.score == 0 && column > 0)) return std::nullopt;
  clock.unit = guessed_unit(values->front(), *step);
  if (const auto by_name = named_unit(name)) {
    clock.against_name = !usual_rate(1 / (*step * by_name->seconds));
    clock.unit = by_name;
  } else if (counts_rows(*values)) {
    return std::nullopt;  // 0, 1, 2 ...: a number of the row
  }
  return clock;
}

void say_clock(const SniffedTable& table, const ClockColumn& clock, TimeRole& role) {
  role.columns = {clock.column};
  role.time.column = table.ref(clock.column);
  const std::string called = table.called(clock.column);
  if (!clock.unit) {
    role.questions.push_back("In which unit " + called + " counts: it grows by " + fixed_text(clock.step, 3) +
                             " a row (\"unit\" of \"time\" in the map).");
    return;
  }
  role.time.unit = clock.unit->unit;
  role.step_s = clock.step * clock.unit->seconds;
  const std::string rate = fixed_text(1 / role.step_s, 1) + " Hz";
  role.reasons.push_back("The time stands in " + called + ", in " + clock.unit->word + ": rows come at " +
                         rate + ".");
  if (clock.against_name)
    role.questions.push_back("Whether " + called + " is in " + clock.unit->word +
                             ", as it is called: " + rate + " would be unusual.");
}

// Seconds and nanoseconds in columns of their own, as ROS writes them.
bool find_two_columns(const SniffedTable& table, TimeRole& role) {
  std::optional<std::size_t> seconds, nanoseconds;
  for (std::size_t column = 0; column < table.names.size(); ++column) {
    const NameWords name = words_of("time " + table.names[column]);
    if (name.has_start({"nsec", "nanosec"}) || name.unit == "ns")
      nanoseconds = column;
    else if (name.has({"sec", "secs", "seconds"}) || name.unit == "s")
      seconds = column;
  }
  if (!seconds || !nanoseconds || !table.numbers(*seconds) || !table.numbers(*nanoseconds)) return false;
  std::vector<double> both;
  for (std::size_t row = 0; row < table.fields.size(); ++row) {
    const double s = (*table.numbers(*seconds))[row], ns = (*table.numbers(*nanoseconds))[row];
    if (!(s == std::floor(s) && ns >= 0 && ns < 1e9)) return false;
    both.push_back(s - table.numbers(*seconds)->front() + ns * 1e-9);
  }
  const auto step = growing_step(both);
  if (!step || !usual_rate(1 / *step)) return false;
  role.columns = {*seconds, *nanoseconds};
  role.time.kind = TimeColumns::Kind::seconds_nanoseconds;
  role.time.column = table.ref(*seconds);
  role.time.nanoseconds = table.ref(*nanoseconds);
  role.step_s = *step;
  role.reasons.push_back("The time stands in " + table.called(*seconds) + " (whole seconds) and " +
                         table.called(*nanoseconds) + " (nanoseconds): rows come at " +
                         fixed_text(1 / *step, 1) + " Hz.");
  return true;
}

bool find_dates(const SniffedTable& table, TimeRole& role) {
  for (std::size_t column = 0; column < table.columns(); ++column) {
    const std::string &first = table.fields.front()[column], &last = table.fields.back()[column];
    if (first.find(':') == std::string::npos) continue;
    const auto from_ns = parse_date(first, "", 0), to_ns = parse_date(last, "", 0);
    if (!from_ns || !to_ns || *to_ns <= *from_ns) continue;
    role.columns = {column};
    role.time.kind = TimeColumns::Kind::date;
    role.time.column = table.ref(column);
    role.step_s =
        static_cast<double>(*to_ns - *from_ns) * 1e-9 / static_cast<double>(table.fields.size() - 1);
    role.reasons.push_back("The time stands in " + table.called(column) + ", as dates: rows come at " +
                           fixed_text(1 / role.step_s, 1) + " Hz." +
                           (date_names_zone(first, "") ? "" : " They name no zone and are taken as UTC."));
    return true;
  }
  return false;
}

// A column that is called time and holds one number.
std::optional<std::size_t> stopped_clock(const SniffedTable& table) {
  for (std::size_t column = 0; column < table.names.size(); ++column) {
    const std::vector<double>* values = table.numbers(column);
    if (values && time_score(words_of(table.names[column])) >= 2 &&
        std::all_of(values->begin(), values->end(), [&](double v) { return v == values->front(); }))
      return column;
  }
  return std::nullopt;
}

}  // namespace

TimeRole find_time(const SniffedTable& table) {
  TimeRole role;
  if (find_two_columns(table, role)) return role;
  std::optional<ClockColumn> best;
  for (std::size_t column = 0; column < table.columns(); ++column) {
    const auto clock = clock_column(table, column);
    if (clock && (!best || clock->score > best->score || (clock->unit && !best->unit))) best = clock;
  }
  if ((!best || !best->unit) && find_dates(table, role)) return role;
  if (best) {
    say_clock(table, *best, role);
    return role;
  }
  role.time.kind = TimeColumns::Kind::rate;
  role.time.rate_hz = 30;
  if (const auto stopped = stopped_clock(table))
    role.questions.push_back("When the rows were recorded: all stamps of " + table.called(*stopped) +
                             " are equal, were they written in single precision? Give \"rate_hz\" in the "
                             "place of \"column\" in the map's \"time\" if the rate was steady.");
  else
    role.questions.push_back(
        "How many rows a second were recorded: no column grows like a clock (\"rate_hz\" "
        "of \"time\" in the map).");
  return role;
}

}  // namespace herr
