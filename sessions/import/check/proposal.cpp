#include "sessions/import/check/proposal.h"

#include <cctype>
#include <optional>
#include <utility>

#include "sessions/files/input_error.h"
#include "sessions/import/check/bare_formats.h"
#include "sessions/import/check/described_columns.h"
#include "sessions/import/check/proposed_map.h"
#include "sessions/import/map/column_map_text.h"
#include "sessions/import/presets/trial_import.h"
#include "sessions/text/fixed_text.h"

namespace herr {
namespace {

// A format with fewer columns asked for by name may fit by accident.
constexpr std::size_t kManyNames = 5;
constexpr double kClearlyReversed = -4.5;  // standard deviations
constexpr double kWalksBack = 0.3;
constexpr double kFewRows = 0.2;

void add_all(const std::vector<std::string>& more, std::vector<std::string>& all) {
  all.insert(all.end(), more.begin(), more.end());
}

// Remarks of other rooms are clauses.
std::vector<std::string> sentences(std::vector<std::string> texts) {
  for (std::string& text : texts) {
    if (text.empty()) continue;
    text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    if (!text.ends_with('.')) text += '.';
  }
  return texts;
}

void say_measured(const TrialImport& trial, std::vector<std::string>& reasons) {
  if (trial.pose_hz > 0) reasons.push_back("Poses come at " + fixed_text(trial.pose_hz, 1) + " Hz.");
  if (trial.gaze_hz > 0) reasons.push_back("Gaze comes at " + fixed_text(trial.gaze_hz, 1) + " Hz.");
  if (!trial.words.empty()) reasons.push_back("So read, " + trial.words + ".");
  if (!trial.gaze_words.empty()) reasons.push_back("Of the gaze: " + trial.gaze_words + ".");
  add_all(sentences(trial.remarks), reasons);
}

// What speaks against a format whose columns are there; empty: nothing.
std::string doubt(const ChosenFormat& chosen, const TrialImport& trial) {
  const std::string against = implausible(trial);
  if (!against.empty()) return against;
  const PlausibilityFigures& f = trial.figures;
  // Eyes that meet are not mirrored sideways, whatever a made recording does.
  const bool eyes_meet = f.diverging_share && *f.diverging_share < kFewRows;
  if ((f.evidence_x < kClearlyReversed && !eyes_meet) || f.evidence_y < kClearlyReversed)
    return "the eyes turn with the head, where people's turn against it";
  if (f.evidence_not_exchanged < kClearlyReversed && !eyes_meet)
    return "the two axes of the gaze seem exchanged";
  if (chosen.format.named_columns < kManyNames && f.forwards_share && *f.forwards_share < kWalksBack)
    return "the head walks backwards over " + fixed_text(100 * (1 - *f.forwards_share), 0) + " % of the way";
  return "";
}

// Nothing in the file says so, and its stamps would be made up.
bool lacks_time(const ImportColumns& columns) {
  return columns.head != nullptr && columns.head->time.kind == TimeColumns::Kind::rate;
}

void ask_rate(const ChosenFormat& chosen, Proposal& proposal) {
  proposal.questions.push_back(
      "How many rows a second were recorded: the file holds no time (\"rate_hz\" in the map).");
  ColumnMap map = *chosen.format.map;
  map.layouts.clear();
  map.camera.clear();
  map.otherwise.clear();
  map.head = {*chosen.format.columns.head};
  map.gaze.clear();
  proposal.map_json = column_map_text(map, {{"time", "rate_hz"}});
}

void ask_doubts(const FormatRequest& request, const ChosenFormat& chosen, const TrialImport& trial,
                Proposal& proposal) {
  const std::string against = doubt(chosen, trial), words = chosen.format.words();
  if (!against.empty())
    proposal.questions.push_back("Whether " + words + " is meant: its columns are there, but " + against +
                                 ".");
  if (lacks_time(chosen.format.columns)) ask_rate(chosen, proposal);
  if (const auto open = open_axes(chosen, request))
    proposal.questions.push_back(*open);
  else if (!chosen.alike.empty())
    proposal.questions.push_back("Which of these it is, as the data fit them alike: " + words + "; " +
                                 chosen.alike + " (--variant).");
}

std::optional<Proposal> preset_of(const FormatRequest& request, std::vector<std::string>& refusals) {
  try {
    const ChosenFormat chosen = choose_format(request);
    const bool named = request.map || !request.preset.empty();
    if (!named && !is_its_own_file(chosen, request)) return std::nullopt;
    const TrialImport trial = trial_import(import_request(request, chosen.format.columns));
    Proposal proposal;
    proposal.preset = chosen.format.preset;
    proposal.variant = chosen.format.variant();
    proposal.still = request.still;
    proposal.reasons = sentences(chosen.remarks);
    add_all(described(chosen.format.columns), proposal.reasons);
    say_measured(trial, proposal.reasons);
    ask_doubts(request, chosen, trial, proposal);
    if (proposal.questions.empty())
      proposal.certainty = chosen.format.named_columns >= kManyNames ? Proposal::Certainty::certain
                                                                     : Proposal::Certainty::likely;
    return proposal;
  } catch (const InputError& error) {
    refusals.push_back("Presets: " + error.problem() + ".");
    return std::nullopt;
  }
}

// What a draft must not state: the fields that questions name.
std::vector<OpenField> open_fields(const std::vector<std::string>& questions) {
  struct NamedField {
    const char* words;
    OpenField field;
  };
  const NamedField named[] = {{"\"world_axes\"", {"head", "world_axes"}},
                              {"\"head_axes\"", {"head", "head_axes"}},
                              {"\"axes\"", {"gaze", "axes"}},
                              {"\"order\"", {"orientation", "order"}},
                              {"\"sense\"", {"orientation", "sense"}},
                              {"\"convention\"", {"", "convention"}},
                              {"\"rate_hz\"", {"time", "rate_hz"}},
                              {"\"unit\" of \"time\"", {"time", "unit"}},
                              {"\"unit\" of \"position\"", {"position", "unit"}},
                              {"\"unit\" in the map", {"orientation", "unit"}},
                              {"\"major\"", {"orientation", "major"}},
                              {"\"space\" of the gaze", {"gaze", "space", true}},
                              {"\"valid\" of the head", {"head", "valid", true}},
                              {"\"valid\" of the gaze's combined", {"combined", "valid", true}},
                              {"\"valid\" of the gaze's left", {"left", "valid", true}},
                              {"\"valid\" of the gaze's right", {"right", "valid", true}}};
  std::vector<OpenField> open;
  for (const std::string& question : questions)
    for (const NamedField& one : named)
      if (question.find(one.words) != std::string::npos) open.push_back(one.field);
  return open;
}

Proposal map_of(const FormatRequest& request) {
  const ProposedMap proposed = propose_map(request.files, request.still);
  Proposal proposal;
  proposal.reasons = {"The columns are those of no preset."};
  add_all(proposed.reasons, proposal.reasons);
  proposal.questions = proposed.questions;
  proposal.still = proposed.still;
  if (proposed.map) proposal.map_json = column_map_text(*proposed.map, open_fields(proposed.questions));
  if (proposed.map && proposed.questions.empty()) proposal.certainty = Proposal::Certainty::likely;
  return proposal;
}

}  // namespace

Proposal propose_format(const FormatRequest& request) {
  std::vector<std::string> refusals;
  if (auto proposal = preset_of(request, refusals)) return std::move(*proposal);
  // A log of gaze alone.
  FormatRequest gaze_alone = request;
  if (!request.files.gaze && !request.files.head.empty()) {
    gaze_alone.files = {{}, request.files.head};
    gaze_alone.still.head = true;
    std::vector<std::string> unused;
    if (auto proposal = preset_of(gaze_alone, unused)) return std::move(*proposal);
  }
  const bool named = request.map || !request.preset.empty();
  if (!named) return map_of(request);
  Proposal refused;
  refused.reasons = refusals;
  refused.questions = {"Which other preset or map is meant: this one does not fit."};
  return refused;
}

}  // namespace herr
