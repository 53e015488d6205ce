#include "drivers/sensor_board/SensorBoard.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/Words.h"
#include "drivers/sensor_board/EncoderProfile.h"

namespace tacto {

using namespace sensorboard;

namespace {

constexpr int kPings = 16;

constexpr Word<StreamKind> kParts[] = {{"fingertip accelerometer", StreamKind::Acceleration},
                                       {"fingertip force", StreamKind::Force},
                                       {"taxel array", StreamKind::Taxels}};

}  // namespace

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
    encoded_.clear();
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
            } else if (takeEncoded(*frame)) {
                if (boardTime_) return {};
            } else if (frame->version != kVersion) {
                ++current_.foreign;
            }
        }
        // A board can send faster than its nominal line rate, but must not keep this loop running forever.
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
            track.append(
                *block, [this](double us) { return timeOf(us); }, blocks[at]);
            return {};
        case StreamTrack::Verdict::Late:
            if (track.lateInARow() < kMaxLate) return {};
            return fail(ErrorCode::Device,
                        "it began again: {} blocks of its {} stream in a row count from the start again",
                        track.lateInARow(), tacto::nameOf(track.configuration().kind));
        case StreamTrack::Verdict::Unsound:
            return {};
    }
    return {};
}

namespace {

EncodedFrame frameOf(const BoardReading& from, double t_s) {
    return {t_s, from.contact, from.sliding, from.slidingAssumed, from.h, from.v, from.R, from.pressure_pa, from.P};
}

EncodedTrain trainOf(const BoardTrain& from, double onset_s) {
    constexpr std::array kShapes{PulseShape::SymmetricBiphasic, PulseShape::AsymmetricBiphasic, PulseShape::Monophasic};
    EncodedTrain train{onset_s, Seconds(from.interval_s), Volts(from.command_v), from.amplitude, {}};
    train.form.shape = kShapes[from.shape];
    train.form.polarity = from.negative ? Polarity::Negative : Polarity::Positive;
    train.form.phaseWidth = Micros(from.width_us);
    train.form.interPhaseGap = Micros(from.gap_us);
    train.form.rechargeRatio = from.rechargeRatio;
    train.form.pulses = static_cast<int>(std::min<std::uint32_t>(from.pulses, std::numeric_limits<int>::max()));
    train.form.rate = Hertz(from.rate_hz);
    train.made_s = onset_s - from.ahead_us * 1e-6;
    return train;
}

}  // namespace

std::optional<double> SensorBoard::place(SequenceTrack& track, std::uint32_t sequence, std::uint64_t time_us) noexcept {
    const auto missing = track.take(sequence);
    const double t_s = timeOf(static_cast<double>(time_us));
    if (!missing || (!boardTime_ && !(std::abs(t_s - toSeconds(link_.arrival())) <= kEncodedWithin_s))) {
        ++current_.encodedLate;
        return std::nullopt;
    }
    current_.encodedLost += *missing;
    return t_s;
}

bool SensorBoard::takeEncoded(const Frame& frame) {
    const auto unused = [](std::uint64_t& count) {
        ++count;
        return true;
    };
    if (frame.is(Reply::Reading)) {
        const auto reading = readReading(frame);
        if (!reading || !encoder_) return unused(current_.foreign);
        if (const auto t_s = place(readings_, reading->sequence, reading->time_us))
            encoded_.frames.push_back(frameOf(*reading, *t_s));
        return true;
    }
    if (frame.is(Reply::Train)) {
        const auto train = readTrain(frame);
        if (!train || !encoder_) return unused(current_.foreign);
        const auto onset_s = place(trains_, train->sequence, train->onset_us);
        if (!onset_s) return true;
        if (!(*onset_s > lastOnset_s_)) return unused(current_.encodedLate);
        lastOnset_s_ = *onset_s;
        encoded_.trains.push_back(trainOf(*train, *onset_s));
        return true;
    }
    if (!frame.is(Reply::Silent)) return false;
    const auto silence = readSilence(frame);
    if (!silence || !encoder_) return unused(current_.foreign);
    if (const auto t_s = place(silences_, silence->sequence, silence->time_us))
        encoded_.silences.push_back({*t_s, std::string_view(silenceWords(silence->faults, silence->refusal)),
                                     silence->refusal != TE_ACCEPTED, (silence->faults & TE_FAULT_RESTING) != 0});
    return true;
}

