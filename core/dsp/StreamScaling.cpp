#include "core/dsp/StreamScaling.h"

#include <algorithm>

namespace tacto {

namespace {

bool fitsTaxels(const StreamInfo& info, const SensorScales& scales) noexcept {
    return info.kind != StreamKind::Taxels || scales.taxels.empty() || scales.taxels.size() == info.channels;
}

}  // namespace

StreamScaling::StreamScaling(std::span<const StreamInfo> streams, const std::optional<SensorScales>& scales,
                             std::string_view serial)
    : scales_(scales.value_or(SensorScales{})), streams_(streams.begin(), streams.end()) {
    if (!scales) return;
    const auto match = matchOf(scales_, serial);
    const bool fits = std::ranges::all_of(streams_, [this](const auto& info) { return fitsTaxels(info, scales_); });
    another_ = match == FingertipMatch::Another || !fits;  // another number of taxels is another fingertip
    notNamed_ = match == FingertipMatch::NotNamed && !another_;
    if (another_) return;
    for (auto& info : streams_) {
        const bool isForce = info.kind == StreamKind::Force && scales_.force;
        const bool isTaxels = info.kind == StreamKind::Taxels && !scales_.taxels.empty();
        if (!isForce && !isTaxels) continue;
        if (info.unit != (isForce ? scales_.forceUnit : scales_.taxelUnit)) {
            leftAside_ = true;
            continue;
        }
        info.unit = isForce ? StreamUnit::Newton : StreamUnit::Pascal;
        (isForce ? force_ : taxels_) = true;
        if (isTaxels) row_.resize(info.channels);
    }
}

double StreamScaling::inUse(std::size_t stream, std::size_t channel, double reading) const noexcept {
    const auto kind = streams_[stream].kind;
    if (kind == StreamKind::Force && force_) return scales_.force->at(reading);
    if (kind == StreamKind::Taxels && taxels_) return scales_.taxels[channel].at(reading);
    return reading;
}

const double* StreamScaling::scaled(std::size_t stream, const double* readings) noexcept {
    if (!taxels_) return readings;
    for (std::size_t c = 0; c < row_.size(); ++c) row_[c] = inUse(stream, c, readings[c]);
    return row_.data();
}

void StreamScaling::raise(RoughnessFlags& flags) const noexcept {
    flags.raise(RoughnessFlag::AnotherFingertip, another_);
    flags.raise(RoughnessFlag::FingertipNotNamed, notNamed_);
    flags.raise(RoughnessFlag::ScalesLeftAside, leftAside_);
}

Result<void> checkScales(std::span<const StreamInfo> streams, const std::optional<SensorScales>& scales,
                         std::string_view serial) {
    if (!scales || matchOf(*scales, serial) != FingertipMatch::Same) return {};
    for (const auto& info : streams) {
        if (fitsTaxels(info, *scales)) continue;
        return fail(ErrorCode::InvalidArgument,
                    "roughness: sensor.taxels has {} scales and {} has {} taxels; one scale a taxel was expected",
                    scales->taxels.size(), info.name, info.channels);
    }
    return {};
}

}  // namespace tacto
