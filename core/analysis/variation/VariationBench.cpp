#include "core/analysis/variation/VariationBench.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/statistics/GivenFigure.h"
#include "core/base/JustNoticeable.h"
#include "core/base/Random.h"

namespace tacto {

namespace {

Result<void> check(const BenchTolerances& tolerances) {
    return checkFigures({{"the stimulator's gain tolerance", tolerances.stimulatorGain, {.low = 0, .high = 0.5}},
                         {"the stimulator's offset in V", tolerances.stimulatorOffset.value(), {.low = 0, .high = 1e3}},
                         {"the load's tolerance", tolerances.load, {.low = 0, .high = 0.5}},
                         {"the oscilloscope's gain tolerance", tolerances.scopeGain, {.low = 0, .high = 0.5}},
                         {"the oscilloscope's offset tolerance", tolerances.scopeOffset, {.low = 0, .high = 0.5}},
                         {"the clocks' tolerance", tolerances.clock, {.low = 0, .high = 0.5}},
                         {"the jitter in us", tolerances.jitter.count(), {.low = 0, .high = 1e6}}});
}

}  // namespace

Estimate spreadOf(std::vector<double> values) {
    std::erase_if(values, [](double value) { return std::isnan(value); });
    if (values.empty()) return {};
    std::ranges::sort(values);
    const auto quantile = [&values](double q) {
        const double at = q * static_cast<double>(values.size() - 1);
        const auto below = static_cast<std::size_t>(at);
        const std::size_t above = std::min(below + 1, values.size() - 1);
        return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
    };
    return {quantile(0.5), quantile(0.05), quantile(0.95)};
}

Result<BenchVariation> predictBench(const EncodingProfile& encoding, Drive drive, const BenchTolerances& tolerances,
                                    std::size_t draws, std::uint64_t seed) {
    if (auto valid = validate(encoding); !valid) return failure(valid);
    if (auto valid = check(tolerances); !valid) return failure(valid);
    if (auto valid = checkFigures({givenCount("the number of draws of a bench", draws, 100, 1e6)}); !valid)
        return failure(valid);
    std::vector<Command> commands;
    const Encoder encoder(encoding);
    for (const auto& condition : encoding.conditions) {
        auto command = encoder.encode(condition.R, condition.P);
        if (!command) return failure(command);
        commands.push_back(*command);
    }
    Random random(seed, "uncertain bench");
    const auto within = [&random](double halfWidth) { return halfWidth * (2 * random.uniform() - 1); };
    std::vector amplitudes(commands.size(), std::vector<double>());
    std::vector intervals(commands.size(), std::vector<double>());
    for (std::size_t draw = 0; draw < draws; ++draw) {
        const double gain = 1 + within(tolerances.stimulatorGain);
        const double offset = within(tolerances.stimulatorOffset.value());
        const double load = 1 + within(tolerances.load);
        const double scope = 1 + within(tolerances.scopeGain);
        const double scopeOffset = within(tolerances.scopeOffset);
        const double clock = 1 + within(tolerances.clock);
        for (std::size_t i = 0; i < commands.size(); ++i) {
            const double wanted = commands[i].amplitude.value();
            const double atLoad = (gain * wanted + offset) * (drive == Drive::Current ? load : 1);
            amplitudes[i].push_back(scope * atLoad + scopeOffset * 2 * wanted);
            intervals[i].push_back(clock * commands[i].interval.count() + within(tolerances.jitter.count() / 1e6));
        }
    }
    BenchVariation out;
    out.draws = draws;
    for (std::size_t a = 0; a < commands.size(); ++a) {
        out.conditions.push_back({encoding.conditions[a].name, spreadOf(amplitudes[a]), spreadOf(intervals[a])});
        for (std::size_t b = a + 1; b < commands.size(); ++b) {
            std::vector<double> amplitude, interval;
            for (std::size_t draw = 0; draw < draws; ++draw) {
                amplitude.push_back(
                    justNoticeableDifferences(amplitudes[a][draw], amplitudes[b][draw], kAmplitudeWeberFraction));
                interval.push_back(
                    justNoticeableDifferences(intervals[a][draw], intervals[b][draw], kIntervalWeberFraction));
            }
            out.pairs.push_back({encoding.conditions[a].name, encoding.conditions[b].name,
                                 spreadOf(std::move(amplitude)), spreadOf(std::move(interval))});
        }
    }
    return out;
}

}  // namespace tacto
