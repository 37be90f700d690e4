#include "server/convert/check_report.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "server/process/exit_code.h"
#include "server/process/terminal.h"
#include "server/text/shell_word.h"
#include "sessions/files/atomic_file.h"
#include "sessions/files/input_error.h"
#include "sessions/import/check/proposal.h"
#include "sessions/import/presets/gaze_beside.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

const char* word_of(Proposal::Certainty certainty) {
  switch (certainty) {
    case Proposal::Certainty::certain:
      return "certain";
    case Proposal::Certainty::likely:
      return "likely";
    case Proposal::Certainty::cannot_tell:
      return "cannot tell";
  }
  return "cannot tell";
}

// On one line and harmless to a terminal, however long.
std::string whole_text(const std::string& text) {
  constexpr std::size_t kPiece = 100;
  std::string shown;
  std::size_t from = 0;
  while (text.size() - from > kPiece) {
    std::size_t to = text.rfind(' ', from + kPiece);
    if (to == std::string::npos || to <= from) break;
    shown += printable(text.substr(from, to - from)) + " ";
    from = to + 1;
  }
  return shown + printable(text.substr(from));
}

// As a shell reads it back.
// Empty where the data cannot tell.
std::string command_line(const ConvertOptions& options, const Proposal& proposal) {
  if (proposal.certainty == Proposal::Certainty::cannot_tell) return "";
  std::string line = "herr convert " + shell_path(options.head) + " OUT";
  if (options.gaze) line += " --gaze " + shell_path(*options.gaze);
  if (!proposal.preset.empty()) line += " --preset " + shell_word(proposal.preset);
  if (!proposal.variant.empty()) line += " --variant " + shell_word(proposal.variant);
  if (proposal.preset.empty())
    line += " --map " + shell_word(!options.map.empty()        ? options.map.string()
                                   : options.write_map.empty() ? std::string("MAP.json")
                                                               : options.write_map.string());
  if (proposal.still.head) line += " --still-head";
  if (proposal.still.gaze) line += " --still-gaze";
  return line;
}

// What writes the map that the command line needs.
std::string writing_line(const ConvertOptions& options, const Proposal& proposal) {
  std::string line = "herr convert --check " + shell_path(options.head);
  if (options.gaze) line += " --gaze " + shell_path(*options.gaze);
  if (options.still.head) line += " --still-head";
  if (options.still.gaze) line += " --still-gaze";
  return proposal.map_json.empty() ? "" : line + " --write-map MAP.json";
}

std::string text_of(const ConvertOptions& options, const Proposal& proposal, const std::string& line,
                    bool map_written) {
  std::string text = std::string("confidence: ") + word_of(proposal.certainty) + "\n";
  for (const std::string& reason : proposal.reasons) text += "  " + whole_text(reason) + "\n";
  if (!proposal.questions.empty()) text += "please say:\n";
  for (const std::string& question : proposal.questions) text += "  " + whole_text(question) + "\n";
  const bool needs_map = !proposal.map_json.empty() && !map_written;
  if (!line.empty() && needs_map) text += "first:       " + writing_line(options, proposal) + "\n";
  if (!line.empty()) text += "recommended: " + line + "\n";
  if (map_written && line.empty())
    text += "written: " + printable(options.write_map.string()) +
            ", a draft: write the answers in the place of each null, and give it with --map\n";
  if (!needs_map) return text;
  return text +
         (line.empty() ? "a draft of a map, to be completed by the answers (or give --write-map FILE):\n"
                       : "MAP.json:\n") +
         proposal.map_json;
}

std::string json_of(const Proposal& proposal, const std::string& line) {
  Json json{{"confidence", word_of(proposal.certainty)},
            {"command", line},
            {"preset", proposal.preset},
            {"variant", proposal.variant},
            {"reasons", proposal.reasons},
            {"questions", proposal.questions}};
  const Json map = proposal.map_json.empty() ? Json() : Json::parse(proposal.map_json);
  json["map"] = line.empty() ? Json() : map;
  json["draft"] = line.empty() ? map : Json();  // of a map, to be completed by the answers
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

// With the gaze that lies beside the head, where one does; `gaze` is that file then.
Proposal proposal_of(const FormatRequest& request, std::optional<std::filesystem::path>& gaze) {
  Proposal alone = propose_format(request);
  FormatRequest with = request;
  with.preset = alone.preset;
  with.variant = alone.variant;
  with.still = alone.still;
  with.files.gaze = alone.preset.empty() ? std::nullopt : gaze_beside(with);
  if (!with.files.gaze) return alone;
  with.preset = request.preset;
  with.variant = request.variant;
  with.still = request.still;
  Proposal both = propose_format(with);
  if (both.certainty == Proposal::Certainty::cannot_tell) return alone;
  gaze = with.files.gaze;
  both.reasons.push_back("The gaze lies beside the head, in " + printable(gaze->filename().string()) + ".");
  return both;
}

}  // namespace

int run_format_check(const ConvertOptions& asked, const FormatRequest& request) {
  ConvertOptions options = asked;
  const Proposal proposal = proposal_of(request, options.gaze);
  const bool write = !options.write_map.empty() && !proposal.map_json.empty();
  if (write) write_whole_file(options.write_map, proposal.map_json);
  const std::string line = command_line(options, proposal);
  print_result(options.json ? json_of(proposal, line) : text_of(options, proposal, line, write));
  return proposal.certainty == Proposal::Certainty::cannot_tell ? kExitInconclusive : kExitDone;
}

}  // namespace herr
