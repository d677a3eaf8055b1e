#include "firmware_app/pipeline/stream_loss.h"

#include <algorithm>
#include <cmath>

namespace nanomap {
namespace {

/// Of the usual interval: stamps jitter by less, and one lost message makes 2.
constexpr double kMuchLonger = 1.75;

}  // namespace

void NumberedStream::arrived(std::uint64_t sequence, Time stamp) {
  if (!newest_) return begin({sequence, stamp});
  if (sequence > newest_->sequence) return advance({sequence, stamp});
  if (stamp > newest_->stamp || newest_->stamp - stamp > kMaxPause) {
    ++loss_.began_again;
    return begin({sequence, stamp});
  }
  const std::uint64_t back = newest_->sequence - sequence;
  if (back < kRemembered && !missing_.test(back)) {
    ++loss_.repeated;
    return;
  }
  ++loss_.late;
  if (back >= kRemembered) return;
  missing_.reset(back);
  --loss_.missing;
}

void NumberedStream::begin(const Newest& message) {
  newest_ = message;
  missing_.reset();
}

void NumberedStream::advance(const Newest& message) {
  const std::uint64_t step = message.sequence - newest_->sequence;
  if (step > kMaxGap) {
    ++loss_.began_again;
    return begin(message);
  }
  newest_ = message;
  loss_.missing += step - 1;
  missing_ <<= step;
  for (std::uint64_t back = 1; back < std::min(step, kRemembered); ++back) missing_.set(back);
}

void StampedStream::arrived(Time stamp) {
  if (!newest_) {
    newest_ = stamp;
    return;
  }
  const Duration interval = stamp - *newest_;
  if (interval == Duration::zero()) {
    ++loss_.repeated;
    return;
  }
  if (interval < Duration::zero() && -interval <= kMaxPause) {
    ++loss_.late;
    if (loss_.suspected > 0) --loss_.suspected;
    return;
  }
  newest_ = stamp;
  if (interval < Duration::zero() || interval > kMaxPause) {
    ++loss_.began_again;
    intervals_seen_ = 0;
    return;
  }
  if (intervals_seen_ >= kKnownIntervals) {
    const double usual = static_cast<double>(interval.count()) / static_cast<double>(usualInterval().count());
    if (usual > kMuchLonger) loss_.suspected += static_cast<std::uint64_t>(std::llround(usual)) - 1;
  }
  intervals_[intervals_seen_++ % kKnownIntervals] = interval;
}

Duration StampedStream::usualInterval() const {
  auto sorted = intervals_;
  const auto middle = sorted.begin() + kKnownIntervals / 2;
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

}  // namespace nanomap
