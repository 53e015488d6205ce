#include "core/pilot/PilotCare.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/analysis/psychophysics/VirtualObserver.h"
#include "core/base/JsonText.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/Random.h"
#include "core/study/NextDay.h"

namespace tacto {

namespace {

constexpr Seconds kBetweenChecks{30};
constexpr double kChecksAgree = 0.2;  // two checks, 30 s apart, agree within 20 %
constexpr double kBlocksAgree = 0.3;  // impedance before a block or on a resume: within 30 % of the first
constexpr int kSkinEnds = 2;          // score of erythema or oedema that ends the session
constexpr std::chrono::milliseconds kStopIn{10};
constexpr int kIntroduction = 3;  // pages
constexpr int kStopTries = 3;     // how often a test is repeated if the other person's STOP is pressed

constexpr Word<int> kSkinKeys[] = {{"0", 0}, {"1", 1}, {"2", 2}, {"3", 3}, {"4", 4}};

double inMs(std::chrono::nanoseconds time) { return std::chrono::duration<double, std::milli>(time).count(); }

constexpr std::string_view kQualities[] = {"touch",    "pressure", "tapping",   "vibration", "tingling",
                                           "pricking", "burning",  "twitching", "phantom"};

/// Returns a target for each key, with its text in `group` of the words.
std::vector<PromptTarget> targetsOf(const ParticipantWords& words, std::string_view group,
                                    std::span<const std::string_view> keys) {
    std::vector<PromptTarget> out;
    for (const auto key : keys) out.push_back({std::string(key), words.text(group, key, key)});
    return out;
}

/// A scale with its question and the words at its ends.
PilotPrompt anchored(const ParticipantWords& words, const std::string& name, int least, int most,
                     const std::string& effect = {}) {
    auto prompt = scalePrompt(name, words.text(name + ".question", {{"effect", effect}}), least, most);
    prompt.leastText = words.text(name + ".least");
    prompt.mostText = words.text(name + ".most");
    return prompt;
}

PilotPrompt severalPrompt(std::string name, std::string text, std::vector<PromptTarget> offered) {
    PilotPrompt prompt = choicePrompt(std::move(name), std::move(text), std::move(offered));
    prompt.kind = PromptKind::Several;
    return prompt;
}

PilotPrompt skinPrompt(const std::string& what, const std::string& words) {
    std::vector<PromptTarget> scores;
    for (const auto& score : kSkinKeys)
        scores.push_back({std::string(score.text), fmt::format("{} {}", score.text, kSkinScores[score.value])});
    return choicePrompt(what, words, std::move(scores), PromptTo::Operator);
}

}  // namespace

std::string machineLacks(const DeviceSet& devices, const Profile& profile, LevelUnit unit) {
    if (unit == LevelUnit::Intensity) {
        if (devices.stimulator) return "a stimulator is connected; a massager alone is expected";
        if (!devices.massager) return "no massager is connected; one is expected";
        const double step = devices.massager->step();
        if (step >= 0 && step <= kIntensityStep) return {};
        return fmt::format("the massager tells intensities apart that are {:.2g} from each other; {} is expected", step,
                           kIntensityStep);
    }
    if (!devices.stimulator) return "no stimulator is connected; a current source is expected";
    if (devices.stimulator->traits().drive != Drive::Current)
        return "the stimulator is a voltage source; a current source is expected";
    if (profile.encoding.train.shape == PulseShape::Monophasic)
        return "the study's train is monophasic; a biphasic one is expected";
    if (!profile.electrodeArea) return "the area of the electrodes is not stated; one in cm² is expected";
    return {};
}

PilotCare::PilotCare(PilotStage& stage) : stage_(stage) {
    stage_.onSeatedAgain([this]() -> Result<void> {
        // If nothing was measured before, the checklist will do this.
        if (stage_.settings().unit == LevelUnit::Intensity || firstImpedance() == nullptr) return {};
        return asAtFirst(fmt::format("seated again, {}", stage_.record().count(row::kImpedance)));
    });
    stage_.afterCare = [this]() -> Result<void> {
        const auto looked = skin("after");
        const auto asked = sideEffects("after");  // always asked, whatever the skin is like
        return looked ? asked : looked;
    };
}

std::string PilotCare::part() const { return fmt::format("part {}", stage_.record().count(row::kResumed) + 1); }

/// Returns the first impedance measured in any part of the session, or null. A pair of checks that disagreed is no
/// measurement.
const nlohmann::json* PilotCare::firstImpedance() const {
    const auto& record = stage_.record();
    const auto parts = record.count(row::kResumed) + 1;
    for (std::size_t n = 1; n <= parts; ++n) {
        const auto* judged = record.find(row::kGate, fmt::format("part {} impedance", n));
        if (judged != nullptr && !flagOr(*judged, "holds")) continue;
        if (const auto* found = record.find(row::kImpedance, fmt::format("part {} second", n))) return found;
    }
    return nullptr;
}

Result<void> PilotCare::gate(const std::string& name, bool holds, const std::string& sentence) {
    nlohmann::json body{{"holds", holds}, {"said", holds ? "" : sentence}};
    if (!holds) body[row::kEnds] = true;
    if (auto kept = stage_.record().write(row::kGate, name, std::move(body)); !kept) return kept;
    return holds ? Result<void>() : stage_.end(PilotEnd::Stopped, sentence);
}

Result<void> PilotCare::checklist() {
    if (auto held = machine(); !held) return held;
    for (const auto& each : stage_.settings().holds) {
        if (auto answered = stage_.answeredFor(each); !answered) return answered;
    }
    if (auto read = introduce(); !read) return read;
    for (const auto by : {PromptTo::Participant, PromptTo::Operator}) {
        if (auto held = stopTest(by); !held) return held;
    }
    if (auto held = skin("before"); !held) return held;
    return stage_.settings().unit == LevelUnit::Current ? electrodes() : massager();
}

Result<void> PilotCare::machine() {
    auto& bench = stage_.bench();
    const auto unit = stage_.settings().unit;
    auto missing = machineLacks(bench.devices(), bench.profile(), unit);
    if (missing.empty() && bench.mode() != OutputMode::Person) missing = "the bench was not opened for a participant";
    return gate(part() + " machine", missing.empty(), missing + ". Nothing was presented");
}

Result<void> PilotCare::introduce() {
    PilotScreen screen;  // from here on a stop is the session's
    screen.phase = "checklist";
    stage_.participant().show(screen);
    for (int page = 1; page <= kIntroduction; ++page) {
        const auto name = fmt::format("introduction {}", page);
        const auto text = stage_.words().text(fmt::format("introduction.{}", page));
        const auto read = stage_.ask(row::kPhase, name, goOnPrompt(text, PromptTo::Participant, stage_.words()));
        if (!read) return failure(read);
    }
    return {};
}

/// Tests one STOP: it must switch the output off in time. If the other person's STOP was pressed instead, asks again.
Result<void> PilotCare::stopTest(PromptTo by) {
    const auto name = fmt::format("{} {}", part(), nameOf(by));
    const auto other = by == PromptTo::Participant ? PromptTo::Operator : PromptTo::Participant;
    std::optional<PilotStage::PressedStop> pressed;
    bool theirs = false, armed = true;
    std::string before;  // why the operator is asked again
    for (int asked = 0; asked < kStopTries && !theirs;) {
        if (auto ready = stage_.arm(); !ready) return ready;
        const bool theirOwn = by == PromptTo::Participant;
        auto prompt = goOnPrompt(theirOwn ? stage_.words().text("stop-test.question")
                                          : before + "Press STOP now: the operator's is being tested.",
                                 by);
        prompt.name = "stop-test";
        PilotScreen screen;  // the test itself begins: a stop from here on is the test's
        screen.phase = "checklist";
        screen.text = prompt.text;
        stage_.participant().show(screen);
        const auto answered = stage_.participant().ask(prompt);
        pressed = stage_.takeStop();
        const auto mark = stage_.bench().stops().mark();  // a stop after this mark does not belong to the test
        armed = stage_.isArmed();
        if (!answered && !pressed) {  // an abort, a lost screen or the end of the program: not a test
            if (auto goesOn = stage_.goOnAfter("stop-test", answered.error()); !goesOn) return goesOn;
            continue;
        }
        ++asked;
        if (answered) pressed.reset();
        const bool own = pressed && pressed->participants == (by == PromptTo::Participant);
        theirs = own && armed;
        before = pressed && !own ? "That was the participant's STOP. " : !armed ? "The output was off already. " : "";
        stage_.rest();
        nlohmann::json body{{"by", nameOf(by)}, {"pressed", theirs}, {"off_ms", theirs ? inMs(pressed->took) : kNaN}};
        if (pressed && !own) body["other"] = nameOf(other);
        if (!armed) body["armed"] = false;
        if (auto kept = stage_.record().write(row::kStopTest, name, std::move(body)); !kept) return kept;
        auto begun = stage_.beginAnew(mark);
        if (begun && stage_.stopped()) begun = fail(ErrorCode::Stopped, "stopped after the test");
        if (!begun) {
            if (auto goesOn = stage_.goOnAfter("stop-test", begun.error()); !goesOn) return goesOn;
        }
        screen.text.clear();
        stage_.participant().show(screen);  // the screen forgets the stop of the test
        if (!pressed) break;
    }
    return gate(name + " stop", theirs && pressed->took <= kStopIn,
                theirs ? fmt::format("the {}'s STOP took {:.1f} ms to switch off; at most 10 ms are accepted",
                                     nameOf(by), inMs(pressed->took))
                : !armed
                    ? fmt::format("the output was off when the {}'s STOP was tested, {} times", nameOf(by), kStopTries)
                : pressed ? fmt::format("in the test of the {}'s STOP the {}'s was pressed, {} times", nameOf(by),
                                        nameOf(other), kStopTries)
                          : fmt::format("the {}'s STOP was not pressed in its test", nameOf(by)));
}

Result<void> PilotCare::electrodes() {
    const bool resumed = stage_.record().isResumed();
    auto lot = choicePrompt("electrode-lot", "Lot of the new pair of electrodes", {}, PromptTo::Operator);
    lot.kind = PromptKind::Text;
    const auto noted = stage_.ask(row::kGate, "electrode lot", lot);
    if (!noted) return failure(noted);
    // The new value is compared with the first; without a first value, the electrodes may have been fitted since.
    const auto* begun = resumed ? firstImpedance() : nullptr;
    const double before = begun != nullptr ? numberOr(*begun, "impedance_ohm") : kNaN;
    if (begun != nullptr) {
        auto untouched = mustHold("electrodes", "electrodes-untouched", "Were the electrodes left untouched?",
                                  "the electrodes were touched since the last answer, which ends a session");
        if (!untouched) return untouched;
    }
    const auto second = checkedTwice();
    if (!second) return failure(second);
    if (std::isnan(before)) return {};
    return gate(
        part() + " impedance since", std::abs(*second - before) / before <= kBlocksAgree,
        fmt::format("the electrodes measure {:.0f} ohm after {:.0f} ohm; a change of at most 30 % is accepted, so "
                    "the session ends",
                    *second, before));
}

/// Runs both checks; if they disagree, has the electrodes seated again and repeats both checks.
Result<double> PilotCare::checkedTwice() {
    const auto name = part() + " impedance";
    for (int tries = 1;; ++tries) {
        const auto first = stage_.measureImpedance(part() + " first");
        if (!first) return failure(first);
        PilotScreen waits;
        waits.phase = "checklist";
        waits.text = stage_.words().text("checking.electrodes");
        waits.operatorText = "Waiting 30 s between the two checks of the electrodes";
        waits.operatorMayKnow = true;
        waits.until = stage_.bench().clock().now() + toInstant(kBetweenChecks);
        stage_.participant().show(waits);
        if (auto passed = stage_.pass(kBetweenChecks); !passed) return failure(passed);
        const auto second = stage_.measureImpedance(part() + " second");
        if (!second) return failure(second);
        const bool agree = std::abs(*second - *first) / *first <= kChecksAgree;
        const auto sentence = fmt::format(
            "the electrodes measured {:.0f} and {:.0f} ohm within 30 s; a difference of at most 20 % is accepted",
            *first, *second);
        if (agree || tries == PilotStage::kSeatings) {
            if (auto held = gate(name, agree, sentence); !held) return failure(held);
            return *second;
        }
        if (auto seated = stage_.seatAgain(name, sentence); !seated) return failure(seated);
    }
}

/// Asks for masking noise, since a motor is audible, and for an untouched massager, since its place sets its strength.
Result<void> PilotCare::massager() {
    if (stage_.record().isResumed()) {
        auto untouched = mustHold("massager-untouched", "massager-untouched", "Was the massager left where it was?",
                                  "the massager was moved since the last answer, which ends a session");
        if (!untouched) return untouched;
    }
    return mustHold("masking-noise", "masking-noise", "Does the participant hear masking noise on earphones?",
                    "the participant hears the motor without masking noise on earphones, so there is no session");
}

/// Asks the operator once in each part; a "no" ends the session.
Result<void> PilotCare::mustHold(const std::string& name, const char* asked, const char* question,
                                 const char* sentence) {
    auto prompt = yesNoPrompt(asked, question, PromptTo::Operator);
    prompt.noEnds = sentence;
    const auto said = stage_.ask(row::kGate, part() + " " + name, prompt);
    if (!said) return failure(said);
    return textOr(*said, "key") == "yes" ? Result<void>() : stage_.end(PilotEnd::Stopped, sentence);
}

Result<void> PilotCare::beforeBlock(int block) {
    if (stage_.settings().unit == LevelUnit::Intensity) return {};
    const auto name = fmt::format("block {}", block);
    const auto* judged = stage_.record().find(row::kGate, name + " impedance");
    return judged != nullptr && flagOr(*judged, "holds") ? Result<void>() : asAtFirst(name);
}

/// If the impedance differs from the first, has the electrodes seated again; a ramp then reaches the levels again.
Result<void> PilotCare::asAtFirst(const std::string& name) {
    const auto* begun = firstImpedance();
    const double before = begun != nullptr ? numberOr(*begun, "impedance_ohm") : kNaN;
    for (int tries = 1;; ++tries) {
        const auto now = stage_.measureImpedance(name);
        if (!now) return failure(now);
        const bool holds = std::abs(*now - before) / before <= kBlocksAgree;
        const auto sentence = fmt::format(
            "the electrodes measure {:.0f} ohm after {:.0f} ohm; a change of at most 30 % is accepted", *now, before);
        if (holds) return gate(name + " impedance", true, sentence);
        if (tries == PilotStage::kSeatings) return gate(name + " impedance", false, sentence + ", so the session ends");
        if (auto seated = stage_.seatAgain(name + " impedance", sentence); !seated) return seated;
    }
}

Result<void> PilotCare::skin(const std::string& moment) {
    stage_.rest();  // the electrodes or the massager may be taken off now
    int worst = 0;
    for (const auto& [what, words] :
         {std::pair{"erythema", "Redness of the skin"}, std::pair{"oedema", "Swelling of the skin"}}) {
        const auto said = stage_.ask(row::kSkin, moment + " " + what, skinPrompt(what, words));
        if (!said) return failure(said);
        const auto score = valueFor(kSkinKeys, textOr(*said, "key"));
        if (!score) return invalid("{}: {} is not a score; 0 to 4 is expected", what, dumpJson(*said));
        worst = std::max(worst, *score);
    }
    if (const auto* judged = stage_.record().find(row::kGate, "skin " + moment)) {
        return flagOr(*judged, "holds") ? Result<void>() : stage_.end(PilotEnd::Stopped, textOr(*judged, "said"));
    }
    const int most = moment == "before" ? 0 : kSkinEnds - 1;
    if (worst >= kSkinEnds) {
        if (stage_.record().find(row::kAdverseEvent, "skin " + moment) == nullptr) {
            auto kept = stage_.record().write(row::kAdverseEvent, "skin " + moment, {{"score", worst}});
            if (!kept) return kept;
        }
        if (skinReacted) {
            if (auto told = skinReacted(moment, worst); !told) return told;
        }
    }
    return gate(
        "skin " + moment, worst <= most,
        fmt::format("the skin scores {} ({}); at most {} is accepted, so the session ends", worst, moment, most));
}

Result<void> PilotCare::ratings(const std::vector<PresentedCondition>& conditions) {
    std::vector<std::size_t> order(conditions.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    Random random(stage_.settings().seed, "order of ratings");
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    for (const auto index : order) {
        const auto& condition = conditions[index];
        StageTrial trial;
        trial.name = "rating " + condition.name;
        trial.about = {{"condition", condition.name}};
        trial.level = condition.level;
        trial.presentation =
            testPresentation(stage_.levelOf(condition.level), condition.interval, stage_.settings().window);
        trial.asks = false;
        trial.screen.state = ScreenState::Feel;
        trial.screen.phase = "ratings";
        const auto felt = stage_.trial(trial);
        if (!felt) return failure(felt);
        std::vector<std::string_view> natural;
        for (const auto& word : kNaturalness) natural.push_back(word.text);
        const auto& words = stage_.words();
        const PilotPrompt prompts[] = {
            anchored(words, "intensity", 0, 10), anchored(words, "unpleasantness", 0, 10),
            anchored(words, "pain", 0, 10),
            choicePrompt("naturalness", words.text("naturalness.question"), targetsOf(words, "naturalness", natural)),
            severalPrompt("qualities", words.text("qualities.question"), targetsOf(words, "qualities", kQualities))};
        for (const auto& prompt : prompts) {
            const auto name = condition.name + " " + prompt.name;
            const bool replayed = stage_.record().find(row::kRating, name) != nullptr;
            const auto said = stage_.ask(row::kRating, name, prompt);
            if (!said) return failure(said);
            const auto pain = replayed ? std::nullopt : painHold(*said, stage_.settings().painCeiling);
            if (pain) {
                if (auto answered = stage_.answeredFor(*pain); !answered) return answered;
            }
        }
    }
    return compareEncodings();
}

/// The targets say when the participant had each encoding; the record keeps the encodings' names.
Result<void> PilotCare::compareEncodings() {
    const auto& settings = stage_.settings();
    if (settings.earlierEncoding.empty()) return {};
    const auto& words = stage_.words();
    const std::vector<PromptTarget> offered = {{settings.encoding, words.text("encodings.today")},
                                               {settings.earlierEncoding, words.text("encodings.earlier")},
                                               {row::kNoDifference, words.text("encodings.no-difference")}};
    for (const char* item : {row::kEasier, row::kMoreLikeTouch}) {
        const auto text = words.text(row::kEncodings, item, item);
        const auto name = fmt::format("{} {}", row::kEncodings, item);
        const auto said = stage_.ask(row::kRating, name, choicePrompt(name, text, offered));
        if (!said) return failure(said);
    }
    return {};
}

Result<void> PilotCare::sideEffects(const std::string& moment) {
    stage_.rest();
    std::vector<PromptTarget> offered;
    const auto& words = stage_.words();
    for (const auto& effect : kSideEffects)
        offered.push_back({effect.key, words.text("effects", effect.key, effect.text)});
    const auto noticed = stage_.ask(row::kSideEffect, moment,
                                    severalPrompt("side-effects", words.text("effects.question"), std::move(offered)));
    if (!noticed) return failure(noticed);
    for (const auto& key : textsOr(*noticed, "keys")) {
        const auto effect = words.text("effects", key, key);
        const auto severity =
            stage_.ask(row::kSideEffect, fmt::format("{} {} severity", moment, key),
                       anchored(words, "severity", 1, static_cast<int>(std::size(kSideEffectSeverities)), effect));
        if (!severity) return failure(severity);
        const auto relation =
            stage_.ask(row::kSideEffect, fmt::format("{} {} relation", moment, key),
                       anchored(words, "relation", 1, static_cast<int>(std::size(kRelations)), effect));
        if (!relation) return failure(relation);
    }
    return {};
}

}  // namespace tacto
