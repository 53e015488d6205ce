#include "core/pilot/PilotStage.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/analysis/vibration/VibrationSeparability.h"
#include "core/base/JsonFields.h"
#include "core/base/Random.h"
#include "core/base/Words.h"

namespace tacto {

namespace {

constexpr Word<PilotEnd> kPilotEnds[] = {
    {"unfinished", PilotEnd::Unfinished}, {"complete", PilotEnd::Complete}, {"stopped", PilotEnd::Stopped}};

constexpr std::size_t kMaxStops = 3;   // of the participant: the third ends the session
constexpr std::size_t kMaxFaults = 2;  // the second ends it
constexpr int kArmingTries = 3;        // while the check pulse finds an electrode that lifted, or a fault lasts
constexpr std::size_t kMaxLate = 5;    // presentations in a row that the bench could not begin in time
constexpr Seconds kMinPause{2};        // from an answer to the next first train
constexpr Seconds kDot{0.5};           // the dot is shown so long before it
/// Until when a bench in person mode may wait for an answer: prompts of trials are shorter.
constexpr Seconds kAskingTakes{60};

constexpr const char* kStopAnswer = "stop";      // to a presentation that they stopped
constexpr const char* kVibration = "vibration";  // member of an answer: what the motor did

/// The check pulse found no load that the bench is armed on.
bool isUnseated(const Error& why) { return why.code == ErrorCode::NotArmed || why.code == ErrorCode::LimitExceeded; }

bool isParticipants(std::string_view by) { return by.starts_with("participant"); }

nlohmann::json trainsJson(const Presented& presented) {
    nlohmann::json all = nlohmann::json::array();
    for (const auto& train : presented.trains) {
        const auto* current = std::get_if<Milliamps>(&train.approved);
        const auto* intensity = std::get_if<VibrationIntensity>(&train.approved);
        nlohmann::json one{{"onset_s", toSeconds(train.onset)}};
        if (current != nullptr) one["approved_ma"] = current->value();
        if (intensity != nullptr) one["approved_intensity"] = intensity->value;
        if (train.readBack) one["read_back_ma"] = train.readBack->value();
        if (train.impedance) one["impedance_ohm"] = train.impedance->value();
        all.push_back(std::move(one));
    }
    return all;
}

/// Name of the row that says that no answer came.
std::string silentName(const StageTrial& trial) { return trial.askedAgain ? trial.name + " again" : trial.name; }

}  // namespace

std::string_view nameOf(PilotEnd end) noexcept { return wordFor<PilotEnd>(kPilotEnds, end); }

PilotStage::PilotStage(Bench& bench, PilotParticipant& participant, PilotRecord& record, PilotSettings settings)
    : bench_(bench),
      participant_(participant),
      record_(record),
      settings_(std::move(settings)),
      vibration_(bench),
      rampDue_(record.isResumed()) {
    participant_.stop = [this](const char* by) {
        const auto pressed = std::chrono::steady_clock::now();
        stoppedBy_.store(by);
        bench_.stop(by);
        stopTook_.store(std::chrono::nanoseconds(std::chrono::steady_clock::now() - pressed).count());
    };
}

PilotStage::~PilotStage() {
    participant_.stop = [](const char*) {};
}

double PilotStage::step() const {
    if (settings_.unit == LevelUnit::Intensity) return kIntensityStep;
    const auto& stimulator = bench_.devices().stimulator;
    return stimulator ? stimulator->traits().amplitudeStep : 0;
}

StimulusLevel PilotStage::levelOf(double level) const {
    if (settings_.unit == LevelUnit::Intensity) return VibrationIntensity{level};
    return Milliamps(level);
}

void PilotStage::cancel() noexcept { participant_.cancel(); }

void PilotStage::rest() noexcept {
    bench_.disarm();
    armed_ = false;
}

Result<void> PilotStage::pass(Seconds time) {
    const auto until = bench_.clock().now() + toInstant(time);
    for (;;) {
        const auto now = bench_.clock().now();
        if (now >= until) return {};
        const auto passed = bench_.wait(Seconds(until - now));
        if (passed) return {};
        if (auto goesOn = recover("pause", passed.error()); !goesOn) return goesOn;
    }
}

Result<void> PilotStage::end(PilotEnd how, const std::string& why) {
    rest();
    if (end_ != PilotEnd::Unfinished) return fail(ErrorCode::Stopped, "{}", why);  // it ends once
    end_ = how;
    // Before anything is asked: killed meanwhile, it is over all the same.
    if (auto kept = record_.write(row::kSessionEnd, "end", {{"state", nameOf(how)}, {"why", why}}); !kept) return kept;
    if (how == PilotEnd::Complete) return {};
    if (afterCare && record_.count(row::kTrialBegin) > 0) {
        participant_.show({});  // the stop that ended it stops no question after it
        static_cast<void>(afterCare());
    }
    return fail(ErrorCode::Stopped, "{}", why);
}

std::optional<PilotStage::PressedStop> PilotStage::takeStop() noexcept {
    const char* by = stoppedBy_.exchange(nullptr);
    if (by == nullptr) return std::nullopt;
    return PressedStop{isParticipants(by), std::chrono::nanoseconds(stopTook_.load())};
}

// Presenting and asking

Result<StageAnswer> PilotStage::trial(const StageTrial& trial) {
    if (const auto* answered = record_.find(row::kAnswer, trial.name)) return replay(trial, *answered);
    if (const auto* silent = record_.find(row::kNoAnswer, silentName(trial))) return replay(trial, *silent);
    for (std::size_t late = 0; late < kMaxLate;) {
        if (auto armed = ready(); !armed) return failure(armed);
        if (trial.held && !participant_.holding()) {
            if (auto held = hold(); !held) return failure(held);
            continue;  // a stop may have come before they held: armed anew
        }
        const auto number = record_.begun(trial.name) + 1;
        auto answer = attempt(trial, number);
        if (answer && *answer) return **answer;
        if (answer) {  // void, and nothing is wrong: once more
            ++late;
            continue;
        }
        const auto stops = record_.count(row::kParticipantStop);
        if (auto goesOn = recover(trial.name, answer.error()); !goesOn) return failure(goesOn);
        if (!trial.stopAnswers || record_.count(row::kParticipantStop) == stops) continue;
        Json body = about(trial, number);
        body["response"] = kStopAnswer;
        if (auto kept = record_.write(row::kAnswer, trial.name, std::move(body)); !kept) return failure(kept);
        return StageAnswer{kStopAnswer, kNaN, number, true, false, {}};
    }
    return fail(ErrorCode::Timeout, "{}: the bench could not begin a presentation in time {} times in a row",
                trial.name, kMaxLate);
}

Result<StageAnswer> PilotStage::replay(const StageTrial& trial, const Json& body) {
    const std::string unit(nameOf(settings_.unit));
    const double stored = numberOr(body, unit.c_str());
    if (!(std::abs(stored - trial.level) < 1e-6))
        return fail(ErrorCode::ParseError,
                    "the record has {} at {} {}, and the script now asks for {}: it cannot be gone on with", trial.name,
                    unit, stored, trial.level);
    const double interval_s = numberOr(body, "interval_s");
    if (body.contains("interval_s") && !(std::abs(interval_s - trial.presentation.interval.count()) < 1e-6))
        return fail(ErrorCode::ParseError,
                    "the record has {} at an interval of {} s, and the script now asks for {} s: it cannot be gone on "
                    "with",
                    trial.name, interval_s, trial.presentation.interval.count());
    const auto response = textOr(body, "response");
    if (response != kStopAnswer) {
        feel(trial);
        given(trial);
    }
    StageAnswer answer{
        response, numberOr(body, "rt_s"), countOr(body, "attempt"), !response.empty() || !trial.asks, true, {}};
    if (const auto found = body.find(kVibration); found != body.end()) answer.vibration = burstFiguresFrom(*found);
    return answer;
}

void PilotStage::feel(const StageTrial& trial) {
    auto felt = trial.felt;
    felt.level = trial.level;
    felt.interval = trial.presentation.interval;
    felt.stimulated = stimulated_;
    felt.drawnFor = fmt::format("seed {} session {} {}", settings_.seed, settings_.session,
                                trial.drawnAs.empty() ? trial.name : trial.drawnAs);
    participant_.delivered(felt);
}

void PilotStage::given(const StageTrial& trial) noexcept { stimulated_ += lengthOf(trial); }

PilotStage::Json PilotStage::about(const StageTrial& trial, std::size_t attempt) const {
    Json body = trial.about;
    body["attempt"] = attempt;
    body[nameOf(settings_.unit)] = trial.level;
    body["interval_s"] = trial.presentation.interval.count();
    return body;
}

Result<std::optional<StageAnswer>> PilotStage::attempt(const StageTrial& trial, std::size_t number) {
    if (auto there = participant_.ready(); !there) return failure(there);
    Json about = this->about(trial, number);
    if (auto kept = record_.write(row::kTrialBegin, trial.name, about); !kept) return failure(kept);

    auto screen = trial.screen;
    screen.state = ScreenState::Dot;
    participant_.show(screen);
    auto presentation = trial.presentation;
    Random pauses(settings_.seed, "pause before " + trial.name);
    const auto earliest = lastAnswer_ + toInstant(kMinPause) + toInstant(pauses.uniform());
    presentation.notBefore = std::max(earliest, bench_.clock().now() + toInstant(kDot));
    if (trial.screen.state != ScreenState::Rest) participant_.show(trial.screen);
    auto presented = present(presentation, trial.screen);
    if (!presented) return failure(presented);
    if (presented->impedance) impedance_ = presented->impedance->value();
    switch (presented->end) {
        case PresentationEnd::Complete:
            break;
        case PresentationEnd::Refused:
            return fail(ErrorCode::LimitExceeded, "{}", presented->reason);
        case PresentationEnd::Faulted:
            return fail(ErrorCode::Device, "{}", presented->reason);
        case PresentationEnd::Stopped:
            return fail(ErrorCode::Stopped, "{}", presented->reason);
        case PresentationEnd::Paused:
        case PresentationEnd::Late:
            return std::optional<StageAnswer>();
    }
    feel(trial);
    about["trains"] = presented->trains.size();
    about["delivered"] = trainsJson(*presented);
    StageAnswer answer{"", kNaN, number, true, false, vibration_.measured(*presented)};
    if (answer.vibration) about[kVibration] = toJson(*answer.vibration);
    if (trial.asks) {
        auto prompt = trial.prompt;
        prompt.targetsAt = presented->ended;
        bench_.attend(prompt.within ? *prompt.within + kAskingTakes : kAskingTakes);
        const auto said = participant_.ask(prompt);
        if (auto noted = writeEarly(trial); !noted) return failure(noted);
        if (!said) return failure(said);
        if (!participant_.answersInRealTime()) {
            const auto taken = said->given ? said->after : prompt.within.value_or(Seconds(0));
            if (auto passed = bench_.wait(taken); !passed) return failure(passed);
        }
        answer.given = said->given;
        if (said->given) {
            answer.response = said->key();
            answer.rt_s = said->after.count();
        }
    }
    lastAnswer_ = bench_.clock().now();
    about["response"] = answer.response.empty() ? Json(nullptr) : Json(answer.response);
    about["rt_s"] = answer.rt_s;
    auto kept = answer.given ? record_.write(row::kAnswer, trial.name, std::move(about))
                             : record_.write(row::kNoAnswer, silentName(trial), std::move(about));
    if (!kept) return failure(kept);
    given(trial);
    return std::optional(answer);
}

/// Marks follow the time since the beginning alone: they are the same whichever interval holds the train.
Result<Presented> PilotStage::present(const Presentation& presentation, const PilotScreen& screen) {
    vibration_.begin();
    auto presented = bench_.present(presentation, passing(screen));
    vibration_.end();
    return presented;
}

std::function<void(Seconds)> PilotStage::passing(const PilotScreen& screen) {
    const bool marks = screen.state == ScreenState::Interval;
    if (!marks && !vibration_.canLook()) return {};
    return [this, marks, passing = screen](Seconds since) mutable {
        vibration_.look();
        const int interval = marks ? detectionIntervalAt(since) : passing.interval;
        if (interval == passing.interval || stoppedBy_.load() != nullptr) return;
        passing.interval = interval;
        participant_.show(passing);
    };
}

Result<void> PilotStage::writeEarly(const StageTrial& trial) {
    for (const auto& press : participant_.takeEarly()) {
        auto kept = record_.write(row::kAnswerEarly, trial.name, {{"key", press.key}, {"at_s", toSeconds(press.at)}});
        if (!kept) return kept;
    }
    return {};
}

Result<PilotStage::Json> PilotStage::ask(const char* kind, const std::string& name, const PilotPrompt& prompt) {
    return record_.once(kind, name, [&]() -> Result<Json> {
        const auto said = insist(prompt);
        if (!said) return failure(said);
        // After its end a bench that has faulted, or was stopped, lets no time pass.
        if (!participant_.answersInRealTime() && end_ == PilotEnd::Unfinished) {
            if (auto passed = pass(said->after); !passed) return failure(passed);
        }
        lastAnswer_ = bench_.clock().now();
        Json body{{"asked", prompt.name}, {"to", nameOf(prompt.to)}, {"rt_s", said->after.count()}};
        if (said->value) body["value"] = *said->value;
        if (prompt.kind == PromptKind::Several)
            body["keys"] = said->keys;
        else if (!said->keys.empty())
            body["key"] = said->key();
        return body;
    });
}

Result<PilotAnswer> PilotStage::insist(const PilotPrompt& prompt) {
    for (;;) {
        bench_.attend(kAskingTakes);
        auto said = participant_.ask(prompt);
        if (said) return said;
        if (auto goesOn = recover(prompt.name, said.error()); !goesOn) return failure(goesOn);
    }
}

Result<void> PilotStage::hold() {
    const auto held = insist(holdPrompt());
    return held ? Result<void>() : failure(held);
}

// Arming, and reaching the levels of a resumed session again

Result<ArmRequest> PilotStage::confirmed(const char* question) {
    ArmRequest request;
    request.declaredLoadConfirmed = true;
    request.operatorConfirmed = true;
    if (!bench_.outputIsReal()) return request;
    const auto load = parseLoad(request.load);
    request.confirmed = load ? bench_.armingText(*load) : std::string();
    participant_.show({});  // what is held may be let go: it is the operator's turn
    const auto asked =
        insist(yesNoPrompt("arm", fmt::format("{} {}?", question, request.confirmed), PromptTo::Operator));
    if (!asked) return failure(asked);
    if (asked->key() != "yes") return fail(ErrorCode::NotArmed, "the operator did not confirm {}", request.confirmed);
    return request;
}

Result<void> PilotStage::arm() {
    for (int tries = 1; !armed_; ++tries) {
        const auto request = confirmed("Arm");
        if (!request) return failure(request);
        const auto armed = bench_.arm(*request);
        armed_ = armed.has_value();
        if (armed_) break;
        const bool unseated = isUnseated(armed.error());
        if (auto goesOn = seatAgain("arming", armed.error(), tries); !goesOn) return goesOn;
        if (!unseated) continue;
        rampDue_ = true;
        if (!afterFault) continue;
        if (auto measured = afterFault(); !measured) return measured;
    }
    return {};
}

Result<void> PilotStage::seatAgain(const std::string& during, const Error& why, int tries) {
    if (!isUnseated(why)) return recover(during, why);
    if (tries >= kArmingTries) return tl::unexpected<Error>(why);
    if (auto kept = record_.write(row::kGate, during, {{"holds", false}, {"said", why.message}}); !kept) return kept;
    return askToSee(why.message);
}

Result<void> PilotStage::askToSee(const std::string& why) {
    participant_.show({});
    const auto seen = insist(goOnPrompt(
        fmt::format("Output is off: {}. See to the {}, then go on.", why, settings_.modality()), PromptTo::Operator));
    return seen ? Result<void>() : failure(seen);
}

Result<double> PilotStage::measureImpedance(const std::string& name) {
    for (int tries = 1;; ++tries) {
        rest();
        const auto request = confirmed("Measure the electrodes with");
        if (!request) return failure(request);
        const auto found = bench_.checkImpedance(*request);
        if (!found) {
            if (auto goesOn = seatAgain(name, found.error(), tries); !goesOn) return failure(goesOn);
            continue;
        }
        const double ohm = *found ? (*found)->value() : kNaN;
        if (auto kept = record_.write(row::kImpedance, name, {{"impedance_ohm", ohm}}); !kept) return failure(kept);
        impedance_ = ohm;
        return ohm;
    }
}

Result<void> PilotStage::ready() {
    if (auto armed = arm(); !armed) return armed;
    if (!rampDue_) return {};
    rampDue_ = false;
    return ramp();
}

Result<void> PilotStage::judged(double level, bool tooStrong, const std::string& trial, bool replayed) {
    if (level <= 0) return {};
    if (tooStrong)
        tooStrong_ = std::min(tooStrong_, level);
    else
        accepted_.try_emplace(level, trial);
    if (tooStrong) {
        auto told = bench_.reportDiscomfort(levelOf(level));
        rest();  // Armed anew under the lower limit before anything else is presented
        return told;
    }
    return replayed ? Result<void>() : bench_.accept(levelOf(level));
}

Result<void> PilotStage::ramp() {
    const auto accepted = accepted_;
    // Each ramp is presented: none takes the answers of another.
    std::size_t number = 0;
    const auto named = [&number](double level) { return fmt::format("ramp {} {}", number, level); };
    while (!accepted.empty() && record_.begun(named(accepted.begin()->first)) > 0) ++number;
    for (const auto& [level, first] : accepted) {
        if (level >= tooStrong_ || (settled_ && level > *settled_)) break;
        StageTrial again;
        again.name = named(level);
        again.about = {{"ramp", true}};
        again.level = level;
        again.presentation = ascendingPresentation(levelOf(level), settings_.shortest);
        again.prompt = strengthPrompt();
        again.screen.state = ScreenState::Feel;
        again.screen.phase = "ascending";
        again.held = true;
        again.drawnAs = first;  // A virtual participant says of a level what they said of it before
        const auto stimulated = stimulated_;
        const auto answer = trial(again);
        stimulated_ = stimulated;  // So that a session that was resumed goes on as one that was not
        if (!answer) return failure(answer);
        if (answer->response == "too-strong") {
            if (auto told = bench_.reportDiscomfort(levelOf(level)); !told) return told;
            return end(PilotEnd::Stopped,
                       fmt::format("{} was accepted before and is too strong now; the session ends here",
                                   textOf(levelOf(level))));
        }
        if (auto told = bench_.accept(levelOf(level)); !told) return told;
    }
    if (accepted.empty()) return {};
    PilotScreen letGo;  // levels rise no more
    letGo.phase = "ascending";
    letGo.text = "You can let go now.";
    participant_.show(letGo);
    return {};
}

// After a stop or a fault

Result<void> PilotStage::recover(const std::string& during, const Error& why) {
    rest();
    if (end_ != PilotEnd::Unfinished) return tl::unexpected<Error>(why);
    if (why.code == ErrorCode::Device) return afterTheFault(during, why);
    if (auto noted = noteStop(during, why); !noted) return noted;
    return askToGoOn("Stopped. Nothing is on. Go on when you want to.");
}

Result<void> PilotStage::noteStop(const std::string& during, const Error& why) {
    if (why.code != ErrorCode::Stopped) return tl::unexpected<Error>(why);
    const char* by = stoppedBy_.exchange(nullptr);
    if (by == nullptr || !isParticipants(by)) {
        const auto kept = record_.write(row::kOperatorStop, during, {{"why", why.message}});
        return kept ? Result<void>(tl::unexpected<Error>(why)) : kept;
    }
    if (auto kept = record_.write(row::kParticipantStop, during, {{"by", by}}); !kept) return kept;
    if (record_.count(row::kParticipantStop) < kMaxStops) return {};
    return end(PilotEnd::Stopped, "the participant stopped for the third time, which ends the session");
}

/// Seated again, wanted again, measured again, reached again (ready()).
Result<void> PilotStage::afterTheFault(const std::string& during, const Error& why) {
    stoppedBy_.store(nullptr);
    if (auto kept = record_.write(row::kFault, during, {{"why", why.message}}); !kept) return kept;
    if (record_.count(row::kFault) >= kMaxFaults)
        return end(PilotEnd::Stopped, "a second fault ends the session: " + why.message);
    auto cause = why.message;
    for (int tries = 1;; ++tries) {
        if (auto seen = askToSee(cause); !seen) return seen;
        const auto reset = bench_.resetFault();
        if (reset) break;
        if (tries >= kArmingTries) return reset;
        cause = reset.error().message;  // it is still there
    }
    if (auto wanted = askToGoOn("The output was off because of a fault. Go on when you want to."); !wanted)
        return wanted;
    rampDue_ = true;
    return afterFault ? afterFault() : Result<void>();
}

Result<void> PilotStage::askToGoOn(const std::string& text) {
    PilotScreen screen;
    screen.text = text;
    for (;;) {
        participant_.show(screen);
        const auto mark = bench_.stops().mark();  // a stop from here on is one after their "go on"
        const auto asked = participant_.ask(goOnPrompt(text, PromptTo::Participant));
        const auto begun = asked ? bench_.begin(mark) : Result<void>(failure(asked));
        if (begun) break;
        // Nothing is on, and they press STOP once more: theirs counts, and they are asked again.
        if (auto noted = noteStop("go on", begun.error()); !noted) return noted;
    }
    lastAnswer_ = bench_.clock().now();
    return record_.write(row::kContinue, "continue");
}

}  // namespace tacto
