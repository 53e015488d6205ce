#include "tests/firmware/BoardAndHost.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>

#include "core/acquisition/StreamHealth.h"
#include "core/dsp/SampleHistory.h"
#include "core/encoding/TrainSeries.h"

namespace tacto::test {

namespace {

constexpr double kStep_s = 0.005;  // of the control loop, which also plans trains this far ahead
constexpr double kFrameDelay_s = 0.078;

te_stream streamOf(StreamKind kind) {
    return kind == StreamKind::Acceleration ? TE_ACCELERATION : kind == StreamKind::Force ? TE_FORCE : TE_TAXEL_ARRAY;
}

std::int64_t nanoseconds(double t_s) { return std::llround(t_s * 1e9); }

/// The bench's chain and series, driven as ControlLoop and FingerInput drive them.
class Host {
public:
    Host(const Samples& samples, const RoughnessSettings& roughness, const EncodingProfile& encoding)
        : streams_(samples.streams),
          chain_(RoughnessChain::create(samples.streams, roughness).value()),
          series_(encoding) {
        for (const auto& info : streams_) {
            health_.emplace_back(info.rate_hz);
            still_.emplace_back(info.channels, info.kind == StreamKind::Acceleration);
        }
    }

    void feed(std::span<const SampleBlock> blocks, Side& to) {
        for (std::size_t s = 0; s < blocks.size(); ++s) {
            health_[s].feed(blocks[s], streams_[s].channels);
            still_[s].feed(blocks[s]);
            for (std::size_t i = 0; i < blocks[s].values.size(); ++i) {
                if (!(std::abs(blocks[s].values[i]) <= mostPlausible(streams_[s].unit)))
                    implausible_ = std::max(implausible_, blocks[s].t_s[i / streams_[s].channels]);
            }
        }
        chain_->feed(blocks, to.frames);
        if (!to.frames.empty()) latest_ = to.frames.back();
    }

    void drive(double now_s, Side& to) {
        const Instant now(nanoseconds(now_s));
        if (!fresh(now_s) || !latest_.contact || std::isnan(latest_.R)) return series_.wantNothing();
        const auto pressure = std::isnan(latest_.P) ? std::nullopt : std::optional(latest_.P);
        series_.want(series_.encoder().encode(latest_.R, pressure).value(), now);
        if (!(*series_.due() < now + toInstant(kStep_s))) return;
        const Instant onset = std::max(*series_.due(), now);
        const Command command = series_.begin(onset);
        series_.delivered();
        to.trains.push_back({toSeconds(onset), command.amplitude.value(), command.interval.count()});
    }

private:
    [[nodiscard]] bool fresh(double now_s) const {
        const auto current = [&](double age, double more) {
            return age <= StreamHealth::kStale_s + more && age >= -StreamHealth::kStale_s;
        };
        if (std::abs(now_s - implausible_) <= StreamHealth::kStale_s) return false;
        if (std::ranges::any_of(health_, [&](const auto& one) { return !current(one.age_s(now_s), 0); })) return false;
        bool all = true;
        for (std::size_t s = 0; s < still_.size(); ++s) {
            const bool moves = streams_[s].kind == StreamKind::Acceleration;
            const bool array = streams_[s].kind == StreamKind::Taxels && streams_[s].channels >= 4 && latest_.contact;
            if (still_[s].since() && moves) return false;
            if (still_[s].repeatsSince() && (moves || array)) return false;
            all = all && still_[s].since();
        }
        return !all && current(now_s - latest_.t_s, kFrameDelay_s);
    }

    std::vector<StreamInfo> streams_;
    std::unique_ptr<RoughnessChain> chain_;
    TrainSeries series_;
    std::vector<StreamHealth> health_;
    std::vector<Standstill> still_;
    RoughnessFrame latest_;
    double implausible_ = -1e9;
};

class Board {
public:
    explicit Board(const te_profile& profile) : state_(std::make_unique<te_state>()) {
        EXPECT_EQ(te_init(state_.get(), &profile), TE_ACCEPTED);
        te_rested(state_.get());
    }

    void feed(std::span<const StreamInfo> streams, std::span<const SampleBlock> blocks, Side& to) {
        for (std::size_t s = 0; s < blocks.size(); ++s) {
            const auto channels = streams[s].channels;
            std::vector<float> values(channels);
            for (std::size_t i = 0; i < blocks[s].samples(); ++i) {
                for (std::size_t c = 0; c < channels; ++c)
                    values[c] = static_cast<float>(blocks[s].values[i * channels + c]);
                EXPECT_EQ(te_samples(state_.get(), streamOf(streams[s].kind), nanoseconds(blocks[s].t_s[i]), 0,
                                     values.data(), 1),
                          1U);
            }
        }
        te_reading frame{};
        while (te_frame(state_.get(), &frame) != 0) {
            to.frames.push_back({static_cast<double>(frame.t_ns) * 1e-9, frame.contact != 0, frame.sliding != 0,
                                 frame.h, frame.v, frame.R, frame.pressure_pa, frame.P});
        }
    }

