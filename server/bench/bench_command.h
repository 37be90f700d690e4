// `herr bench`: frame time against the bare time of its own rays and pixels, as a table or as JSON.
#pragma once

#include "server/bench/bench_options.h"

namespace herr {

int run_bench(const BenchOptions& options);

}  // namespace herr
