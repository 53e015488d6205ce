#include "core/dsp/RoughnessChain.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/Statistics.h"
#include "core/dsp/AccelerationTrack.h"
#include "core/dsp/ForceTrack.h"
#include "core/dsp/FramePacer.h"
#include "core/dsp/RoughnessIndex.h"
#include "core/dsp/SampleHistory.h"
#include "core/dsp/SensorScales.h"
#include "core/dsp/TaxelTrack.h"
#include "core/dsp/WindowVibration.h"

namespace tacto {

namespace {

constexpr double kSlice_s = 0.05;  // how far a stream may run ahead within feed()
constexpr double kSkew_s = 0.25;   // how far a stream may run ahead between calls, with a margin

}  // namespace

struct RoughnessChain::State {
    State(std::span<const StreamInfo> infos, const RoughnessSettings& chosen, const DeclaredIntervals& stated,
          std::string_view serial);

    void feed(std::span<const SampleBlock> blocks, std::vector<RoughnessFrame>& frames);
    void takeSlice(std::span<const SampleBlock> blocks);
    void take(std::size_t stream, const SampleBlock& block, std::size_t begin, std::size_t end);
    void advance(std::vector<RoughnessFrame>& frames, bool forced);
    [[nodiscard]] bool ready(double centre_s, double end_s) const noexcept;
    void evaluate(double begin_s, double centre_s, double end_s, const AccelerationWindow* window,
                  std::vector<RoughnessFrame>& frames);
    [[nodiscard]] double forceKnown_s() const noexcept;
    [[nodiscard]] double horizon_s() const noexcept;
    [[nodiscard]] double streamBegin_s() const noexcept;
    [[nodiscard]] bool contactAt(double t_s, const ForceTrack::Reading& reading) const noexcept;
    [[nodiscard]] double firstContact_s() const noexcept;
    void raiseAbsence(RoughnessFlags& flags) const noexcept;
    void clear();

    // Constant after construction:
    StreamScaling scaling;
    const std::vector<StreamInfo>& streams;  // converted to the units in use
    RoughnessSettings settings;
    DeclaredIntervals declared;
    std::optional<StreamInfo> accelerationInfo, forceInfo, taxelInfo;
    double period_s = 0;
    StreamKind pacedBy = StreamKind::Acceleration;

    std::optional<AccelerationTrack> acceleration;
    std::optional<WindowVibration> vibration;
    std::optional<ForceTrack> force;
    std::optional<TaxelTrack> taxels;
    std::optional<RoughnessIndex> index;
    std::optional<SlidingRest> sliding;
    std::optional<FramePacer> pacer;  // used without acceleration
    std::vector<std::size_t> taken;   // samples taken from the current blocks, per stream

