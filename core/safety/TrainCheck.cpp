#include "core/safety/TrainCheck.h"

#include <cmath>
#include <fmt/format.h>

#include "core/safety/GateChecks.h"

namespace tacto {

using namespace gate;

namespace {
FixedText<159> percentText(double imbalance, double uncertainty) noexcept {
    std::array<char, 160> text{};
    const auto end =
        fmt::format_to_n(text.data(), text.size() - 1,
                         "net charge is {:.2g} % of the phase charge, uncertainty {:.2g} %; a person allows 1 %",
                         imbalance * 100, uncertainty * 100);
    return std::string_view(text.data(), std::min(end.size, text.size() - 1));
}

bool sane(const std::optional<double>& value) noexcept { return !value || (std::isfinite(*value) && *value >= 0); }
}  // namespace

std::string_view nameOf(TrainFinding finding) noexcept {
    switch (finding) {
        case TrainFinding::Pending:
            return "pending";
        case TrainFinding::Ok:
            return "ok";
        case TrainFinding::Open:
            return "open electrode";
        case TrainFinding::Short:
            return "shorted electrode";
        case TrainFinding::NetCharge:
            return "net charge";
        case TrainFinding::StatusMissing:
            return "status missing";
        case TrainFinding::StuckOn:
            return "stuck on";
        case TrainFinding::Garbage:
            return "garbage";
    }
    return "unknown";
}

std::string_view nameOf(ChargeBalance balance) noexcept {
    switch (balance) {
        case ChargeBalance::NotEvaluated:
            return "not evaluated";
        case ChargeBalance::Green:
            return "green";
        case ChargeBalance::Amber:
            return "amber";
        case ChargeBalance::Red:
            return "red";
    }
    return "unknown";
}

ChargeBalance chargeBalance(const std::optional<double>& imbalance, const std::optional<double>& uncertainty) noexcept {
    if (!imbalance || !uncertainty || !sane(imbalance) || !sane(uncertainty)) return ChargeBalance::NotEvaluated;
    if (!(*uncertainty <= kNetChargeUncertainty)) return ChargeBalance::NotEvaluated;
    if (*imbalance < 0.01) return ChargeBalance::Green;
    return *imbalance < 0.1 ? ChargeBalance::Amber : ChargeBalance::Red;
}

TrainJudgement judgeTrain(OutputMode mode, const std::optional<TrainReadBack>& status, Instant trainEnd,
                          Instant now) noexcept {
    TrainJudgement judgement;
    const auto found = [&judgement](TrainFinding finding, FixedText<159> reason) {
        judgement.finding = finding;
        judgement.reason = reason;
        return judgement;
    };
    const bool late = now - trainEnd > kStatusDeadline;
    if (!status) {
        return late && checks(TrainNoStatus)
                   ? found(TrainFinding::StatusMissing, "no status from the stimulator within 50 ms after a train")
                   : judgement;
    }
    if (checks(TrainGarbage) && !(sane(status->imbalance) && sane(status->imbalanceUncertainty))) {
        return found(TrainFinding::Garbage,
                     "the stimulator reads back a charge imbalance that is no number or negative");
    }
    judgement.balance = chargeBalance(status->imbalance, status->imbalanceUncertainty);
    if (checks(TrainOpen) && status->electrode == ElectrodeReading::Open) {
        return found(TrainFinding::Open, "the electrode is open: it lifted, or its lead is off");
    }
    if (checks(TrainShort) && status->electrode == ElectrodeReading::Short) {
        return found(TrainFinding::Short, "the electrodes are shorted");
    }
    if (checks(TrainNetCharge) && mode == OutputMode::Person && status->imbalance) {
        // Without a stated uncertainty nothing excuses the reading.
        const double uncertainty = status->imbalanceUncertainty.value_or(0);
        if (!(*status->imbalance - uncertainty <= kNetChargeLimit)) {
            return found(TrainFinding::NetCharge, percentText(*status->imbalance, uncertainty));
        }
    }
    if (checks(TrainStuckOn) && late && status->delivering) {
        return found(TrainFinding::StuckOn, "the stimulator still delivers 50 ms after its train should have ended");
    }
    if (checks(TrainStatusLate) && status->at - trainEnd > kStatusDeadline) {
        return found(TrainFinding::StatusMissing, "the stimulator's status came later than 50 ms after a train");
    }
    if (checks(TrainReadEarly) && (status->delivering || status->at < trainEnd)) {
        // Read too early: wait for a newer one, but not for ever.
        if (!late) return judgement;
        return found(TrainFinding::StatusMissing, "no status from the stimulator within 50 ms after a train");
    }
    judgement.finding = TrainFinding::Ok;
    return judgement;
}

FaultCause causeOf(TrainFinding finding) noexcept {
    switch (finding) {
        case TrainFinding::Open:
            return FaultCause::OpenElectrode;
        case TrainFinding::Short:
            return FaultCause::ShortElectrode;
        case TrainFinding::NetCharge:
            return FaultCause::NetCharge;
        case TrainFinding::StatusMissing:
            return FaultCause::StatusMissing;
        case TrainFinding::StuckOn:
        case TrainFinding::Garbage:
            return FaultCause::DeviceFault;
        case TrainFinding::Pending:
        case TrainFinding::Ok:
            break;
    }
    return FaultCause::Internal;
}

}  // namespace tacto
