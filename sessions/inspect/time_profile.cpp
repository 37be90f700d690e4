#include "sessions/inspect/time_profile.h"

#include <algorithm>

namespace herr {

void ProfileSpan::merge(const ProfileSpan& other) {
  peak = std::max(peak, other.peak);
  sum += other.sum;
  values += other.values;
  without += other.without;
}

void TimeProfile::halve() {
  for (std::size_t i = 0; i < kBins / 2; ++i) {
    ProfileSpan both = bins_[2 * i];
    both.merge(bins_[2 * i + 1]);
    bins_[i] = both;
  }
  std::fill(bins_.begin() + kBins / 2, bins_.end(), ProfileSpan{});
  width_ns_ *= 2;
}

void TimeProfile::add(TimeNs t_ns, std::optional<double> value) {
  if (!start_ns_) {
    start_ns_ = t_ns;
    bins_.resize(kBins);
  }
  while ((t_ns - *start_ns_) / width_ns_ >= static_cast<TimeNs>(kBins)) halve();
  const ProfileSpan instant{value.value_or(0), value.value_or(0), value ? 1 : 0, value ? 0 : 1};
  bins_[static_cast<std::size_t>((t_ns - *start_ns_) / width_ns_)].merge(instant);
}

std::vector<ProfileSpan> TimeProfile::columns(TimeNs start_ns, TimeNs end_ns, int columns) const {
  std::vector<ProfileSpan> spans(static_cast<std::size_t>(columns));
  if (!start_ns_ || columns < 1) return spans;
  const double bin_of_ns = 1.0 / static_cast<double>(width_ns_);
  const double first = static_cast<double>(start_ns - *start_ns_) * bin_of_ns;
  const double step = static_cast<double>(end_ns - start_ns) * bin_of_ns / columns;
  for (int column = 0; column < columns; ++column) {
    const double from = first + column * step, to = from + step;
    const auto last = static_cast<double>(kBins - 1);
    if (to < 0 || from > last + 1) continue;
    const auto begin = static_cast<std::size_t>(std::clamp(from, 0.0, last));
    // A column that ends on a bin's border does not take the bin behind it.
    const auto end = static_cast<std::size_t>(std::clamp(to - 1e-6, static_cast<double>(begin), last));
    for (std::size_t bin = begin; bin <= end; ++bin)
      spans[static_cast<std::size_t>(column)].merge(bins_[bin]);
  }
  return spans;
}

}  // namespace herr
