#include "app/run/EncoderComparison.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "core/bench/delivery/TrainPlanner.h"
#include "core/bench/sensing/FingerInput.h"
#include "core/devices/EncoderLoader.h"
#include "core/devices/EncodingSensor.h"
#include "core/dsp/SampleHistory.h"

namespace tacto {

namespace {

constexpr double kTrainsApart_s = 0.025;                    // half the shortest interval of the board
constexpr Instant kMissed = std::chrono::milliseconds(20);  // a board asks every 5 ms, and may be slow
constexpr double kFramesApart_s = 3e-6;                     // a board's stamps are whole microseconds
constexpr double kUnheard_s = 0.1;                          // what may still be on its way when the comparison ends
constexpr double kRest_s = 8.1;                             // of a board that was switched on, and a turn of its loop

te_stream streamOf(StreamKind kind) noexcept {
    return kind == StreamKind::Acceleration ? TE_ACCELERATION : kind == StreamKind::Force ? TE_FORCE : TE_TAXEL_ARRAY;
}

/// The sensor without what its maker stated of rest and contact.
class Undeclared final : public TactileSensor {
public:
    explicit Undeclared(TactileSensor& sensor) : sensor_(sensor) {}
    [[nodiscard]] const DeviceIdentity& identity() const noexcept override { return sensor_.identity(); }
    [[nodiscard]] std::span<const StreamInfo> streams() const noexcept override { return sensor_.streams(); }
    [[nodiscard]] Result<void> read(std::span<SampleBlock> blocks) override { return sensor_.read(blocks); }

private:
    TactileSensor& sensor_;
};

double level(const PulseTrain& train) {
    return std::visit([](auto amplitude) { return amplitude.value(); }, train.amplitude);
}

/// The C99 code, here.
class OwnEncoder {
public:
    explicit OwnEncoder(const te_profile& profile) : state_(std::make_unique<te_state>()) {
        (void)te_init(state_.get(), &profile);  // encoderProfile() has seen that it is accepted
        te_rested(state_.get());
    }

    void feed(std::span<const StreamInfo> streams, std::span<const SampleBlock> blocks) {
        for (std::size_t s = 0; s < blocks.size(); ++s) {
            const auto channels = streams[s].channels;
            std::vector<float> values(channels);
            for (std::size_t i = 0; i < blocks[s].samples(); ++i) {
                for (std::size_t c = 0; c < channels; ++c)
                    values[c] = static_cast<float>(blocks[s].values[i * channels + c]);
                te_samples(state_.get(), streamOf(streams[s].kind), toInstant(blocks[s].t_s[i]).count(), 0,
                           values.data(), 1);
            }
        }
        te_reading frame{};
        while (te_frame(state_.get(), &frame) != 0) {
            made_.frames.push_back({toSeconds(Instant(frame.t_ns)), frame.contact != 0, frame.sliding != 0, frame.h,
                                    frame.v, frame.R, frame.pressure_pa, frame.P});
        }
    }

    void drive(Instant now) {
        const auto refused = state_->trains_refused;
        te_train train{};
        if (te_next_train(state_.get(), now.count(), &train) != 0)
            made_.trains.push_back({toSeconds(Instant(train.onset_ns)), train.amplitude});
        if (state_->trains_refused != refused) made_.refused_s.push_back(toSeconds(now));
    }

