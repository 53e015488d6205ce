#include "drivers/sensor_board/EncoderProfile.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <fmt/format.h>
#include <iterator>
#include <memory>
#include <type_traits>
#include <utility>

#include "core/dsp/SampleHistory.h"
#include "core/dsp/SensorScales.h"
#include "core/encoding/Rounding.h"

namespace tacto {

namespace {

float single(double x) noexcept { return static_cast<float>(x); }
std::uint32_t word(bool x) noexcept { return x ? 1U : 0U; }

template <class Enum>
std::uint32_t numberOf(Enum value) noexcept {
    return static_cast<std::uint32_t>(value);
}
static_assert(static_cast<int>(CurveKind::Logarithmic) == TE_LOGARITHMIC &&
              static_cast<int>(CurveKind::Power) == TE_POWER);
static_assert(static_cast<int>(PulseShape::AsymmetricBiphasic) == TE_ASYMMETRIC &&
              static_cast<int>(PulseShape::Monophasic) == TE_MONOPHASIC);

/// The largest reading that is accepted. Counts have no limit; here, one that keeps their squares finite.
float mostReading(StreamUnit unit) noexcept { return single(std::min(mostPlausible(unit), 1e15)); }

void setStream(te_profile& to, const StreamScaling& scaling, std::size_t s) noexcept {
    const StreamInfo& info = scaling.streams()[s];
    const float rate = single(info.rate_hz), most = mostReading(info.unit);
    const auto channels = static_cast<std::uint32_t>(info.channels);
    const auto line = [&](std::size_t channel, float& scale, float& offset) {
        offset = single(scaling.inUse(s, channel, 0));
        scale = single(scaling.inUse(s, channel, 1) - scaling.inUse(s, channel, 0));
    };
    switch (info.kind) {
        case StreamKind::Acceleration:
            to.acceleration_hz = rate;
            to.axes = channels;
            to.acceleration_most = most;
            return;
        case StreamKind::Force:
            to.force_hz = rate;
            to.force_most = most;
            to.force_newton = word(info.unit == StreamUnit::Newton);
            return line(0, to.force_scale, to.force_offset);
        case StreamKind::Taxels:
            to.taxels_hz = rate;
            to.taxels = channels;
            to.taxels_most = most;
            to.taxels_pascal = word(info.unit == StreamUnit::Pascal);
            for (std::size_t c = 0; c < std::min<std::size_t>(channels, TE_TAXELS); ++c)
                line(c, to.taxel_scale[c], to.taxel_offset[c]);
    }
}

void setRoughness(te_profile& to, const RoughnessSettings& from, bool restFits) noexcept {
    to.spectral_absolute = word(from.spectral == SpectralFeature::Absolute);
    to.taxel_dynamic = word(from.taxel == TaxelFeature::Dynamic);
    to.band_low_hz = single(from.bandLow.value());
    to.spectral_weight = single(from.spectralWeight);
    to.taxel_weight = single(from.taxelWeight);
    to.spectral_smooth = single(from.spectralScale().smooth);
    to.spectral_rough = single(from.spectralScale().rough);
    to.taxel_smooth = single(from.taxelScale().smooth);
    to.taxel_rough = single(from.taxelScale().rough);
    to.smoothing_s = single(from.smoothing.count());
    to.rest_mean_square = restFits ? single(from.restMeanSquare.value_or(0)) : 0;
    to.contact_area_cm2 = single(from.contactArea.value());
    to.pressure_min_pa = single(from.pressureMin.value());
    to.pressure_max_pa = single(from.pressureMax.value());
}

void setEncoding(te_profile& to, const EncodingProfile& from) noexcept {
    to.amplitude_min_v = single(from.amplitudeMin.value());
    to.amplitude_max_v = single(from.amplitudeMax.value());
    to.interval_min_s = single(from.intervalMin.count());
    to.interval_max_s = single(from.intervalMax.count());
    to.amplitude_curve = numberOf(from.amplitudeCurve.kind);
    to.interval_curve = numberOf(from.intervalCurve.kind);
    to.amplitude_beta = single(from.amplitudeCurve.beta);
    to.interval_beta = single(from.intervalCurve.beta);
    to.swapped = word(from.assignment == Assignment::Swapped);
    to.amplitude_ratio = single(from.amplitudeRatioPerTrain);
    to.interval_ratio = single(from.intervalRatioPerTrain);
    to.amplitude_slew_v_s = single(from.amplitudeSlew_V_per_s);
    to.shape = numberOf(from.train.shape);
    to.negative = word(from.train.polarity == Polarity::Negative);
    to.width_us = single(from.train.phaseWidth.count());
    to.gap_us = single(from.train.interPhaseGap.count());
    to.recharge_ratio = single(from.train.rechargeRatio);
    to.pulses = static_cast<std::uint32_t>(from.train.pulses);
    to.pulse_hz = single(from.train.rate.value());
}

/// A board knows relative errors only, so an absolute one is taken of the `smallest` value that it may set; nothing
/// stated is ± 5 %, as for the gate.
float relative(const std::optional<Spread>& stated, double smallest) noexcept {
    const Spread spread = stated.value_or(kUnknownSpread);
    return single(spread.relative + (smallest > 0 ? spread.absolute / smallest : 0));
}

/// The errors of what comes out, for the profile's trains.
void setErrors(te_profile& to, const EncoderOutput& from, const EncodingProfile& encoding) noexcept {
    const auto& stated = from.source.accuracy;
    const bool current = from.source.drive == Drive::Current;
    const double least = encoding.amplitudeMin.value() * (1 - kLargestRounding) /
                         (current ? from.load.nominal.series.value() * 1e-3 : 1);
    to.amplitude_error = relative(stated.amplitude, least);
    to.width_error = std::max(relative(stated.phaseWidth, Seconds(encoding.train.phaseWidth).count()),
                              relative(stated.gap, Seconds(encoding.train.interPhaseGap).count()));
    to.interval_error = relative(stated.interval, encoding.intervalMin.count());
    to.rate_error = relative(stated.rate, encoding.train.rate.value());
}

Result<void> setCeiling(te_profile& to, const Ceiling& ceiling, double amplitudeMax) {
    const float most = single(ceiling.max);
    switch (ceiling.quantity) {
        case Quantity::PeakCurrent:
            to.ceiling_peak_ma = std::min(to.ceiling_peak_ma, most);
            return {};
        case Quantity::PhaseCharge:
            to.ceiling_charge_uc = std::min(to.ceiling_charge_uc, most);
            return {};
        case Quantity::RmsCurrent5s:
            to.ceiling_rms_ma = std::min(to.ceiling_rms_ma, most);
            return {};
        case Quantity::CommandVoltage:
            if (amplitudeMax <= ceiling.max) return {};
            return fail(ErrorCode::LimitExceeded, "the profile's amplitude_max_v {} V is above its ceiling of {} V",
                        amplitudeMax, ceiling.max);
        default:
            return fail(ErrorCode::Unsupported,
                        "the profile has a ceiling of {}; the board's encoder judges command voltage, peak current, "
                        "charge per phase and 5 s RMS current",
                        titleOf(ceiling.quantity));
    }
}

Result<void> setOutput(te_profile& to, const EncoderOutput& from, const EncodingProfile& encoding) {
    const SourceTraits& source = from.source;
    if (from.load.keepsCharge()) {
        return fail(ErrorCode::Unsupported, "a load of {}; the board's encoder accepts a resistance",
                    from.load.nominal.text());
    }
    if (encoding.hold != Hold::Voltage) {
        return fail(ErrorCode::Unsupported, "the profile holds the {} constant; the board's encoder holds the voltage",
                    nameOf(encoding.hold));
    }
    // A board's stimulator is given the profile's widths as they are.
    DeviceGrid grid = gridOf(source);
    grid.amplitudeStep = 0;
    const auto settable = roundToDevice(trainAt(encoding.train, source.drive, source.amplitudeMax), grid);
    if (!settable) return failure(settable);
    if (settable->changed()) {
        return fail(
            ErrorCode::Unsupported,
            "the stimulator would make a phase of {:g} us, a gap of {:g} us and {} pulses of the profile's {:g} "
            "us, {:g} us and {}; a board's encoder changes nothing of them",
            settable->train.phaseWidth.count(), settable->train.interPhaseGap.count(), settable->train.pulses,
            encoding.train.phaseWidth.count(), encoding.train.interPhaseGap.count(), encoding.train.pulses);
    }
    to.current_source = word(source.drive == Drive::Current);
    to.load_low_ohm = single(from.load.min.series.value());
    to.load_ohm = single(from.load.nominal.series.value());
    to.load_high_ohm = single(from.load.max.series.value());
    to.output_step = single(source.amplitudeStep);
    to.output_max = single(source.amplitudeMax);
    setErrors(to, from, encoding);
    to.ceiling_peak_ma = TE_MAX_PEAK_MA;
    to.ceiling_charge_uc = TE_MAX_CHARGE_UC;
    to.ceiling_rms_ma = TE_MAX_RMS_MA;
    for (const auto& ceiling : from.ceilings) {
        if (auto set = setCeiling(to, ceiling, encoding.amplitudeMax.value()); !set) return set;
    }
    return {};
}

}  // namespace

std::string_view wordsOf(te_refusal refusal) noexcept {
    switch (refusal) {
        case TE_ACCEPTED:
            break;
        case TE_BAD_LAYOUT:
            return "another layout";
        case TE_BAD_HASH:
            return "the hash of another content";
        case TE_BAD_STREAM:
            return "a stream that it cannot take: acceleration of 1 to 3 axes at 99 to 4007 Hz, force at 20 to 300 Hz, "
                   "2 taxels or more at up to 256 Hz are accepted";
        case TE_BAD_ROUGHNESS:
            return "a value of the roughness section that it cannot take";
        case TE_BAD_ENCODING:
            return "an amplitude above 40 V, an interval below 0.05 s, or another value of the encoding section that "
                   "it "
                   "cannot take";
        case TE_BAD_TRAIN:
            return "a train that makes no sense";
        case TE_BAD_OUTPUT:
            return "a load or a stimulator that it cannot take: resistances of 1 ohm to 1 Mohm and errors of at most "
                   "20 % are accepted";
        case TE_BAD_CEILING:
            return "a ceiling above its own: 100 mA, 20 uC and 10 mA RMS";
        case TE_ABOVE_COMMAND:
            return "more than 40 V";
        case TE_ABOVE_OUTPUT:
            return "more than the device's largest amplitude, or one that its step cannot approach within 10 %";
        case TE_ABOVE_PEAK:
            return "more than the ceiling of peak current";
        case TE_ABOVE_CHARGE:
            return "more than the ceiling of charge per phase";
        case TE_ABOVE_WIDTH:
            return "a phase of less than 1 us or, at worst, more than 1000 us";
        case TE_ABOVE_RATE:
            return "more than 1000 pulses/s, or trains closer than 0.05 s or than they last";
        case TE_ABOVE_DURATION:
            return "a train of more than 0.5 s";
        case TE_ABOVE_RMS:
            return "more RMS current over 5 s than allowed";
        case TE_METER:
            return "more trains in the last seconds than it can count, or a clock that went back";
    }
    return {};
}

std::string silenceWords(std::uint32_t faults, std::uint32_t refusal) {
    constexpr std::pair<std::uint32_t, std::string_view> kFaults[] = {
        {TE_FAULT_STOPPED, "a stop"},
        {TE_FAULT_STALE, "data that are older than 100 ms"},
        {TE_FAULT_FUTURE, "a stamp more than 100 ms ahead"},
        {TE_FAULT_STUCK, "a sensor that repeats itself"},
        {TE_FAULT_IMPLAUSIBLE, "a reading that no fingertip gives"},
        {TE_FAULT_RESTING, "the rest of 8 s after a start"},
        {TE_FAULT_PROFILE, "a profile that it refuses"}};
    std::string words;
    const auto add = [&](std::string_view phrase) { words += fmt::format("{}{}", words.empty() ? "" : ", ", phrase); };
    for (const auto& [bit, phrase] : kFaults) {
        if ((faults & bit) != 0) add(phrase);
        faults &= ~bit;
    }
    if (faults != 0) add(fmt::format("faults {:#x}, which are not known here", faults));
    if (refusal == TE_ACCEPTED) return words;
    const auto why = refusal <= TE_METER ? wordsOf(static_cast<te_refusal>(refusal)) : std::string_view();
    add(why.empty() ? fmt::format("a train that it refuses for reason {}", refusal)
                    : fmt::format("a train that it refuses: {}", why));
    return words;
}

Result<te_profile> encoderProfile(std::span<const StreamInfo> streams, const RoughnessSettings& roughness,
                                  const EncodingProfile& encoding, const EncoderOutput& output,
                                  std::string_view serial) {
    te_profile profile{};
    profile.layout = TE_LAYOUT;
    const StreamScaling scaling(streams, roughness.sensor, serial);
    bool restFits = false;
    for (std::size_t s = 0; s < streams.size(); ++s) {
        setStream(profile, scaling, s);
        restFits = restFits || (streams[s].kind == StreamKind::Acceleration && streams[s].unit == roughness.restUnit);
    }
    setRoughness(profile, roughness, restFits);
    setEncoding(profile, encoding);
    if (auto set = setOutput(profile, output, encoding); !set) return failure(set);
    profile.hash = te_hash(&profile);
    const auto state = std::make_unique<te_state>();
    if (const auto refusal = te_init(state.get(), &profile); refusal != TE_ACCEPTED)
        return fail(ErrorCode::Unsupported, "the board's encoder refuses {}", wordsOf(refusal));
    return profile;
}

namespace {

struct WordOfProfile {
    const char* name;
    std::size_t at;  ///< bytes from the profile's beginning
    bool whole;      ///< a whole number; else a float
};

// The name of a member is all that a row says: the macro makes text, place and kind of it.
#define TACTO_WORD(member) \
    WordOfProfile { #member, offsetof(te_profile, member), std::is_same_v<decltype(te_profile::member), std::uint32_t> }
constexpr WordOfProfile kWords[] = {
    TACTO_WORD(layout),
    TACTO_WORD(hash),
    TACTO_WORD(acceleration_hz),
    TACTO_WORD(axes),
    TACTO_WORD(acceleration_most),
    TACTO_WORD(force_hz),
    TACTO_WORD(force_scale),
    TACTO_WORD(force_offset),
    TACTO_WORD(force_most),
    TACTO_WORD(force_newton),
    TACTO_WORD(taxels_hz),
    TACTO_WORD(taxels),
    TACTO_WORD(taxels_most),
    TACTO_WORD(taxels_pascal),
    TACTO_WORD(spectral_absolute),
    TACTO_WORD(taxel_dynamic),
    TACTO_WORD(band_low_hz),
    TACTO_WORD(spectral_weight),
    TACTO_WORD(taxel_weight),
    TACTO_WORD(spectral_smooth),
    TACTO_WORD(spectral_rough),
    TACTO_WORD(taxel_smooth),
    TACTO_WORD(taxel_rough),
    TACTO_WORD(smoothing_s),
    TACTO_WORD(rest_mean_square),
    TACTO_WORD(contact_area_cm2),
    TACTO_WORD(pressure_min_pa),
    TACTO_WORD(pressure_max_pa),
    TACTO_WORD(amplitude_min_v),
    TACTO_WORD(amplitude_max_v),
    TACTO_WORD(interval_min_s),
    TACTO_WORD(interval_max_s),
    TACTO_WORD(amplitude_curve),
    TACTO_WORD(interval_curve),
    TACTO_WORD(amplitude_beta),
    TACTO_WORD(interval_beta),
    TACTO_WORD(swapped),
    TACTO_WORD(amplitude_ratio),
    TACTO_WORD(interval_ratio),
    TACTO_WORD(amplitude_slew_v_s),
    TACTO_WORD(shape),
    TACTO_WORD(negative),
    TACTO_WORD(width_us),
    TACTO_WORD(gap_us),
    TACTO_WORD(recharge_ratio),
    TACTO_WORD(pulses),
    TACTO_WORD(pulse_hz),
    TACTO_WORD(current_source),
    TACTO_WORD(load_low_ohm),
    TACTO_WORD(load_ohm),
    TACTO_WORD(load_high_ohm),
    TACTO_WORD(output_step),
    TACTO_WORD(output_max),
    TACTO_WORD(amplitude_error),
    TACTO_WORD(width_error),
    TACTO_WORD(interval_error),
    TACTO_WORD(rate_error),
    TACTO_WORD(ceiling_peak_ma),
    TACTO_WORD(ceiling_charge_uc),
    TACTO_WORD(ceiling_rms_ma),
};
#undef TACTO_WORD
static_assert(sizeof(std::uint32_t) * std::size(kWords) == offsetof(te_profile, taxel_scale));
static_assert(std::endian::native == std::endian::little);

std::string listOf(const float* values, std::uint32_t count) {
    std::string list = "{";
    for (std::uint32_t i = 0; i < count; ++i) list += fmt::format("{}{:.9e}F", i == 0 ? "" : ", ", values[i]);
    return list + "}";
}

}  // namespace

std::string profileBytes(const te_profile& profile) {
    const auto part = [](const void* from, std::size_t size) {
        return std::string(static_cast<const char*>(from), size);
    };
    const std::size_t taxels = profile.taxels * sizeof(float);
    return part(&profile, offsetof(te_profile, taxel_scale)) + part(profile.taxel_scale, taxels) +
           part(profile.taxel_offset, taxels);
}

std::string profileHeader(const te_profile& profile, std::string_view name) {
    std::string shown(name);
    std::ranges::replace_if(
        shown, [](unsigned char c) { return c < ' ' || c > '~' || c == '*' || c == '/'; }, '_');
    std::string text = fmt::format(
        "/* Written by tactoscope-cli firmware-profile. The profile \"{}\" for the tactile encoder: te_init(&state, "
        "&tactile_profile). */\n#include \"tactile_encoder.h\"\n\n#if TE_TAXELS < {}U\n#error \"this profile has {} "
        "taxels: define TE_TAXELS as that many or more for every file of the encoder\"\n#endif\n\nstatic const struct "
        "te_profile tactile_profile = "
        "{{\n",
        shown, profile.taxels, profile.taxels);
    const auto bytes = profileBytes(profile);
    for (const auto& [member, at, whole] : kWords) {
        float number = 0;
        std::uint32_t integer = 0;
        std::memcpy(&number, bytes.data() + at, sizeof number);
        std::memcpy(&integer, bytes.data() + at, sizeof integer);
        text += whole ? fmt::format("    .{} = {}U,\n", member, integer)
                      : fmt::format("    .{} = {:.9e}F,\n", member, number);
    }
    if (profile.taxels > 0) {
        text += fmt::format("    .taxel_scale = {},\n    .taxel_offset = {},\n",
                            listOf(profile.taxel_scale, profile.taxels), listOf(profile.taxel_offset, profile.taxels));
    }
    return text + "};\n";
}

}  // namespace tacto
