// Which instruction sets this CPU offers, and their names. Kernels are picked in simd/kernel_for.h.
#include <stdexcept>
#include <string>

#include "renderer/render_settings.h"

namespace herr {

const char* name_of(Isa isa) {
  switch (isa) {
    case Isa::best:
      return "best";
    case Isa::sse4:
      return "sse4";
    case Isa::avx2:
      return "avx2";
    case Isa::avx512:
      return "avx512";
  }
  return "unknown";
}

namespace {

bool cpu_has(Isa isa) {
  switch (isa) {
    case Isa::avx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
             __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
             __builtin_cpu_supports("avx512cd") && cpu_has(Isa::avx2);
    case Isa::avx2:
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
             __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("f16c");
    case Isa::sse4:
      return __builtin_cpu_supports("sse4.2") != 0;
    case Isa::best:
      return true;
  }
  return false;
}

}  // namespace

Isa resolve_isa(Isa asked) {
  __builtin_cpu_init();
  if (asked == Isa::best) {
    for (const Isa isa : {Isa::avx512, Isa::avx2}) {
      if (cpu_has(isa)) return isa;
    }
    return Isa::sse4;
  }
  if (!cpu_has(asked)) {
    throw std::invalid_argument(std::string("this CPU lacks the instruction set ") + name_of(asked));
  }
  return asked;
}

}  // namespace herr
