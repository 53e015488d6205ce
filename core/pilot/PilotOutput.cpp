#include "core/pilot/PilotOutput.h"

#include <algorithm>
#include <string_view>

#include "core/analysis/psychophysics/AscendingLimits.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/Printable.h"
#include "core/pilot/PilotRecord.h"
#include "core/pilot/PilotStage.h"

namespace tacto {

namespace {

constexpr Seconds kHindrancePoll{0.1};  // time between two looks for hindrances
constexpr Seconds kReasonTimeout{300};

/// The check pulse did not find the load for which the bench is armed.
bool isUnseated(const Error& why) { return why.code == ErrorCode::NotArmed || why.code == ErrorCode::LimitExceeded; }

/// Returns the bench's sentence about a fault without its first word, which the sentence around it says already.
std::string_view withoutFaultWord(std::string_view said) {
    constexpr std::string_view kWord = "fault: ";
    return said.starts_with(kWord) ? said.substr(kWord.size()) : said;
}

/// Returns what happened and whether the output is off, in sentences.
std::string saidOfOutput(const std::string& why, std::optional<FaultCause> fault) {
    // The bench's sentence about a stop or a fault ends with the state of the output.
    auto output = std::string(outputAfter(fault));
    output.pop_back();
    return why.ends_with('.') ? fmt::format("{}{}", capital(why.front()), why.substr(1))
                              : fmt::format("{}: {}.", output, why);
}

/// Ends the session without a reset, after which only a load-safety run resets the unit's fault.
Result<void> endAfter(PilotStage& stage, FaultCause grave, const std::string& during, const std::string& why) {
    const auto ends =
        fmt::format("a fault of {} ends the session; the safety check comes before the next", nameOf(grave));
    auto kept = stage.record().write(row::kGate, during, {{"holds", false}, {"said", ends}, {row::kEnds, true}});
    if (!kept) return kept;
    stage.participant().show({});
    const auto text = fmt::format("{} Take the {} off the participant, then go on: {}.", saidOfOutput(why, grave),
                                  stage.settings().modality(), ends);
    static_cast<void>(stage.participant().ask(goOnPrompt(text, PromptTo::Operator)));  // it ends, whatever is answered
    return stage.end(PilotEnd::Stopped, ends);
}

}  // namespace

// Stops

void PilotOutput::stop(const char* by) noexcept {
    stops_.press(by, [this, by] { stage_.bench().stop(by); });
}

void PilotOutput::rest() noexcept {
    stage_.bench().disarm();
    armed_ = false;
}

Result<PilotAnswer> PilotOutput::insist(const PilotPrompt& prompt) {
    for (;;) {
        stage_.bench().attend(PilotStage::kAskingTimeout);
        auto said = stage_.participant().ask(prompt);
        if (said) return said;
        const bool over = stage_.ended() != PilotEnd::Unfinished;
        if (over && (takeStop() || stops_.takePaused())) {  // after the end, questions are still asked
            stage_.participant().show({});
            continue;
        }
        if (auto goesOn = recover(prompt.name, said.error()); !goesOn) return failure(goesOn);
    }
}

// Arming, and reaching the levels again

Result<ArmRequest> PilotOutput::confirmed(const char* question) {
    auto& bench = stage_.bench();
    ArmRequest request;
    request.declaredLoadConfirmed = true;
    request.operatorConfirmed = true;
    if (!bench.outputIsReal()) return request;
    const auto load = parseLoad(request.load);
    request.confirmed = load ? bench.armingText(*load) : std::string();
    stage_.participant().show({});  // the participant may let go: the operator answers now
    const auto asked =
        insist(yesNoPrompt("arm", fmt::format("{} {}?", question, request.confirmed), PromptTo::Operator));
    if (!asked) return failure(asked);
    if (asked->key() != "yes") return fail(ErrorCode::NotArmed, "the operator did not confirm {}", request.confirmed);
    return request;
}

Result<void> PilotOutput::notOver() const {
    if (stage_.record().find(row::kSessionEnd, row::kEnd) == nullptr) return {};
    return fail(ErrorCode::Stopped, "the session is over; nothing is armed any more");
}

Result<void> PilotOutput::arm() {
    if (auto may = notOver(); !may) return may;
    for (int seatings = 0; !armed_;) {
        if (auto measured = measureTouched(); !measured) return measured;
        const auto request = confirmed("Arm");
        if (!request) return failure(request);
        const auto armed = stage_.bench().arm(*request);
        armed_ = armed.has_value();
        if (armed_) break;
        if (auto goesOn = afterArmingFailed("arming", armed.error(), seatings); !goesOn) return goesOn;
    }
    return {};
}

Result<void> PilotOutput::measureTouched() {
    if (!unmeasured_) return {};
    if (measureAnew) {
        if (auto measured = measureAnew(); !measured) return measured;
    }
    unmeasured_ = false;
    return {};
}

Result<void> PilotOutput::ready() {
    if (auto armed = arm(); !armed) return armed;
    return ramp_.reach();
}

Result<double> PilotOutput::measureImpedance(const std::string& name) {
    if (auto may = notOver(); !may) return failure(may);
    for (int seatings = 0;;) {
        rest();
        const auto request = confirmed("Measure the electrodes with");
        if (!request) return failure(request);
        const auto found = stage_.bench().checkImpedance(*request);
        if (!found) {
            if (auto goesOn = afterArmingFailed(name, found.error(), seatings); !goesOn) return failure(goesOn);
            continue;
        }
        const double ohm = *found ? (*found)->value() : kNaN;
        if (auto kept = stage_.record().write(row::kImpedance, name, {{"impedance_ohm", ohm}}); !kept)
            return failure(kept);
        impedance_ = checked_ = ohm;
        unmeasured_ = false;
        return ohm;
    }
}

/// Counts failed seatings. A stop or a fault in between does not count as a seating.
Result<void> PilotOutput::afterArmingFailed(const std::string& during, const Error& why, int& seatings) {
    if (!isUnseated(why)) return recover(during, why);
    if (++seatings >= kSeatings) return tl::unexpected<Error>(why);
    return seatAgain(during, why.message);
}

Result<void> PilotOutput::seatAgain(const std::string& during, const std::string& why) {
    rest();
    if (auto kept = stage_.record().write(row::kGate, during, {{"holds", false}, {"said", why}}); !kept) return kept;
    electrodesTouched();
    ramp_.becomeDue();
    return askToSee(why);
}

Result<void> PilotOutput::askToSee(const std::string& why) {
    stage_.participant().show({});
    const auto seen = insist(
        goOnPrompt(fmt::format("{} See to the {}, then go on.", saidOfOutput(why, stage_.bench().telemetry().fault),
                               stage_.settings().modality()),
                   PromptTo::Operator));
    return seen ? Result<void>() : failure(seen);
}

Result<void> PilotOutput::askAboutTheComputer() {
    stage_.participant().show({});
    const auto seen = insist(goOnPrompt(
        fmt::format("The computer was too slow for 0.1 s: output is off, nothing is wrong with the {}. Close the "
                    "programs that keep the computer busy, then go on.",
                    stage_.settings().modality()),
        PromptTo::Operator));
    return seen ? Result<void>() : failure(seen);
}

// Hindrances of a presentation

Result<void> PilotOutput::clearTheWay(const StageTrial& trial) {
    bool noted = false;
    Seconds waited{0};
    while (const auto hindrance = stage_.participant().hindrance()) {
        if (hindrance->isBreak) {
            if (auto over = takeBreak(trial.name, trial.screen); !over) return over;
            continue;
        }
        if (!std::exchange(noted, true)) {
            auto kept = stage_.record().write(row::kFocusLost, trial.name, {{"why", hindrance->why}});
            if (!kept) return kept;
        }
        if (waited >= kFocusTimeout && armed_) rest();
        waited += kHindrancePoll;
        if (const auto passed = stage_.bench().wait(kHindrancePoll); !passed) {
            if (auto goesOn = recover("before " + trial.name, passed.error()); !goesOn) return goesOn;
        }
    }
    return {};
}

/// Switches the output off while a question waits and the window lacks the keyboard. If the row cannot be written, the
/// write of the answer's row reports the error.
void PilotOutput::whileAsked() {
    const auto hindrance = stage_.participant().hindrance();
    if (!armed_ || !hindrance || hindrance->isBreak) {
        keysGone_ = Seconds(0);
        return;
    }
    keysGone_ += kWaitingLook;
    if (keysGone_ < kFocusTimeout) return;
    rest();
    static_cast<void>(stage_.record().write(row::kFocusLost, "question", {{"why", hindrance->why}}));
}

/// Switches the output off. The operator ends the break, then the participant continues.
Result<void> PilotOutput::takeBreak(const std::string& during, PilotScreen screen) {
    auto& record = stage_.record();
    auto& people = stage_.participant();
    rest();
    const auto name = fmt::format("operator's break {}", record.count(row::kBreakBegin) + 1);
    auto kept = record.write(row::kBreakBegin, name, {{"by", "operator"}, {"during", during}});
    if (!kept) return kept;
    people.show({});  // the participant may let go
    screen.state = ScreenState::Break;
    screen.named.clear();
    screen.right.reset();
    const auto lasts = [&people] {
        const auto hindrance = people.hindrance();
        return hindrance && hindrance->isBreak;
    };
    if (auto over = idleWhile(name, screen, lasts); !over) return over;
    if (auto wanted = askToGoOn("after.break"); !wanted) return wanted;
    unmeasured_ = true;
    return record.write(row::kBreakEnd, name);
}

Result<void> PilotOutput::idleWhile(const std::string& during, const PilotScreen& screen,
                                    const std::function<bool()>& lasts) {
    auto& people = stage_.participant();
    auto& bench = stage_.bench();
    people.show(screen);
    auto mark = bench.stops().mark();
    while (lasts()) {
        bench.idle(kHindrancePoll);
        if (!bench.stops().movedSince(mark) && !stopped()) continue;
        const Error why{ErrorCode::Stopped, "stopped in a break"};
        if (auto goesOn = interrupted(during, why); !goesOn) return goesOn;
        mark = bench.stops().mark();
        people.show(screen);
    }
    return {};
}

bool PilotOutput::isPaused() {
    stage_.bench().idle(kHindrancePoll);
    return stage_.bench().telemetry().paused;
}

Result<void> PilotOutput::afterThePause(const StageTrial& trial) {
    rest();
    if (auto kept = stage_.record().write(row::kPause, trial.name, {{"why", "paused by the operator"}}); !kept)
        return kept;
    stage_.participant().show({});  // the participant may let go
    PilotScreen screen;
    screen.state = ScreenState::Break;
    screen.text = stage_.words().text("paused.text");
    if (auto over = idleWhile(trial.name, screen, [this] { return isPaused(); }); !over) return over;
    unmeasured_ = true;
    return askToGoOn("after.pause");
}

// recover(): after a stop, a fault or a lost screen

Result<void> PilotOutput::recover(const std::string& during, const Error& why) {
    rest();
    if (stage_.ended() != PilotEnd::Unfinished) return tl::unexpected<Error>(why);
    if (runEnds_) {  // the run ends for good, even if a person has also pressed STOP
        const auto noted = interrupted(during, why);
        return noted ? tl::unexpected<Error>(why) : noted;
    }
    const bool atScreen = stops_.screenGone() || !stage_.participant().hasScreen();
    const bool late = why.code == ErrorCode::Timeout && stage_.bench().telemetry().state == InterlockState::Faulted;
    if ((late || why.code == ErrorCode::Device) && !atScreen && !stops_.aborted()) return afterTheFault(during, why);
    const bool paused = stops_.paused();
    if (auto goesOn = interrupted(during, why); !goesOn) return goesOn;
    if (const auto hindrance = stage_.participant().hindrance(); paused && hindrance && hindrance->isBreak)
        return takeBreak(during, {});
    return askToGoOn("after.stop");
}

Result<void> PilotOutput::interrupted(const std::string& during, const Error& why) {
    if (stops_.aborted()) return noteAbort(during);
    if (stops_.takePaused()) {
        const auto wanted = stage_.participant().hindrance();
        auto kept = stage_.record().write(
            row::kPause, during, {{"why", wanted && wanted->isBreak ? wanted->why : "the operator wants a break now"}});
        if (!kept || (stops_.by() == nullptr && !stops_.screenGone())) return kept;
    }
    const bool gone = stops_.takeScreenGone() || !stage_.participant().hasScreen();
    if (!gone) return noteStop(during, why);
    if (const char* by = stops_.by(); by != nullptr && isParticipants(by)) {  // the participant's own stop still counts
        if (auto noted = noteStop(during, why); !noted) return noted;
    }
    return seatTheirScreen(during);
}

Result<void> PilotOutput::seatTheirScreen(const std::string& during) {
    auto& people = stage_.participant();
    auto& bench = stage_.bench();
    auto kept = stage_.record().write(row::kPause, during, {{"why", "the participant's screen is gone"}});
    if (!kept) return kept;
    electrodesTouched();
    ramp_.becomeDue();
    people.show({});
    const auto until =
        std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::seconds>(kScreenTimeout);
    auto prompt = goOnPrompt(
        "Output is off: the participant's screen is gone. Seat the participant at it again, then "
        "go on.",
        PromptTo::Operator);
    prompt.name = kScreenPrompt;
    PilotAnswer none;  // an empty answer: there is no time limit
    none.given = false;
    for (;;) {
        const auto mark = bench.stops().mark();
        const auto left = Seconds(until - std::chrono::steady_clock::now());
        prompt.within = left;
        const auto asked = left > Seconds(0) ? people.ask(prompt) : Result<PilotAnswer>(none);
        if (asked && !asked->given)
            return fail(ErrorCode::Stopped,
                        "the participant's screen was gone for {:.0f} min, so the session is interrupted; it can go on "
                        "within 2 h",
                        kScreenTimeout.count() / 60);
        const auto begun = asked ? beginAnew(mark) : Result<void>(failure(asked));
        if (begun && people.hasScreen()) return {};
        if (begun || stops_.takeScreenGone() || stops_.takePaused()) continue;  // the screen is still gone, or again
        if (stops_.aborted()) return noteAbort(during);
        if (auto noted = noteStop(kScreenPrompt, begun.error()); !noted) return noted;
        people.show({});
    }
}

Result<void> PilotOutput::noteAbort(const std::string& during) {
    auto& record = stage_.record();
    const auto broken = fail(ErrorCode::Stopped, "the operator aborted the session; it can go on within 2 h");
    if (std::exchange(reasonAsked_, true)) return broken;
    if (auto kept = record.write(row::kOperatorStop, kOperatorAborts, {{"during", during}}); !kept) return kept;
    stage_.participant().show({});
    auto prompt = goOnPrompt(
        "Output is off. Free the participant of the device first. Why was the session aborted? "
        "Never a name.",
        PromptTo::Operator);
    prompt.name = kReasonPrompt;
    prompt.kind = PromptKind::Text;
    prompt.targets.clear();
    prompt.within = kReasonTimeout;
    const auto said = stage_.participant().ask(prompt);
    const auto reason = said && said->given ? std::string(said->key()) : std::string();
    auto kept = record.write(row::kNote, kReasonPrompt,
                             {{"reason", reason.empty() ? nlohmann::json(nullptr) : nlohmann::json(reason)}});
    if (!kept) return kept;
    return broken;
}

Result<void> PilotOutput::noteStop(const std::string& during, const Error& why) {
    if (why.code != ErrorCode::Stopped) return tl::unexpected<Error>(why);
    auto& record = stage_.record();
    const char* by = stops_.takeBy();
    if (by == nullptr || !isParticipants(by)) {
        const auto kept = record.write(row::kOperatorStop, during, {{"why", why.message}});
        return kept ? Result<void>(tl::unexpected<Error>(why)) : kept;
    }
    return noteParticipantStop(during, by);
}

Result<void> PilotOutput::noteParticipantStop(const std::string& during, const char* by) {
    auto& record = stage_.record();
    if (std::string_view(by) == kParticipantLetGo && stage_.participant().letGoWasBounce())
        return record.write(row::kPause, during, {{"why", "the contact of the button that is held bounced"}});
    if (auto kept = record.write(row::kParticipantStop, during, {{"by", by}}); !kept) return kept;
    if (record.count(row::kParticipantStop) < kMaxParticipantStops) return {};
    return stage_.end(PilotEnd::Stopped, kThirdStop);
}

/// After a fault: seats again, asks whether to continue, and measures again; ready() then reaches the levels again.
Result<void> PilotOutput::afterTheFault(const std::string& during, const Error& why) {
    auto& record = stage_.record();
    if (auto kept = record.write(row::kFault, during, {{"why", why.message}}); !kept) return kept;
    const bool slow = stage_.bench().telemetry().fault == FaultCause::LoopSilent;
    if (record.count(row::kFault) >= kMaxFaults)
        return stage_.end(PilotEnd::Stopped,
                          fmt::format("{}: {}", kSecondFault,
                                      slow ? "the computer was too slow for 0.1 s" : withoutFaultWord(why.message)));
    if (const char* by = stops_.takeBy(); by != nullptr && isParticipants(by)) {  // the participant also pressed STOP
        if (auto noted = noteParticipantStop(during, by); !noted) return noted;
    }
    auto cause = withoutNumbers(why.message);  // numbers may reveal the train to the participant; the row keeps them
    Result<void> reset;
    for (int tries = 1;; ++tries) {
        const auto known = stage_.bench().telemetry().causesCame;  // read first: `fault` has all that it counts
        const auto fault = stage_.bench().unitFault();
        if (const auto grave = fault ? graveCause(fault->causes) : std::nullopt)
            return endAfter(stage_, *grave, during, cause);
        if (tries > kSeatings) return reset;
        const bool computer = slow && tries == 1;
        if (auto seen = computer ? askAboutTheComputer() : askToSee(cause); !seen) return seen;
        reset = stage_.bench().resetFault(known);
        if (reset) break;
        cause = reset.error().message;  // its cause is still present, or another has come
    }
    electrodesTouched();
    ramp_.becomeDue();
    return askToGoOn(slow ? "after.slow" : "after.fault");
}

Result<void> PilotOutput::beginAnew(StopMark mark) {
    auto begun = stage_.bench().begin(mark);
    if (begun && runEnds_) return fail(ErrorCode::Stopped, "the run was stopped");
    return begun;
}

/// `key`: of the words that the participant reads.
Result<void> PilotOutput::askToGoOn(const char* key) {
    const auto& words = stage_.words();
    PilotScreen screen;
    screen.text = words.text(key);
    auto& bench = stage_.bench();
    for (;;) {
        stage_.participant().show(screen);
        const auto mark = bench.stops().mark();  // a stop after this mark comes after the participant's "go on"
        if (stopped()) {                         // another stop came while the last one was handled
            const Error why{ErrorCode::Stopped, "stopped before the participant was asked"};
            if (auto goesOn = interrupted("go on", why); !goesOn) return goesOn;
            continue;
        }
        const auto asked = stage_.participant().ask(goOnPrompt(screen.text, PromptTo::Participant, words));
        const auto begun = asked ? beginAnew(mark) : Result<void>(failure(asked));
        if (begun) break;
        // The output is off and the participant presses STOP again: the stop counts, and they are asked again.
        if (auto goesOn = interrupted("go on", begun.error()); !goesOn) return goesOn;
    }
    stage_.noteAnswered();
    return stage_.record().write(row::kContinue, "continue");
}

Result<void> LevelRamp::judged(double level, bool tooStrong, const std::string& trial, bool replayed) {
    if (level <= 0) return {};
    auto& bench = stage_.bench();
    if (tooStrong) {
        tooStrong_ = std::min(tooStrong_, level);
        auto reported = bench.reportDiscomfort(stage_.levelOf(level));
        stage_.rest();  // the output is armed again, with the lower limit, before the next presentation
        return reported;
    }
    accepted_.try_emplace(level, trial);
    return replayed ? Result<void>() : bench.accept(stage_.levelOf(level));
}

Result<void> LevelRamp::reach() {
    if (!due_) return {};
    due_ = false;
    const auto accepted = accepted_;
    // Each ramp has its own number, so that it never takes the answers of an earlier ramp.
    std::size_t number = 0;
    const auto named = [&number](double level) { return fmt::format("ramp {} {}", number, level); };
    while (!accepted.empty() && stage_.record().begun(named(accepted.begin()->first)) > 0) ++number;
    for (const auto& [level, first] : accepted) {
        if (level >= tooStrong_ || (settled_ && level > *settled_)) break;
        if (auto reached = presentAgain(named(level), level, first); !reached) return reached;
    }
    if (accepted.empty()) return {};
    PilotScreen letGo;  // the levels stop rising, so the participant may let go
    letGo.phase = "ascending";
    letGo.text = stage_.words().text("hold.let-go");
    stage_.participant().show(letGo);
    return {};
}

/// True if a higher level was accepted before, so that "too strong" may be a slip.
bool LevelRamp::isFarBelow(double level) const noexcept {
    return !accepted_.empty() && level <= AscendingLimits::kFarBelow * accepted_.rbegin()->first;
}

Result<void> LevelRamp::presentAgain(const std::string& name, double level, const std::string& first) {
    auto& bench = stage_.bench();
    StageTrial again;
    again.name = name;
    again.about = {{row::kRamp, true}};
    again.level = level;
    again.presentation = ascendingPresentation(stage_.levelOf(level), stage_.settings().shortest);
    again.prompt = strengthPrompt(stage_.words());
    again.screen.state = ScreenState::Feel;
    again.screen.phase = "ascending";
    again.held = true;
    again.counts = false;   // a resumed session then continues like an undisturbed session
    again.drawnAs = first;  // a virtual participant answers as before about the same level
    auto answer = stage_.trial(again);
    if (answer && answer->response == row::kTooStrong && isFarBelow(level)) {
        const auto meant = stage_.meantTooStrong(name);
        if (!meant) return failure(meant);
        if (!*meant) {
            if (auto held = stage_.answeredFor(tooStrongHold(name)); !held) return held;
            again.name += " again";
            answer = stage_.trial(again);
        }
    }
    if (!answer) return failure(answer);
    if (answer->response == row::kTooStrong) {
        if (auto reported = bench.reportDiscomfort(stage_.levelOf(level)); !reported) return reported;
        return stage_.end(PilotEnd::Stopped, tooStrongNow(textOf(stage_.levelOf(level))));
    }
    return bench.accept(stage_.levelOf(level));
}

}  // namespace tacto
