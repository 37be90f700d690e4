// `herr check`: did frames become slower? Counters, alternating runs against another build, stored runs.
#pragma once

#include "server/check/check_options.h"

namespace herr {

int run_check(const CheckOptions& options);

}  // namespace herr
