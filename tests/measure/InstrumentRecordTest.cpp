// Records as instruments write them: levels between two codes of a coarse converter, edges in the middle of a record,
// single wrong samples, pulses cut by the ends. Drawn from a seed, so the truth is known.
#include <gtest/gtest.h>

#include "core/measure/ConverterStep.h"
#include "core/measure/PulseMeasurement.h"
#include "tests/measure/SyntheticPulses.h"

namespace tacto::test {
namespace {

/// Writes codes like an instrument that states no resolution: as decimal text with `digits` digits below the step.
void writeCodes(CaptureChannel& channel, double step, double phase, int digits = 2) {
    const double unit = std::pow(10, std::floor(std::log10(step)) - digits);
    for (float& x : channel.samples) {
        const double code = step * std::round(static_cast<double>(x) / step + phase);
        x = static_cast<float>(unit * std::round(code / unit));
    }
    channel.lsb = 0;
}

bool says(const ChannelMeasurement& m, std::string_view part) {
    return std::any_of(m.warnings.begin(), m.warnings.end(),
                       [&](const std::string& warning) { return warning.find(part) != std::string::npos; });
}

TEST(ConverterStep, IsFoundInNoiseOfAFractionOfAStepAndOfMany) {
    RecordProperty("hazard", "H9");
    for (unsigned seed = 1; seed <= 60; ++seed) {
        Random random(seed, "converter step");
        const double step = std::pow(10, -3 + 5 * random.uniform());
        const double noise = step * std::pow(10, -0.5 + random.uniform());
        auto capture = recordOf(biphasic(1e-3, step * (20 + 100 * random.uniform())),
                                {.rate_hz = 1e6, .samples = 3000, .noise = noise, .seed = seed});
        writeCodes(capture.channels[0], step, random.uniform(), 1);
        EXPECT_NEAR(converterStep(capture.channels[0].samples), step, 0.05 * step) << seed << ": " << noise / step;
    }
}

TEST(ConverterStep, IsNotMadeUpWhereSamplesShowNone) {
    RecordProperty("hazard", "H9");
    std::vector<float> logic, clean;
    for (int i = 0; i < 2000; ++i) logic.push_back(i % 40 < 10 ? 3.3F : 0.0F);
    EXPECT_EQ(converterStep(logic), 0);
    const auto edges = recordOf(biphasic(1e-3), {});
    EXPECT_EQ(converterStep(edges.channels[0].samples), 0) << "a few samples on an edge do not make a grid";
    const auto fine = recordOf(biphasic(1e-3), {.noise = 0.1});
    EXPECT_EQ(converterStep(fine.channels[0].samples), 0) << "floating-point noise lies on no grid";
    EXPECT_EQ(converterStep({}), 0);
    EXPECT_EQ(converterStep(std::vector<float>(100, 1.0F)), 0);
}

TEST(InstrumentRecords, AStateBetweenTwoCodesIsOneState) {
    RecordProperty("hazard", "H9");
    for (unsigned seed = 1; seed <= 120; ++seed) {
        Random random(seed, "between codes");
        const double codes = 8 + 60 * random.uniform();
        const double step = 40 / codes;
        std::vector<SyntheticPhase> phases;
        for (int k = 0; k < 3; ++k) append(phases, biphasic((1 + 2 * k) * 1e-3 + 1e-6 * random.uniform()));
        if (seed % 3 == 0) {
            phases = {phases[0], phases[2], phases[4]};
        }
        // The baseline is so near the border of two codes that both occur, each in 30 to 70 % of the samples.
        const double noise = step * (0.1 + 0.3 * random.uniform());
        const double offset = step * (static_cast<double>(random.below(9)) + 0.5) + noise * (random.uniform() - 0.5);
        auto capture =
            recordOf(phases, {.rate_hz = 500e3, .samples = 4000, .offset = offset, .noise = noise, .seed = seed});
        writeCodes(capture.channels[0], step, 0);
        const auto m = measureChannel(capture, 0);
        ASSERT_EQ(m.measuredPulses, 3U) << seed << ": " << codes << " codes; " << m.states.why;
        EXPECT_NEAR(m.quality.foundStep, step, 0.05 * step) << seed;
        EXPECT_NEAR(m.amplitude.mean, 40, step) << seed;
        EXPECT_NEAR(m.width_s.mean, 200e-6, 2e-6) << seed;
        EXPECT_TRUE(std::isfinite(m.uncertainty.amplitude)) << seed;
    }
}

TEST(InstrumentRecords, ACleanPulseIsReadWhereverItBegins) {
    RecordProperty("hazard", "H9");
    for (int sample = 1400; sample < 1600; ++sample) {
        for (const double width_s : {sample % 2 == 0 ? 200e-6 : 300e-6}) {
            const auto capture = recordOf(biphasic((sample + 0.5) / 10e6, 40, width_s, 100e-6, 1e-7),
                                          {.rate_hz = 10e6, .samples = 10'000, .lsb = 0.05});
            const auto m = measureChannel(capture, 0);
            ASSERT_EQ(m.measuredPulses, 1U) << sample;
            EXPECT_NEAR(m.amplitude.mean, 40, 0.05) << sample;
            EXPECT_NEAR(m.gap_s.mean, 100e-6, 1e-7) << sample;
            EXPECT_EQ(m.quality.drift, 0) << sample;
        }
    }
}

TEST(InstrumentRecords, OneEdgeIsNoPulseWhereverItIs) {
    RecordProperty("hazard", "H9");
    for (const std::size_t samples : {1000U, 2000U, 2500U, 10'000U}) {
        for (int off = -4; off <= 4; ++off) {
            for (unsigned seed = 1; seed <= 4; ++seed) {
                const double rate_hz = 4e3;
                const double at_s = (0.5 * static_cast<double>(samples) + off) / rate_hz;
                const auto capture = recordOf({{at_s, 1e3, seed % 2 == 0 ? 15.0 : -15.0, 1e-5}},
                                              {.rate_hz = rate_hz, .samples = samples, .offset = -8.5, .noise = 0.1});
                const auto m = measureChannel(capture, 0);
                EXPECT_EQ(m.measuredPulses, 0U) << samples << " " << off;
                EXPECT_EQ(m.quality.drift, 0) << samples << " " << off;
                EXPECT_TRUE(says(m, "cut off by the record's ends")) << samples << " " << off;
            }
        }
    }
}

TEST(InstrumentRecords, SingleSamplesThatLeapAreLeftOutAndCounted) {
    RecordProperty("hazard", "H9");
    for (unsigned seed = 1; seed <= 60; ++seed) {
        Random random(seed, "leaping samples");
        auto capture = recordOf(biphasic(1e-3), {.rate_hz = 1e6, .samples = 5000, .noise = 0.1, .lsb = 0.05});
        auto& samples = capture.channels[0].samples;
        // The leaps are on plateaus and in the silence, because on an edge a leap looks like the edge.
        for (const std::size_t at : {300U, 1030U, 1100U, 1400U, 3000U}) {
            const double leap = (2 + 90 * random.uniform()) * (random.below(2) == 0 ? 1 : -1);
            samples[at + random.below(60)] += static_cast<float>(leap);
        }
        const auto m = measureChannel(capture, 0);
        ASSERT_EQ(m.measuredPulses, 1U) << seed;
        EXPECT_EQ(m.quality.leaps, 5U) << seed;
        EXPECT_TRUE(says(m, "far from both neighbours")) << seed;
        EXPECT_NEAR(m.amplitude.mean, 40, 0.06) << seed;
        EXPECT_NEAR(m.width_s.mean, 200e-6, 0.2e-6) << seed;
    }
}

TEST(InstrumentRecords, AShortPulseTrainIsNoLeap) {
    Capture capture;
    capture.rate_hz = 1e6;
    capture.channels.push_back({"voltage", "V", {}});
    for (int i = 0; i < 1000; ++i) capture.channels[0].samples.push_back(i % 20 == 0 ? 5.0F : 0.0F);
    const auto m = measureChannel(capture, 0);
    EXPECT_EQ(m.quality.leaps, 0U) << "one sample in twenty is the signal";
    EXPECT_EQ(m.measuredPulses, 0U);
    EXPECT_FALSE(m.warnings.empty());
}

TEST(InstrumentRecords, TheSecondPhaseOfACutPulseIsNotTakenForAPulse) {
    RecordProperty("hazard", "H9");
    for (unsigned seed = 1; seed <= 40; ++seed) {
        Random random(seed, "cut");
        const double begin_s = 1e-3 + 200e-6 * random.uniform();  // the record begins within the leading phase
        const auto begins = recordOf(biphasic(1e-3), {.rate_hz = 1e6, .start_s = begin_s, .samples = 3000});
        EXPECT_EQ(measureChannel(begins, 0).measuredPulses, 0U) << seed;
        // The record ends within the second phase.
        const double length_s = 1e-3 + 310e-6 + 180e-6 * random.uniform();
        const auto samples = static_cast<std::size_t>(length_s * 1e6);
        const auto ends = recordOf(biphasic(1e-3), {.rate_hz = 1e6, .samples = samples});
        const auto m = measureChannel(ends, 0);
        EXPECT_EQ(m.measuredPulses, 0U) << seed;
        EXPECT_TRUE(says(m, "cut off")) << seed;
    }
}

TEST(InstrumentRecords, ABaselineThatMovesTooMuchIsRefusedByName) {
    RecordProperty("hazard", "H9");
    std::vector<SyntheticPhase> phases;
    for (int k = 0; k < 6; ++k) append(phases, biphasic((1 + 3 * k) * 1e-3));
    const auto capture = recordOf(phases, {.rate_hz = 500e3, .samples = 10'000, .noise = 0.1, .hum = 5, .hum_hz = 400});
    const auto m = measureChannel(capture, 0);
    EXPECT_EQ(m.measuredPulses, 0U);
    EXPECT_TRUE(says(m, "moves")) << (m.warnings.empty() ? "" : m.warnings.front());
}

TEST(InstrumentRecords, ASlowSignalOfAFewStepsHasNoPulses) {
    RecordProperty("hazard", "H9");
    for (unsigned seed = 1; seed <= 60; ++seed) {
        Random random(seed, "few steps");
        // Two to four isolated values may also be a signal with that many levels, unless a step is stated.
        const bool stated = seed % 3 == 0;
        const double steps = (stated ? 0.5 : 3) + 4 * random.uniform();
        auto capture = recordOf({}, {.rate_hz = 100e3,
                                     .samples = 4000,
                                     .noise = seed % 2 == 0 ? 0 : 0.08 * random.uniform(),
                                     .seed = seed,
                                     .hum = steps,
                                     .hum_hz = 25 + 200 * random.uniform()});
        writeCodes(capture.channels[0], 1, random.uniform());
        if (stated) capture.channels[0].lsb = 1;
        const auto m = measureChannel(capture, 0);
        EXPECT_EQ(m.measuredPulses, 0U) << seed << ": hum of " << steps << " steps";
        EXPECT_FALSE(m.warnings.empty()) << seed;
    }
}

}  // namespace
}  // namespace tacto::test
