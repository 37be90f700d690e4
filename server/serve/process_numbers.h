// What the kernel says about this process, for the metrics that every exporter has. Source: proc(5).
#pragma once

#include <cstdint>
#include <optional>

namespace herr {

struct ProcessNumbers {
  double cpu_seconds = 0;
  double start_time_seconds = 0;  // since 1970; a label, not for durations
  std::int64_t resident_bytes = 0, virtual_bytes = 0;
  std::int64_t open_descriptors = 0, most_descriptors = 0;
};

// None where /proc cannot be read.
std::optional<ProcessNumbers> read_process_numbers();

}  // namespace herr