    bool contactAssumed = false;
    std::size_t framesSeen = 0, framesInContact = 0, framesWithForce = 0, framesWithTaxels = 0;
    bool finished = false;
    mutable RestLevels levels;
};

RoughnessChain::State::State(std::span<const StreamInfo> infos, const RoughnessSettings& chosen,
                             const DeclaredIntervals& stated, std::string_view serial)
    : scaling(infos, chosen.sensor, serial),
      streams(scaling.streams()),
      settings(chosen),
      declared(stated),
      taken(infos.size()) {
    if (!scaling.holds()) settings.calibrated = false;
    for (const auto& info : streams) {
        if (info.kind == StreamKind::Acceleration) accelerationInfo = info;
        if (info.kind == StreamKind::Force) forceInfo = info;
        if (info.kind == StreamKind::Taxels) taxelInfo = info;
    }
    if (forceInfo) force.emplace(forceInfo->rate_hz, mostPlausible(forceInfo->unit));
    if (taxelInfo) taxels.emplace(*taxelInfo, declared.baseline);
    if (accelerationInfo) {
        acceleration.emplace(*accelerationInfo);
        period_s = acceleration->hop_s();
        vibration.emplace(*acceleration, accelerationInfo->channels, accelerationInfo->rate_hz, settings);
    } else {
        const auto& paced = taxelInfo ? *taxelInfo : *forceInfo;
        pacedBy = paced.kind;
        pacer.emplace(paced.rate_hz);
        period_s = pacer->period_s();
    }
    contactAssumed = !forceInfo && !declared.contact;
    index.emplace(settings, period_s);
    const bool restFits = accelerationInfo && settings.restUnit == accelerationInfo->unit;
    sliding.emplace(accelerationInfo.has_value(), declared.baseline, restFits ? settings.restMeanSquare : std::nullopt);
}

void RoughnessChain::State::clear() {
    if (acceleration) acceleration->clear();
    if (force) force->clear();
    if (taxels) taxels->clear();
    if (pacer) pacer->clear();
    sliding->clear();
    index->clear();
    framesSeen = framesInContact = framesWithForce = framesWithTaxels = 0;
    finished = false;
}

/// Raises flags for why there is no contact, and for a stream without data for the frames.
void RoughnessChain::State::raiseAbsence(RoughnessFlags& flags) const noexcept {
    using enum RoughnessFlag;
    constexpr double kEarly_s = 2;  // a stream may begin this much later than another
    const bool told = framesSeen > 0 && (finished || static_cast<double>(framesSeen) * period_s > kEarly_s);
    const bool hasForce = force && std::isfinite(force->newest_s());
    if (told && hasForce && framesWithForce == 0) flags.count(ForceElsewhere, framesSeen);
    if (told && taxels && std::isfinite(taxels->newest_s()) && framesWithTaxels == 0)
        flags.count(TaxelsElsewhere, framesSeen);
    if (hasForce && force->firstContact_s() == kInfinity_s) {
        // Nothing has been touched yet, or the sign is reversed, which can be reported at once.
        flags.raise(ForceBelowContact, finished || force->least() <= -ForceTrack::kContactStart_n);
        flags.leastForce = force->least();
        flags.mostForce = force->most();
        flags.forceUnit = forceInfo->unit;
    } else if (finished && framesInContact == 0 && framesSeen > 0 && !flags.has(ForceElsewhere)) {
        flags.raise(NoFrameInContact, hasForce || (!force && declared.contact));
    }
}

double RoughnessChain::State::horizon_s() const noexcept {
    return acceleration ? acceleration->newest_s() : pacer->newest_s();
}

double RoughnessChain::State::streamBegin_s() const noexcept {
    return acceleration ? acceleration->first_s() : pacer->first_s();
}

double RoughnessChain::State::firstContact_s() const noexcept {
    if (force) return force->firstContact_s();
    if (!declared.contact) return -kInfinity_s;
    return declared.contact->empty() ? kInfinity_s : declared.contact->front().begin_s;
}

double RoughnessChain::State::forceKnown_s() const noexcept {
    if (!force || finished) return kInfinity_s;
    const double start = streamBegin_s();
    // Before the first sample, and in a long silence, frames do not wait for force without limit.
    const double spoken = std::max(force->newest_s(), start);
    if (horizon_s() > spoken + ForceTrack::kLongestBridge_s + kSkew_s) return kInfinity_s;
    // What is stamped as the newest sample is known, however both stamps were rounded.
    return force->newest_s() + kStampRounding_s;
}

bool RoughnessChain::State::contactAt(double t_s, const ForceTrack::Reading& reading) const noexcept {
    if (force) return reading.contact;
    if (!declared.contact) return true;
    return std::ranges::any_of(*declared.contact, [&](const TimeInterval& c) { return c.contains(t_s); });
}

void RoughnessChain::State::take(std::size_t stream, const SampleBlock& block, std::size_t begin, std::size_t end) {
    const auto& info = streams[stream];
    const double* values = block.values.data() + begin * info.channels;
    switch (info.kind) {
        case StreamKind::Acceleration:
            acceleration->push(std::span(block.t_s).subspan(begin, end - begin), values);
            return;
        case StreamKind::Force:
            for (std::size_t i = begin; i < end; ++i)
                force->push(block.t_s[i], scaling.inUse(stream, 0, block.values[i]));
            break;
        case StreamKind::Taxels:
            for (std::size_t i = begin; i < end; ++i, values += info.channels)
                taxels->push(block.t_s[i], scaling.scaled(stream, values));
            break;
    }
    if (!acceleration && info.kind == pacedBy) {
        for (std::size_t i = begin; i < end; ++i) pacer->sample(block.t_s[i]);
    }
}

void RoughnessChain::State::takeSlice(std::span<const SampleBlock> blocks) {
    // Keeps in step with the slowest stream, so that a file waits for no more than a live bench does.
    double until = kInfinity_s;
    for (std::size_t s = 0; s < streams.size(); ++s) {
        if (taken[s] < blocks[s].samples()) until = std::min(until, blocks[s].t_s[taken[s]]);
    }
    until += kSlice_s;
    for (std::size_t s = 0; s < streams.size(); ++s) {
        const auto& stamps = blocks[s].t_s;
        const std::size_t most = std::min(stamps.size(), taken[s] + AccelerationTrack::kChunk);
        std::size_t end = taken[s];
        while (end < most && !(stamps[end] > until)) ++end;
        if (end == taken[s]) continue;
        take(s, blocks[s], taken[s], end);
        taken[s] = end;
    }
}

void RoughnessChain::State::feed(std::span<const SampleBlock> blocks, std::vector<RoughnessFrame>& frames) {
    std::ranges::fill(taken, std::size_t{0});
    const auto left = [&] {
        for (std::size_t s = 0; s < streams.size(); ++s) {
            if (taken[s] < blocks[s].samples()) return true;
        }
        return false;
    };
    while (left()) {
        takeSlice(blocks);
        advance(frames, false);
        // Reached only if streams are further apart than feed() permits: completes the oldest frames as they are.
        while (acceleration ? acceleration->full() : pacer->crowded()) advance(frames, true);
    }
}

bool RoughnessChain::State::ready(double centre_s, double end_s) const noexcept {
    if (finished) return true;
    const double known = forceKnown_s();
    if (known < end_s) return false;
    if (!taxels) return true;
    const bool silent = horizon_s() > std::max({taxels->newest_s(), centre_s + taxels->reach_s(), streamBegin_s()}) +
                                          ForceTrack::kLongestBridge_s;
    if (silent) return true;
    if (taxels->newest_s() + kStampRounding_s < centre_s && horizon_s() <= centre_s + taxels->reach_s() + kSkew_s)
        return false;
    return taxels->decided(std::min(known, taxels->newest_s()));
}

void RoughnessChain::State::advance(std::vector<RoughnessFrame>& frames, bool forced) {
    const double known = forceKnown_s();
    if (acceleration) {
        auto stretch = acceleration->unnormalised(forced ? kInfinity_s : known);
        if (!stretch.stamps.empty()) {
            if (force) {
                force->normalise(stretch.stamps, std::span(stretch.axes).first(accelerationInfo->channels),
                                 acceleration->first_s());
            }
            acceleration->markNormalised(stretch.stamps.size());
        }
    }
    if (taxels) taxels->settle(known, firstContact_s());
    if (taxels && finished) taxels->close();

    bool regardless = forced;
    if (acceleration) {
        for (const auto* window = acceleration->frontWindow(); window != nullptr;
             window = acceleration->frontWindow()) {
            if (!regardless && !ready(window->centre_s, std::max(window->end_s, window->last_s))) break;
            evaluate(window->begin_s, window->centre_s, window->end_s, window, frames);
            acceleration->popWindow();
            regardless = false;
        }
        return;
    }
    while (!pacer->empty() && (regardless || ready(pacer->front(), pacer->front()))) {
        evaluate(pacer->front(), pacer->front(), pacer->front(), nullptr, frames);
        pacer->pop();
        regardless = false;
    }
}

void RoughnessChain::State::evaluate(double begin_s, double centre_s, double end_s, const AccelerationWindow* window,
                                     std::vector<RoughnessFrame>& frames) {
    RoughnessFrame frame;
    frame.t_s = centre_s;
    ForceTrack::Reading pressed{kNaN, false, false};
    if (force) pressed = force->at(centre_s);
    frame.contact = contactAt(centre_s, pressed);

    double meanSquare = 0;
    if (window != nullptr) {
        const auto read = vibration->of(*window);
        frame.h = read.feature;
        meanSquare = read.meanSquare;
        if (force) {
            // If the force is unknown (NaN), the comparison is false and the smallest divisor is used.
            const bool pressing = pressed.force_n > ForceTrack::kSmallestDivisor_n;
            const double divisor = pressing ? pressed.force_n : ForceTrack::kSmallestDivisor_n;
            meanSquare *= divisor * divisor;
            if (frame.contact && force->unsteady(begin_s, end_s, streamBegin_s())) {
                meanSquare = std::min(meanSquare, vibration->undoneMeanSquare(*window, *force, streamBegin_s()));
            }
        }
    }

    double taxelMean = kNaN;
    if (taxels) {
        const auto reading = taxels->at(centre_s, settings.taxel == TaxelFeature::Dynamic);
        frame.v = reading.v > 0 && std::isfinite(reading.v) ? reading.v : kNaN;
        taxelMean = reading.mean;
    }
    const Motion motion = sliding->next({begin_s, end_s, meanSquare, frame.contact, streamBegin_s(), firstContact_s()});
    frame.sliding = motion == Motion::Sliding;
    frame.R = index->next(centre_s, motion, frame.h, frame.v);

    if (forceInfo) {
        if (forceInfo->unit == StreamUnit::Newton && pressed.fresh) {
            constexpr double kSquareMetresPerSquareCentimetre = 1e-4;
            frame.pressure_pa = pressed.force_n / (settings.contactArea.value() * kSquareMetresPerSquareCentimetre);
        }
    } else if (taxelInfo && taxelInfo->unit == StreamUnit::Pascal) {
        frame.pressure_pa = taxelMean;
    }
    if (!std::isnan(frame.pressure_pa)) frame.P = pressureIndex(frame.pressure_pa, settings);
    ++framesSeen;
    framesInContact += frame.contact ? 1 : 0;
    framesWithForce += pressed.fresh ? 1 : 0;
    framesWithTaxels += std::isnan(taxelMean) ? 0 : 1;
    frames.push_back(frame);
    if (force) force->release(begin_s);
}

RoughnessChain::RoughnessChain(std::unique_ptr<State> state) : state_(std::move(state)) {}
RoughnessChain::~RoughnessChain() = default;

Result<std::unique_ptr<RoughnessChain>> RoughnessChain::create(std::span<const StreamInfo> streams,
                                                               const RoughnessSettings& settings,
                                                               const DeclaredIntervals& declared,
                                                               std::string_view serial) {
    if (const auto valid = validate(settings); !valid) return failure(valid);
    if (const auto good = checkStreams(streams); !good) return failure(good);
    if (const auto fits = checkScales(streams, settings.sensor, serial); !fits) return failure(fits);
    return std::unique_ptr<RoughnessChain>(
        new RoughnessChain(std::make_unique<State>(streams, settings, declared, serial)));
}

void RoughnessChain::feed(std::span<const SampleBlock> blocks, std::vector<RoughnessFrame>& frames) {
    if (blocks.size() != state_->streams.size()) return;
    state_->feed(blocks, frames);
}

void RoughnessChain::finish(std::vector<RoughnessFrame>& frames) {
    state_->finished = true;
    state_->advance(frames, false);
    state_->sliding->close();
}

void RoughnessChain::reset() { state_->clear(); }

void RoughnessChain::presetRest(const RestLevels& rest) {
    if (state_->taxels) state_->taxels->preset(rest);
    if (rest.slidingMeanSquare >= 0) state_->sliding->preset(rest.slidingMeanSquare);
}

const RestLevels* RoughnessChain::rest() const noexcept {
    const bool taxelsKnown = !state_->taxels || state_->taxels->baselineKnown();
    if (!taxelsKnown || !state_->sliding->decided()) return nullptr;
    auto& levels = state_->levels;
    levels.taxelBaseline = state_->taxels ? state_->taxels->baseline() : std::vector<double>{};
    levels.taxelFloor = state_->taxels ? state_->taxels->floor() : 0;
    levels.slidingMeanSquare = state_->sliding->meanSquare();
    return &levels;
}

double RoughnessChain::framePeriod_s() const noexcept { return state_->period_s; }

std::span<const StreamInfo> RoughnessChain::streams() const noexcept { return state_->streams; }

bool RoughnessChain::converts(std::size_t stream) const noexcept { return state_->scaling.converts(stream); }

double RoughnessChain::inUse(std::size_t stream, std::size_t channel, double reading) const noexcept {
    return state_->scaling.inUse(stream, channel, reading);
}

RoughnessFlags RoughnessChain::flags() const noexcept {
    using enum RoughnessFlag;
    const auto& s = *state_;
    RoughnessFlags out;
    s.raiseAbsence(out);
    out.raise(BandTruncated, s.acceleration && s.acceleration->bandTruncated());
    out.raise(NoSpectralFeature, !s.vibration || !s.vibration->hasFeature());
    out.raise(NotForceNormalised, !s.force);
    out.raise(ContactAssumed, s.contactAssumed);
    out.raise(SlidingAssumed, s.sliding->assumed());
    out.raise(BaselineAssumed, s.taxels && s.taxels->baselineAssumed());
    out.raise(UncalibratedR, !s.settings.calibrated);
    out.raise(UncalibratedUnits,
              std::ranges::any_of(s.streams, [](const auto& info) { return info.unit == StreamUnit::Count; }));
    s.scaling.raise(out);
    if (s.force) {
        out.count(ForceStale, s.force->staleStretches(s.horizon_s()));
        out.count(ForceInvalid, s.force->invalidSamples());
        out.count(ForceBeyond, s.force->samplesBeyond());
        out.count(ForceOrder, s.force->outOfOrder());
    }
    if (s.acceleration) {
        const auto& lost = s.acceleration->losses();
        out.count(AccelerationGaps, lost.gaps);
        out.count(AccelerationOrder, lost.repeats + lost.clockSteps);
        out.count(AccelerationInvalid, lost.invalid);
        out.count(AccelerationBeyond, lost.beyond);
    }
    if (s.taxels) {
        out.count(TaxelsInvalid, s.taxels->invalidSamples());
        out.count(TaxelsBeyond, s.taxels->samplesBeyond());
        out.count(TaxelsOrder, s.taxels->outOfOrder());
    }
    return out;
}

}  // namespace tacto
