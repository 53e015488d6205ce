#include "drivers/sensor_board/SensorBoard.h"

#include <algorithm>
#include <cmath>

namespace tacto {

using namespace sensorboard;

SensorBoard::SensorBoard(std::unique_ptr<Transport> transport, const Clock& clock)
    : link_(std::move(transport), clock), clock_(clock) {
    trackOf_.fill(-1);
}

SensorBoard::~SensorBoard() {
    if (began_) link_.stopUnheard();
}

Result<void> SensorBoard::read(std::span<SampleBlock> blocks) {
    if (blocks.size() != infos_.size()) {
        return fail(ErrorCode::InvalidArgument, "{} has {} streams, but {} blocks were given", identity_.name,
                    infos_.size(), blocks.size());
    }
    if (failed_) return tl::unexpected<Error>(*failed_);
    auto taken = takeFrames(blocks);
    if (taken) taken = judgeNoise();
    publish();
    if (!taken) {
        failed_ = Error{ErrorCode::Device, fmt::format("{}: {}", identity_.name, taken.error().message)};
        return tl::unexpected<Error>(*failed_);
    }
    return {};
}

Result<void> SensorBoard::takeFrames(std::span<SampleBlock> blocks) {
    const auto begin = link_.counts().bytes;
    for (;;) {
        while (const auto frame = link_.next()) {
            if (frame->is(Reply::Data)) {
                if (const auto taken = takeBlock(*frame, blocks); !taken) return taken;
            } else if (frame->is(Reply::Status)) {
                const auto status = readStatus(*frame);
                if (!status) {
                    ++current_.foreign;
                    continue;
                }
                if (const auto seen = observe(status->time_us); !seen) return seen;
                current_.board = *status;
            } else if (frame->version != kVersion) {
                ++current_.foreign;
            }
        }
        // A board can send faster than the line it names, but not make this loop last for ever.
        if (link_.counts().bytes - begin >= kMaxRead) return {};
        const auto came = link_.fill(Seconds(0));
        if (!came) return failure(came);
        if (!*came) return {};
    }
}

Result<void> SensorBoard::takeBlock(const Frame& frame, std::span<SampleBlock> blocks) {
    const auto block = readBlock(frame);
    const int which = block && block->stream < kMaxStreams ? trackOf_[block->stream] : -1;
    if (which < 0) {
        ++current_.foreign;
        return {};
    }
    const auto at = static_cast<std::size_t>(which);
    auto& track = tracks_[at];
    switch (track.take(*block)) {
        case StreamTrack::Verdict::Next:
            if (const auto seen = observe(StreamTrack::endOf(*block)); !seen) return seen;
            track.append(*block, fit_, blocks[at]);
            return {};
        case StreamTrack::Verdict::Late:
            if (track.lateInARow() < kMaxLate) return {};
            return fail(ErrorCode::Device, "it began again: {} blocks of its {} stream in a row count from anew",
                        track.lateInARow(), tacto::nameOf(track.configuration().kind));
        case StreamTrack::Verdict::Unsound:
            return {};
    }
    return {};
}

Result<void> SensorBoard::observe(std::uint64_t device_us) {
    if (const double early = fit_.early_s(device_us, link_.arrival()); early > kMaxJump_s) {
        return fail(ErrorCode::Device, "its clock jumped ahead by {:.3g} s; {} s at most were expected", early,
                    kMaxJump_s);
    }
    fit_.observe(device_us, link_.arrival(), link_.doubt());
    const auto& drift = fit_.report().drift_ppm;
    if (drift && !(std::abs(*drift) - *fit_.report().uncertainty_ppm <= kMaxDrift_ppm)) {
        return fail(ErrorCode::Device, "its clock runs {:+.2f} % wrong; ± {} % at most was expected", *drift * 1e-4,
                    kMaxDrift_ppm * 1e-4);
    }
    return {};
}

Result<void> SensorBoard::judgeNoise() {
    const auto& line = link_.counts();
    const Instant now = clock_.now();
    if (line.frames != soundFrames_ || line.bytes == bytesThen_) {
        soundFrames_ = line.frames;
        bytesThen_ = line.bytes;
        lastSound_ = now;
        return {};
    }
    const auto noise = line.bytes - bytesThen_;
    if (noise < kGarbageBytes || now - lastSound_ < toInstant(kGarbageTime)) return {};
    return fail(ErrorCode::Device, "it sends garbage: {} bytes without a sound frame in {:.2g} s", noise,
                toSeconds(now - lastSound_));
}

void SensorBoard::publish() noexcept {
    for (std::size_t i = 0; i < tracks_.size(); ++i) current_.streams[i] = tracks_[i].counts();
    current_.line = link_.counts();
    current_.dropped = link_.dropped();
    const auto& clock = fit_.report();
    current_.driftKnown = clock.drift_ppm.has_value();
    current_.drift_ppm = clock.drift_ppm.value_or(0);
    current_.driftUncertainty_ppm = clock.uncertainty_ppm.value_or(0);
    current_.driftSpan_s = clock.span_s;
    current_.clockSteps = clock.steps;
    report_.write(current_);
}

}  // namespace tacto
