// What a study has decided and made, beside the rows of study.csv: with it a study that was cut off goes on
// as the same one. Before: study_run decides. After: study.state.json, replaced whole at each change.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/study/plan/study_setting.h"
#include "server/study/report/study_record.h"

namespace herr {

struct StudyState {
  std::string subject;  // inputs, settings, frames and program: another one is another study
  // Once the time was shared out: names of the settings that are measured, in turn, on how many frames, and
  // what beside settings was dropped.
  std::optional<std::vector<std::string>> settings;
  std::size_t frames = 0;
  double minutes = 0;  // that were shared out; more of them are shared out anew
  std::vector<std::string> dropped;
  std::optional<std::vector<StudySetting>> combinations;            // once they were chosen
  std::vector<std::pair<std::int64_t, StudyReference>> references;  // made so far, by frame
};

void write_state(const std::filesystem::path& file, const StudyState& state);
// Throws InputError.
StudyState read_state(const std::filesystem::path& file);

}  // namespace herr
