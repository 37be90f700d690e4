#include "sessions/import/check/proposal.h"

#include <optional>

#include "sessions/files/input_error.h"
#include "sessions/import/check/proposed_map.h"
#include "sessions/import/map/column_map_text.h"
#include "sessions/import/presets/trial_import.h"

namespace herr {
namespace {

// A format with fewer columns asked for by name may fit by accident.
constexpr std::size_t kManyNames = 5;

std::optional<Proposal> preset_of(FormatRequest request, Proposal& refused) {
  try {
    const ChosenFormat chosen = choose_format(request);
    const TrialImport trial = trial_import(import_request(request, chosen.format.columns));
    Proposal proposal;
    proposal.preset = chosen.format.preset;
    proposal.variant = chosen.format.variant();
    proposal.still = request.still;
    proposal.reasons = chosen.remarks;
    const std::string against = implausible(trial);
    if (!against.empty()) {
      proposal.reasons.push_back("but " + against);
      proposal.questions.push_back("whether preset " + proposal.preset + " is meant: its data look wrong");
      return proposal;
    }
    proposal.certainty = chosen.format.named_columns >= kManyNames ? Proposal::Certainty::certain
                                                                   : Proposal::Certainty::likely;
    return proposal;
  } catch (const InputError& error) {
    refused.reasons.push_back(error.problem());
    return std::nullopt;
  }
}

}  // namespace

Proposal propose_format(const RecordingFiles& files) {
  Proposal refused;
  FormatRequest request;
  request.files = files;
  if (!files.head.empty())
    if (auto proposal = preset_of(request, refused)) return *proposal;
  // A log of gaze alone.
  FormatRequest gaze_alone;
  gaze_alone.files.gaze = files.gaze ? files.gaze : std::optional(files.head);
  gaze_alone.still.head = true;
  if (!files.gaze || files.head.empty())
    if (auto proposal = preset_of(gaze_alone, refused);
        proposal && proposal->certainty == Proposal::Certainty::certain)
      return *proposal;
  if (files.head.empty()) return refused;

  const ProposedMap proposed = propose_map(files);
  Proposal proposal;
  proposal.reasons = {"the columns are those of no preset"};
  proposal.reasons.insert(proposal.reasons.end(), proposed.reasons.begin(), proposed.reasons.end());
  proposal.questions = proposed.questions;
  if (!proposed.map) return proposal;
  proposal.certainty = Proposal::Certainty::likely;
  proposal.map_json = column_map_text(*proposed.map);
  return proposal;
}

}  // namespace herr
