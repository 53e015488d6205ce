#include "core/dsp/SensorScales.h"

#include <algorithm>
#include <cmath>

#include "core/base/RecordFields.h"
#include "core/base/Statistics.h"
#include "core/dsp/Butterworth.h"

namespace tacto {

namespace {

// Scales as stored in a file: force with its unit, taxels in columns.
struct ForceScale {
    StreamUnit unit = StreamUnit::Newton;
    SensorLine line;
};
struct TaxelScales {
    StreamUnit unit = StreamUnit::Pascal;
    std::vector<double> scale, offset, scaleU;  // NaN if U is not known
};
struct StoredScales {
    std::string serial;
    std::optional<ForceScale> force;
    std::optional<TaxelScales> taxels;
};

StoredScales storedFrom(const SensorScales& scales) {
    StoredScales out{scales.fingertip, std::nullopt, std::nullopt};
    if (scales.force) out.force = {scales.forceUnit, *scales.force};
    if (scales.taxels.empty()) return out;
    auto& columns = out.taxels.emplace();
    columns.unit = scales.taxelUnit;
    for (const auto& line : scales.taxels) {
        columns.scale.push_back(line.scale);
        columns.offset.push_back(line.offset);
        columns.scaleU.push_back(line.scaleU.value_or(kNaN));
    }
    return out;
}

SensorScales scalesFrom(const StoredScales& stored) {
    SensorScales out;
    out.fingertip = stored.serial;
    if (stored.force) {
        out.forceUnit = stored.force->unit;
        out.force = stored.force->line;
    }
    if (!stored.taxels) return out;
    out.taxelUnit = stored.taxels->unit;
    for (std::size_t i = 0; i < stored.taxels->scale.size(); ++i) {
        const double u = stored.taxels->scaleU[i];
        out.taxels.push_back(
            {stored.taxels->scale[i], stored.taxels->offset[i], std::isnan(u) ? std::nullopt : std::optional(u)});
    }
    return out;
}

Result<void> scaleIsNotZero(double scale) {
    if (scale != 0) return {};
    return invalid("\"scale\" is 0; a number other than 0 was expected");
}

RecordFields<ForceScale> forceFields() {
    RecordFields<ForceScale> all;
    all.word("unit", &ForceScale::unit, kForceUnits).required = true;
    all.number("scale", in(&ForceScale::line, &SensorLine::scale)).required = true;
    all.number("offset_n", in(&ForceScale::line, &SensorLine::offset), {.unit = "N"}).required = true;
    all.number("scale_u", in(&ForceScale::line, &SensorLine::scaleU), {.low = 0});
    all.rule([](const ForceScale& force) { return scaleIsNotZero(force.line.scale); });
    return all;
}

RecordFields<TaxelScales> taxelFields() {
    constexpr std::size_t kMaxTaxels = 100'000;
    const auto known = numberKind<double>({.low = 0});
    auto orNull = known;
    orNull.reads([known](const nlohmann::json& value, double& into, const RecordPlace& place, std::string_view key) {
        into = kNaN;
        return value.is_null() ? Result<void>() : known.read(value, into, place, key);
    });
    orNull.checks([known](double value, const RecordPlace& place, std::string_view key) {
        return std::isnan(value) ? Result<void>() : known.check(value, place, key);
    });
    RecordFields<TaxelScales> all;
    all.word("unit", &TaxelScales::unit, kTaxelUnits).required = true;
    all.list("scale", &TaxelScales::scale, numberKind<double>({}), 1, kMaxTaxels).required = true;
    all.list("offset_pa", &TaxelScales::offset, numberKind<double>({.unit = "Pa"}), 0, kMaxTaxels).required = true;
    all.list("scale_u", &TaxelScales::scaleU, orNull, 0, kMaxTaxels).required = true;
    all.rule([](const TaxelScales& taxels) -> Result<void> {
        for (const auto& [key, list] : {std::pair("offset_pa", &taxels.offset), std::pair("scale_u", &taxels.scaleU)}) {
            if (list->size() == taxels.scale.size()) continue;
            return invalid("\"{}\" has {} values; as many values as scale has were expected", key, list->size());
        }
        for (const double scale : taxels.scale) {
            if (auto sound = scaleIsNotZero(scale); !sound) return sound;
        }
        return {};
    });
    return all;
}

}  // namespace

double RoughnessUncertainty::expanded(double R) const noexcept {
    const auto smooth = static_cast<double>(smoothSlides), rough = static_cast<double>(roughSlides);
    return coverage * slideSd * std::sqrt(1 + (1 - R) * (1 - R) / smooth + R * R / rough);
}

FingertipMatch matchOf(const SensorScales& scales, std::string_view serial) noexcept {
    if (scales.fingertip.empty() || serial.empty()) return FingertipMatch::NotNamed;
    return scales.fingertip == serial ? FingertipMatch::Same : FingertipMatch::Another;
}

ValueKind<SensorScales> sensorScalesKind() {
    RecordFields<StoredScales> stored;
    stored.text("serial", &StoredScales::serial, {.mayBeEmpty = true});
    stored.record("force", &StoredScales::force, forceFields()).leftOutIfEmpty = true;
    stored.record("taxels", &StoredScales::taxels, taxelFields()).leftOutIfEmpty = true;
    return storedAs<SensorScales, StoredScales>(stored, scalesFrom, storedFrom);
}

RecordFields<RoughnessUncertainty> roughnessUncertaintyFields() {
    using U = RoughnessUncertainty;
    RecordFields<U> all;
    all.number("slide_sd", &U::slideSd, {.low = 0}).required = true;
    all.number("coverage_factor", &U::coverage, {.low = 0}).required = true;
    all.number("smooth_slides", &U::smoothSlides, {.low = 1, .high = 100'000}).required = true;
    all.number("rough_slides", &U::roughSlides, {.low = 1, .high = 100'000}).required = true;
    return all;
}

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
    another_ = match == FingertipMatch::Another || !fits;  // a different number of taxels means a different fingertip
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

bool StreamScaling::converts(std::size_t stream) const noexcept {
    const auto kind = streams_[stream].kind;
    return (kind == StreamKind::Force && force_) || (kind == StreamKind::Taxels && taxels_);
}

double StreamScaling::inUse(std::size_t stream, std::size_t channel, double reading) const noexcept {
    if (!converts(stream)) return reading;
    return streams_[stream].kind == StreamKind::Force ? scales_.force->at(reading)
                                                      : scales_.taxels[channel].at(reading);
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
        return invalid("roughness: sensor.taxels has {} scales and {} has {} taxels; one scale a taxel was expected",
                       scales->taxels.size(), info.name, info.channels);
    }
    return {};
}

namespace {

Result<void> checkStream(const StreamInfo& info) {
    if (!(info.rate_hz > 0 && info.rate_hz <= 1e6)) {
        return invalid("{}: its rate is {} Hz; above 0 to 1 MHz was expected", nameOf(info.kind), info.rate_hz);
    }
    switch (info.kind) {
        case StreamKind::Acceleration:
            // A measured rate may miss a nominal 100 Hz or 20 kHz by a little.
            if (!(info.rate_hz >= 99 && info.rate_hz <= 20'200)) {
                return invalid("acceleration: its rate is {:.6g} Hz; 100 Hz to 20 kHz was expected", info.rate_hz);
            }
            if (info.channels < 1 || info.channels > AxesBandpass::kMaxAxes) {
                return invalid("acceleration: it has {} axes; 1 to 3 were expected", info.channels);
            }
            return {};
        case StreamKind::Force:
            if (info.channels == 1) return {};
            return invalid("force: it has {} channels; 1 was expected", info.channels);
        case StreamKind::Taxels:
            if (info.channels >= 2) return {};
            return invalid("taxels: there are {}; at least 2 were expected", info.channels);
    }
    return {};
}

}  // namespace

Result<void> checkStreams(std::span<const StreamInfo> streams) {
    if (streams.empty()) {
        return invalid("roughness: there is no stream; acceleration, force or taxels was expected");
    }
    for (std::size_t i = 0; i < streams.size(); ++i) {
        if (const auto good = checkStream(streams[i]); !good) return failure(good);
        for (std::size_t j = 0; j < i; ++j) {
            if (streams[i].kind != streams[j].kind) continue;
            return invalid("roughness: there are two {} streams; one was expected", nameOf(streams[i].kind));
        }
    }
    return {};
}

}  // namespace tacto
