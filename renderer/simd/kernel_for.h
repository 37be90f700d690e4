// Picks the instance of a kernel that was compiled for one instruction set (simd/kernel_instance.cpp.in).
// A renderer keeps the pointers that it picked, so renderers of different instruction sets live side by side.
#pragma once

#include <type_traits>

#include "renderer/render_settings.h"

namespace herr {

// `isa` must be resolved. Thread-safe.
template <typename Kernel>
Kernel kernel_for(Isa isa, Kernel sse4, Kernel avx2, Kernel avx512) {
  switch (isa) {
    case Isa::avx512:
      return avx512;
    case Isa::avx2:
      return avx2;
    default:
      return sse4;
  }
}

}  // namespace herr

// Declares the instances of kernel `name`, a function that pointers of type `Kernel` point to. In namespace
// herr; N_AVX3 is Highway's name for AVX-512.
#define HERR_DECLARE_KERNEL(Kernel, name) \
  namespace N_SSE4 {                      \
  std::remove_pointer_t<Kernel> name;     \
  }                                       \
  namespace N_AVX2 {                      \
  std::remove_pointer_t<Kernel> name;     \
  }                                       \
  namespace N_AVX3 {                      \
  std::remove_pointer_t<Kernel> name;     \
  }                                       \
  static_assert(true, "a semicolon follows")

// The one of them that is compiled for `isa`.
#define HERR_KERNEL_FOR(isa, name) kernel_for(isa, &N_SSE4::name, &N_AVX2::name, &N_AVX3::name)
