#include "core/pilot/PilotStage.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/analysis/vibration/VibrationSeparability.h"
#include "core/base/JsonText.h"
#include "core/base/Random.h"

namespace tacto {

namespace {

constexpr std::size_t kMaxLate = 5;              // presentations in a row that may begin too late
constexpr Seconds kMinPause{2};                  // from an answer to the first train of the next trial
constexpr Seconds kDot{0.5};                     // how long the dot is shown before a presentation
constexpr const char* kStopAnswer = "stop";      // the answer to a presentation that the participant stopped
constexpr const char* kVibration = "vibration";  // a member of an answer: what the motor did

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

/// Returns the name of the row that records a missing answer.
std::string silentName(const StageTrial& trial) { return trial.askedAgain ? trial.name + " again" : trial.name; }

}  // namespace

PilotStage::PilotStage(Bench& bench, PilotParticipant& participant, PilotRecord& record, PilotSettings settings)
    : bench_(bench),
      participant_(participant),
      record_(record),
      settings_(std::move(settings)),
      vibration_(bench),
      output_(*this, record.isResumed()) {
    participant_.stop = [this](const char* by) { output_.stop(by); };
    participant_.waiting = [this] { output_.whileAsked(); };
}

PilotStage::~PilotStage() {
    participant_.leave();
    participant_.stop = nullptr;
    participant_.waiting = nullptr;
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

Result<void> PilotStage::pass(Seconds time) {
    const auto until = bench_.clock().now() + toInstant(time);
    for (;;) {
        const auto now = bench_.clock().now();
        if (now >= until) return {};
        const auto passed = bench_.wait(Seconds(until - now));
        if (passed) return {};
        if (auto goesOn = output_.recover("pause", passed.error()); !goesOn) return goesOn;
    }
}

Result<void> PilotStage::end(PilotEnd how, const std::string& why) {
    rest();
    if (end_ != PilotEnd::Unfinished) return fail(ErrorCode::Stopped, "{}", why);  // a session ends once
    end_ = how;
    // The end is written before any question: if the program is killed meanwhile, the session is still over.
    const auto ended = record_.once(row::kSessionEnd, row::kEnd, [&]() -> Result<Json> {
        return Json{{"state", nameOf(how)}, {"why", why}};
    });
    if (!ended) return failure(ended);
    if (how == PilotEnd::Complete) return {};
    if (afterCare && record_.count(row::kTrialBegin) > 0) {
        participant_.show({});  // the stop that ended the session does not stop the questions after it
        if (const auto cared = afterCare(); !cared) {
            auto kept = record_.write(row::kNote, "after care", {{"not_asked", cared.error().message}});
            if (!kept) return kept;
        }
    }
    return fail(ErrorCode::Stopped, "{}", why);
}

// Presenting and asking

Result<StageAnswer> PilotStage::trial(const StageTrial& trial) {
    if (const auto* answered = record_.find(row::kAnswer, trial.name)) return replay(trial, *answered);
    if (const auto* silent = record_.find(row::kNoAnswer, silentName(trial))) return replay(trial, *silent);
    for (std::size_t late = 0; late < kMaxLate;) {
        if (trial.stopAnswers && record_.find(row::kParticipantStop, trial.name) != nullptr)
            return stoppedAnswer(trial);
        if (auto clear = output_.clearTheWay(trial); !clear) return failure(clear);
        if (auto armed = ready(); !armed) return failure(armed);
        if (participant_.hindrance()) continue;
        if (trial.held && !participant_.holding()) {
            if (auto held = hold(holdPrompt(words())); !held) return failure(held);
            continue;  // a stop may have come before they held: arms again
        }
        const auto number = record_.begun(trial.name) + 1;
        auto answer = attempt(trial, number, late);
        if (answer && *answer) return **answer;
        if (answer) continue;
        if (auto goesOn = output_.recover(trial.name, answer.error()); !goesOn) return failure(goesOn);
    }
    return fail(
        ErrorCode::Timeout,
        "the computer was too slow: {} could not begin in time {} times in a row, and nothing is wrong with the {}",
        trial.name, kMaxLate, settings_.modality());
}

Result<StageAnswer> PilotStage::stoppedAnswer(const StageTrial& trial) {
    const auto number = record_.begun(trial.name);
    Json body = about(trial, number);
    body["response"] = kStopAnswer;
    if (auto kept = record_.write(row::kAnswer, trial.name, std::move(body)); !kept) return failure(kept);
    return StageAnswer{kStopAnswer, kNaN, number, true, false, {}};
}

Result<StageAnswer> PilotStage::replay(const StageTrial& trial, const Json& body) {
    const std::string unit(nameOf(settings_.unit));
    const double stored = numberOr(body, unit.c_str());
    if (!(std::abs(stored - trial.level) < 1e-6))
        return fail(ErrorCode::ParseError,
                    "the record has {} at {} {}, and the script now asks for {}: the session cannot continue from it",
                    trial.name, unit, stored, trial.level);
    const double weaker = numberOr(body, levelKey("weaker", settings_.unit).c_str());
    if (trial.weaker > 0 && !(std::abs(weaker - trial.weaker) < 1e-6))
        return fail(ErrorCode::ParseError,
                    "the record has {} beside {} {}, and the script now asks for {}: the session cannot continue from "
                    "it",
                    trial.name, unit, weaker, trial.weaker);
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
    felt.weaker = trial.weaker;
    felt.interval = trial.presentation.interval;
    felt.stimulated = stimulated_;
    felt.drawnFor = fmt::format("seed {} session {} {}", settings_.seed, settings_.session,
                                trial.drawnAs.empty() ? trial.name : trial.drawnAs);
    if (likelyAnswer) felt.likely = likelyAnswer(felt, trial.prompt);
    participant_.delivered(felt);
}

void PilotStage::tellCounts() {
    participant_.counted({static_cast<int>(record_.answers()), static_cast<int>(record_.voided()), settings_.blocks});
}

void PilotStage::given(const StageTrial& trial) noexcept {
    if (trial.counts) stimulated_ += lengthOf(trial);
}

PilotStage::Json PilotStage::about(const StageTrial& trial, std::size_t attempt) const {
    Json body = trial.about;
    body["attempt"] = attempt;
    body[nameOf(settings_.unit)] = trial.level;
    if (trial.weaker > 0) body[levelKey("weaker", settings_.unit)] = trial.weaker;
    body["interval_s"] = trial.presentation.interval.count();
    return body;
}

Result<std::optional<StageAnswer>> PilotStage::attempt(const StageTrial& trial, std::size_t number, std::size_t& late) {
    Json about = this->about(trial, number);
    tellCounts();
    if (auto kept = record_.write(row::kTrialBegin, trial.name, about); !kept) return failure(kept);

    auto screen = trial.screen;
    screen.impedance_ohm = output_.checkedImpedance();
    screen.state = ScreenState::Dot;
    participant_.show(screen);
    auto presentation = trial.presentation;
    Random pauses(settings_.seed, "pause before " + trial.name);
    const auto earliest = lastAnswer_ + toInstant(kMinPause) + toInstant(pauses.uniform());
    presentation.notBefore = std::max(earliest, bench_.clock().now() + toInstant(kDot));
    screen.state = trial.screen.state;
    if (screen.state != ScreenState::Rest) participant_.show(screen);
    auto presented = present(presentation, trial);
    if (!presented) {  // the presentation was paused before it began, or it failed
        if (presented.error().code != ErrorCode::NotArmed || !output_.isPaused()) return failure(presented);
        if (auto goesOn = output_.afterThePause(trial); !goesOn) return failure(goesOn);
        return std::optional<StageAnswer>();
    }
    if (presented->impedance) output_.setImpedance(presented->impedance->value());
    switch (presented->end) {
        case PresentationEnd::Complete:
            break;
        case PresentationEnd::Refused:
            return fail(ErrorCode::LimitExceeded, "{}", presented->reason);
        case PresentationEnd::Faulted:
            return fail(bench_.faultCode(), "{}", presented->reason);
        case PresentationEnd::Stopped:
            return fail(ErrorCode::Stopped, "{}", presented->reason);
        case PresentationEnd::Paused:
            if (auto goesOn = output_.afterThePause(trial); !goesOn) return failure(goesOn);
            return std::optional<StageAnswer>();
        case PresentationEnd::Late:
            ++late;
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
        bench_.attend(prompt.within ? *prompt.within + kAskingTimeout : kAskingTimeout);
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
    tellCounts();
    given(trial);
    return std::optional(answer);
}

/// Changes the screen at fixed times after the beginning, the same times whichever interval holds the train.
Result<Presented> PilotStage::present(const Presentation& presentation, const StageTrial& trial) {
    vibration_.begin();
    auto presented = bench_.present(presentation, passing(trial));
    vibration_.end();
    return presented;
}

/// Sends the recorder a marker when a presentation begins, in the same way for an empty presentation. If the marker's
/// row cannot be written, the write of the answer's row reports the error.
std::function<void(Seconds, Instant)> PilotStage::passing(const StageTrial& trial) {
    const bool marks = trial.screen.state == ScreenState::Interval;
    bool tells = record_.onMarker != nullptr;
    if (!marks && !tells && !vibration_.canLook()) return {};
    return [this, marks, tells, name = trial.name, passing = trial.screen](Seconds since, Instant began) mutable {
        vibration_.look();
        const int interval = marks ? detectionIntervalAt(since) : passing.interval;
        if (interval != passing.interval && !output_.stopped()) {
            passing.interval = interval;
            participant_.show(passing);
        }
        if (std::exchange(tells, false)) static_cast<void>(record_.writeAt(began, row::kPresentation, name));
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
        const auto said = output_.insist(prompt);
        if (!said) return failure(said);
        // After the session's end, the bench may have faulted or be stopped, and then lets no time pass.
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
        if (!prompt.noEnds.empty() && said->key() == "no") {
            body[row::kEnds] = true;
            body["said"] = prompt.noEnds;
        }
        return body;
    });
}

Result<void> PilotStage::answeredFor(const PilotHold& held) {
    if (record_.find(row::kHold, held.name) != nullptr) return {};
    rest();
    auto prompt = choicePrompt(kHoldPrompt,
                               fmt::format("{}. Nothing is presented until you answer with your initials", held.said),
                               {}, PromptTo::Operator);
    prompt.kind = PromptKind::Text;
    for (;;) {
        const auto said = output_.insist(prompt);
        if (!said) return failure(said);
        if (said->key().empty()) continue;
        lastAnswer_ = bench_.clock().now();
        return record_.write(row::kHold, held.name,
                             {{"said", held.said}, {"by", said->key()}, {"rt_s", said->after.count()}});
    }
}

Result<void> PilotStage::instruct(const std::string& phase) {
    rest();
    const auto text = words().text("instruction." + phase);
    const auto read = ask(row::kPhase, "instruction " + phase, goOnPrompt(text, PromptTo::Participant, words()));
    return read ? Result<void>() : failure(read);
}

Result<bool> PilotStage::meantTooStrong(const std::string& trial) {
    rest();
    PilotScreen letGo;  // the participant may let go: both hands are free for the answer
    letGo.phase = "ascending";
    participant_.show(letGo);
    const auto said = ask(row::kPhase, row::meantName(trial), meantPrompt(words()));
    if (!said) return failure(said);
    return textOr(*said, "key") != "no";
}

Result<void> PilotStage::hold(const PilotPrompt& prompt) {
    const auto held = output_.insist(prompt);
    return held ? Result<void>() : failure(held);
}

}  // namespace tacto
