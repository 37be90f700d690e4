// The result of `herr bench` as a table for people and as JSON for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "renderer/bench_frame.h"
#include "server/bench/bench_subject.h"

namespace herr {

nlohmann::ordered_json bench_json(const BenchResult& result, const BenchSubject& subject);
std::string bench_table(const BenchResult& result, const BenchSubject& subject);

}  // namespace herr
