#include "firmware_app/health/latency_histogram.h"

#include <algorithm>
#include <boost/histogram/axis/regular.hpp>
#include <boost/histogram/make_histogram.hpp>
#include <cmath>

namespace nanomap {
namespace {

namespace bh = boost::histogram;

constexpr double kShortest_s = 1e-6;
constexpr double kLongest_s = 10.0;
constexpr unsigned kBins = 814;  // ln(10 s / 1 us) / ln(1.02)

using Axis = bh::axis::regular<double, bh::axis::transform::log>;

}  // namespace

struct LatencyHistogram::Bins {
  decltype(bh::make_histogram(Axis{})) histogram = bh::make_histogram(Axis{kBins, kShortest_s, kLongest_s});
};

LatencyHistogram::LatencyHistogram() : bins_(std::make_unique<Bins>()) {}
LatencyHistogram::~LatencyHistogram() = default;
LatencyHistogram::LatencyHistogram(LatencyHistogram&&) noexcept = default;
LatencyHistogram& LatencyHistogram::operator=(LatencyHistogram&&) noexcept = default;

void LatencyHistogram::record(Duration latency) {
  constexpr double kJustBelow = 0.999;  // the axis is open at its end
  bins_->histogram(std::clamp(toSeconds(latency), kShortest_s, kLongest_s * kJustBelow));
  ++count_;
  max_ = std::max(max_, latency);
}

Duration LatencyHistogram::quantile(double share) const {
  const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_)));
  const auto& axis = bins_->histogram.axis();
  std::uint64_t seen = 0;
  for (int bin = 0; bin < axis.size(); ++bin) {
    seen += static_cast<std::uint64_t>(bins_->histogram.at(bin));
    if (seen >= wanted && seen > 0) return std::min(max_, fromSeconds(axis.bin(bin).upper()));
  }
  return max_;
}

}  // namespace nanomap