    [[nodiscard]] const EncoderSide& made() const noexcept { return made_; }

private:
    std::unique_ptr<te_state> state_;
    EncoderSide made_;
};

void note(EncoderAgreement& found, std::string sentence) {
    found.refusedAlike = false;
    if (found.unlike.empty()) found.unlike = std::move(sentence);
}

constexpr std::string_view kBench = "the bench";

/// What kept the board's trains back then, in words that follow a sentence.
std::string silenceOf(const EncoderSide& board, double t_s) {
    const EncodedSilence* last = nullptr;
    for (const auto& silence : board.silences)
        if (silence.t_s <= t_s + kTrainsApart_s) last = &silence;
    return last != nullptr && !last->why.empty() ? fmt::format("; the board is silent: {}", last->why.view()) : "";
}

/// Calls `both` for what lies within `apart` of each other in two rows in order of time, `alone` for the rest.
template <class Row, class Time, class Both, class Alone>
void pairUp(const Row& bench, const Row& board, double apart, Time time, Both both, Alone alone) {
    std::size_t i = 0, k = 0;
    while (i < bench.size() || k < board.size()) {
        const double a = i < bench.size() ? time(bench[i]) : kInfinity_s;
        const double b = k < board.size() ? time(board[k]) : kInfinity_s;
        if (std::abs(a - b) <= apart)
            both(bench[i++], board[k++]);
        else if (a < b)
            alone(time(bench[i++]), kBench);
        else
            alone(time(board[k++]), "the board");
    }
}

void compareFrames(const RoughnessFrame& bench, const RoughnessFrame& board, EncoderAgreement& found) {
    ++found.frames;
    if (bench.contact != board.contact) note(found, fmt::format("one side alone has contact at {:.3f} s", bench.t_s));
    for (const auto& [name, value] : {std::pair{"R", &RoughnessFrame::R}, std::pair{"P", &RoughnessFrame::P},
                                      std::pair{"h", &RoughnessFrame::h}, std::pair{"v", &RoughnessFrame::v}}) {
        if (std::isnan(bench.*value) != std::isnan(board.*value))
            note(found, fmt::format("one side alone has {} at {:.3f} s", name, bench.t_s));
    }
    // A value that is not a number leaves them as they are.
    found.maxR = std::fmax(found.maxR, std::abs(bench.R - board.R));
    found.maxP = std::fmax(found.maxP, std::abs(bench.P - board.P));
}

}  // namespace

bool EncoderAgreement::holds() const noexcept {
    return refusedAlike && maxR <= acceptedR && maxP <= acceptedP && maxOnset_s <= acceptedOnset_s &&
           (maxAmplitude <= acceptedAmplitude || (maxAmplitudeSteps > 0 && maxAmplitudeSteps <= 1 + 1e-6));
}

EncoderAgreement agreementOf(const EncoderSide& bench, const EncoderSide& board, double amplitudeStep) {
    EncoderAgreement found;
    const auto alone = [&](const char* what) {
        return [&, what](double t_s, std::string_view who) {
            note(found, fmt::format("{} alone {} at {:.3f} s{}", who, what, t_s,
                                    who == kBench ? silenceOf(board, t_s) : std::string()));
        };
    };
    pairUp(
        bench.frames, board.frames, kFramesApart_s, [](const auto& frame) { return frame.t_s; },
        [&](const auto& ours, const auto& theirs) { compareFrames(ours, theirs, found); }, alone("has a frame"));
    pairUp(
        bench.trains, board.trains, kTrainsApart_s, [](const auto& train) { return train.onset_s; },
        [&](const auto& ours, const auto& theirs) {
            ++found.trains;
            const double apart = std::abs(ours.amplitude - theirs.amplitude);
            found.maxOnset_s = std::max(found.maxOnset_s, std::abs(ours.onset_s - theirs.onset_s));
            found.maxAmplitude = std::max(found.maxAmplitude, apart / ours.amplitude);
            if (amplitudeStep > 0) found.maxAmplitudeSteps = std::max(found.maxAmplitudeSteps, apart / amplitudeStep);
        },
        alone("has a train"));
    pairUp(
        bench.refused_s, board.refused_s, kTrainsApart_s, [](double t_s) { return t_s; }, [](double, double) {},
        alone("refuses a train"));
    return found;
}

EncoderOutput idealOutput() {
    EncoderOutput output;
    output.source.accuracy = StatedAccuracy::exact();
    output.source.amplitudeMax = 60;
    output.source.compliance = Volts(60);
    output.source.widthStep = Micros(0);
    output.source.widthMin = Micros(1);
    output.load = LoadRange::declared(Load::resistor(Ohms(1000)));
    return output;
}

struct EncoderComparison::State {
    State(TactileSensor& finger, EncodingSensor* board, const Clock& at, const EncoderOutput& out,
          const EncodingProfile& encoding, const te_profile& profile)
        : sensor(finger),
          clock(at),
          gate(board != nullptr ? boards : at),
          planner(encoding, out.source, gate),
          own(profile),
          board(board),
          load(out.load.nominal.series),
          step(out.source.amplitudeStep) {}

