// A whole bench with an emulated P24 and an oscilloscope on its load. The time of a record decides which command it
// belongs to, even if a check pulse precedes a train closely (H12), and a wrong train is found in the records (H3).
#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "core/bench/Bench.h"
#include "tests/drivers/sciencemode/EmulatedLine.h"
#include "tests/support/Limits.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

constexpr double kOhm = 1000;

/// An oscilloscope that shows the emulated stimulator's output on a resistor.
class ScopeOnLine final : public Oscilloscope {
public:
    ScopeOnLine(const Clock& clock, EmulatedLine& line, double gain, double stampTolerance_s)
        : clock_(clock), line_(line), gain_(gain), stampTolerance_s_(stampTolerance_s) {}
    const DeviceIdentity& identity() const noexcept override { return identity_; }
    const ScopeTraits& traits() const noexcept override { return traits_; }
    Result<void> configure(const ScopeSettings& settings) override {
        settings_ = settings;
        return {};
    }
    Result<void> arm() override {
        from_s_ = toSeconds(clock_.now());
        armed_ = true;
        return {};
    }
    void disarm() noexcept override { armed_ = false; }
    Result<std::optional<Capture>> poll() override {
        if (!armed_) return std::optional<Capture>();
        const auto pulses = line_.pulseList();
        const double length_s = static_cast<double>(settings_.samples) / settings_.sampleRate.value();
        for (const auto& pulse : pulses) {
            const double trigger_s = toSeconds(pulse.onset);
            const double volts = gain_ * 1e-3 * kOhm * std::abs(pulse.points.items[0].current.value());
            const double end_s = trigger_s + (1 - settings_.preTrigger) * length_s;
            if (trigger_s < from_s_ || volts < settings_.triggerLevel) continue;
            if (end_s > toSeconds(clock_.now())) break;
            from_s_ = end_s;
            return std::optional(record(pulses, trigger_s, length_s));
        }
        return std::optional<Capture>();
    }

private:
    Capture record(const std::vector<sciencemode::EmittedPulse>& pulses, double trigger_s, double length_s) {
        Capture capture;
        capture.rate_hz = settings_.sampleRate.value();
        capture.trigger_s = trigger_s;
        capture.start_s = trigger_s - settings_.preTrigger * length_s;
        capture.stampTolerance_s = stampTolerance_s_;
        capture.simulated = true;
        std::vector<double> level(settings_.samples);
        for (const auto& pulse : pulses) {
            double begin_s = toSeconds(pulse.onset);
            for (const auto& point : pulse.points.span()) {
                const double end_s = begin_s + Seconds(point.time).count();
                const auto at = [&](double t_s) {
                    const double index = std::ceil((t_s - capture.start_s) * capture.rate_hz);
                    return static_cast<std::size_t>(std::clamp(index, 0.0, static_cast<double>(level.size())));
                };
                for (auto i = at(begin_s); i < at(end_s); ++i) level[i] = gain_ * point.current.value() * 1e-3;
                begin_s = end_s;
            }
        }
        for (const bool current : {false, true}) {
            const double range = current ? settings_.currentRange.value() * 1e-3 : settings_.voltageRange.value();
            CaptureChannel channel{
                current ? "current" : "voltage", current ? "A" : "V", {}, -range, range, 2 * range / 4096};
            channel.gainTolerance = channel.offsetTolerance = channel.probeTolerance = 0;
            std::normal_distribution<double> noise(0, channel.lsb);
            for (const double amps : level) {
                const double value = std::clamp((current ? 1 : kOhm) * amps + noise(draw_), -range, range);
                channel.samples.push_back(static_cast<float>(std::round(value / channel.lsb) * channel.lsb));
            }
            capture.channels.push_back(std::move(channel));
        }
        return capture;
    }

    const Clock& clock_;
    EmulatedLine& line_;
    const double gain_, stampTolerance_s_;
    DeviceIdentity identity_{"scope:", Role::Oscilloscope, "Oscilloscope on the line", "", "", true};
    ScopeTraits traits_{Hertz(10e6), 1'000'000, 12, Hertz(20e6)};
    ScopeSettings settings_;
    std::mt19937 draw_{5};
    double from_s_ = 0;
    bool armed_ = false;
};

