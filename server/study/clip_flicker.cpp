#include "server/study/clip_flicker.h"

#include <cstddef>
#include <memory>
#include <utility>

#include "server/process/steady_time.h"
#include "server/study/reference/reference_spec.h"

namespace herr {
namespace {

StudyRow row_of(const StudySetting& setting, std::int64_t frame, double seconds) {
  StudyRow row;
  row.name = setting.name, row.knob = setting.knob, row.base = setting.base, row.value = setting.value;
  row.n = setting.n;
  row.flags = flags_text(setting.changes);
  row.frame = frame;
  row.seconds = seconds;
  return row;
}

}  // namespace

std::vector<StudyRow> measure_clip(StudySubject& subject, const std::vector<StudySetting>& settings,
                                   const References::Context& context, int passes,
                                   const std::function<bool(std::size_t frame)>& progress,
                                   const KeepClipFrame& keep) {
  const TimeNs start_ns = steady_now_ns();
  subject.rewind();
  std::vector<std::unique_ptr<Renderer>> renderers;
  std::vector<FlickerSum> sums(settings.size());
  const std::vector<StudyFrame>& clip = subject.frames().clip;
  for (std::size_t f = 0; f < clip.size(); ++f) {
    if (!progress(f)) return {};
    const FrameInstant instant = subject.instant(clip[f].number);
    References references(instant, context);
    ReferenceSpec spec = endless_effort(subject.defaults(), {});
    spec.passes = passes;
    spec.refined = false;
    const ReferencePicture& reference = references.get(spec);
    std::vector<std::vector<LinearPicture>> pictures(settings.size());
    for (std::size_t s = 0; s < settings.size(); ++s) {
      if (f == 0) {
        renderers.push_back(renderer_at(instant, with_changes(subject.defaults(), settings[s].changes)));
      }
      RenderedFrame frame;
      renderers[s]->render_frame(*instant.sample, *instant.state, frame);
      read_viewports(frame, instant, threads_of(*renderers[s]), pictures[s]);
      for (LinearPicture& viewport : pictures[s]) limit_to_white(viewport);
    }
    if (keep) keep(f, instant, reference.picture, pictures);
    for (std::size_t s = 0; s < settings.size(); ++s) {
      sums[s].add(instant.maps, std::move(pictures[s]), reference.picture);
    }
  }
  const double seconds = static_cast<double>(steady_now_ns() - start_ns) * 1e-9;
  std::vector<StudyRow> rows;
  for (std::size_t s = 0; s < settings.size(); ++s) {
    rows.push_back(row_of(settings[s], clip.front().number, seconds / static_cast<double>(settings.size())));
    rows.back().flicker = sums[s].flicker();
  }
  return rows;
}

}  // namespace herr