    Result<void> takeSamples(Instant now) {
        session->serve(now);
        if (session->failed()) return fail(ErrorCode::Device, "{}", session->error().view());
        finger->update();
        bench.frames.insert(bench.frames.end(), finger->frames().begin(), finger->frames().end());
        return {};
    }

    /// Has the bench want its next train, and returns when that is due.
    std::optional<Instant> want(Instant now) {
        const auto& frame = finger->latest();
        if (rests || finger->standing(toSeconds(now)) != FingerStanding::Fresh || !frame.contact ||
            std::isnan(frame.R)) {
            planner.wantNothing();
            return std::nullopt;
        }
        const auto pressure = std::isnan(frame.P) ? std::nullopt : std::optional(frame.P);
        if (!planner.want(frame.R, pressure, now)) return std::nullopt;
        return planner.due();
    }

    void driveBench(Instant now) {
        const auto due = want(now);
        if (!due || !(*due < now + ControlLoop::kPeriod)) return;
        planner.armedOn(load);
        if (const auto planned = planner.plan(now, load))
            bench.trains.push_back({toSeconds(planned->onset), level(planned->approved.train())});
        else
            bench.refused_s.push_back(toSeconds(now));
    }

    /// Has the bench make its trains when the board's encoder was asked for one.
    void driveWith(double asked_s) {
        const Instant asked = toInstant(Seconds(asked_s));
        boards.advanceTo(asked);
        driveBench(asked);
    }

    /// Goes on to a time at which the board made something. What it should have made before is missing there.
    void reach(double t_s) {
        const Instant now = toInstant(Seconds(t_s));
        if (now <= reached) return;
        reached = now;
        if (const auto due = planner.due(); due && *due + kMissed < now) driveWith(toSeconds(*due));
        static_cast<void>(want(now));
    }

    void take(const EncodedSilence& silence) {
        if (sent.silences.empty()) restsUntil_s = silence.t_s + kRest_s;
        rests = silence.rests && silence.t_s < restsUntil_s;
        reach(silence.t_s);
        driveWith(silence.t_s);
        sent.silences.push_back(silence);
        if (silence.refused) sent.refused_s.push_back(silence.t_s);
    }

    void take(const EncodedTrain& train) {
        rests = false;
        reach(train.made_s);
        driveWith(train.made_s);
        sent.trains.push_back({train.onset_s, train.amplitude});
    }

    /// Follows the board message by message, in its own time, so that the bench has what the board had at each.
    Result<void> followBoard() {
        for (bool more = true; more;) {
            if (auto taken = takeSamples(clock.now()); !taken) return taken;
            const auto& said = board->encoded();
            more = !said.frames.empty() || !said.trains.empty() || !said.silences.empty();
            for (const auto& block : finger->blocks()) {
                if (block.samples() == 0) continue;
                more = true;
                reach(block.t_s.back());
            }
            for (const auto& f : said.frames)
                sent.frames.push_back({f.t_s, f.contact, f.sliding, f.h, f.v, f.R, f.pressure_pa, f.P});
            for (const auto& silence : said.silences) take(silence);
            for (const auto& train : said.trains) take(train);
        }
        return {};
    }

