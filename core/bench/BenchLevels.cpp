#include "core/bench/BenchLevels.h"

#include <algorithm>
#include <cmath>

#include "core/safety/DeliveryBounds.h"

namespace tacto {

namespace {

constexpr Milliamps kContinuousStep{0.1};  // of a source without a grid (choice)
constexpr Instant kAnswerTimeout = std::chrono::milliseconds(500);
constexpr Instant kLevelLook = std::chrono::milliseconds(1);

/// The first limit that forbids the train at that interval, by its name; empty when none does.
std::string forbiddenBy(const GateSetup& setup, const PulseTrain& train, Seconds interval) {
    for (const auto& row : exposureTable(setup, train, interval)) {
        if (row.action != LimitAction::Refuse || row.within) continue;
        return fmt::format("{} ({})", titleOf(row.quantity), row.set.view());
    }
    return {};
}

}  // namespace

Result<void> BenchLevels::checkPerson() const {
    if (config_.mode == OutputMode::Person && config_.person) return {};
    return fail(ErrorCode::NotArmed, "levels of a person are kept in person mode only, and this is {} mode",
                nameOf(config_.mode));
}

Result<PulseTrain> BenchLevels::trainAt(Milliamps level) const {
    return levelTrain(config_.profile.encoding, output_.source(), calibration_.applied(), level);
}

Milliamps BenchLevels::step() const noexcept {
    const double step = output_.source().amplitudeStep;
    return step > 0 ? Milliamps(step) : kContinuousStep;
}

Result<void> BenchLevels::checkSettable(const StimulusLevel& level) const {
    const bool isCurrent = std::holds_alternative<Milliamps>(level);
    if (isCurrent != (output_.stimulator() != nullptr) || !output_.isOpen()) {
        return fail(ErrorCode::Unsupported, "level at {} on {}: must be {}", textOf(level),
                    output_.device() != nullptr ? output_.device()->identity().name : "no output",
                    output_.massager() != nullptr ? "an intensity" : "a current");
    }
    if (!isCurrent) return {};
    // An empty one asks the same of the output.
    const Milliamps current = std::get<Milliamps>(level);
    const auto train = trainAt(isEmpty(level) ? step() : current);
    return train ? Result<void>{} : failure(train);
}

void BenchLevels::presented(const StimulusLevel& level, const Presented& ended) noexcept {
    presented_.reset();
    const auto* current = std::get_if<Milliamps>(&level);
    if (current != nullptr && !isEmpty(level) && !ended.isVoid()) presented_ = *current;
}

Result<void> BenchLevels::accept(Milliamps level) {
    if (auto person = checkPerson(); !person) return person;
    if (!presented_ || !(level == *presented_)) {
        return fail(ErrorCode::InvalidArgument, "{} mA accepted; {} is what can be accepted", level.value(),
                    presented_ ? textOf(*presented_) : "the level of a presentation that was complete and not empty");
    }
    const auto train = trainAt(level);
    if (!train) return failure(train);
    const auto ceiling = tell({.what = LevelRequest::What::Accept, .train = *train});
    if (!ceiling) return failure(ceiling);
    return notes_.level(row::kLevelAccepted, level, *ceiling);
}

Result<void> BenchLevels::reportDiscomfort(Milliamps level) {
    if (auto person = checkPerson(); !person) return person;
    if (!(std::isfinite(level.value()) && level.value() >= 0)) {
        return fail(ErrorCode::InvalidArgument, "{} mA too strong; a finite current of 0 or more is accepted",
                    level.value());
    }
    gate_.latchStop();  // nothing that was approved before comes after the word
    auto& limit = config_.person->discomfortLimit;
    limit = std::min(limit, level);
    const auto train = trainAt(step());
    if (!train) return failure(train);
    // A gate that was not configured for a person yet learns it from the limit when it is armed.
    const auto ceiling = tell({.what = LevelRequest::What::Discomfort, .train = *train, .uncomfortable = level});
    if (!ceiling && ceiling.error().code != ErrorCode::NotArmed) return failure(ceiling);
    return notes_.level(row::kLevelTooStrong, level, ceiling ? *ceiling : limit);
}

Result<void> BenchLevels::ascend(bool begin) {
    if (auto person = checkPerson(); !person) return person;
    const auto train = trainAt(step());
    if (!train) return failure(train);
    const auto what = begin ? LevelRequest::What::BeginAscending : LevelRequest::What::EndAscending;
    const auto told = tell({.what = what, .train = *train});
    return told ? Result<void>{} : failure(told);
}

Result<Milliamps> BenchLevels::ceiling() {
    if (auto person = checkPerson(); !person) return failure(person);
    const auto train = trainAt(step());
    if (!train) return failure(train);
    return tell({.what = LevelRequest::What::Ceiling, .train = *train});
}

/// Also after a stop or a fault: what a participant says counts at any time.
Result<Milliamps> BenchLevels::tell(const LevelRequest& request) {
    auto& desk = loop_->levels();
    desk.ask(request);
    const Instant until = time_.now() + kAnswerTimeout;
    std::optional<Result<Milliamps>> answer;
    while (!(answer = desk.answer()) && time_.now() < until) time_.pass(until, kLevelLook);
    if (answer) return *answer;
    return fail(ErrorCode::Device, "the control loop does not run: it has not heard of a level within 0.5 s");
}

/// The reason against a level, accepted or not; empty when there is none.
std::string BenchLevels::hindranceTo(Milliamps level, Seconds interval, const GateSetup& setup) const {
    const auto& person = *config_.person;
    if (!(level.value() <= output_.source().amplitudeMax)) return "the device's largest";
    if (person.cap && !(level <= *person.cap)) return "the study's cap";
    const auto train = trainAt(level);
    if (!train) return train.error().message;
    const double counts = siValue(DeliveryBounds(setup).levelOf(*train).amplitude) * 1e3;
    constexpr double kRounding = 1e-9;
    if (!(counts <= person.discomfortLimit.value() * (1 + kRounding))) return "what was too strong";
    const auto& lines = setup.calibration;
    if (lines && !(level.value() <= lines->amplitude.highest)) return "the range in which the stimulator is calibrated";
    return forbiddenBy(setup, *train, interval);
}

Result<PermittedLevel> BenchLevels::limit(Seconds interval) const {
    if (auto person = checkPerson(); !person) return failure(person);
    if (auto settable = checkSettable(Milliamps(0)); !settable) return failure(settable);
    if (!(interval.count() > 0 && interval <= Presentation::kLongest)) {
        return fail(ErrorCode::InvalidArgument, "an interval of {} s; above 0 to {} s is accepted", interval.count(),
                    Presentation::kLongest.count());
    }
    const double ohm = loop_->telemetry().impedance_ohm;
    if (!(ohm > 0)) return fail(ErrorCode::NotArmed, "no impedance is known, so no largest level; arm first");
    GateSetup setup = terms_.setupFor(Load::resistor(Ohms(ohm)));
    setup.load = LoadRange::measured(Ohms(ohm));
    const Seconds kept = programmedFor(interval, calibration_.applied());
    // Every hindrance stands against all higher levels too.
    int permitted = 0;
    int hindered = static_cast<int>(output_.source().amplitudeMax / step().value()) + 2;
    std::string by = "the device's largest";
    while (hindered - permitted > 1) {
        const int middle = permitted + (hindered - permitted) / 2;
        auto hindrance = hindranceTo(middle * step(), kept, setup);
        if (hindrance.empty()) {
            permitted = middle;
        } else {
            hindered = middle;
            by = std::move(hindrance);
        }
    }
    return PermittedLevel{permitted * step(), std::move(by)};
}

}  // namespace tacto
