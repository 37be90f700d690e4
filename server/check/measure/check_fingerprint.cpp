#include "server/check/measure/check_fingerprint.h"

#include <gnu/libc-version.h>

#include <algorithm>

#include "server/bench/bench_report.h"

namespace herr {
namespace {

std::string build_text() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return "with sanitizers";
#elif defined(__OPTIMIZE__)
  return "optimised";
#else
  return "not optimised";
#endif
}

}  // namespace

CheckFingerprint check_fingerprint(const SessionReport& report, const ReplayOptions& options,
                                   const Scene& scene, const std::string& libraries) {
  CheckFingerprint fingerprint;
  fingerprint.work = fingerprint_of(report, options, scene, PictureIdentity::size);
  // The program is what is compared.
  std::erase_if(fingerprint.work.settings, [](const auto& entry) { return entry.first == "the program"; });
  // Builds before frame_step.h measured such scenes standing still: theirs is other work.
  if (scene.changes) fingerprint.work.inputs.emplace_back("how the scene moves", "as replay shows it");
  fingerprint.machine = {{"--threads", std::to_string(report.settings.threads)},
                         {"the libraries", libraries + ", glibc " + gnu_get_libc_version()},
                         {"the CPU", cpu_name()},
                         {"the build", build_text()}};
  return fingerprint;
}

}  // namespace herr