    Undeclared sensor;
    const Clock& clock;
    VirtualClock boards;  // the time of a board that encodes
    SafetyGate gate;
    TrainPlanner planner;
    std::unique_ptr<SensorSession> session;
    std::unique_ptr<FingerInput> finger;
    EncoderSide bench;
    OwnEncoder own;
    EncodingSensor* const board;  // null: the encoder here takes its place
    EncoderSide sent;             // by the board
    Instant reached{0};           // by the board's clock
    bool rests = false;           // the board does, after it was switched on
    double restsUntil_s = 0;
    const Ohms load;
    const double step;
    Instant drives{0};  // when both sides here are next asked for trains
};

EncoderComparison::EncoderComparison(std::unique_ptr<State> state) : state_(std::move(state)) {}
EncoderComparison::~EncoderComparison() = default;

Result<std::unique_ptr<EncoderComparison>> EncoderComparison::create(TactileSensor& sensor, const Profile& profile,
                                                                     const EncoderOutput& output,
                                                                     const std::vector<LimitSet>& limits,
                                                                     const Clock& clock) {
    const auto encoder =
        encoderProfile(sensor.streams(), profile.roughness, profile.encoding, output, sensor.identity().serial);
    if (!encoder) return failure(encoder);
    if (auto* loader = dynamic_cast<EncoderLoader*>(&sensor); loader != nullptr && loader->wantsProfile()) {
        if (const auto loaded = loader->load(profileBytes(*encoder), true); !loaded) return failure(loaded);
    }
    auto* board = dynamic_cast<EncodingSensor*>(&sensor);
    if (board != nullptr && !board->encoder()) board = nullptr;
    if (board != nullptr && board->encoder()->hash != encoder->hash) {
        return fail(ErrorCode::Unsupported,
                    "the profile in the encoder of {} has the hash {:08x}; {:08x}, of \"{}\" for a {} source of up to "
                    "{:g} {} into {:g} ohm, was expected",
                    sensor.identity().name, board->encoder()->hash, encoder->hash, profile.name,
                    output.source.drive == Drive::Current ? "current" : "voltage", output.source.amplitudeMax,
                    amplitudeUnit(output.source.drive), output.load.nominal.series.value());
    }
    if (board != nullptr) board->keepBoardTime();
    auto state = std::make_unique<State>(sensor, board, clock, output, profile.encoding, *encoder);
    GateSetup setup;
    setup.source = output.source;
    setup.load = output.load;
    setup.limits = limits;
    setup.ceilings = output.ceilings;
    setup.electrodeArea = profile.electrodeArea;
    setup.check = profile.encoding.train;
    if (const auto configured = state->gate.configure(setup); !configured) return failure(configured);
    auto session = SensorSession::create(state->sensor);
    if (!session) return failure(session);
    state->session = std::move(*session);
    auto finger = FingerInput::create(*state->session, profile.roughness);
    if (!finger) return failure(finger);
    state->finger = std::move(*finger);
    return std::unique_ptr<EncoderComparison>(new EncoderComparison(std::move(state)));
}

Result<void> EncoderComparison::turn() {
    auto& s = *state_;
    if (s.board != nullptr) return s.followBoard();
    const Instant now = s.clock.now();
    if (auto taken = s.takeSamples(now); !taken) return taken;
    s.own.feed(s.sensor.streams(), s.finger->blocks());
    if (now < s.drives) return {};
    s.drives = now + ControlLoop::kPeriod;
    s.driveBench(now);
    s.own.drive(now);
    return {};
}

const EncoderSide& EncoderComparison::bench() const noexcept { return state_->bench; }
const EncoderSide& EncoderComparison::board() const noexcept {
    return state_->board != nullptr ? state_->sent : state_->own.made();
}

EncoderAgreement EncoderComparison::agreement() const {
    EncoderSide ours = bench();
    if (state_->board != nullptr && !ours.frames.empty()) {
        const double heard_s = board().frames.empty() ? -kInfinity_s : board().frames.back().t_s;
        const double end_s = std::max(heard_s, ours.frames.back().t_s - kUnheard_s) + kFramesApart_s;
        std::erase_if(ours.frames, [=](const auto& frame) { return frame.t_s > end_s; });
    }
    auto found = agreementOf(ours, board(), state_->step);
    found.acceptedOnset_s = 1e-3;
    for (const auto& info : state_->sensor.streams())
        if (info.kind == StreamKind::Acceleration) found.acceptedOnset_s = 1 / info.rate_hz;
    if (state_->board != nullptr) found.lost = state_->board->lostOnTheWay();
    return found;
}

}  // namespace tacto