class ScopedScienceMode : public testing::Test {
protected:
    void open(double gain, double stampTolerance_s) {
        bench_.reset();
        clock_ = std::make_shared<VirtualClock>();
        line_ = std::make_shared<EmulatedLine>(*clock_, clock_.get());
        sciencemode::StimulatorSettings settings;
        settings.emulated = true;
        auto opened = accepted(sciencemode::ScienceModeStimulator::open(line_->connector(), "sciencemode:?emulated=yes",
                                                                        {}, settings, *clock_));
        BenchConfig config;
        config.devices.stimulator = std::move(opened);
        config.devices.oscilloscope = std::make_unique<ScopeOnLine>(*clock_, *line_, gain, stampTolerance_s);
        config.clock = clock_;
        config.profile = profile_;
        config.limits = limitSets();
        bench_ = accepted(Bench::create(std::move(config)));
        accepted(bench_->arm(ArmRequest{"1 kohm", true, true}));
    }
    [[nodiscard]] double between(double low, double high) { return std::uniform_real_distribution(low, high)(draw_); }
    [[nodiscard]] std::string reason() const { return bench_->telemetry().reason.c_str(); }

    Profile profile_;
    std::mt19937 draw_{12};
    std::shared_ptr<VirtualClock> clock_;
    std::shared_ptr<EmulatedLine> line_;
    std::unique_ptr<Bench> bench_;
};

TEST_F(ScopedScienceMode, ACheckPulseAtAnyTimeBesideATrainIsNotTakenForIt) {
    RecordProperty("hazard", "H12");
    int checks = 0, trains = 0, neither = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const double stamps[] = {0, 0.002, std::nan("")};
        ASSERT_NO_FATAL_FAILURE(open(1, stamps[trial % 3]));
        ScopeSettings settings;
        settings.samples = std::uniform_int_distribution<std::size_t>(4000, 60'000)(draw_);
        settings.preTrigger = between(0, 1);
        settings.triggerLevel = 0.3;
        ASSERT_TRUE(bench_->requestCaptures(64, settings));
        ASSERT_TRUE(bench_->wait(Seconds(4.9 + 4.1 * trial / 60)));
        ASSERT_TRUE(bench_->drive(DriveSource::Manual, between(0, 1), 0.9));
        const auto waited = bench_->wait(Seconds(between(0.3, 1.5)));
        ASSERT_TRUE(waited) << trial << ": " << reason();
        const auto captures = accepted(bench_->takeCaptures());
        for (const auto& capture : captures) {
            if (std::isnan(capture.programmed)) {
                ++neither;
                continue;
            }
            const auto& volts = capture.channels[0].samples;
            const double peak = *std::max_element(volts.begin(), volts.end());
            EXPECT_NEAR(peak, capture.programmed * 1e-3 * kOhm, 0.3) << trial;
            ++(capture.programmed < 1 ? checks : trains);
        }
    }
    EXPECT_GT(trains, 20);
    EXPECT_GT(checks + neither, 10);
}

TEST_F(ScopedScienceMode, WhatTheOscilloscopeShowsOfAWrongTrainIsFound) {
    RecordProperty("hazard", "H3");
    for (const double gain : {0.5, 0.7, 1.3, 1.6}) {
        ASSERT_NO_FATAL_FAILURE(open(gain, 0));
        ScopeSettings settings;
        settings.triggerLevel = 0.1;
        settings.voltageRange = Volts(100);
        ASSERT_TRUE(bench_->requestCaptures(64, settings));
        ASSERT_TRUE(bench_->drive(DriveSource::Manual, 0.5, 0.9));
        const auto waited = bench_->wait(Seconds(4));
        EXPECT_FALSE(waited) << gain;
        EXPECT_THAT(reason(), testing::HasSubstr("the oscilloscope shows")) << gain;
    }
}

}  // namespace
}  // namespace tacto::test
