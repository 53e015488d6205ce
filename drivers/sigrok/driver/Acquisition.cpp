#include "drivers/sigrok/driver/Acquisition.h"

#include "drivers/sigrok/protocol/StreamTrigger.h"

namespace tacto::sigrok_driver {

Result<void> Acquisition::open(const ScopeUri& uri, const std::vector<std::pair<std::string, std::string>>& options) {
    auto library = SigrokLibrary::get();
    if (!library) return failure(library);
    auto opened = Instrument::open(std::move(*library), uri.driver, options);
    if (!opened) return failure(opened);
    abilities = (*opened)->abilities();
    auto wired = wire(uri, abilities);
    if (!wired) return failure(wired);
    wiring = *wired;
    if (auto prepared = (*opened)->prepare(wiring); !prepared) return prepared;
    if (!closing) instrument = std::move(*opened);
    return {};
}

void Acquisition::acquire(const RecordPlan& plan, std::uint64_t number) noexcept {
    if (!instrument || !queue.wanted(number)) return;
    const auto ended = guarded("the acquisition", [&]() -> Result<void> {
        auto done = instrument->apply(plan, wiring);
        if (!done) return done;
        return abilities.streams() ? acquireStream(plan, number) : acquireFrames(plan, number);
    });
    if (!ended) {
        queue.fail(ended.error());
    } else if (!*ended) {
        queue.fail(ended->error());
    }
}

Result<void> Acquisition::acquireFrames(const RecordPlan& plan, std::uint64_t number) {
    std::optional<RawRecord> before;  // live records only: the screen that was read last
    while (queue.waitForRoom(number)) {
        auto frame = takeFrame(plan, number);
        if (!frame) return failure(frame);
        if (!*frame) return {};
        RawRecord& raw = **frame;
        const auto& watched = plan.settings.triggerOnCurrent ? raw.current : raw.voltage;
        const double expected = plan.triggerAt_s * raw.rate_hz;
        const auto crossed = crossing(watched, plan.triggerLevel_V, expected);
        if (wiring.live) {
            const bool same = before && before->voltage == raw.voltage && before->current == raw.current;
            const bool first = !before;
            before = raw;
            if (first || same || !crossed) continue;
        }
        auto capture = cut(raw, plan, wiring, crossed.value_or(expected));
        if (!capture) return failure(capture);
        queue.push(number, std::move(*capture));
    }
    return {};
}

Result<std::optional<RawRecord>> Acquisition::takeFrame(const RecordPlan& plan, std::uint64_t number) {
    RawRecord raw;
    bool arrived = false;
    bool complete = false;
    bool stopped = false;
    constexpr std::size_t kMaxRecordSamples = 100'000'000;
    Instrument::Sink sink;
    sink.samples = [&](std::size_t channel, std::span<const float> samples, double resolution) {
        (void)queue.wanted(number);  // wanted() also notes that the loop turns
        if (!arrived) raw.end_s = now();
        arrived = true;
        if (resolution > 0) raw.resolution = resolution;
        auto& into = channel == wiring.voltage ? raw.voltage : raw.current;
        const std::size_t most = plan.record > 0 ? plan.record : kMaxRecordSamples;
        if (into.size() + samples.size() > most) {
            // Fails at once: after excess samples libsigrok may wait forever for an answer that it has read already.
            const auto why = fmt::format("the instrument gave more than the {} samples that a record holds", most);
            queue.fail({ErrorCode::Device, why});
            throw std::length_error(why);
        }
        if (plan.record > 0) into.reserve(plan.record);
        into.insert(into.end(), samples.begin(), samples.end());
    };
    sink.frameBegin = [&] { queue.started(number); };
    sink.frameEnd = [&] { complete = true; };
    sink.stop = [&] {
        if (!queue.wanted(number)) stopped = true;
        return stopped;
    };
    if (auto ran = instrument->run(sink, 1, 0); !ran) return failure(ran);
    if (stopped) return std::optional<RawRecord>{};
    const bool even = !wiring.current || raw.voltage.size() == raw.current.size();
    const bool asPlanned = plan.record == 0 || raw.voltage.size() == plan.record;
    if (!complete || raw.voltage.empty() || !even || !asPlanned) {
        const std::string expected = plan.record > 0 ? fmt::format("{}", plan.record) : "equally many";
        return fail(ErrorCode::Device,
                    "the instrument gave {} samples of voltage and {} of current; {} of each channel were expected{}",
                    raw.voltage.size(), raw.current.size(), expected,
                    sigrokLog().last.empty() ? "" : fmt::format(" ({})", sigrokLog().last));
    }
    raw.rate_hz = static_cast<double>(raw.voltage.size()) / plan.screen_s;
    // If the driver states a rate, that rate is exact. For a record from memory the driver states none.
    if (const double told = plan.record > 0 ? 0 : instrument->rate(); told > 0) raw.rate_hz = told;
    return std::optional<RawRecord>(std::move(raw));
}

Result<void> Acquisition::acquireStream(const RecordPlan& plan, std::uint64_t number) {
    StreamTrigger trigger(plan, wiring);
    Instrument::Sink sink;
    sink.samples = [&](std::size_t channel, std::span<const float> samples, double resolution) {
        if (!queue.wanted(number)) return;
        trigger.add(channel, samples, resolution, now());
        queue.started(number);
    };
    sink.frameBegin = [] {};
    sink.frameEnd = [] {};
    // Searches here and not with each packet: samples come in bursts, and only a burst's last packet dates them well.
    sink.stop = [&] {
        if (queue.takeForced()) trigger.force();
        while (queue.wanted(number)) {
            auto found = trigger.next();
            if (!found) throw std::runtime_error(found.error().message);
            if (!*found) return false;
            if (!queue.hasRoom()) continue;  // a stream does not wait: records that find no room are lost
            queue.push(number, std::move(**found));
        }
        return true;
    };
    while (queue.wanted(number)) {
        if (auto ran = instrument->run(sink, 0, 0); !ran) return ran;
        if (queue.wanted(number)) return fail(ErrorCode::Device, "{} has ended its stream", abilities.model);
    }
    return {};
}

}  // namespace tacto::sigrok_driver