std::uint64_t SensorBoard::lostOnTheWay() const noexcept {
    std::uint64_t lost = current_.encodedLost + current_.encodedLate + link_.dropped();
    for (const auto& track : tracks_) lost += track.counts().lostBlocks + track.counts().unsound;
    return lost;
}

Result<void> SensorBoard::observe(std::uint64_t device_us) {
    if (boardTime_) return {};
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
    return fail(ErrorCode::Device, "it sends garbage: {} bytes without a valid frame in {:.2g} s", noise,
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

using namespace sensorboard;

Result<std::unique_ptr<SensorBoard>> SensorBoard::open(std::unique_ptr<Transport> transport,
                                                       const SensorBoardSettings& settings, const Clock& clock) {
    std::unique_ptr<SensorBoard> board(new SensorBoard(std::move(transport), clock));
    auto ready = board->identify(settings);
    if (ready) ready = board->measureDelay();
    if (ready) ready = board->askToEncode(settings.encodes);
    if (ready) {
        // Even without an acknowledgement the board may have heard START.
        board->began_ = true;
        ready = board->link_.order(Command::Start);
    }
    if (!ready) {
        return fail(ready.error().code, "sensor board \"{}\": {}", settings.uri, ready.error().message);
    }
    board->link_.listen();
    board->lastSound_ = clock.now();
    board->soundFrames_ = board->link_.counts().frames;
    board->bytesThen_ = board->link_.counts().bytes;
    board->publish();
    return board;
}

Result<void> SensorBoard::identify(const SensorBoardSettings& settings) {
    const auto answer = link_.ask(Command::Hello, Reply::Identity);
    if (!answer) return failure(answer);
    const auto who = readIdentity(*answer);
    if (!who) return fail(ErrorCode::Device, "{}", who.error().message);
    if (kEncoderVersion < who->lowestVersion || kVersion > who->highestVersion) {
        return fail(ErrorCode::Unsupported,
                    "it speaks versions {} to {} of the sensor board protocol; version {} or {} was expected",
                    who->lowestVersion, who->highestVersion, static_cast<int>(kVersion),
                    static_cast<int>(kEncoderVersion));
    }
    highestVersion_ = who->highestVersion;
    if (!settings.serial.empty() && settings.serial != who->serial) {
        return fail(ErrorCode::NotFound, "its serial number is \"{}\"; \"{}\" was expected", who->serial,
                    settings.serial);
    }
    if (settings.emulated && !who->serial.starts_with(kEmulatedSerial)) {
        return fail(ErrorCode::Device,
                    "its serial number is \"{}\", and the address says emulated=yes; that of an emulated board begins "
                    "with {}",
                    who->serial, kEmulatedSerial);
    }
    identity_ = {settings.uri, Role::Sensor,  who->name.empty() ? "sensor board" : who->name,
                 who->serial,  who->firmware, settings.emulated};
    // First stops a board that another program left running: configurations are set while it is silent.
    if (const auto stopped = link_.order(Command::Stop); !stopped) return stopped;
    return configure(settings, who->streams);
}

Result<void> SensorBoard::configure(const SensorBoardSettings& settings, std::size_t streams) {
    for (std::size_t i = 0; i < streams; ++i) {
        const std::array<std::uint8_t, 1> which{static_cast<std::uint8_t>(i)};
        const auto answer = link_.ask(Command::GetConfiguration, Reply::Configuration, which);
        if (!answer) return failure(answer);
        auto now = readConfiguration(*answer);
        if (!now) return fail(ErrorCode::Device, "{}", now.error().message);
        if (now->stream != i) {
            return fail(ErrorCode::Device, "it describes stream {} when asked for {}", now->stream, i);
        }
        if (!now->enabled) continue;
        const auto same = [&](const StreamInfo& info) { return info.kind == now->kind; };
        if (std::ranges::any_of(infos_, same)) {
            return fail(ErrorCode::Device, "it has two {} streams enabled; one was expected", tacto::nameOf(now->kind));
        }
        const double rate = now->kind == StreamKind::Acceleration ? settings.accelerationRate_hz : settings.slowRate_hz;
        if (rate != 0 && rate != now->rate_hz()) {
            now = setRate(*now, rate);
            if (!now) return failure(now);
        }
        const auto calibration = link_.ask(Command::GetCalibration, Reply::Calibration, which);
        if (!calibration) return failure(calibration);
        auto known = readCalibration(*calibration);
        if (!known) return fail(ErrorCode::Device, "{}", known.error().message);
        if (known->stream != i || known->uncertainty.size() != now->columns.size()) {
            return fail(ErrorCode::Device,
                        "it gives the calibration of {} columns of stream {}; {} of stream {} were "
                        "expected",
                        known->uncertainty.size(), known->stream, now->columns.size(), i);
        }
        trackOf_[i] = static_cast<int>(tracks_.size());
        infos_.push_back({now->kind, now->unit, now->columns.size(), now->rate_hz(),
                          std::string(wordFor(kParts, now->kind, "stream"))});
        calibrations_.push_back(std::move(*known));
        tracks_.emplace_back(std::move(*now));
    }
    if (infos_.empty()) {
        return fail(ErrorCode::Unsupported, "none of its {} streams is enabled; at least one was expected", streams);
    }
    return {};
}

Result<StreamConfiguration> SensorBoard::setRate(StreamConfiguration now, double rate_hz) {
    if (!(rate_hz >= 1 && rate_hz <= 1e6)) {
        return fail(ErrorCode::InvalidArgument, "a rate of {} Hz for its {} stream; 1 Hz to 1 MHz was expected",
                    rate_hz, tacto::nameOf(now.kind));
    }
    now.rate_mhz = static_cast<std::uint32_t>(std::llround(rate_hz * 1000));
    const auto payload = configurationPayload(now);
    const auto answer = link_.ask(Command::SetConfiguration, Reply::Configuration, payload);
    if (!answer) {
        return fail(answer.error().code, "its {} stream cannot have {} Hz: {}", tacto::nameOf(now.kind), rate_hz,
                    answer.error().message);
    }
    auto set = readConfiguration(*answer);
    if (!set) return fail(ErrorCode::Device, "{}", set.error().message);
    if (set->stream != now.stream || set->rate_mhz != now.rate_mhz || set->columns.size() != now.columns.size()) {
        return fail(ErrorCode::Device, "its {} stream was set to {} Hz and answers {} Hz", tacto::nameOf(now.kind),
                    rate_hz, set->rate_hz());
    }
    return set;
}

Result<void> SensorBoard::askToEncode(Encodes wanted) {
    const bool able = highestVersion_ >= kEncoderVersion;
    if (wanted == Encodes::No) {
        // Another program may have left it encoding. A board without an encoder refuses this, which is as good.
        if (able) static_cast<void>(link_.ask(Command::SetEncoder, Reply::Encoder, std::array<std::uint8_t, 1>{0}));
        return {};
    }
    if (!able) {
        return fail(ErrorCode::Unsupported,
                    "it speaks version {} of the sensor board protocol and does not encode; version {} was expected",
                    highestVersion_, static_cast<int>(kEncoderVersion));
    }
    const auto answer = link_.ask(Command::SetEncoder, Reply::Encoder, std::array<std::uint8_t, 1>{1});
    if (!answer) return failure(answer);
    const auto state = readEncoder(*answer);
    if (!state) return fail(ErrorCode::Device, "{}", state.error().message);
    if (state->layout != TE_LAYOUT) {
        return fail(ErrorCode::Unsupported, "its encoder has profiles of layout {}; {} was expected", state->layout,
                    TE_LAYOUT);
    }
    if (state->refusal != TE_ACCEPTED || !state->encodes) {
        return fail(ErrorCode::Device, "its encoder does not begin: {}",
                    state->refusal == TE_ACCEPTED ? std::string("it stays off, and gives no reason")
                    : state->refusal <= TE_METER
                        ? fmt::format("the profile in it has {}{}", wordsOf(static_cast<te_refusal>(state->refusal)),
                                      state->refusal == TE_BAD_STREAM
                                          ? ", with the rates and channels that the board's sensors have now"
                                          : "")
                        : fmt::format("it gives reason {}, which is not known here", state->refusal));
    }
    encoder_ = BoardEncoder{wanted == Encodes::Drives, state->hash};
    return {};
}

Result<void> SensorBoard::measureDelay() {
    current_.delayMost_s = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kPings; ++i) {
        const auto answer = link_.ask(Command::GetStatus, Reply::Status);
        if (!answer) return failure(answer);
        const auto status = readStatus(*answer);
        if (!status) return fail(ErrorCode::Device, "{}", status.error().message);
        fit_.observe(status->time_us, link_.arrival());
        // The board wrote its time between question and answer (Cristian, Distributed Computing 3, 1989).
        current_.delayMost_s = std::min(current_.delayMost_s, toSeconds(link_.arrival() - link_.sent()));
        current_.board = *status;
    }
    fit_.settle();
    return {};
}

}  // namespace tacto