    void drive(double now_s, Side& to) {
        te_train train{};
        if (te_next_train(state_.get(), nanoseconds(now_s), &train) == 0) return;
        to.trains.push_back({static_cast<double>(train.onset_ns) * 1e-9, train.amplitude, train.interval_s});
    }

    [[nodiscard]] const te_state& state() const { return *state_; }

private:
    std::unique_ptr<te_state> state_;
};

/// Moves the samples up to `until_s` into `next`, in order; a stamp that steps back is not waited for.
void take(const Samples& from, std::vector<std::size_t>& taken, double until_s, std::vector<SampleBlock>& next) {
    for (std::size_t s = 0; s < from.blocks.size(); ++s) {
        const auto& block = from.blocks[s];
        const auto channels = from.streams[s].channels;
        next[s].clear();
        for (; taken[s] < block.samples() && !(block.t_s[taken[s]] > until_s); ++taken[s]) {
            next[s].t_s.push_back(block.t_s[taken[s]]);
            const auto* row = block.values.data() + taken[s] * channels;
            next[s].values.insert(next[s].values.end(), row, row + channels);
        }
    }
}

void expectAlike(const RoughnessFrame& host, const RoughnessFrame& board, Comparison& found) {
    ASSERT_NEAR(host.t_s, board.t_s, 2e-6);
    ASSERT_EQ(host.contact, board.contact);
    ASSERT_EQ(std::isnan(host.R), std::isnan(board.R)) << "R is " << host.R << " and " << board.R;
    ASSERT_EQ(std::isnan(host.P), std::isnan(board.P)) << "P is " << host.P << " and " << board.P;
    ASSERT_EQ(std::isnan(host.h), std::isnan(board.h)) << "h is " << host.h << " and " << board.h;
    ASSERT_EQ(std::isnan(host.v), std::isnan(board.v)) << "v is " << host.v << " and " << board.v;
    if (!std::isnan(host.R)) found.maxR = std::max(found.maxR, std::abs(host.R - board.R));
    if (!std::isnan(host.P)) found.maxP = std::max(found.maxP, std::abs(host.P - board.P));
}

}  // namespace

EncoderOutput idealOutput() {
    EncoderOutput output;
    output.source.accuracy = StatedAccuracy::exact();
    output.source.amplitudeMax = 60;
    output.load = LoadRange::declared(Load::resistor(Ohms(1000)));
    return output;
}

Comparison compare(const Samples& samples, const RoughnessSettings& roughness, const EncodingProfile& encoding,
                   const std::string& what) {
    SCOPED_TRACE(what);
    Comparison found;
    const auto profile = encoderProfile(samples.streams, roughness, encoding, idealOutput());
    EXPECT_TRUE(profile) << profile.error().message;
    if (!profile) return found;
    Host host(samples, roughness, encoding);
    Board board(*profile);
    double begin = kInfinity_s, end = -kInfinity_s;
    for (const auto& block : samples.blocks) {
        begin = std::min(begin, block.t_s.front());
        end = std::max(end, block.t_s.back());
    }
    std::vector<std::size_t> taken(samples.blocks.size());
    std::vector<SampleBlock> next(samples.blocks.size());
    for (double now = begin; now < end + kStep_s; now += kStep_s) {
        take(samples, taken, now, next);
        host.feed(next, found.host);
        board.feed(samples.streams, next, found.board);
        host.drive(now, found.host);
        board.drive(now, found.board);
    }
    EXPECT_EQ(board.state().trains_refused, 0U) << wordsOf(static_cast<te_refusal>(board.state().refusal));
    EXPECT_EQ(board.state().windows_lost, 0U);
    EXPECT_EQ(found.host.frames.size(), found.board.frames.size());
    const auto frames = std::min(found.host.frames.size(), found.board.frames.size());
    for (std::size_t i = 0; i < frames && !testing::Test::HasFatalFailure(); ++i) {
        SCOPED_TRACE(fmt::format("frame {} at {} s", i, found.host.frames[i].t_s));
        expectAlike(found.host.frames[i], found.board.frames[i], found);
    }
    EXPECT_EQ(found.host.trains.size(), found.board.trains.size());
    const auto trains = std::min(found.host.trains.size(), found.board.trains.size());
    for (std::size_t i = 0; i < trains; ++i) {
        const auto &ours = found.host.trains[i], &theirs = found.board.trains[i];
        found.maxOnset_s = std::max(found.maxOnset_s, std::abs(ours.onset_s - theirs.onset_s));
        found.maxAmplitude = std::max(found.maxAmplitude, std::abs(ours.amplitude_V / theirs.amplitude_V - 1));
    }
    return found;
}

}  // namespace tacto::test
