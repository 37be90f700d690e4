// One run of one program, measured: what `herr check` gets from each fresh process as a line of JSON.
// Before: measure_run. After: run_values, counter_gate, baseline_file.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/check/measure/cpu_time.h"
#include "server/results/fingerprint.h"

namespace herr {

// Raised whenever a field changes its meaning: programs of other versions are then not comparable.
inline constexpr int kMeasurementVersion = 1;

// What two runs must share. Different work takes different time; different machines take different time for
// the same work.
struct CheckFingerprint {
  Fingerprint work;              // settings and inputs
  Fingerprint::Entries machine;  // threads, libraries, CPU, build
};
// A setting that only one of the two knows is no difference: the other was not given it, and the first has
// its default.
std::vector<FingerprintDifference> work_differences(const CheckFingerprint& earlier,
                                                    const CheckFingerprint& now);
// The first difference as one line, "--isa was avx512, is avx2"; empty when there is none.
std::string work_difference(const CheckFingerprint& earlier, const CheckFingerprint& now);
std::string machine_difference(const CheckFingerprint& earlier, const CheckFingerprint& now);

struct Measurement {
  std::string program;  // name and version
  CheckFingerprint fingerprint;
  std::vector<double> frame_ms;  // in order, without those that warm up
  // Just before each frame, and after the last: one more than there are frames.
  std::vector<double> calibration_rays_ms, calibration_memory_ms;
  // Per frame. Kinds of rays that are not here are 0; none: this build cannot count it.
  std::vector<std::pair<std::string, std::optional<double>>> counters;
  std::optional<CpuTicks> cpu;  // of the measured frames; none where the kernel does not tell
};

nlohmann::ordered_json measurement_json(const Measurement& measurement);

// The record of a program that another version may be. Throws NotComparable when it is of another format
// version, InputError when it is no such record; `source` names the program or file.
Measurement read_measurement(const nlohmann::json& record, const std::string& source);

nlohmann::ordered_json fingerprint_json(const CheckFingerprint& fingerprint);
CheckFingerprint read_fingerprint(const nlohmann::json& value, const std::string& source);

}  // namespace herr
