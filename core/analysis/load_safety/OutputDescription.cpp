#include "core/analysis/load_safety/OutputDescription.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "core/analysis/load_safety/LoadSafetyRows.h"
#include "core/base/QuantityText.h"
#include "core/base/Words.h"
#include "core/encoding/PulseTrain.h"
#include "core/results/ResultRecord.h"

namespace tacto {

namespace {

const LoadRecord* measuredRecord(const LoadSafetyInput& input) {
    const LoadRecord* first = nullptr;
    for (const auto& record : input.loads) {
        if (record.steps.empty()) continue;
        if (record.load == Load::resistor(Ohms(500))) return &record;
        if (first == nullptr) first = &record;
    }
    return first;
}

std::string textOf(const Reading& reading, const char* unit, double factor = 1) {
    if (!std::isfinite(reading.value)) return "not evaluated";
    return measuredText(factor * reading.value, factor * reading.expanded, unit);
}

constexpr Word<PulseShape> kWaveforms[] = {
    {"trains of biphasic pulses, phases alike", PulseShape::SymmetricBiphasic},
    {"trains of biphasic pulses, recharge phase longer and lower", PulseShape::AsymmetricBiphasic},
    {"trains of monophasic pulses", PulseShape::Monophasic}};

std::string symmetryOf(const PulseTrain& train) {
    if (train.shape == PulseShape::Monophasic) return "one phase only";
    if (train.shape == PulseShape::SymmetricBiphasic) return "equal amplitude and width, opposite polarity";
    return fmt::format("recharge phase at 1/{:g} of the amplitude, {:g} times the width", train.rechargeRatio,
                       train.rechargeRatio);
}

std::string netChargeOf(const LoadSafetyInput& input) {
    if (input.train.shape == PulseShape::Monophasic) return "it is not zero: bench loads only";
    return fmt::format("the second phase returns the charge of the first; {} between the phases and after the pulse",
                       input.source.gap == GapState::HoldsZero ? "0 V is held" : "the output is open");
}

std::string perSecond(double value) { return fmt::format("{:.4g} per second", value); }

}  // namespace

std::vector<DescribedOutput> describeOutput(const LoadSafetyInput& input) {
    const PulseTrain& train = input.train;
    const auto* record = measuredRecord(input);
    const LoadReading most = record != nullptr ? strongestOf(*record) : LoadReading{};
    const double interval = input.interval_s;
    const double output = train.outputDuration().count();
    const double driving = train.pulses * (train.pulseDuration() - Seconds(train.interPhaseGap)).count();
    std::vector<DescribedOutput> out{
        {"waveform", std::string(wordFor(kWaveforms, train.shape)), {}},
        {"shape",
         fmt::format("rectangular, {} source, leading phase {}", nameOf(input.source.drive),
                     train.polarity == Polarity::Positive ? "positive" : "negative"),
         {}},
        {"phase width", scaledText(Seconds(train.phaseWidth).count(), "s", 3), textOf(most.width_s, "s")},
        {"inter-phase gap", scaledText(Seconds(train.interPhaseGap).count(), "s", 3), {}},
        {"largest frequency of trains", perSecond(1 / interval),
         std::isfinite(most.interval_s.value) ? "interval " + textOf(most.interval_s, "s") : "not evaluated"},
        {"pulses per train",
         train.pulses == 1 ? std::string("1")
                           : fmt::format("{} at {}", train.pulses, scaledText(train.rate.value(), "Hz", 3)),
         train.pulses == 1 ? std::string() : "at " + textOf(most.rate_hz, "Hz")},
        {"symmetry of the phases", symmetryOf(train),
         train.shape == PulseShape::Monophasic ? std::string()
                                               : "net charge " + textOf(most.imbalance, "%", 100) + " of a phase's"},
        {"how net charge comes to zero", netChargeOf(input),
         train.shape == PulseShape::Monophasic ? std::string() : textOf(most.net_charge_uc, "uC")},
        {"burst duty",
         fmt::format("{} of output in every {}: {}", scaledText(driving, "s", 3), scaledText(interval, "s", 3),
                     scaledText(100 * driving / interval, "%", 2)),
         {}},
        {"on and off time",
         fmt::format("on {}, off {}, as long as there is contact; no other cycle", scaledText(output, "s", 3),
                     scaledText(interval - output, "s", 4)),
         {}},
    };
    return out;
}

namespace {

using namespace describe;

ResultRecord<DescribedOutput> describeDescribed() {
    using D = DescribedOutput;
    ResultRecord<D> all;
    all.shown(as(As::Heading, "Output", "output"), &D::output);
    all.shown(text("Commanded", "commanded"), &D::commanded);
    all.shown(text("Measured", "measured"), nullIfEmpty(&D::measured));
    return all;
}

}  // namespace

nlohmann::json toJson(const DescribedOutput& output) { return builtOnce<describeDescribed>().write(output); }

std::vector<ResultColumn> outputColumns() { return builtOnce<describeDescribed>().columns(); }

}  // namespace tacto
