#include "core/bench/arming/BenchLevels.h"

#include <algorithm>
#include <cmath>

#include "core/safety/DeliveryBounds.h"

namespace tacto {

namespace {

constexpr Milliamps kContinuousStep{0.1};  // the step for a source without a grid (choice)
constexpr Instant kAnswerTimeout = std::chrono::milliseconds(500);
constexpr Instant kLevelPoll = std::chrono::milliseconds(1);

}  // namespace

Result<void> BenchLevels::checkPerson() const {
    if (config_.mode == OutputMode::Person && config_.person) return {};
    return fail(ErrorCode::NotArmed, "levels of a person are kept in person mode only, and this is {} mode",
                nameOf(config_.mode));
}

Result<PulseTrain> BenchLevels::trainAt(Milliamps level) const {
    return levelTrain(config_.profile.encoding, output_.source(), calibration_.applied(), level);
}

StimulusLevel BenchLevels::none() const noexcept {
    if (takesIntensities()) return VibrationIntensity{0};
    return Milliamps(0);
}

Milliamps BenchLevels::step() const noexcept {
    const double step = output_.source().amplitudeStep;
    return step > 0 ? Milliamps(step) : kContinuousStep;
}

Result<void> BenchLevels::checkKind(const StimulusLevel& level) const {
    if (output_.isOpen() && std::holds_alternative<VibrationIntensity>(level) == takesIntensities()) return {};
    return fail(ErrorCode::Unsupported, "a presentation at {} on {}; {} is accepted", textOf(level),
                output_.device() != nullptr ? output_.device()->identity().name : "no output",
                takesIntensities() ? "an intensity" : "a current");
}

Result<void> BenchLevels::checkSettable(const StimulusLevel& level) const {
    if (auto fits = checkKind(level); !fits) return fits;
    const auto* current = std::get_if<Milliamps>(&level);
    if (current == nullptr) return {};
    // An empty level needs the same kind of output, so one step is checked instead.
    const auto train = trainAt(isEmpty(level) ? step() : *current);
    return train ? Result<void>{} : failure(train);
}

void BenchLevels::presented(const StimulusLevel& level, const Presented& ended) noexcept {
    presented_.reset();
    if (!isEmpty(level) && !ended.isVoid()) presented_ = level;
}

/// Makes a request; for a stimulator it includes a train of the study's kind.
Result<LevelRequest> BenchLevels::requestFor(LevelRequest::What what, const StimulusLevel& level) const {
    LevelRequest request{.what = what, .train = {}, .level = level};
    if (takesIntensities()) return request;
    const auto* current = std::get_if<Milliamps>(&level);
    const auto train = trainAt(what == LevelRequest::What::Accept && current != nullptr ? *current : step());
    if (!train) return failure(train);
    request.train = *train;
    return request;
}

Result<void> BenchLevels::accept(const StimulusLevel& level) {
    if (auto person = checkPerson(); !person) return person;
    if (!presented_ || !(level == *presented_)) {
        return invalid(
            "{} accepted; {} is what can be accepted", textOf(level),
            presented_ ? textOf(*presented_) : "the level of a presentation that was complete and not empty");
    }
    const auto request = requestFor(LevelRequest::What::Accept, level);
    if (!request) return failure(request);
    const auto ceiling = tell(*request);
    if (!ceiling) return failure(ceiling);
    return notes_.level(row::kLevelAccepted, level, *ceiling);
}

Result<void> BenchLevels::reportDiscomfort(const StimulusLevel& level) {
    if (auto person = checkPerson(); !person) return person;
    if (auto fits = checkKind(level); !fits) return fits;
    const auto* current = std::get_if<Milliamps>(&level);
    const double value = current != nullptr ? current->value() : std::get<VibrationIntensity>(level).value;
    if (!(std::isfinite(value) && value >= 0 && (current != nullptr || value <= 1))) {
        return invalid("{} too strong; {} is accepted", textOf(level),
                       current != nullptr ? "a finite current of 0 or more" : "an intensity from 0 to 1");
    }
    gate_.latchStop();  // so that no train approved earlier follows the report
    StimulusLevel limit = level;
    if (current != nullptr) {
        auto& known = config_.person->discomfortLimit;
        limit = known = std::min(known, *current);
    } else if (auto& vibration = config_.person->vibration) {
        vibration->discomfortLimit = std::min(vibration->discomfortLimit, value);
        limit = VibrationIntensity{vibration->discomfortLimit};
    }
    const auto request = requestFor(LevelRequest::What::Discomfort, level);
    if (!request) return failure(request);
    // A gate that was not yet configured for a person gets the level through the limit at the next arming.
    const auto ceiling = tell(*request);
    if (!ceiling && ceiling.error().code != ErrorCode::NotArmed) return failure(ceiling);
    return notes_.level(row::kLevelTooStrong, level, ceiling ? *ceiling : limit);
}

Result<void> BenchLevels::ascend(bool begin) {
    if (auto person = checkPerson(); !person) return person;
    const auto request =
        requestFor(begin ? LevelRequest::What::BeginAscending : LevelRequest::What::EndAscending, none());
    if (!request) return failure(request);
    const auto told = tell(*request);
    return told ? Result<void>{} : failure(told);
}

Result<StimulusLevel> BenchLevels::ceiling() {
    if (auto person = checkPerson(); !person) return failure(person);
    const auto request = requestFor(LevelRequest::What::Ceiling, none());
    if (!request) return failure(request);
    return tell(*request);
}

/// Tells the loop even after a stop or fault: a participant's word is taken at any time.
Result<StimulusLevel> BenchLevels::tell(const LevelRequest& request) {
    auto& desk = loop_->levels();
    desk.ask(request);
    const Instant until = time_.now() + kAnswerTimeout;
    std::optional<Result<StimulusLevel>> answer;
    while (!(answer = desk.answer()) && time_.now() < until) time_.pass(until, kLevelPoll);
    if (answer) return *answer;
    return fail(ErrorCode::Timeout, "the control loop does not run: it has not heard of a level within 0.5 s");
}

/// Returns why the level is not permitted, whether accepted or not; empty if it is permitted.
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
        return invalid("an interval of {} s; above 0 to {} s is accepted", interval.count(),
                       Presentation::kLongest.count());
    }
    const double ohm = loop_->telemetry().impedance_ohm;
    if (!(ohm > 0)) return fail(ErrorCode::NotArmed, "no impedance is known, so no largest level; arm first");
    GateSetup setup = terms_.setupFor(Load::resistor(Ohms(ohm)));
    setup.load = LoadRange::measured(Ohms(ohm));
    const Seconds kept = programmedFor(interval, calibration_.applied());
    // Search by halving: if one level is hindered, all higher levels are, too.
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
