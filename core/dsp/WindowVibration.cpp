#include "core/dsp/WindowVibration.h"

#include <algorithm>
#include <cmath>

#include "core/base/Statistics.h"

namespace tacto {

WindowVibration::WindowVibration(const AccelerationTrack& track, std::size_t axes, double rate_hz,
                                 const RoughnessSettings& settings)
    : track_(track),
      axes_(axes),
      feature_(settings.spectral),
      spectrum_(track.windowLength(), axes, rate_hz),
      divisors_(track.windowLength()) {
    const double top = std::min(AccelerationTrack::kHigh_hz, track.upperEdge_hz());
    whole_ = spectrum_.bins(AccelerationTrack::kLow_hz, top);
    if (top > settings.bandLow.value()) rough_ = spectrum_.bins(settings.bandLow.value(), top);
    for (auto& axis : undone_) axis.resize(track.windowLength());
}

WindowVibration::Reading WindowVibration::of(const AccelerationWindow& window) noexcept {
    const auto axes = track_.samples(window);
    spectrum_.transform(std::span(axes).first(axes_));
    const double high = rough_.empty() ? 0 : spectrum_.power(rough_);
    const double meanSquare = rough_.empty() || rough_.first <= whole_.first
                                  ? spectrum_.power(whole_)
                                  : spectrum_.power({whole_.first, rough_.first - 1}) + high;
    if (rough_.empty()) return {kNaN, meanSquare};
    const double feature = feature_ == SpectralFeature::Relative ? high / meanSquare : high;
    return {feature > 0 && std::isfinite(feature) ? feature : kNaN, meanSquare};
}

double WindowVibration::undoneMeanSquare(const AccelerationWindow& window, const ForceTrack& force,
                                         double start_s) noexcept {
    const auto axes = track_.samples(window);
    std::array<const double*, AxesBandpass::kMaxAxes> pointers{};
    force.divisors(track_.stamps(window), divisors_, start_s);
    for (std::size_t a = 0; a < axes_; ++a) {
        for (std::size_t i = 0; i < divisors_.size(); ++i) undone_[a][i] = axes[a][i] * divisors_[i];
        pointers[a] = undone_[a].data();
    }
    spectrum_.transform(std::span(pointers).first(axes_));
    return spectrum_.power(whole_);
}

}  // namespace tacto
