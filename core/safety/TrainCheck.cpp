#include "core/safety/TrainCheck.h"

#include <cmath>
#include <fmt/format.h>

#include "core/base/Words.h"
#include "core/safety/Rules.h"

namespace tacto {

using namespace gate;

namespace {
bool sane(const std::optional<double>& value) noexcept { return !value || (std::isfinite(*value) && *value >= 0); }

/// A status and the train that it follows.
struct ReadTrain {
    OutputMode mode;
    const TrainReadBack& status;
    Instant end;
    Instant now;
    [[nodiscard]] bool late() const noexcept { return now - end > kStatusDeadline; }
    [[nodiscard]] bool early() const noexcept { return status.delivering || status.at < end; }
    /// Without a stated uncertainty, the reading is taken as exact.
    [[nodiscard]] double uncertainty() const noexcept { return status.imbalanceUncertainty.value_or(0); }
};

FixedText<159> percentText(const ReadTrain& train) noexcept {
    std::array<char, 160> text{};
    const auto end =
        fmt::format_to_n(text.data(), text.size() - 1,
                         "net charge is {:.2g} % of the phase charge, uncertainty {:.2g} %; a person allows 1 %",
                         train.status.imbalance.value_or(0) * 100, train.uncertainty() * 100);
    return std::string_view(text.data(), std::min(end.size, text.size() - 1));
}

struct FindingRule {
    int id;
    bool (*broken)(const ReadTrain&) noexcept;
    TrainFinding finding;
    FixedText<159> reason;  // replaced by a text with values if net charge is the finding
};

constexpr FixedText<159> kMissing = "no status from the stimulator within 50 ms after a train";

constexpr FindingRule kRulesWithoutStatus[] = {
    {TrainNoStatus, [](auto& t) noexcept { return t.late(); }, TrainFinding::StatusMissing, kMissing},
};

constexpr FindingRule kStatusRules[] = {
    {TrainGarbage, [](auto& t) noexcept { return !(sane(t.status.imbalance) && sane(t.status.imbalanceUncertainty)); },
     TrainFinding::Garbage, "the stimulator reads back a charge imbalance that is negative or not a number"},
    {TrainOpen, [](auto& t) noexcept { return t.status.electrode == ElectrodeReading::Open; }, TrainFinding::Open,
     "the electrode is open: it lifted, or its lead is off"},
    {TrainShort, [](auto& t) noexcept { return t.status.electrode == ElectrodeReading::Short; }, TrainFinding::Short,
     "the electrodes are shorted"},
    {TrainNetCharge,
     [](auto& t) noexcept {
         return t.mode == OutputMode::Person && t.status.imbalance &&
                !(*t.status.imbalance - t.uncertainty() <= kNetChargeLimit);
     },
     TrainFinding::NetCharge,
     {}},
    {TrainStuckOn, [](auto& t) noexcept { return t.late() && t.status.delivering; }, TrainFinding::StuckOn,
     "the stimulator still delivers 50 ms after its train should have ended"},
    {TrainStatusLate, [](auto& t) noexcept { return t.status.at - t.end > kStatusDeadline; },
     TrainFinding::StatusMissing, "the stimulator's status came later than 50 ms after a train"},
    // Read too early: wait for the next status, which must still come in time.
    {TrainNeverRead, [](auto& t) noexcept { return t.early() && t.late(); }, TrainFinding::StatusMissing, kMissing},
    {TrainReadEarly, [](auto& t) noexcept { return t.early(); }, TrainFinding::Pending, {}},
};

constexpr Word<TrainFinding> kTrainFindings[] = {
    {"pending", TrainFinding::Pending},      {"ok", TrainFinding::Ok},
    {"open electrode", TrainFinding::Open},  {"shorted electrode", TrainFinding::Short},
    {"net charge", TrainFinding::NetCharge}, {"status missing", TrainFinding::StatusMissing},
    {"stuck on", TrainFinding::StuckOn},     {"garbage", TrainFinding::Garbage}};
constexpr Word<ChargeBalance> kChargeBalances[] = {{"not evaluated", ChargeBalance::NotEvaluated},
                                                   {"green", ChargeBalance::Green},
                                                   {"amber", ChargeBalance::Amber},
                                                   {"red", ChargeBalance::Red}};
}  // namespace

std::string_view nameOf(TrainFinding finding) noexcept { return wordFor(kTrainFindings, finding); }

std::string_view nameOf(ChargeBalance balance) noexcept { return wordFor(kChargeBalances, balance); }

ChargeBalance chargeBalance(const std::optional<double>& imbalance, const std::optional<double>& uncertainty) noexcept {
    if (!imbalance || !uncertainty || !sane(imbalance) || !sane(uncertainty)) return ChargeBalance::NotEvaluated;
    if (!(*uncertainty <= kNetChargeUncertainty)) return ChargeBalance::NotEvaluated;
    if (*imbalance < 0.01) return ChargeBalance::Green;
    return *imbalance < 0.1 ? ChargeBalance::Amber : ChargeBalance::Red;
}

TrainJudgement judgeTrain(OutputMode mode, const std::optional<TrainReadBack>& status, Instant trainEnd,
                          Instant now) noexcept {
    const TrainReadBack read = status.value_or(TrainReadBack{});
    const ReadTrain train{mode, read, trainEnd, now};
    TrainJudgement judgement;
    if (status) {
        judgement.finding = TrainFinding::Ok;
        judgement.balance = chargeBalance(read.imbalance, read.imbalanceUncertainty);
    }
    if (const auto* rule = status ? firstBroken(kStatusRules, train) : firstBroken(kRulesWithoutStatus, train)) {
        judgement.finding = rule->finding;
        judgement.reason = rule->finding == TrainFinding::NetCharge ? percentText(train) : rule->reason;
    }
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
            return FaultCause::StuckOn;
        case TrainFinding::Garbage:
            return FaultCause::DeviceFault;
        case TrainFinding::Pending:
        case TrainFinding::Ok:
            break;
    }
    return FaultCause::Internal;
}

}  // namespace tacto
